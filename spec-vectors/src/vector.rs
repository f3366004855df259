//! Vectors: one type for each JSON object. Unknown fields are errors.

use crate::catalogue::{self, Assumption, Level, Requirement, Source};
use crate::hex::{Hex, address};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Direction of a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// From the client to the CNC.
    Request,
    /// From the CNC to the client.
    Reply,
    /// In both directions.
    Both,
}

/// ADS service that carries a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum AdsService {
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
    /// One byte; 0 is FALSE, any other byte is TRUE.
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
    /// BOOLEAN, by its name in the COM task.
    Bool,
    /// Unsigned, 1 byte; a type name of the COM task.
    Byte,
    /// Signed, 1 byte; a type name of the COM task.
    Sint,
    /// Unsigned, 2 bytes; a type name of the COM task.
    Word,
    /// Signed, 2 bytes; a type name of the COM task.
    Int,
    /// Unsigned, 4 bytes; a type name of the COM task.
    Dword,
    /// Signed, 4 bytes; a type name of the COM task.
    Dint,
    /// Unsigned, 8 bytes; a type name of the COM task.
    Lword,
    /// Signed, 8 bytes; a type name of the COM task.
    Lint,
    /// Binary32, 4 bytes; a type name of the COM task.
    Real,
    /// Binary64, 8 bytes; a type name of the COM task.
    Lreal,
    /// Text in CP1252.
    String,
    /// AMS NetId, 6 bytes.
    NetId,
    /// Bytes without a further structure.
    Bytes,
    /// A word for a part of an address. This project defines the words; the stream does not contain them.
    Name,
}

impl Type {
    /// The name of the type in the data files, which is the name in the manuals if they have the type.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "BOOLEAN",
            Self::Uns08 => "UNS08",
            Self::Sgn08 => "SGN08",
            Self::Uns16 => "UNS16",
            Self::Sgn16 => "SGN16",
            Self::Uns32 => "UNS32",
            Self::Sgn32 => "SGN32",
            Self::Real32 => "REAL32",
            Self::Real64 => "REAL64",
            Self::Bool => "BOOL",
            Self::Byte => "BYTE",
            Self::Sint => "SINT",
            Self::Word => "WORD",
            Self::Int => "INT",
            Self::Dword => "DWORD",
            Self::Dint => "DINT",
            Self::Lword => "LWORD",
            Self::Lint => "LINT",
            Self::Real => "REAL",
            Self::Lreal => "LREAL",
            Self::String => "STRING",
            Self::NetId => "NETID",
            Self::Bytes => "BYTES",
            Self::Name => "NAME",
        }
    }
}

/// The information that a decoder has in addition to the bytes.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Context {
    /// ADS service that carries the stream.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub service: Option<AdsService>,
    /// Index group.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub index_group: Option<u32>,
    /// Index offset.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub index_offset: Option<u32>,
    /// Type of the elements of a value, or of the items of a content.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<Type>,
    /// Dimensions of a value or content; an empty list for a single element.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Vec<u32>>,
    /// Stride of an axis in an index offset.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub stride: Option<u32>,
    /// Base of an index group, to which a channel, axis or spindle was added.
    #[serde(default, with = "address", skip_serializing_if = "Option::is_none")]
    pub base: Option<u32>,
    /// ID of the vector whose stream is the data of the service in a frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub carries: Option<String>,
    /// ID of the vector of the request to which this stream is the reply.
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
    /// Type of the value.
    #[serde(rename = "type")]
    pub kind: Type,
    /// The number in decimal, the NetId, the name, or a text decoded as CP1252; `None` for bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// The bytes of a text before its NUL, or plain bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hex: Option<Hex>,
    /// Bits of a floating-point number, as `0x…`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bits: Option<String>,
    /// Bytes after the first NUL of a text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tail: Option<Hex>,
    /// Whether the text has no NUL.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub open: bool,
}

impl Tagged {
    /// The value of an integer type, including BOOLEAN and BOOL. `None` for other types.
    pub fn integer(&self) -> Option<i128> {
        match self.kind {
            Type::Boolean | Type::Uns08 | Type::Uns16 | Type::Uns32 => {}
            Type::Sgn08 | Type::Sgn16 | Type::Sgn32 => {}
            Type::Bool | Type::Byte | Type::Word | Type::Dword | Type::Lword => {}
            Type::Sint | Type::Int | Type::Dint | Type::Lint => {}
            _ => return None,
        }
        self.value.as_deref()?.parse().ok()
    }

    /// The bits of a floating-point number; those of a REAL32 or REAL are in the low half. `None` for
    /// other types.
    pub fn real_bits(&self) -> Option<u64> {
        let digits = self.bits.as_deref()?.strip_prefix("0x")?;
        u64::from_str_radix(digits, 16).ok()
    }
}

/// The fields of a stream under their names.
pub type Fields = BTreeMap<String, Value>;

/// The value of a stream or of one of its fields.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// One value.
    One(Tagged),
    /// A list: dimensions, indices, elements, descriptors.
    List(Vec<Value>),
    /// A record with its own fields.
    Record(Fields),
}

impl Value {
    /// The single value, or `None` for a list or a record.
    pub fn tagged(&self) -> Option<&Tagged> {
        match self {
            Value::One(tagged) => Some(tagged),
            _ => None,
        }
    }

    /// The items of a list, or `None` for a single value or a record.
    pub fn list(&self) -> Option<&[Value]> {
        match self {
            Value::List(items) => Some(items),
            _ => None,
        }
    }
}

/// A part of a stream, at most one field or list, so that a reader can compare it with the manual.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Segment {
    /// The field, such as `dimensions[0]`; for a fault also a name such as `trailing`.
    pub field: String,
    /// The bytes of the segment; empty for a field without bytes.
    pub hex: Hex,
    /// The value of the bytes, if they represent a value of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
}

/// The expected outcome for a well-formed stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Accept {
    /// Value of the stream, without numbers that only count other data of the stream.
    pub value: Fields,
    /// The canonical bytes of the value, if they differ from the stream.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub canonical: Option<Hex>,
}

/// The expected outcome for a malformed stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reject {
    /// Class of the fault. This is advisory, because a codec may classify faults differently.
    pub class: String,
    /// Offset of the fault: the start of the faulty field, or for some classes a byte in it or after
    /// it, such as the first extra byte. This is advisory.
    pub offset: usize,
    /// Name of the faulty field. This is advisory.
    pub field: String,
}

/// The expected outcome of decoding a stream.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Expect {
    /// A codec must decode the stream to the value.
    Accept(Accept),
    /// A codec must reject the stream.
    Reject(Reject),
}

/// Kind of origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ProvenanceKind {
    /// An example printed in the manuals.
    Manual,
    /// Made by this project, for the reason in [`Provenance::reason`].
    Derived,
    /// Found by fuzzing.
    Fuzz,
}

/// The origin of a vector or a sequence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Kind of origin.
    pub kind: ProvenanceKind,
    /// The reason why the vector or sequence was made; only if it is not a printed example.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The printed example, or the examples from which the vector or sequence is derived.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<Source>,
}

/// One stream and the expected outcome of decoding it.
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
    /// ID: a slug, which is never reused.
    pub id: String,
    /// Title of a few words.
    pub title: String,
    /// IDs of the requirements, or of parts of requirements, that the bytes or the outcome of the vector
    /// exercise; at least one.
    pub requirements: Vec<String>,
    /// IDs of the errata that affect the vector.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// Kind of stream.
    pub stream: String,
    /// Direction of the stream.
    pub direction: Direction,
    /// Documents that state the expected outcome, if another edition contradicts it or omits it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub editions: Vec<String>,
    /// The information that a decoder has in addition to the bytes.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub context: Context,
    /// The bytes, field by field.
    pub segments: Vec<Segment>,
    /// The expected outcome.
    pub expect: Expect,
    /// For a rejected vector: an accepted vector that differs only in lacking this fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sibling: Option<String>,
    /// Origin of the vector.
    pub provenance: Provenance,
    /// The assumptions that the vector needs and that no document states.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumption>,
}

impl Vector {
    /// The stream: the bytes of all segments, concatenated.
    pub fn bytes(&self) -> Vec<u8> {
        self.segments.iter().flat_map(|segment| segment.hex.iter().copied()).collect()
    }

    /// Whether a codec has to accept the stream.
    pub fn is_accepted(&self) -> bool {
        matches!(self.expect, Expect::Accept(_))
    }

    /// The level of the vector: [`Level::Info`] if an assumption decides the outcome, otherwise the
    /// weakest level among the cited clauses.
    ///
    /// ```
    /// use ads_cnc_vectors::{Level, vector};
    ///
    /// assert_eq!(vector("handle-printed").unwrap().level(), Level::Must);
    /// assert_eq!(vector("kind-no-bytes").unwrap().level(), Level::Info);
    /// ```
    pub fn level(&self) -> Level {
        catalogue::level(&self.requirements, &self.assumed)
    }

    /// The level of a difference that no assumption covers: the weakest level among the cited clauses
    /// that a document states.
    ///
    /// ```
    /// use ads_cnc_vectors::{Level, vector};
    ///
    /// // The width of four bytes is assumed; the value, 16, is not.
    /// let count = vector("object-count").unwrap();
    /// assert_eq!((count.level(), count.stated_level()), (Level::Info, Level::Must));
    /// ```
    pub fn stated_level(&self) -> Level {
        catalogue::stated_level(&self.requirements)
    }

    /// The cited requirements, and the requirements of the cited parts, each only once.
    pub fn cited(&self) -> Vec<&'static Requirement> {
        catalogue::requirements_of(&self.requirements)
    }
}

fn is_empty(context: &Context) -> bool {
    *context == Context::default()
}
