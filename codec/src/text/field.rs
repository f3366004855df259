//! Text as a field of a stream.

use core::fmt;

use super::CncStr;
use super::end::{not_padded, split_nul};
use crate::bytes::{Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::Field;

/// A text field with its end: one NUL, a NUL and further bytes, or no NUL.
///
/// The end is kept so that a decoded stream encodes to the same bytes. Two fields are equal if both
/// texts and both ends are equal. [`TextRef::new`] and the conversion from [`CncStr`] create the
/// canonical end: one NUL.
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
    /// A field with the text of a Rust string and one NUL.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(text: &'a str) -> Result<Self, Error> {
        Ok(CncStr::new(text)?.into())
    }

    /// A field with a text and the bytes after its NUL; `None` for a text without a NUL.
    #[inline]
    pub const fn with_tail(text: CncStr<'a>, tail: Option<&'a [u8]>) -> Self {
        Self { text, tail }
    }

    /// Splits all bytes of a field into text and tail.
    #[inline]
    pub(crate) fn split(field: &'a [u8]) -> Self {
        match split_nul(field) {
            Some((text, tail)) => Self { text: CncStr::without_nul(text), tail: Some(tail) },
            None => Self { text: CncStr::without_nul(field), tail: None },
        }
    }

    /// The text.
    #[inline]
    pub const fn text(&self) -> CncStr<'a> {
        self.text
    }

    /// The bytes after the first NUL; `None` if there is no NUL.
    #[inline]
    pub const fn tail(&self) -> Option<&'a [u8]> {
        self.tail
    }

    /// The length of the field in bytes, including NUL and tail.
    #[inline]
    pub fn field_len(&self) -> usize {
        let end = self.tail.map_or(0, |tail| tail.len().saturating_add(1));
        self.text.len().saturating_add(end)
    }

    #[inline]
    pub(crate) fn write(&self, out: &mut Writer<'_>) {
        self.text.write(out);
        if let Some(tail) = self.tail {
            out.nul_and(tail);
        }
    }

    /// Checks a field at the end of a request, which must end in one or more NULs; returns its length.
    pub(crate) fn check_cstring(&self, field: Field, at: u32, max: u32) -> Result<usize, Error> {
        let len = self.field_len();
        if len > to_usize(max) {
            return Err(Error::new(ErrorKind::TooLong, field, at, max, to_u32(len)));
        }
        match self.tail {
            Some(tail) => self.check_padding(tail, field, at)?,
            None => {
                return Err(Error::new(ErrorKind::MissingNul, field, at, max, to_u32(len)));
            }
        }
        Ok(len)
    }

    /// Like [`check_cstring`](Self::check_cstring), but the NUL may be missing.
    #[inline]
    pub(crate) fn check_optional_nul(
        &self,
        field: Field,
        at: u32,
        max: u32,
    ) -> Result<usize, Error> {
        let len = self.check_text_and_tail(field, at, 1, max)?;
        self.check_padding(self.tail.unwrap_or_default(), field, at)?;
        Ok(len)
    }

    /// Checks a field of `min` to `max` bytes; returns its length.
    pub(crate) fn check_text_and_tail(
        &self,
        field: Field,
        at: u32,
        min: u32,
        max: u32,
    ) -> Result<usize, Error> {
        let len = self.field_len();
        if len < to_usize(min) {
            return Err(Error::new(ErrorKind::Truncated, field, at, min, to_u32(len)));
        }
        if len > to_usize(max) {
            return Err(Error::new(ErrorKind::TooLong, field, at, max, to_u32(len)));
        }
        Ok(len)
    }

    /// Checks that all bytes after the first NUL, the `tail`, are NULs.
    #[inline]
    fn check_padding(&self, tail: &[u8], field: Field, at: u32) -> Result<(), Error> {
        if tail.iter().all(|&byte| byte == 0) {
            Ok(())
        } else {
            Err(not_padded(field, at, self.text.len(), tail))
        }
    }
}

#[cfg(feature = "alloc")]
impl TextRef<'_> {
    /// Copies the text and its end.
    pub fn to_owned(&self) -> super::Text {
        (*self).into()
    }
}

impl<'a> From<CncStr<'a>> for TextRef<'a> {
    fn from(text: CncStr<'a>) -> Self {
        Self { text, tail: Some(&[]) }
    }
}

/// Displays the text, without its end.
impl fmt::Display for TextRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.text, f)
    }
}

/// Formats the text, and also its end unless the end is exactly one NUL.
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
