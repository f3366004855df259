//! Text as it stands in a stream.

use core::fmt;

use super::CncStr;
use crate::bytes::{Writer, split_nul};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};

/// A text field with its end: one NUL, a NUL and more bytes, or no NUL at all.
///
/// Only the text counts; the end is kept so that a decoded stream encodes to the same bytes.
/// [`TextRef::new`] and the conversion from [`CncStr`] give the canonical end, one NUL.
///
/// ```
/// use ads_cnc::{Decode, VariableNameRef};
///
/// let padded = VariableNameRef::decode(b"V.E.a\0\0\0")?;
/// assert_eq!(padded.name.text(), "V.E.a");
/// assert_eq!(padded.name.tail(), Some(&[0, 0][..]));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct TextRef<'a> {
    text: CncStr<'a>,
    tail: Option<&'a [u8]>,
}

impl<'a> TextRef<'a> {
    /// The text of a Rust string, ended by one NUL.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(text: &'a str) -> Result<Self, Error> {
        Ok(CncStr::new(text)?.into())
    }

    /// Text with another end: the bytes behind the NUL, or no NUL.
    pub const fn with_tail(text: CncStr<'a>, tail: Option<&'a [u8]>) -> Self {
        Self { text, tail }
    }

    /// All bytes of a field.
    pub(crate) fn split(field: &'a [u8]) -> Self {
        match split_nul(field) {
            Some((text, tail)) => Self { text: CncStr::without_nul(text), tail: Some(tail) },
            None => Self { text: CncStr::without_nul(field), tail: None },
        }
    }

    /// The text.
    pub const fn text(&self) -> CncStr<'a> {
        self.text
    }

    /// The bytes behind the first NUL; none if there is no NUL.
    pub const fn tail(&self) -> Option<&'a [u8]> {
        self.tail
    }

    /// Bytes of the field, NUL and tail included.
    pub fn field_len(&self) -> usize {
        let end = self.tail.map_or(0, |tail| tail.len().saturating_add(1));
        self.text.len().saturating_add(end)
    }

    pub(crate) fn write(&self, out: &mut Writer<'_>) {
        self.text.write(out);
        if let Some(tail) = self.tail {
            out.put(&[0]);
            out.put(tail);
        }
    }

    /// The field as all of a stream.
    #[inline]
    pub(crate) fn encode<'b>(self, stream: Stream, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::run(stream, self.field_len(), buf, |out| self.write(out))
    }

    /// Whether the field may stand at the end of a request: a NUL, and only NULs behind it.
    pub(crate) fn check_terminated(&self, field: Field, at: u32, max: u32) -> Result<(), Error> {
        let len = crate::bytes::to_u32(self.field_len());
        if len > max {
            return Err(Error::new(ErrorKind::TooLong, field, at, max, len));
        }
        match self.tail {
            Some(_) => self.check_padding(field, at),
            None => Err(Error::new(ErrorKind::MissingNul, field, at, max, len)),
        }
    }

    /// As [`check_terminated`](Self::check_terminated), but the NUL may be missing.
    pub(crate) fn check_may_terminate(&self, field: Field, at: u32, max: u32) -> Result<(), Error> {
        self.check_open(field, at, 1, max)?;
        self.check_padding(field, at)
    }

    /// Whether the field has between `min` and `max` bytes.
    pub(crate) fn check_open(
        &self,
        field: Field,
        at: u32,
        min: u32,
        max: u32,
    ) -> Result<(), Error> {
        match crate::bytes::to_u32(self.field_len()) {
            len if len < min => Err(Error::new(ErrorKind::Truncated, field, at, min, len)),
            len if len > max => Err(Error::new(ErrorKind::TooLong, field, at, max, len)),
            _ => Ok(()),
        }
    }

    /// Behind the NUL, if there is one, only NULs.
    fn check_padding(&self, field: Field, at: u32) -> Result<(), Error> {
        let tail = self.tail.unwrap_or_default();
        let padding = tail.iter().take_while(|&&byte| byte == 0).count();
        if padding == tail.len() {
            return Ok(());
        }
        let used = self.text.len().saturating_add(padding).saturating_add(1);
        let end = at.saturating_add(crate::bytes::to_u32(used));
        let given = at.saturating_add(crate::bytes::to_u32(self.field_len()));
        Err(Error::new(ErrorKind::Trailing, Field::whole(field.stream()), end, end, given))
    }
}

impl<'a> From<CncStr<'a>> for TextRef<'a> {
    fn from(text: CncStr<'a>) -> Self {
        Self { text, tail: Some(&[]) }
    }
}

/// The text, and its end where that is not one NUL.
impl fmt::Debug for TextRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.text, f)?;
        match self.tail {
            Some([]) => Ok(()),
            Some(tail) if tail.iter().all(|&byte| byte == 0) => {
                write!(f, " and {} NULs more", tail.len())
            }
            Some(tail) => write!(f, " and {tail:02x?}"),
            None => f.write_str(" without NUL"),
        }
    }
}
