//! The one error of the crate.

use core::fmt;

use crate::layout::Field;

/// What is wrong, in which field, where, what was expected and what was there.
///
/// `Copy` and 16 bytes. The text is the same in every feature set:
///
/// ```
/// use ads_cnc::{Decode, DescriptionRef};
///
/// let error = DescriptionRef::decode(&[2, 0, 0, 2, 1, 0]).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "variable-description: type at offset 4: truncated, 4 bytes expected, 2 there"
/// );
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, thiserror::Error)]
pub struct Error {
    kind: ErrorKind,
    field: Field,
    offset: u32,
    expected: u32,
    found: u32,
}

/// The class of an [`Error`]; says what its two numbers mean.
///
/// ```
/// use ads_cnc::{Decode, ErrorKind, Handle};
///
/// let error = Handle::decode(&[4, 0, 0, 2, 0]).unwrap_err();
/// assert_eq!(error.kind(), ErrorKind::Trailing);
/// assert_eq!((error.expected(), error.found()), (4, 5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The stream ends inside the field: bytes the field needs, bytes there.
    Truncated,
    /// Bytes follow where nothing may: length of the stream proper, length given.
    Trailing,
    /// More bytes than the field or stream may have: the limit, the length.
    TooLong,
    /// A count that does not fit: the most that fits, the count.
    TooMany,
    /// No NUL ends the text: bytes the text may have with its NUL, bytes there.
    MissingNul,
    /// A NUL inside the text: its place in the text (found); expected is 0.
    InnerNul,
    /// A character without a CP1252 byte: its code point (found); expected is 0.
    NotCp1252,
    /// A character that is no decimal digit: its code point (found); expected is 0.
    NotDecimal,
    /// A number without digits or with too many: the most, how many.
    Digits,
    /// A character where another has to stand: its code point (found); expected is 0.
    Unexpected,
    /// What has to be there is not; both numbers are 0.
    Missing,
    /// A value outside its range: the nearest value allowed, the value.
    OutOfRange,
    /// A value that has to equal another: that one, the value.
    Mismatch,
    /// An index offset at which there is a function, where content was meant: the offset (found);
    /// expected is 0.
    Function,
    /// The buffer does not hold the encoded stream: bytes needed, bytes there.
    BufferTooSmall,
}

impl Error {
    pub(crate) const fn new(
        kind: ErrorKind,
        field: Field,
        offset: u32,
        expected: u32,
        found: u32,
    ) -> Self {
        Self { kind, field, offset, expected, found }
    }

    /// The same error in a stream that begins at this offset.
    #[cfg(feature = "binrw")]
    pub(crate) const fn moved(self, by: u32) -> Self {
        Self { offset: self.offset.saturating_add(by), ..self }
    }

    /// The class of the error.
    pub const fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The field that is wrong; tells the stream too.
    pub const fn field(&self) -> Field {
        self.field
    }

    /// Where the fault is, in bytes from the start of the stream.
    ///
    /// What is not read from a stream counts what it is made of, and says so where it is made:
    /// characters of a text, a name or a version, numbers of a NetId, places of indices.
    pub const fn offset(&self) -> u32 {
        self.offset
    }

    /// What was expected; the unit is that of [`ErrorKind`].
    pub const fn expected(&self) -> u32 {
        self.expected
    }

    /// What was there; the unit is that of [`ErrorKind`].
    pub const fn found(&self) -> u32 {
        self.found
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, field, offset, expected, found } = *self;
        write!(f, "{field} at offset {offset}: ")?;
        match kind {
            ErrorKind::Truncated => {
                write!(f, "truncated, {expected} bytes expected, {found} there")
            }
            ErrorKind::Trailing => {
                write!(f, "trailing bytes, {expected} bytes expected, {found} there")
            }
            ErrorKind::TooLong => {
                write!(f, "too long, at most {expected} bytes expected, {found} there")
            }
            ErrorKind::TooMany => {
                write!(f, "too many, at most {expected} expected, {found} found")
            }
            ErrorKind::MissingNul => {
                write!(f, "no NUL, one expected within {expected} bytes, {found} there without")
            }
            ErrorKind::InnerNul => write!(f, "NUL inside the text, at its byte {found}"),
            ErrorKind::NotCp1252 => write!(f, "U+{found:04X} is not in CP1252"),
            ErrorKind::NotDecimal => write!(f, "U+{found:04X} is no decimal digit"),
            ErrorKind::Digits => write!(f, "1 to {expected} digits expected, {found} found"),
            ErrorKind::Unexpected => match char::from_u32(found) {
                Some(character) if character.is_ascii_graphic() => {
                    write!(f, "'{character}' may not stand here")
                }
                _ => write!(f, "U+{found:04X} may not stand here"),
            },
            ErrorKind::Missing => f.write_str("missing"),
            ErrorKind::OutOfRange if found < expected => {
                write!(f, "out of range, at least {expected} expected, {found} found")
            }
            ErrorKind::OutOfRange => {
                write!(f, "out of range, at most {expected} expected, {found} found")
            }
            ErrorKind::Mismatch => write!(f, "mismatch, {expected} expected, {found} found"),
            ErrorKind::Function => write!(f, "{found:#x} is a function, not content"),
            ErrorKind::BufferTooSmall => {
                write!(f, "buffer too small, {expected} bytes expected, {found} there")
            }
        }
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Error({:?}, {self})", self.kind)
    }
}

const _: () = assert!(size_of::<Error>() == 16);
