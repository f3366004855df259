//! The lines that go to a testee and come from it.

use ads_cnc_vectors::{Context, Fields, Type};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

pub const PROTOCOL: u32 = 1;

use crate::text::{hex::compact, shorten};

/// A line to the testee.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cmd", rename_all = "lowercase")]
pub enum TesteeCommand {
    /// The first line.
    Hello { protocol: u32 },
    Case {
        /// Number of the case in this run.
        seq: u64,
        #[serde(flatten)]
        question: Box<Question>,
    },
    /// The last line.
    Bye,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// `decode`, `encode`, `packets`, `check`, or one that does not exist.
    pub op: String,
    pub stream: String,
    /// The edition, such as `en-1.05`.
    pub edition: String,
    /// What has to be known beside the bytes.
    #[serde(default)]
    pub context: Known,
    /// Bytes.
    #[serde(default, with = "compact::option", skip_serializing_if = "Option::is_none")]
    pub hex: Option<Vec<u8>>,
    /// Fields of a value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Fields>,
    /// Pieces of an NC program as they are written.
    #[serde(default, with = "compact::list", skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Vec<u8>>>,
}

impl Question {
    /// A question about nothing yet.
    pub fn new(op: impl Into<String>, stream: impl Into<String>, edition: &str) -> Self {
        Self {
            op: op.into(),
            stream: stream.into(),
            edition: edition.to_owned(),
            context: Known::default(),
            hex: None,
            value: None,
            packets: None,
        }
    }
}

/// What a testee is told beside the bytes: no more than it needs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Known {
    /// Type of the elements of a value or content.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<Type>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Vec<u32>>,
    /// What an axis counts in an index offset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stride: Option<String>,
    /// Index group without its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
}

impl From<&Context> for Known {
    fn from(context: &Context) -> Self {
        let address = |number: u32| format!("{number:#x}");
        Self {
            kind: context.kind,
            dimensions: context.dimensions.clone(),
            stride: context.stride.map(address),
            base: context.base.map(address),
        }
    }
}

impl Known {
    /// As a context of the vectors; none if an address is none.
    pub(crate) fn context(&self) -> Option<Context> {
        let address = |text: &Option<String>| match text.as_deref() {
            None => Some(None),
            Some(text) => {
                let digits = text.strip_prefix("0x")?;
                u32::from_str_radix(digits, 16).ok().map(Some)
            }
        };
        Some(Context {
            kind: self.kind,
            dimensions: self.dimensions.clone(),
            stride: address(&self.stride)?,
            base: address(&self.base)?,
            ..Context::default()
        })
    }
}

/// The answer to `hello`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TesteeHello {
    pub protocol: u32,
    pub testee: Identity,
    /// What it can do.
    pub capabilities: Capabilities,
}

/// The name, version and language of a program, as its answer to `hello` has them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    pub name: String,
    #[serde(default)]
    pub version: String,
    #[serde(default)]
    pub language: String,
}

/// What a testee claims to be able to do.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capabilities {
    /// Ops.
    pub ops: Vec<String>,
    /// Streams by name.
    pub streams: Vec<String>,
    /// Editions, such as `en-1.05`.
    #[serde(default)]
    pub editions: Vec<String>,
}

impl Capabilities {
    /// Whether it claims this op of this stream.
    pub fn claim(&self, op: &str, stream: &str) -> bool {
        let is_text = matches!(op, "packets" | "check");
        self.ops.iter().any(|one| one == op)
            && (is_text || self.streams.iter().any(|one| one == stream))
    }
}

/// The answer to a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    Ok(Output),
    /// It cannot be.
    Reject(Rejection),
    /// The testee does not do this.
    Unsupported {
        /// Of the question: `op`, `stream`, `edition`, `context`.
        what: String,
    },
    /// Something else is wrong.
    Error {
        message: String,
    },
}

/// What has come of a case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Of `decode`: the value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// Of `encode`: the bytes.
    #[serde(default, with = "compact::option", skip_serializing_if = "Option::is_none")]
    pub hex: Option<Vec<u8>>,
    /// Of `packets`: what is written one after the other.
    #[serde(default, with = "compact::list", skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Vec<u8>>>,
}

/// Why something cannot be.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejection {
    /// Sort of fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub class: Option<String>,
    /// Where, in bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// Where, in lines from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Anything that helps a person.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
}

/// A line from the testee that answers a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Keys")]
pub struct Reply {
    /// Number of the case; none if the line of the case could not be read.
    pub seq: Option<u64>,
    #[serde(flatten)]
    pub answer: Answer,
}

/// The most characters that are kept of a text in an answer.
const TEXT_MAX: usize = 400;

fn short(text: &str) -> String {
    shorten(text, TEXT_MAX)
}

impl Rejection {
    fn cut(self) -> Self {
        let short = |text: Option<String>| text.map(|text| short(&text));
        Self { class: short(self.class), message: short(self.message), ..self }
    }
}

impl Output {
    /// About how many bytes of memory it takes.
    pub(crate) fn weight(&self) -> usize {
        let packets = self.packets.iter().flatten().map(|packet| packet.len().saturating_add(NODE));
        let parts = [self.value.as_ref().map(weight), self.hex.as_ref().map(Vec::len)];
        parts.into_iter().flatten().chain(packets).fold(NODE, usize::saturating_add)
    }
}

/// About what a value of JSON takes beside its text.
const NODE: usize = 64;

/// About what the map of an object takes, with room for several keys.
const MAP: usize = 1024;

fn weight(value: &Value) -> usize {
    match value {
        Value::String(text) => text.len(),
        Value::Array(all) => all.iter().map(weight).fold(0, usize::saturating_add),
        Value::Object(all) => {
            let each = all.iter().map(|(key, value)| key.len().saturating_add(weight(value)));
            each.fold(if all.is_empty() { 0 } else { MAP }, usize::saturating_add)
        }
        _ => 0,
    }
    .saturating_add(NODE)
}

/// The same with every key that an answer may have: who gives two has not answered.
#[derive(Deserialize)]
struct Keys {
    seq: Option<u64>,
    #[serde(default, deserialize_with = "present")]
    ok: Option<Output>,
    #[serde(default, deserialize_with = "present")]
    reject: Option<Rejection>,
    #[serde(default, deserialize_with = "present")]
    unsupported: Option<Unsupported>,
    #[serde(default, deserialize_with = "present")]
    error: Option<OwnError>,
}

#[derive(Deserialize)]
struct Unsupported {
    what: String,
}

#[derive(Deserialize)]
struct OwnError {
    message: String,
}

/// A key that is there has a value; null is none of these.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

impl TryFrom<Keys> for Reply {
    type Error = String;

    fn try_from(keys: Keys) -> Result<Self, String> {
        let Keys { seq, ok, reject, unsupported, error } = keys;
        let given = [
            ok.map(|output| ("ok", Answer::Ok(output))),
            reject.map(|rejection| ("reject", Answer::Reject(rejection.cut()))),
            unsupported.map(|Unsupported { what }| {
                ("unsupported", Answer::Unsupported { what: short(&what) })
            }),
            error.map(|OwnError { message }| ("error", Answer::Error { message: short(&message) })),
        ];
        let mut given = given.into_iter().flatten();
        let (first, answer) =
            given.next().ok_or("none of ok, reject, unsupported and error is there")?;
        match given.next() {
            None => Ok(Self { seq, answer }),
            Some((second, _)) => Err(format!("both {first} and {second} are there")),
        }
    }
}
