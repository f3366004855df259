//! What the JSON files hold, one type for each shape. Unknown fields are errors.

use crate::hex::{Hex, address};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A manual, or the vendors' public help pages, under the short name that sources use.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Short name, such as `ads-en`.
    pub document: String,
    /// Edition; empty if none is printed.
    pub edition: String,
    /// Title as printed.
    pub title: String,
    /// `en` or `de`.
    pub language: String,
}

/// A place in a document.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section number, or a description where there are no numbers.
    pub section: String,
    /// Which example of the section; only in the provenance of a vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub example: Option<String>,
}

/// Where a statement comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Every edition that covers the subject says so.
    Stated,
    /// The editions differ, and the text says how.
    Edition,
    /// It follows from something stated or from a printed example.
    Derived,
    /// From the vendors' public help pages.
    Online,
    /// Nobody says; decided by this project.
    Assumed,
}

/// What not doing it means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// A failure.
    Must,
    /// A warning.
    Should,
    /// A difference worth naming, no more.
    Info,
}

/// How a requirement can be judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Observable {
    /// From bytes alone.
    Codec,
    /// In traffic.
    Wire,
    /// By asking a running CNC.
    Live,
}

/// A part of a requirement that stands on a basis of its own.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// What it says.
    pub text: String,
    /// Its own basis.
    pub basis: Basis,
    /// Its own level.
    pub level: Level,
}

/// One thing an implementation has to do.
///
/// ```
/// use ads_cnc_vectors::{Level, requirement};
///
/// let handle_read = requirement("VAR-11").unwrap();
/// assert_eq!((handle_read.area.as_str(), handle_read.level), ("VAR", Level::Must));
/// assert_eq!(handle_read.parts[0].level, Level::Info);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Area and number, such as `VAR-4`. Never reused.
    pub id: String,
    /// The part of the ID in front of the number.
    pub area: String,
    /// A few words.
    pub title: String,
    /// What is required, complete with offsets and limits.
    pub text: String,
    /// Where it stands; empty if it stands nowhere.
    pub sources: Vec<Source>,
    /// Basis of the text.
    pub basis: Basis,
    /// Level of the text.
    pub level: Level,
    /// What belongs to the requirement on another basis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
    /// How it can be judged; at least one way.
    pub observable: Vec<Observable>,
    /// IDs of the errata that touch it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// The vectors for it are still to come.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pending: bool,
    /// Why it has no vectors although it can be judged from bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excluded: Option<String>,
}

/// One reading of a place that contradicts another, or itself.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section, or several.
    pub section: String,
    /// The fact in question, as that place has it.
    pub reading: String,
}

/// How firm a ruling is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Decided for the time being: only a running CNC can tell.
    Open,
    /// Decided.
    Ruled,
}

/// A contradiction in the documents, and what was decided.
///
/// ```
/// use ads_cnc_vectors::{Status, erratum};
///
/// let name_end = erratum("E-17").unwrap();
/// assert_eq!(name_end.status, Status::Open);
/// assert!(name_end.readings.iter().any(|reading| reading.document == "ads-de"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// `E-` and a number. Never reused.
    pub id: String,
    /// A few words.
    pub title: String,
    /// Each reading with its place.
    pub readings: Vec<Reading>,
    /// What was decided.
    pub ruling: String,
    /// How firmly.
    pub status: Status,
}

/// Which way a stream goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// From the client.
    Request,
    /// From the CNC.
    Reply,
    /// Either way.
    Both,
}

/// ADS service that carries a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Service {
    /// Read
    Read,
    /// Write
    Write,
    /// ReadWrite
    ReadWrite,
}

/// Type of a tagged value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum Type {
    /// One byte, 0 or 1.
    Boolean,
    /// Unsigned, 1 byte.
    Uns08,
    /// Signed, 1 byte.
    Sgn08,
    /// Unsigned, 2 bytes.
    Uns16,
    /// Signed, 2 bytes.
    Sgn16,
    /// Unsigned, 4 bytes.
    Uns32,
    /// Signed, 4 bytes.
    Sgn32,
    /// Binary32, 4 bytes.
    Real32,
    /// Binary64, 8 bytes.
    Real64,
    /// Text in CP1252.
    String,
    /// AMS NetId, 6 bytes.
    NetId,
    /// Bytes without a meaning of their own.
    Bytes,
    /// A word of this project for a part of an address; not on the wire.
    Name,
}

/// What is known beside the bytes.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Context {
    /// ADS service that carries the stream.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub service: Option<Service>,
    /// Index group.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub index_group: Option<u32>,
    /// Index offset.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub index_offset: Option<u32>,
    /// Type of the elements of a value.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<Type>,
    /// Dimensions of a value; none of them for a single element.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Vec<u32>>,
    /// What an axis counts in an index offset.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub stride: Option<u32>,
    /// Vector of the request that this stream answers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request: Option<String>,
}

/// A single value with its type.
///
/// ```
/// use ads_cnc_vectors::{Tagged, Type};
///
/// let text: Tagged = serde_json::from_str(r#"{"type":"STRING","value":"V.E","hex":"56 2e 45"}"#)?;
/// assert_eq!(text.kind, Type::String);
/// assert_eq!(text.hex.as_deref(), Some(b"V.E".as_slice()));
/// let number: Tagged = serde_json::from_str(r#"{"type":"SGN32","value":"-2"}"#)?;
/// assert_eq!(number.integer(), Some(-2));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tagged {
    /// Type.
    #[serde(rename = "type")]
    pub kind: Type,
    /// The number in decimal, the NetId, the name, or the CP1252 reading of a text; none for bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// The bytes of a text in front of its NUL, or plain bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hex: Option<Hex>,
    /// Bits of a float, as `0x…`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<String>,
    /// Bytes behind the first NUL of a text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tail: Option<Hex>,
    /// The text has no NUL.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
}

impl Tagged {
    /// The value of an integer type, BOOLEAN included.
    pub fn integer(&self) -> Option<i64> {
        match self.kind {
            Type::Boolean | Type::Uns08 | Type::Uns16 | Type::Uns32 => {}
            Type::Sgn08 | Type::Sgn16 | Type::Sgn32 => {}
            _ => return None,
        }
        self.value.as_deref()?.parse().ok()
    }

    /// The bits of a float, those of a REAL32 in the low half.
    pub fn real_bits(&self) -> Option<u64> {
        let digits = self.bits.as_deref()?.strip_prefix("0x")?;
        u64::from_str_radix(digits, 16).ok()
    }
}

/// The fields of a stream under their names.
pub type Fields = BTreeMap<String, Value>;

/// What a stream or one of its fields stands for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// One value.
    One(Tagged),
    /// A list: dimensions, indices, elements, descriptors.
    List(Vec<Value>),
    /// A record with fields of its own.
    Record(Fields),
}

impl Value {
    /// The single value, if it is one.
    pub fn tagged(&self) -> Option<&Tagged> {
        match self {
            Value::One(tagged) => Some(tagged),
            _ => None,
        }
    }

    /// The items, if it is a list.
    pub fn list(&self) -> Option<&[Value]> {
        match self {
            Value::List(items) => Some(items),
            _ => None,
        }
    }
}

/// A piece of a stream that a person can hold beside the manual.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segment {
    /// Field it belongs to, such as `dimensions[0]`, or `trailing` and the like for a fault.
    pub field: String,
    /// Its bytes; none for a field that takes no room.
    pub hex: Hex,
    /// What these bytes alone stand for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
}

/// The stream is well-formed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accept {
    /// What it stands for, without the numbers that only count something else in it.
    pub value: Fields,
    /// How a careful writer puts the same value, if that is another stream.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub canonical: Option<Hex>,
}

/// The stream is malformed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reject {
    /// Sort of fault; advice for a codec that has its own.
    pub class: String,
    /// First byte of the field at fault, or the first byte too many; advice likewise.
    pub offset: usize,
    /// Field at fault; advice likewise.
    pub field: String,
}

/// What a codec has to make of a stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Expect {
    /// Decode it to the value.
    Accept(Accept),
    /// Refuse it.
    Reject(Reject),
}

/// Sort of origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProvenanceKind {
    /// An example printed in the manuals.
    Manual,
    /// Made up for a reason.
    Derived,
    /// Found by fuzzing.
    Fuzz,
}

/// Where a vector comes from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Sort of origin.
    pub kind: ProvenanceKind,
    /// Why it was made; only for those that are not printed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The printed example, or what the vector is derived from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<Source>,
}

/// One stream, and what a codec has to make of it.
///
/// ```
/// use ads_cnc_vectors::{Expect, vector, vectors};
///
/// for rejected in vectors().iter().filter(|v| !v.is_accepted()) {
///     let sibling = rejected.sibling.as_deref().and_then(vector).unwrap();
///     assert!(sibling.is_accepted());
///     assert_ne!(sibling.bytes(), rejected.bytes());
/// }
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vector {
    /// A slug. Never reused.
    pub id: String,
    /// A few words.
    pub title: String,
    /// IDs of the requirements it bears on; at least one.
    pub requirements: Vec<String>,
    /// IDs of the errata it bears on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// Sort of stream.
    pub stream: String,
    /// Which way it goes.
    pub direction: Direction,
    /// What is known beside the bytes.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub context: Context,
    /// The bytes, piece by piece.
    pub segments: Vec<Segment>,
    /// What a codec has to make of them.
    pub expect: Expect,
    /// For a rejected one: the accepted vector from which it differs by this fault alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sibling: Option<String>,
    /// Where it comes from.
    pub provenance: Provenance,
    /// What no document says but the vector needs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
}

impl Vector {
    /// The stream: all segments, one behind the other.
    pub fn bytes(&self) -> Vec<u8> {
        self.segments.iter().flat_map(|segment| segment.hex.iter().copied()).collect()
    }

    /// Whether a codec has to accept it.
    pub fn is_accepted(&self) -> bool {
        matches!(self.expect, Expect::Accept(_))
    }
}

fn is_empty(context: &Context) -> bool {
    *context == Context::default()
}
