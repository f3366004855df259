//! The tables of the codec as data: streams with their fields, and functions with their addresses.
//!
//! The tables are meant for code generators and other tools. `ads-cnc tables --json` prints
//! [`Tables`]; the dissector for Wireshark and the description for Kaitai Struct are generated from
//! [`Tables`].
//!
//! ```
//! use ads_cnc_conformance::tables::{SizeTable, Tables};
//!
//! let tables = Tables::new();
//! let handle = tables.streams.iter().find(|one| one.name == "variable-handle").unwrap();
//! assert_eq!((handle.fields[0].name, &handle.fields[0].size), ("handle", &SizeTable::Fixed { bytes: 4 }));
//!
//! let read = tables.functions.iter().find(|one| one.id == "ReadByName").unwrap();
//! assert_eq!((read.service.as_str(), read.port, read.effect), ("ReadWrite", 552, "Query"));
//! ```

mod kaitai;
mod wireshark;

use ads_cnc::address::IndexGroup;
use ads_cnc::layout::{FieldSpec, Layout, Size, Stream};
use ads_cnc::operation::{Effect, Function, GroupRule, OffsetRule};
use serde::Serialize;

pub use kaitai::kaitai_struct;
pub use wireshark::dissector;

/// The tables of all streams and functions.
#[derive(Clone, Debug, Serialize)]
pub struct Tables {
    /// The version of the JSON format of these tables.
    pub format: u32,
    /// The version of the package `ads-cnc-conformance`.
    pub version: &'static str,
    pub streams: Vec<StreamTable>,
    /// A request calls the first function that matches its port, group and offset. If that function
    /// has another command than the request, the search continues only if the request or reply of
    /// the function is the stream `content`; otherwise, the request calls no function. Ports 551
    /// and 552 have the same functions.
    pub functions: Vec<FunctionTable>,
}

/// A stream.
#[derive(Clone, Debug, Serialize)]
pub struct StreamTable {
    pub name: &'static str,
    pub title: &'static str,
    /// The ID of the requirement that defines the stream.
    pub clause: &'static str,
    /// Maximum length in bytes.
    pub max_length: u32,
    /// Whether the stream consists of one or more records with these fields.
    pub repeats: bool,
    /// The fields in the order of their bytes; numbers are little-endian.
    pub fields: Vec<FieldTable>,
}

/// A field of a stream.
#[derive(Clone, Debug, Serialize)]
pub struct FieldTable {
    pub name: &'static str,
    /// `UNS08`, `UNS16`, `UNS32`, `unsigned`, `BOOLEAN`, `REAL64`, `STRING`, `BYTE[6]` or `BYTE[]`.
    #[serde(rename = "type")]
    pub ty: String,
    /// Offset in bytes from the beginning of the stream or, if it repeats, of the record. The
    /// counted fields before this field are taken to have no items, and the text before it to be
    /// empty.
    pub offset: u32,
    /// Number of bytes that each item of a counted field before this field adds to the offset.
    pub offset_per_item: u32,
    pub size: SizeTable,
    pub meaning: &'static str,
    /// The ID of the requirement that defines the field.
    pub clause: &'static str,
}

/// The size of a field.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum SizeTable {
    /// Always this many bytes.
    Fixed { bytes: u32 },
    /// A number of four bytes that must not be 0.
    NonZero { bytes: u32 },
    /// Text in a field of this many bytes. If the text is shorter, a NUL ends it.
    Padded { bytes: u32 },
    /// This many bytes. If the preceding field, which is a result, is not 0, this field and all
    /// following fields may be absent.
    FixedOnSuccess { bytes: u32 },
    /// This many bytes; the stream may also be empty.
    OptionalFixed { bytes: u32 },
    /// Items of `each` bytes; the preceding field contains their number.
    Items { each: u32, max: u32 },
    /// Text that includes its final NUL. Other fields follow.
    CStringPrefix { max: u32 },
    /// Text up to the end of the stream, with at least one NUL at the end; may be empty if
    /// `optional`.
    CString { max: u32, optional: bool },
    /// Text up to the end of the stream, with or without NULs at the end.
    OptionalNul { max: u32 },
    /// Text that ends at the first NUL or with the stream. The bytes after the NUL are not part of
    /// the text.
    TextAndTail { min: u32, max: u32 },
    /// An unsigned number of one, two or four bytes: the whole stream.
    UnsignedRest { max: u32 },
    /// All remaining bytes of the stream.
    Rest { min: u32, max: u32 },
}

/// A function of the CNC.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionTable {
    /// The name of the function in the codec, such as `ReadByName`.
    pub id: String,
    pub title: &'static str,
    /// The ID of the requirement that defines the function.
    pub clause: &'static str,
    /// The section in `ads-en` 1.05 and `ads-de` 1.051 that describes the function, the section of
    /// another document with the name of the document, or `online` for the vendors' help pages.
    pub section: &'static str,
    /// `Read`, `Write` or `ReadWrite`.
    pub service: String,
    /// The AMS command of the service.
    pub command: u16,
    /// `GEO`, `SDA` or `COM`.
    pub task: String,
    /// The AMS port of the task.
    pub port: u16,
    /// The index groups, as ranges `[first, last]` that include both groups.
    pub groups: Vec<[u32; 2]>,
    pub offsets: OffsetTable,
    /// The stream that is sent as data; `null` for none.
    pub request: Option<&'static str>,
    /// The stream that is returned as data; `null` for none.
    pub reply: Option<&'static str>,
    /// `Query`, `Write`, or `Motion` if the function may move an axis.
    pub effect: &'static str,
}

/// The index offsets of a function.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum OffsetTable {
    /// One of these offsets.
    OneOf { offsets: Vec<u32> },
    /// This offset and all larger offsets.
    AtLeast { first: u32 },
    /// 0x10000 × axis + `element`, with axes from `first_axis`.
    OfAxis { first_axis: u32, element: u32 },
}

impl Default for Tables {
    fn default() -> Self {
        Self::new()
    }
}

impl Tables {
    pub fn new() -> Self {
        Self {
            format: 1,
            version: env!("CARGO_PKG_VERSION"),
            streams: Stream::all().map(|stream| StreamTable::new(stream.layout())).collect(),
            functions: Function::ALL.iter().map(|one| FunctionTable::new(*one)).collect(),
        }
    }
}

impl StreamTable {
    fn new(layout: &Layout) -> Self {
        let Layout { name, title, clause, max, repeats, fields, .. } = *layout;
        let fields = fields.iter().map(FieldTable::new).collect();
        Self { name, title, clause, max_length: max, repeats, fields }
    }
}

impl FieldTable {
    fn new(field: &FieldSpec) -> Self {
        let FieldSpec { name, offset, per_item, size, ty, meaning, clause, .. } = *field;
        let (ty, size) = (ty.to_string(), SizeTable::new(size));
        Self { name, ty, offset, offset_per_item: per_item, size, meaning, clause }
    }
}

impl SizeTable {
    fn new(size: Size) -> Self {
        match size {
            Size::Fixed(bytes) => Self::Fixed { bytes },
            Size::NonZero => Self::NonZero { bytes: 4 },
            Size::Padded(bytes) => Self::Padded { bytes },
            Size::FixedOnSuccess(bytes) => Self::FixedOnSuccess { bytes },
            Size::OptionalFixed(bytes) => Self::OptionalFixed { bytes },
            Size::Items { each, max } => Self::Items { each, max },
            Size::CStringPrefix { max } => Self::CStringPrefix { max },
            Size::CString { max, is_optional } => Self::CString { max, optional: is_optional },
            Size::OptionalNul { max } => Self::OptionalNul { max },
            Size::TextAndTail { min, max } => Self::TextAndTail { min, max },
            Size::Uns8To32 => Self::UnsignedRest { max: 4 },
            Size::Rest { min, max } => Self::Rest { min, max },
            // The test `every_size_is_known` fails if the codec has a size that this match lacks.
            _ => Self::Rest { min: 0, max: 0 },
        }
    }
}

impl FunctionTable {
    fn new(function: Function) -> Self {
        let spec = function.spec();
        let name = |stream: Option<Stream>| stream.map(|stream| stream.layout().name);
        let effect = match spec.effect {
            Effect::Query => "Query",
            Effect::Write => "Write",
            Effect::Motion => "Motion",
            // The schema rejects this value.
            _ => "unknown",
        };
        Self {
            id: format!("{function:?}"),
            title: spec.name,
            clause: spec.clause,
            section: spec.section,
            service: spec.service.to_string(),
            command: spec.service.command().0,
            task: spec.task.to_string(),
            port: spec.task.port().0,
            groups: groups(spec.group),
            offsets: OffsetTable::new(spec.offset),
            request: name(spec.request),
            reply: name(spec.reply),
            effect,
        }
    }
}

impl OffsetTable {
    fn new(rule: OffsetRule) -> Self {
        match rule {
            OffsetRule::At(offset) => Self::OneOf { offsets: vec![offset] },
            OffsetRule::OfKind(offsets) => Self::OneOf { offsets: offsets.to_vec() },
            OffsetRule::OfAxis(element) => Self::OfAxis { first_axis: 1, element },
            OffsetRule::FirstElement => Self::OfAxis { first_axis: 0, element: 0 },
            OffsetRule::AtLeast(first) => Self::AtLeast { first },
            // The test `addresses_are_those_of_the_codec` fails if the codec has a rule that this
            // match lacks.
            _ => Self::OneOf { offsets: Vec::new() },
        }
    }

    #[cfg(test)]
    fn contains(&self, offset: u32) -> bool {
        match self {
            Self::OneOf { offsets } => offsets.contains(&offset),
            Self::AtLeast { first } => offset >= *first,
            Self::OfAxis { first_axis, element } => {
                offset >> 16 >= *first_axis && offset & 0xFFFF == *element
            }
        }
    }
}

/// The end of the search for index groups: all index groups of the manuals are smaller.
const GROUPS_END: u32 = 0x20_0000;

/// The index groups that a rule contains, as ranges `[first, last]`.
fn groups(rule: GroupRule) -> Vec<[u32; 2]> {
    let mut ranges: Vec<[u32; 2]> = Vec::new();
    for group in 0..GROUPS_END {
        if !IndexGroup::new(group).parts().is_some_and(|parts| rule.contains(parts)) {
            continue;
        }
        match ranges.last_mut() {
            Some([_, last]) if last.saturating_add(1) == group => *last = group,
            _ => ranges.push([group, group]),
        }
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;
    use ads_cnc::address::IndexOffset;

    #[test]
    fn every_size_is_known() {
        for stream in Stream::all() {
            for field in stream.layout().fields {
                let is_unknown = SizeTable::new(field.size) == SizeTable::Rest { min: 0, max: 0 };
                assert!(!is_unknown, "{stream}: {:?}", field.size);
            }
        }
    }

    #[test]
    fn addresses_are_those_of_the_codec() {
        let offsets =
            (0..0x300_u32).flat_map(|low| [0, 1, 2, 0x7FFF, 0xFFFF].map(|axis| axis << 16 | low));
        let offsets: Vec<u32> = offsets.chain([u32::MAX]).collect();
        for function in Function::ALL {
            let (spec, table) = (function.spec(), FunctionTable::new(*function));
            assert!(!table.groups.is_empty(), "{function:?}");
            for &offset in &offsets {
                let expected = spec.offset.contains(IndexOffset::new(offset));
                assert_eq!(table.offsets.contains(offset), expected, "{function:?} {offset:#x}");
            }
        }
        assert_eq!(IndexGroup::new(GROUPS_END).parts(), None);
        assert_eq!(IndexGroup::new(GROUPS_END | 0x12_2301).parts(), None);
    }
}
