//! The types of the table of a stream.

use core::fmt;

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
    /// The stream's name in vectors and reports.
    pub name: &'static str,
    /// A description of the stream.
    pub title: &'static str,
    /// The requirement that defines it, by its ID.
    pub clause: &'static str,
    /// The maximum length in bytes.
    pub max: u32,
    /// The fields are one record; the stream is one or more of them.
    pub repeats: bool,
    /// The fields in their order on the wire.
    pub fields: &'static [FieldSpec],
}

impl Layout {
    /// Whether every stream of this kind has the same length.
    pub fn is_fixed(&self) -> bool {
        let fixed =
            |row: &FieldSpec| matches!(row.size, Size::Fixed(_) | Size::Padded(_) | Size::NonZero);
        !self.repeats && self.fields.iter().all(fixed)
    }

    /// The bytes of the fixed fields that the stream begins with.
    pub(crate) const fn head(&self) -> usize {
        super::head::head(self.fields)
    }

    /// The most items of a list, or bytes of another field, of this name.
    pub(crate) const fn most(&self, name: &str) -> u32 {
        self.row(name).size.most()
    }

    /// The row of the field of this name.
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

    /// The offset of the field of this name, as the manual prints it.
    pub(crate) const fn offset(&self, name: &str) -> u32 {
        self.row(name).offset
    }

    /// The index of the field of this name.
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

    /// Whether the fields determine the end of the stream: more bytes are trailing, not too long.
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
/// // The name follows the m dimensions: its offset is 20 + 4m.
/// let name = Stream::VariableDescription.layout().fields.last().unwrap();
/// assert_eq!((name.name, name.offset, name.per_item), ("name", 20, 4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FieldSpec {
    /// The field's name in errors, vectors and reports.
    pub name: &'static str,
    /// Offset as the manual prints it, without the part that depends on a count.
    pub offset: u32,
    /// Bytes added to `offset` for each counted item before the field.
    pub per_item: u32,
    /// How long the field is.
    pub size: Size,
    /// The type's name.
    pub ty: Type,
    /// The meaning of the field.
    pub meaning: &'static str,
    /// The requirement that defines the field, by its ID.
    pub clause: &'static str,
}

/// How long a field is.
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
    /// Always this many bytes.
    Fixed(u32),
    /// This many bytes. This field and those after it may be absent if the field before, an ADS
    /// result, is not 0 (ADS-6).
    FixedOnSuccess(u32),
    /// Items; the field before is their count.
    Items {
        /// Bytes of one item.
        each: u32,
        /// The most items the stream can hold.
        max: u32,
    },
    /// NUL-terminated text; more NULs may pad it.
    CString {
        /// The most bytes, NULs included.
        max: u32,
        /// No bytes are accepted as the empty text.
        is_optional: bool,
    },
    /// NUL-terminated text before other fields of the stream.
    CStringPrefix {
        /// The most bytes, the NUL included.
        max: u32,
    },
    /// This many bytes, in a stream that may also be empty.
    OptionalFixed(u32),
    /// Text up to a NUL or to the end of the stream. Bytes after the NUL are the tail, and kept.
    TextAndTail {
        /// The fewest bytes.
        min: u32,
        /// The most bytes in all.
        max: u32,
    },
    /// Text with or without a NUL at its end; more NULs may pad it.
    OptionalNul {
        /// The most bytes in all, one at least.
        max: u32,
    },
    /// Four bytes: a number that must not be 0.
    NonZero,
    /// An unsigned number of one, two or four bytes, as the stream ends.
    Uns8To32,
    /// Text in this many bytes, padded with NULs.
    Padded(u32),
    /// The rest of the stream.
    Rest {
        /// The fewest bytes.
        min: u32,
        /// The most bytes.
        max: u32,
    },
}

impl Size {
    /// The bytes of a field of fixed size, 0 for any other.
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

    /// The fewest bytes of a field. An absent text counts as its NUL: it is absent only where
    /// nothing follows.
    pub(crate) const fn least(self) -> u32 {
        match self {
            Self::TextAndTail { min, .. } | Self::Rest { min, .. } => min,
            Self::CString { .. } | Self::CStringPrefix { .. } | Self::OptionalNul { .. } => 1,
            size => size.fixed(),
        }
    }

    /// The most bytes of a field, or items of a list.
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

/// The name of a type on the wire, as the manuals and ADS spell it.
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
    /// Unsigned, little-endian, of a width that is not documented.
    Unsigned,
    /// One byte; 0 is FALSE, any other TRUE.
    Boolean,
    /// IEEE 754 binary64, little-endian.
    Real64,
    /// CP1252 text.
    String,
    /// Six bytes of an AMS NetId.
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
