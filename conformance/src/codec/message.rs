//! The lines of the testee protocol.

use ads_cnc_vectors::{Context, Fields, Type};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

pub const PROTOCOL: u32 = 1;

use crate::edition::Edition;
use crate::text::{did_you_mean, hex::compact, shorten};

/// A line from the suite to the testee.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "cmd", rename_all = "lowercase")]
pub enum TesteeCommand {
    /// The first line to the testee.
    Hello { protocol: u32 },
    Case {
        /// The number of the question in this run, which the answer repeats.
        seq: u64,
        #[serde(flatten)]
        question: Box<Question>,
    },
    /// The last line to the testee.
    Bye,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Question {
    /// The op: `decode`, `encode`, `packets`, `check`, or any other word to test an unknown op.
    pub op: String,
    pub stream: String,
    /// The edition, such as `en-1.05`.
    pub edition: String,
    /// The facts that the testee needs, but that the bytes do not contain.
    #[serde(default)]
    pub context: QuestionContext,
    #[serde(default, with = "compact::option", skip_serializing_if = "Option::is_none")]
    pub hex: Option<Vec<u8>>,
    /// The fields of the value to encode.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Fields>,
    /// The packets of an NC program.
    #[serde(default, with = "compact::list", skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Vec<u8>>>,
}

impl Question {
    /// A question without input.
    pub fn new(op: impl Into<String>, stream: impl Into<String>, edition: &str) -> Self {
        Self {
            op: op.into(),
            stream: stream.into(),
            edition: edition.to_owned(),
            context: QuestionContext::default(),
            hex: None,
            value: None,
            packets: None,
        }
    }
}

/// The facts that a question needs and its bytes do not contain.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct QuestionContext {
    /// Type of the elements of a value or content.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<Type>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dimensions: Option<Vec<u32>>,
    /// The number that one axis adds to an index offset: 0x10000 or 0x1000, in hex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stride: Option<String>,
    /// The index group without the number of the channel, axis or spindle, in hex.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
}

impl From<&Context> for QuestionContext {
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

impl QuestionContext {
    /// Converts the facts to a context of the vectors; `None` if `stride` or `base` is invalid.
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
    pub capabilities: Capabilities,
}

/// Name, version and language of a program, from its answer to `hello`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    pub name: String,
    #[serde(default)]
    pub version: String,
    #[serde(default)]
    pub language: String,
}

/// The capabilities that a testee claims.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Capabilities {
    pub ops: Vec<String>,
    /// Streams by name.
    pub streams: Vec<String>,
    /// Editions, such as `en-1.05`.
    #[serde(default)]
    pub editions: Vec<String>,
}

/// The ops of the protocol.
pub(crate) const OPS: [&str; 4] = ["decode", "encode", "packets", "check"];

impl Capabilities {
    /// Describes the first op, stream or edition that does not exist; `None` if all exist.
    pub(crate) fn misspelt(&self) -> Option<String> {
        let is_op = |op: &&String| !OPS.contains(&op.as_str());
        if let Some(op) = self.ops.iter().find(is_op) {
            return Some(format!("{op:?} is not an op{}", did_you_mean(op, OPS)));
        }
        let streams = || {
            let vectors = ads_cnc_vectors::vectors().iter().map(|vector| vector.stream.as_str());
            vectors.chain(["nc-text", "nc-check"])
        };
        let is_unknown = |name: &&String| !streams().any(|stream| stream == name.as_str());
        if let Some(name) = self.streams.iter().find(is_unknown) {
            let hint = did_you_mean(name, streams());
            return Some(format!("{name:?} is not a stream of the vectors{hint}"));
        }
        self.editions.iter().find_map(|name| Edition::by_name(name).err())
    }

    /// Whether the testee claims this op and this stream. The ops `packets` and `check` need no
    /// claim of a stream.
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
    /// The input is invalid.
    Reject(Rejection),
    /// The testee does not implement a part of the question.
    Unsupported {
        /// The unsupported part of the question: `op`, `stream`, `edition`, `context`.
        what: String,
    },
    /// The testee itself failed.
    Error {
        message: String,
    },
}

/// The output of a case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// The value, for `decode`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
    /// The bytes, for `encode`.
    #[serde(default, with = "compact::option", skip_serializing_if = "Option::is_none")]
    pub hex: Option<Vec<u8>>,
    /// The packets in the order in which they are written, for `packets`.
    #[serde(default, with = "compact::list", skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Vec<u8>>>,
}

/// Why the input is invalid.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejection {
    /// Class of the error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub class: Option<String>,
    /// Byte offset of the error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// Line number of the error, starting at 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u64>,
    /// Message for a reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
}

/// A line from the testee, which answers a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Keys")]
pub struct AnswerLine {
    /// The number of the question; `None` if the testee could not parse the line.
    pub seq: Option<u64>,
    #[serde(flatten)]
    pub answer: Answer,
}

/// Maximum number of characters that are stored of a class, a message or `what` in an answer.
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
    /// The output without the members of other ops, which are not judged.
    pub(crate) fn of_op(self, op: &str) -> Self {
        match op {
            "decode" => Self { hex: None, packets: None, ..self },
            "encode" => Self { value: None, packets: None, ..self },
            "packets" => Self { value: None, hex: None, ..self },
            "check" => Self::default(),
            _ => self,
        }
    }

    /// Estimated memory of the output in bytes.
    pub(crate) fn weight(&self) -> usize {
        let packets = self.packets.iter().flatten().map(|packet| packet.len().saturating_add(NODE));
        let parts = [self.value.as_ref().map(weight), self.hex.as_ref().map(Vec::len)];
        parts.into_iter().flatten().chain(packets).fold(NODE, usize::saturating_add)
    }
}

/// Estimated memory in bytes of a JSON value or a packet, in addition to its text or bytes.
const NODE: usize = 64;

/// Estimated memory in bytes of the map of a JSON object that is not empty.
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

/// The keys of an answer line: `seq`, and the four kinds of answers, of which exactly one must be
/// present.
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

/// Deserializes a key that is present; its value must not be null.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> Result<Option<T>, D::Error> {
    T::deserialize(from).map(Some)
}

impl TryFrom<Keys> for AnswerLine {
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
            given.next().ok_or("the answer has none of ok, reject, unsupported and error")?;
        match given.next() {
            None => Ok(Self { seq, answer }),
            Some((second, _)) => Err(format!("the answer has both {first} and {second}")),
        }
    }
}
