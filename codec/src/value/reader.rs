//! Decoding of content whose layout only the application knows.

use zerocopy::{FromBytes as _, FromZeros as _};

use super::Scalar;
use crate::bytes::{self, to_u32};
use crate::content::ContentRef;
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::text::TextRef;

/// The field with the bytes of a content, for errors.
const CONTENT: Field = Field::of::<ContentRef<'static>>("content");

/// Reads the members of a structure in sequence, without a panic and without an allocation.
///
/// Use it to implement [`Decode`](crate::Decode) for an object or element whose type is a structure of
/// your application. The error for a missing member has the field `content` of the stream `content`
/// and the offset of the member.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.2 and 2.2.2.
///
/// ```
/// use ads_cnc::layout::Stream;
/// use ads_cnc::value::Reader;
/// use ads_cnc::{Decode, Error};
///
/// #[derive(Debug, PartialEq)]
/// struct Position {
///     axis: u16,
///     position: f64,
/// }
///
/// impl<'a> Decode<'a> for Position {
///     const STREAM: Stream = Stream::Content;
///
///     fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
///         let mut input = Reader::new(bytes);
///         let position = Self { axis: input.read()?, position: input.read()? };
///         input.finish()?;
///         Ok(position)
///     }
/// }
///
/// let position = Position::decode(b"\x02\0\0\0\0\0\0\0\xf8\x3f")?;
/// assert_eq!(position, Position { axis: 2, position: 1.5 });
/// assert_eq!(
///     Position::decode(&[2, 0, 0, 0]).unwrap_err().to_string(),
///     "content: content at offset 2: truncated, expected 8 bytes, found 2"
/// );
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug)]
pub struct Reader<'a>(bytes::Reader<'a>);

impl<'a> Reader<'a> {
    /// Creates a reader at the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes::Reader::without_limit(Stream::Content, bytes))
    }

    /// Reads the next number or BOOLEAN.
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if fewer bytes remain.
    pub fn read<T: Scalar>(&mut self) -> Result<T, Error> {
        let bytes = self.bytes(size_of::<T::Wire>())?;
        // This cannot fail, because the bytes have the length of the type.
        let wire = T::Wire::read_from_bytes(bytes).unwrap_or_else(|_| T::Wire::new_zeroed());
        Ok(T::from_wire(wire))
    }

    /// Reads the next `count` bytes.
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if fewer bytes remain.
    pub fn bytes(&mut self, count: usize) -> Result<&'a [u8], Error> {
        self.0.take(CONTENT, to_u32(count))
    }

    /// Reads the text in the next `size` bytes, up to its first NUL or to the last byte.
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if fewer bytes remain.
    pub fn text(&mut self, size: usize) -> Result<TextRef<'a>, Error> {
        self.bytes(size).map(TextRef::split)
    }

    /// Reads all remaining bytes.
    pub fn rest(&mut self) -> &'a [u8] {
        self.0.take_all()
    }

    /// Checks that no bytes remain.
    ///
    /// # Errors
    /// [`ErrorKind::Trailing`](crate::ErrorKind::Trailing) if bytes remain.
    pub fn finish(self) -> Result<(), Error> {
        self.0.finish()
    }
}

/// Creates an error for content whose layout only the application knows, for the application's
/// implementations of [`Decode`](crate::Decode) and [`Encode`](crate::Encode).
///
/// ```
/// use ads_cnc::layout::Stream;
/// use ads_cnc::value::{Reader, content_error};
/// use ads_cnc::{Decode, Error, ErrorKind};
///
/// #[derive(Debug, PartialEq)]
/// enum Mode {
///     Manual,
///     Automatic,
/// }
///
/// impl<'a> Decode<'a> for Mode {
///     const STREAM: Stream = Stream::Content;
///
///     fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
///         let mut input = Reader::new(bytes);
///         let mode: u16 = input.read()?;
///         input.finish()?;
///         match mode {
///             0 => Ok(Self::Manual),
///             1 => Ok(Self::Automatic),
///             other => Err(content_error(ErrorKind::OutOfRange, 0, 1, other.into())),
///         }
///     }
/// }
///
/// assert_eq!(Mode::decode(&[1, 0]), Ok(Mode::Automatic));
/// assert_eq!(
///     Mode::decode(&[2, 0]).unwrap_err().to_string(),
///     "content: content at offset 0: out of range, expected at most 1, found 2"
/// );
/// ```
pub const fn content_error(kind: ErrorKind, offset: u32, expected: u32, found: u32) -> Error {
    Error::new(kind, CONTENT, offset, expected, found)
}
