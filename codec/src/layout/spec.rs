//! The types of the table of a stream.

use core::fmt;

use super::Stream;

/// [`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX) as a `u32`, which the declarations of streams use.
pub(crate) const ADS_DATA: u32 = 0x40_0000;

/// A type that is declared as a stream.
pub(crate) trait Declared {
    const STREAM: Stream;
    const LAYOUT: Layout;
}

/// The table of one stream.
///
/// ```
/// use ads_cnc::layout::Stream;
///
/// let layout = Stream::ObjectDescriptor.layout();
/// assert_eq!((layout.name, layout.max), ("object-descriptor", 84));
/// assert!(layout.is_fixed() && !layout.repeats);
/// assert!(Stream::ObjectDescriptors.layout().repeats);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Layout {
    /// The stream's name in errors, golden vectors and reports.
    pub name: &'static str,
    /// A description of the stream.
    pub title: &'static str,
    /// The ID of the requirement that defines the stream.
    pub clause: &'static str,
    /// The maximum length in bytes.
    pub max: u32,
    /// Whether the stream consists of one or more records with these fields.
    pub repeats: bool,
    /// The fields, in the order on the wire.
    pub fields: &'static [FieldSpec],
}

impl Layout {
    /// Whether the stream always has the same length.
    pub fn is_fixed(&self) -> bool {
        let fixed =
            |row: &FieldSpec| matches!(row.size, Size::Fixed(_) | Size::Padded(_) | Size::NonZero);
        !self.repeats && self.fields.iter().all(fixed)
    }

    /// The length of the fixed fields at the start of the stream, in bytes.
    pub(crate) const fn head(&self) -> usize {
        super::head::head(self.fields)
    }

    /// The maximum number of items of the list, or bytes of another field, with this name.
    pub(crate) const fn most(&self, name: &str) -> u32 {
        self.row(name).size.most()
    }

    /// The row of the field with this name.
    const fn row(&self, name: &str) -> FieldSpec {
        let mut fields = self.fields;
        loop {
            assert!(!fields.is_empty(), "the stream has no field of this name");
            if let [row, rest @ ..] = fields {
                if is_same(row.name, name) {
                    return *row;
                }
                fields = rest;
            }
        }
    }

    /// The [`offset`](FieldSpec::offset) of the field with this name.
    pub(crate) const fn offset(&self, name: &str) -> u32 {
        self.row(name).offset
    }

    /// The index of the field with this name; `u8::MAX` if there is no such field.
    pub(super) const fn index(&self, name: &str) -> u8 {
        let (mut fields, mut index) = (self.fields, 0_u8);
        while let [row, rest @ ..] = fields {
            if is_same(row.name, name) {
                return index;
            }
            (fields, index) = (rest, index.saturating_add(1));
        }
        u8::MAX
    }

    /// Whether bytes beyond the maximum length are reported as `Trailing` and not as `TooLong`: for
    /// a stream of fixed length, and for a number of one, two or four bytes.
    pub(crate) fn ends_itself(&self) -> bool {
        self.is_fixed() || self.fields.iter().any(|row| row.size == Size::Uns8To32)
    }
}

pub(super) const fn is_same(one: &str, other: &str) -> bool {
    let (mut one, mut other) = (one.as_bytes(), other.as_bytes());
    while let ([a, one_rest @ ..], [b, other_rest @ ..]) = (one, other) {
        if *a != *b {
            return false;
        }
        (one, other) = (one_rest, other_rest);
    }
    one.is_empty() && other.is_empty()
}

/// One row of a table.
///
/// ```
/// use ads_cnc::layout::Stream;
///
/// // The name follows m dimensions, so its offset is 20 + 4m.
/// let name = Stream::VariableDescription.layout().fields.last().unwrap();
/// assert_eq!((name.name, name.offset, name.per_item), ("name", 20, 4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FieldSpec {
    /// The field's name in errors, golden vectors and reports.
    pub name: &'static str,
    /// The offset of the field in bytes, without the part that depends on a count or on the length
    /// of a text.
    pub offset: u32,
    /// The number of bytes to add to `offset` for each counted item before the field.
    pub per_item: u32,
    /// The size of the field.
    pub size: Size,
    /// The type of the field.
    pub ty: Type,
    /// The meaning of the field.
    pub meaning: &'static str,
    /// The ID of the requirement that defines the field.
    pub clause: &'static str,
}

/// The size of a field.
///
/// ```
/// use ads_cnc::layout::{Field, Size, Stream};
///
/// let size = |stream, name| Field::by_name(stream, name)?.spec().map(|spec| spec.size);
/// assert_eq!(size(Stream::ObjectDescriptor, "id"), Some(Size::Fixed(4)));
/// assert_eq!(size(Stream::ObjectDescriptor, "name"), Some(Size::Padded(32)));
/// let dimensions = size(Stream::VariableDescription, "dimensions");
/// assert_eq!(dimensions, Some(Size::Items { each: 4, max: 506 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Size {
    /// Exactly this number of bytes.
    Fixed(u32),
    /// This number of bytes. This field and the fields after it may be absent if the field before it, an
    /// ADS result, is not 0 (ADS-6).
    FixedOnSuccess(u32),
    /// Items; the previous field contains their number.
    Items {
        /// The length of one item in bytes.
        each: u32,
        /// The maximum number of items.
        max: u32,
    },
    /// NUL-terminated text; more NULs may pad it.
    CString {
        /// The maximum length in bytes, including NULs.
        max: u32,
        /// Whether a field without any bytes is accepted as the empty text.
        is_optional: bool,
    },
    /// NUL-terminated text before other fields of the stream.
    CStringPrefix {
        /// The maximum length in bytes, including the NUL.
        max: u32,
    },
    /// This number of bytes, in a stream that may also be empty.
    OptionalFixed(u32),
    /// Text up to a NUL or to the end of the stream. The bytes after the NUL are its tail, which is
    /// kept.
    TextAndTail {
        /// The minimum length in bytes.
        min: u32,
        /// The maximum length in bytes.
        max: u32,
    },
    /// Text with or without a NUL at its end; more NULs may pad it.
    OptionalNul {
        /// The maximum length in bytes; the minimum is 1.
        max: u32,
    },
    /// Four bytes: a number that must not be 0.
    NonZero,
    /// An unsigned number of one, two or four bytes, up to the end of the stream.
    Uns8To32,
    /// Text in this number of bytes, up to its first NUL if it has one.
    Padded(u32),
    /// The rest of the stream.
    Rest {
        /// The minimum length in bytes.
        min: u32,
        /// The maximum length in bytes.
        max: u32,
    },
}

impl Size {
    /// The length of a field of fixed size in bytes; 0 for any other field.
    pub(crate) const fn fixed(self) -> u32 {
        match self {
            Self::Fixed(size)
            | Self::FixedOnSuccess(size)
            | Self::OptionalFixed(size)
            | Self::Padded(size) => size,
            Self::NonZero => 4,
            _ => 0,
        }
    }

    /// The minimum length of a field that is present, in bytes; 0 for [`Items`](Self::Items) and
    /// [`Uns8To32`](Self::Uns8To32).
    pub(crate) const fn least(self) -> u32 {
        match self {
            Self::TextAndTail { min, .. } | Self::Rest { min, .. } => min,
            Self::CString { .. } | Self::CStringPrefix { .. } | Self::OptionalNul { .. } => 1,
            size => size.fixed(),
        }
    }

    /// The maximum length of a field in bytes, or number of items of a list.
    const fn most(self) -> u32 {
        match self {
            Self::Items { max, .. }
            | Self::CString { max, .. }
            | Self::CStringPrefix { max }
            | Self::TextAndTail { max, .. }
            | Self::OptionalNul { max }
            | Self::Rest { max, .. } => max,
            Self::Uns8To32 => 4,
            size => size.fixed(),
        }
    }
}

/// The type of a field on the wire.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 3.1 and 4.3.
///
/// ```
/// use ads_cnc::layout::{Stream, Type};
///
/// let [index, kind] = Stream::VariableIndexKind.layout().fields else { panic!() };
/// assert_eq!((index.ty, kind.ty), (Type::Uns32, Type::String));
/// assert_eq!(index.ty.to_string(), "UNS32");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Type {
    /// 8-bit unsigned.
    Uns08,
    /// 16-bit unsigned, little-endian.
    Uns16,
    /// 32-bit unsigned, little-endian.
    Uns32,
    /// Unsigned, little-endian; the width is not documented.
    Unsigned,
    /// One byte; 0 is FALSE, any other value is TRUE.
    Boolean,
    /// IEEE 754 binary64, little-endian.
    Real64,
    /// CP1252 text.
    String,
    /// AMS NetId, six bytes.
    NetId,
    /// Uninterpreted bytes.
    Bytes,
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Uns08 => "UNS08",
            Self::Uns16 => "UNS16",
            Self::Uns32 => "UNS32",
            Self::Unsigned => "unsigned",
            Self::Boolean => "BOOLEAN",
            Self::Real64 => "REAL64",
            Self::String => "STRING",
            Self::NetId => "BYTE[6]",
            Self::Bytes => "BYTE[]",
        })
    }
}
