//! What a table says of a stream and of a field.

use core::fmt;

use super::tables::TABLES;
use super::{Stream, Subject};
use crate::declare::Declared;

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
    /// What the stream is.
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

    /// Whether all fixed fields are in front, where they are read.
    pub(crate) const fn is_headed(&self) -> bool {
        let (mut fields, mut is_head) = (self.fields, true);
        while let [row, rest @ ..] = fields {
            is_head = is_head && row.size.fixed() > 0 && row.per_item == 0;
            if !is_head && row.size.fixed() > 0 {
                return false;
            }
            fields = rest;
        }
        true
    }

    /// Whether the field of this name is where the rows before it end, at their fewest bytes.
    pub(crate) const fn is_at(&self, name: &str) -> bool {
        let (mut fields, mut end, mut per_item) = (self.fields, 0_u32, 0_u32);
        while let [row, rest @ ..] = fields {
            if is_same(row.name, name) {
                return row.offset == end && row.per_item == per_item;
            }
            match row.size {
                Size::Items { each, .. } => per_item = per_item.saturating_add(each),
                Size::CStringPrefix { .. } => end = end.saturating_add(1),
                size => end = end.saturating_add(size.fixed()),
            }
            fields = rest;
        }
        false
    }

    /// Whether the length of the stream leaves each row as much as the row may have at most, and no
    /// more where nothing but that length limits the row.
    pub(crate) const fn is_filled(&self) -> bool {
        let (mut fields, mut before) = (self.fields, 0_u32);
        while let [row, rest @ ..] = fields {
            let left = self.max.saturating_sub(before).saturating_sub(least(rest));
            let is_filled = match row.size {
                Size::Items { each, max } => matches!(left.checked_div(each), Some(n) if n == max),
                Size::CString { max, .. } | Size::OptionalNul { max } | Size::Rest { max, .. } => {
                    left == max
                }
                Size::TextAndTail { max, .. } | Size::CStringPrefix { max } => max <= left,
                _ => true,
            };
            if !is_filled {
                return false;
            }
            before = before.saturating_add(row.size.least());
            fields = rest;
        }
        true
    }

    /// The most that the field of this name may have: items of a list, bytes of any other.
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
    const fn index(&self, name: &str) -> u8 {
        let (mut fields, mut index) = (self.fields, 0_u8);
        while let [row, rest @ ..] = fields {
            if is_same(row.name, name) {
                return index;
            }
            (fields, index) = (rest, index.saturating_add(1));
        }
        u8::MAX
    }

    /// Whether the fields tell where the stream ends: what follows is trailing, not too long.
    pub(crate) fn ends_itself(&self) -> bool {
        self.is_fixed() || self.fields.iter().any(|row| row.size == Size::Uns8To32)
    }
}

/// The fewest bytes of these rows.
const fn least(mut fields: &[FieldSpec]) -> u32 {
    let mut least = 0_u32;
    while let [row, rest @ ..] = fields {
        (least, fields) = (least.saturating_add(row.size.least()), rest);
    }
    least
}

const fn is_same(one: &str, other: &str) -> bool {
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
/// // The name stands behind m numbers of elements: at 20 + 4m.
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
    /// What the field says.
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
    /// So many bytes.
    Fixed(u32),
    /// So many bytes; this and what follows may be absent if the field before is not 0 (ADS-6).
    FixedOnSuccess(u32),
    /// As many items as the field before says.
    Items {
        /// Bytes of one item.
        each: u32,
        /// The most items the stream can hold.
        max: u32,
    },
    /// Text that a NUL must end; more NULs may pad it.
    CString {
        /// The most bytes, NULs included.
        max: u32,
        /// Zero bytes are accepted for the empty text.
        is_optional: bool,
    },
    /// Text that a NUL must end, and more of the stream behind it.
    CStringPrefix {
        /// The most bytes, the NUL included.
        max: u32,
    },
    /// So many bytes; the stream may have none at all instead.
    OptionalFixed(u32),
    /// Text that a NUL or the end of the stream ends; what follows the NUL is kept.
    TextAndTail {
        /// The fewest bytes.
        min: u32,
        /// The most bytes in all.
        max: u32,
    },
    /// Text that a NUL may end; more NULs may pad it.
    OptionalNul {
        /// The most bytes in all, one at least.
        max: u32,
    },
    /// Four bytes, a number that is not 0.
    NonZero,
    /// An unsigned number of one, two or four bytes, as the stream ends.
    Uns8To32,
    /// Text in so many bytes, padded with NULs if shorter.
    Padded(u32),
    /// All that is left.
    Rest {
        /// The fewest bytes.
        min: u32,
        /// The most bytes.
        max: u32,
    },
}

impl Size {
    /// The bytes of a field that always has as many where it is at all.
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
    const fn least(self) -> u32 {
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

/// A field of a stream, or a part of another [`Subject`]; or the whole of it.
///
/// ```
/// use ads_cnc::layout::{Field, Stream};
/// use ads_cnc::{Decode, DescriptionRef};
///
/// let error = DescriptionRef::decode(&[2, 0, 0, 2, 1, 0]).unwrap_err();
/// assert_eq!(Some(error.field()), Field::by_name(Stream::VariableDescription, "type"));
/// assert_eq!(error.field().spec().unwrap().offset, 4);
/// assert_eq!(Field::whole(Stream::VariableDescription).name(), "stream");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Field {
    subject: Subject,
    index: u8,
}

impl Field {
    #[inline]
    pub(crate) const fn new(subject: Subject, index: u8) -> Self {
        Self { subject, index }
    }

    /// The field of this name of a declared stream.
    pub(crate) const fn of<T: Declared>(name: &str) -> Self {
        let index = T::LAYOUT.index(name);
        assert!(index != u8::MAX, "the stream has no field of this name");
        Self::new(Subject::Stream(T::STREAM), index)
    }

    /// The field before: the count of a list.
    pub(crate) const fn before(self) -> Self {
        Self { index: self.index.saturating_sub(1), ..self }
    }

    /// The same row of another stream, whose table is the same.
    pub(crate) const fn in_stream(self, stream: Stream) -> Self {
        Self { subject: Subject::Stream(stream), ..self }
    }

    /// The stream as a whole: its length, its end.
    pub const fn whole(stream: Stream) -> Self {
        Self::whole_subject(Subject::Stream(stream))
    }

    /// The subject as a whole.
    pub(crate) const fn whole_subject(subject: Subject) -> Self {
        Self { subject, index: u8::MAX }
    }

    /// The whole that this is a part of.
    pub(crate) const fn to_whole(self) -> Self {
        Self::whole_subject(self.subject)
    }

    /// The field of `stream` with this name.
    pub fn by_name(stream: Stream, name: &str) -> Option<Self> {
        stream.fields().find(|field| field.name() == name)
    }

    /// What this is a part of.
    pub const fn subject(self) -> Subject {
        self.subject
    }

    /// The stream that the field belongs to; `None` for a part of another subject.
    pub const fn stream(self) -> Option<Stream> {
        match self.subject {
            Subject::Stream(stream) => Some(stream),
            _ => None,
        }
    }

    /// The row of the stream's table; `None` for the stream as a whole and for a part of another
    /// subject.
    pub fn spec(self) -> Option<&'static FieldSpec> {
        self.stream()?.layout().fields.get(usize::from(self.index))
    }

    /// The field's name; `stream` for the whole.
    pub fn name(self) -> &'static str {
        self.subject.part(self.index).unwrap_or("stream")
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.subject.name(), self.name())
    }
}

impl fmt::Debug for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.subject.name(), self.name())
    }
}

impl Stream {
    /// The fields in their order on the wire.
    pub fn fields(self) -> impl Iterator<Item = Field> {
        (0u8..)
            .zip(self.layout().fields)
            .map(move |(index, _)| Field::new(Subject::Stream(self), index))
    }

    /// Every stream that has bytes: all but [`NoData`](Self::NoData).
    pub fn all() -> impl Iterator<Item = Self> {
        TABLES.iter().copied().filter(|stream| *stream != Self::NoData)
    }

    /// The stream with this name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().find(|stream| stream.layout().name == name)
    }
}

impl fmt::Display for Stream {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.layout().name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DescriptionRef, HandleWriteRef, NameWriteRef};

    fn layout(rows: &[(&'static str, u32, u32, Size)]) -> Layout {
        let row = |&(name, offset, per_item, size)| {
            let (ty, meaning, clause) = (Type::Uns32, "", "");
            FieldSpec { name, offset, per_item, size, ty, meaning, clause }
        };
        let fields: std::vec::Vec<FieldSpec> = rows.iter().map(row).collect();
        Layout { fields: fields.leak(), ..DescriptionRef::LAYOUT }
    }

    /// What the compiler checks of each declaration is found where it is wrong.
    #[test]
    fn wrong_tables_are_found() {
        const LIST: Size = Size::Items { each: 4, max: 5 };
        const FOUR: Size = Size::Fixed(4);
        const REST: Size = Size::Rest { min: 0, max: 9 };
        let rows =
            [("a", 0, 0, FOUR), ("n", 4, 0, FOUR), ("list", 8, 0, LIST), ("rest", 8, 4, REST)];
        let right = layout(&rows);
        assert!(["a", "n", "list", "rest"].iter().all(|name| right.is_at(name)));
        assert!(right.is_headed() && right.head() == 8);
        assert!(!right.is_at("b"));
        assert_eq!([right.index("list"), right.index("lost")], [2, u8::MAX]);
        let shifted = layout(&[("a", 0, 0, FOUR), ("b", 5, 0, FOUR)]);
        assert!(shifted.is_at("a") && !shifted.is_at("b"));
        let counted = layout(&[("list", 0, 0, LIST), ("rest", 0, 0, REST)]);
        assert!(!counted.is_at("rest"));
        let after = layout(&[("list", 0, 0, LIST), ("a", 0, 4, FOUR)]);
        assert!(!after.is_headed());
        assert!(NameWriteRef::LAYOUT.is_at("value") && HandleWriteRef::LAYOUT.is_at("value"));
    }

    /// A row may have at most what the stream's length leaves it, no more and no less.
    #[test]
    fn maxima_that_no_row_enforces_are_found() {
        let filled = |max, rows: &[_]| Layout { max, ..layout(rows) }.is_filled();
        let list = [("n", 0, 0, Size::Fixed(4)), ("list", 4, 0, Size::Items { each: 4, max: 5 })];
        assert_eq!([23, 24, 27, 28].map(|max| filled(max, &list)), [false, true, true, false]);
        let open = ("name", 4, 4, Size::TextAndTail { min: 1, max: 4 });
        let named = [list[0], list[1], open];
        assert_eq!([24, 25, 28, 29].map(|max| filled(max, &named)), [false, true, true, false]);
        for size in [Size::TextAndTail { min: 1, max: 9 }, Size::CStringPrefix { max: 9 }] {
            let rows = [("first", 0, 0, Size::Fixed(4)), ("last", 4, 0, size)];
            assert_eq!([12, 13, 99].map(|max| filled(max, &rows)), [false, true, true]);
        }
        for size in [
            Size::Rest { min: 0, max: 9 },
            Size::OptionalNul { max: 9 },
            Size::CString { max: 9, is_optional: false },
        ] {
            let rows = [("first", 0, 0, Size::CStringPrefix { max: 4 }), ("last", 1, 0, size)];
            assert_eq!([9, 10, 11].map(|max| filled(max, &rows)), [false, true, false]);
        }
    }

    /// Limits and offsets are those of the rows.
    #[test]
    fn limits_are_those_of_the_rows() {
        for (size, most) in [
            (Size::Fixed(4), 4),
            (Size::Items { each: 4, max: 5 }, 5),
            (Size::TextAndTail { min: 1, max: 9 }, 9),
            (Size::Rest { min: 0, max: 8 }, 8),
            (Size::CStringPrefix { max: 7 }, 7),
            (Size::OptionalNul { max: 6 }, 6),
            (Size::CString { max: 3, is_optional: true }, 3),
            (Size::Uns8To32, 4),
        ] {
            let rows = layout(&[("first", 0, 0, Size::Fixed(2)), ("last", 2, 0, size)]);
            assert_eq!((rows.most("last"), rows.offset("last")), (most, 2));
            assert_eq!((rows.most("first"), rows.offset("first")), (2, 0));
        }
    }

    #[test]
    #[should_panic = "no field of this name"]
    fn a_name_of_no_field_has_no_maximum() {
        layout(&[]).most("value");
    }

    #[test]
    fn fields_are_found_by_name() {
        let field = Field::of::<DescriptionRef<'_>>("dimensions");
        assert_eq!((field.name(), field.before().name()), ("dimensions", "dimension_count"));
    }

    #[test]
    #[should_panic = "no field of this name"]
    fn a_name_of_no_field_is_no_field() {
        Field::of::<DescriptionRef<'_>>("dimension");
    }
}
