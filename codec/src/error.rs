//! The error type of decoders, encoders and constructors.

use core::fmt;

use crate::address::range;
use crate::com::ObjectCount;
use crate::layout::{Field, Size, Subject, index_offset, typed_value, variable_path};
use crate::operation::ReadDescriptors;
use crate::sda::ObjectAddress;
use crate::value::DataType;

/// The error of decoders, encoders and constructors: kind, field, offset, and the expected and the
/// found number. [`NcText::new`](crate::streaming::NcText::new) has an error type of its own.
///
/// The type is `Copy` and has 16 bytes. Its `Display` text does not depend on the features of the
/// crate:
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::{Decode, DescriptionRef};
///
/// let error = DescriptionRef::decode(&[2, 0, 0, 2, 1, 0]).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "variable-description: type at offset 4: truncated, expected 4 bytes, found 2"
/// );
/// assert_eq!(Channel::new(0).unwrap_err().to_string(), "channel 0 is out of range 1..=255");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, thiserror::Error)]
pub struct Error {
    kind: ErrorKind,
    field: Field,
    offset: u32,
    expected: u32,
    found: u32,
}

/// The class of an [`Error`]. It defines the meaning of the numbers [`Error::expected`] and
/// [`Error::found`]: see each variant. A length of more than 32 bits is reported as `u32::MAX`.
/// With [`content_error`](crate::value::content_error), the application chooses the numbers.
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
    /// The stream, value or name ends before the end of the field. Expected: the minimum number of
    /// bytes (of a UUID or name: characters) of the field. Found: those that remain.
    Truncated,
    /// Bytes (of a UUID: characters) follow the end of the stream or value. Expected: the length up
    /// to this end. Found: the length of the input.
    Trailing,
    /// The field, stream, value or name exceeds its maximum length. Expected: the maximum. Found:
    /// the length, or that of the part that `BinRead` has read.
    TooLong,
    /// A count exceeds its maximum, or the number of items in the remaining bytes. Expected: the
    /// smaller of these two limits; in an error of `BinRead` it may be 0. Found: the count.
    TooMany,
    /// No NUL ends the text within its maximum length. Expected: the maximum length including the
    /// NUL. Found: the number of bytes without a NUL, from the start of the text.
    MissingNul,
    /// A NUL inside the text. Expected: 0. Found: index of the NUL in the text.
    InnerNul,
    /// A character without a CP1252 byte. Expected: 0. Found: its code point.
    NotCp1252,
    /// A character that is not a decimal digit. Expected: 0. Found: its code point.
    NotDecimal,
    /// A number with no digits or too many digits. Expected: the maximum number of digits. Found:
    /// the number of digits.
    Digits,
    /// A character where the syntax requires a different character. Expected: 0. Found: its code
    /// point.
    Unexpected,
    /// A required part is missing, or a value has no elements. Expected and found: 0.
    Missing,
    /// A value outside its range. Expected: the nearest permitted value. Found: the value. The
    /// conversions from an [`Element`](crate::Element) define these numbers differently.
    OutOfRange,
    /// A value differs from the required value. Expected and found: the required value (or an
    /// example of it) and the value, or numbers of both, such as their lengths or the numbers of
    /// their types.
    Mismatch,
    /// An index offset that is that of a function, but must be that of content or of the first
    /// element of an instance. Expected: 0. Found: the offset.
    Function,
    /// The buffer is too small for the encoded stream, value or name, or the read length of a
    /// received request is too small for the reply. Expected: bytes needed. Found: bytes available.
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

    /// The same error, for a stream that begins at offset `by`.
    #[cfg(feature = "binrw")]
    pub(crate) const fn moved(self, by: u32) -> Self {
        Self { offset: self.offset.saturating_add(by), ..self }
    }

    /// The class of the error.
    pub const fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The field at fault. [`Field::stream`] returns the stream of the field, if it has one.
    pub const fn field(&self) -> Field {
        self.field
    }

    /// The offset of the fault, in bytes from the start of the stream: of the field at fault, or of
    /// the first byte after the permitted length. An error of `BinRead` or `BinWrite` may count
    /// from the start of the reader or writer; an error of
    /// [`FrameRef::split`](crate::ads::FrameRef::split) counts from the start of the frame.
    ///
    /// For a [`Subject`] that is not a stream, the function that returns the error defines the
    /// offset: it counts, for example, characters of a text or name, bytes of a value, or
    /// dimensions.
    pub const fn offset(&self) -> u32 {
        self.offset
    }

    /// The expected number; [`ErrorKind`] defines its meaning.
    pub const fn expected(&self) -> u32 {
        self.expected
    }

    /// The found number; [`ErrorKind`] defines its meaning.
    pub const fn found(&self) -> u32 {
        self.found
    }
}

/// Displays a short description of the class.
impl fmt::Display for ErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Truncated => "truncated",
            Self::Trailing => "trailing bytes",
            Self::TooLong => "too long",
            Self::TooMany => "too many",
            Self::MissingNul => "no NUL",
            Self::InnerNul => "NUL inside the text",
            Self::NotCp1252 => "not in CP1252",
            Self::NotDecimal => "not a decimal digit",
            Self::Digits => "wrong number of digits",
            Self::Unexpected => "unexpected character",
            Self::Missing => "missing",
            Self::OutOfRange => "out of range",
            Self::Mismatch => "mismatch",
            Self::Function => "a function, not content",
            Self::BufferTooSmall => "buffer too small",
        })
    }
}

/// A number with its unit, in the singular and in the plural.
struct Quantity(u32, [&'static str; 2]);

const BYTES: [&str; 2] = ["byte", "bytes"];

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number, [one, more]) = self;
        write!(f, "{number} {}", if *number == 1 { one } else { more })
    }
}

/// A character, given by its code point.
struct Character(u32);

impl fmt::Display for Character {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match char::from_u32(self.0) {
            Some(character) if character.is_ascii_graphic() => write!(f, "'{character}'"),
            _ => write!(f, "U+{:04X}", self.0),
        }
    }
}

/// The name, minimum and maximum of the constructor argument that `field` identifies in an error;
/// `None` for any other field.
fn argument(field: Field) -> Option<(&'static str, u32, u32)> {
    const COUNT: Field = Field::of::<ObjectCount>("count");
    match field {
        COUNT => Some(("count of descriptors", 1, ReadDescriptors::COUNT_MAX)),
        index_offset::OBJECT => Some(("first object", 1, u32::MAX)),
        _ => range(field),
    }
}

/// The name and the unit of the count or size of a value that `field` identifies in a `Mismatch`;
/// `None` for any other field.
fn counted(field: Field) -> Option<(&'static str, [&'static str; 2])> {
    match field {
        typed_value::COUNT => Some(("value", ["element", "elements"])),
        typed_value::INDEX_COUNT => Some(("value", ["index", "indices"])),
        typed_value::SIZE => Some(("size", BYTES)),
        _ => None,
    }
}

/// Whether the limit of a count is due to the remaining bytes, and not the maximum of its list.
fn is_cut(count: Field, limit: u32) -> bool {
    let mut rows = count.stream().into_iter().flat_map(|stream| stream.layout().fields);
    rows.any(|row| matches!(row.size, Size::Items { max, .. } if max != limit))
}

/// Whether the numbers of a `Mismatch` with this field are index groups.
fn is_group(field: Field) -> bool {
    field.subject() == Subject::IndexGroup
        || field == const { Field::of::<ObjectAddress>("index_group") }
}

/// The name of the type that has this number in errors; empty for any other number.
fn type_name(number: u32) -> &'static str {
    DataType::by_number(number).map_or("", DataType::name)
}

impl Error {
    /// Writes an error whose text does not contain `at offset`, such as an error about an argument
    /// of a constructor or about the length of a name. For any other error, writes nothing and
    /// returns `None`.
    fn fmt_words(&self, f: &mut fmt::Formatter<'_>) -> Option<fmt::Result> {
        const NAME: Field = Field::whole_subject(Subject::VariablePath);
        let Self { kind, field, offset, expected, found } = *self;
        let (argument, counted) = (argument(field), counted(field));
        Some(match (kind, field) {
            (ErrorKind::OutOfRange | ErrorKind::TooMany, _) if argument.is_some() => {
                let (what, least, most) = argument?;
                write!(f, "{what} {found} is out of range {least}..={most}")
            }
            (ErrorKind::Mismatch, _) if counted.is_some() => {
                let (what, unit) = counted?;
                write!(f, "{what}: expected {}, found {found}", Quantity(expected, unit))
            }
            (ErrorKind::Mismatch, _) if is_group(field) => {
                write!(f, "index group: expected one such as {expected:#x}, found {found:#x}")
            }
            (ErrorKind::Mismatch, typed_value::TYPE) => {
                write!(f, "expected {}, found {}", type_name(expected), type_name(found))
            }
            (ErrorKind::OutOfRange, typed_value::NUMBER | typed_value::NEGATIVE) => {
                let sign = if field == typed_value::NEGATIVE { "-" } else { "" };
                let expected = type_name(expected);
                match offset {
                    0 => write!(f, "{sign}{found} does not fit {expected}"),
                    // Decimal output of 64 bits would add 1.2 KB of code on a microcontroller.
                    high => write!(f, "{sign}{high:#x}{found:08x} does not fit {expected}"),
                }
            }
            (ErrorKind::OutOfRange, typed_value::INDEX) => {
                let written = match offset {
                    0 => write!(f, "index {found}"),
                    dimension => write!(f, "index {found} in dimension {dimension} (from 0)"),
                };
                written.and_then(|()| write!(f, " is out of range 0..={expected}"))
            }
            (ErrorKind::TooLong, NAME) => {
                let subject = field.subject().name();
                write!(
                    f,
                    "{subject}: {kind}, expected at most {expected} characters, found {found}"
                )
            }
            _ => return None,
        })
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(written) = self.fmt_words(f) {
            return written;
        }
        let Self { kind, field, offset, expected, found } = *self;
        match field.subject() {
            // The subject `text` has only one part, also named `text`: do not display both names.
            Subject::Text => f.write_str(field.name())?,
            _ => write!(f, "{field}")?,
        }
        write!(f, " at offset {offset}: ")?;
        let wanted = Quantity(expected, BYTES);
        match kind {
            ErrorKind::Truncated if field.subject() == Subject::VariablePath => {
                f.write_str(match field {
                    variable_path::INDEX => "no \"]\"",
                    variable_path::KIND => "the name ends, expected a kind such as V.E",
                    _ => "the name ends, expected another part",
                })
            }
            ErrorKind::Truncated | ErrorKind::Trailing | ErrorKind::BufferTooSmall => {
                write!(f, "{kind}, expected {wanted}, found {found}")
            }
            ErrorKind::TooLong => write!(f, "{kind}, expected at most {wanted}, found {found}"),
            ErrorKind::TooMany => {
                let rest = if is_cut(field, expected) { " in the bytes that follow" } else { "" };
                write!(f, "{kind}, expected at most {expected}{rest}, found {found}")
            }
            ErrorKind::MissingNul => {
                write!(f, "{kind}, expected one within {wanted}, found {found} without")
            }
            // The offset of a text error is already the offset of the NUL.
            ErrorKind::InnerNul if field.subject() != Subject::Text => {
                write!(f, "{kind}, at its byte {found}")
            }
            ErrorKind::InnerNul | ErrorKind::Missing => write!(f, "{kind}"),
            ErrorKind::NotCp1252 | ErrorKind::NotDecimal => {
                write!(f, "{} is {kind}", Character(found))
            }
            ErrorKind::Digits => write!(f, "expected 1 to {expected} digits, found {found}"),
            ErrorKind::Unexpected => write!(f, "unexpected {}", Character(found)),
            ErrorKind::OutOfRange => {
                let bound = if found < expected { "least" } else { "most" };
                write!(f, "{kind}, expected at {bound} {expected}, found {found}")
            }
            ErrorKind::Mismatch => write!(f, "expected {expected}, found {found}"),
            ErrorKind::Function => write!(f, "{found:#x} is {kind}"),
        }
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Error({:?}, {self})", self.kind)
    }
}

const _: () = assert!(size_of::<Error>() == 16);
