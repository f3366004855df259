//! Sequences: what takes a text or several steps to show. Unknown fields are errors.

use crate::catalogue::{self, Assumption, Level, Requirement};
use crate::hex::Hex;
use crate::vector::Provenance;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A part of [`Pieces`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Piece {
    /// ASCII characters, each a byte.
    Text(String),
    /// Bytes.
    Hex(HexPiece),
    /// ASCII characters so many times.
    Fill(FillPiece),
}

/// Bytes in a list of pieces.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HexPiece {
    /// The bytes.
    pub hex: Hex,
}

/// Repeated characters in a list of pieces.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FillPiece {
    /// The characters, mostly one.
    pub fill: String,
    /// How often.
    pub count: usize,
}

/// Bytes that a person can read: long ones and those that are no ASCII are written short.
///
/// ```
/// use ads_cnc_vectors::Pieces;
///
/// let pieces: Pieces =
///     serde_json::from_str(r#"["N10 ", { "fill": "X", "count": 3 }, { "hex": "e4" }, "\r\n"]"#)?;
/// assert_eq!(pieces.bytes(), b"N10 XXX\xE4\r\n");
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Pieces(pub Vec<Piece>);

impl Pieces {
    /// All bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let part = |piece: &Piece| match piece {
            Piece::Text(text) => text.clone().into_bytes(),
            Piece::Hex(piece) => piece.hex.to_vec(),
            Piece::Fill(piece) => piece.fill.repeat(piece.count).into_bytes(),
        };
        self.0.iter().flat_map(part).collect()
    }
}

/// How a write to the stream is answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StreamAck {
    /// It was taken.
    Accepted,
    /// Refused for now; the same has to come again.
    Later,
    /// Refused for good.
    Refused,
}

/// Where the CNC finds fault with what it has read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreamError {
    /// Number of the CNC's error, if it is printed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<u32>,
    /// Line since the start of the program, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
}

/// What happens at the streaming interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StreamAction {
    /// The streaming program is started.
    Start,
    /// The client writes.
    Write,
    /// The CNC takes what is there.
    Take,
    /// NC reset.
    Reset,
}

/// A step at the streaming interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreamStep {
    /// A slug; never a number.
    pub id: String,
    /// Milliseconds; those of the step before if there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// What happens.
    pub action: StreamAction,
    /// What is written or taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<Pieces>,
    /// Of a write: the answer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ack: Option<StreamAck>,
    /// Of a take: the fault that the CNC finds in it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<StreamError>,
    /// Of a take: the program end in it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<String>,
    /// Of a take: the lines behind the program end, which are not run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub discarded: Option<Pieces>,
    /// Bytes that the interface holds after the step.
    pub held: usize,
}

/// A client and the CNC at the streaming interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Streaming {
    /// The text that the client streams; without it, writes just happen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<Pieces>,
    /// What happens.
    pub steps: Vec<StreamStep>,
}

/// A service that listens on channel 1.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExternalService {
    /// Its UUID.
    pub uuid: String,
    /// What it does, if that is known: `square-root`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub does: Option<String>,
}

/// What somebody does at the Service Interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ServiceAction {
    /// Reads a variable.
    Read,
    /// Writes a variable.
    Write,
    /// The program decides to ask; its writes follow.
    Ask,
    /// The program looks, and goes on waiting.
    Wait,
    /// The program has the response and goes on.
    Done,
    /// The program gives up.
    Timeout,
    /// The service starts its task.
    Serve,
    /// The service has finished its task; its writes follow.
    Answer,
    /// The service looks, and has nothing to do.
    Idle,
}

/// Parameters of the cycle SysServiceWait, in decimal.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaitParameters {
    /// `@P1`: the response state in which it goes on waiting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p1: Option<String>,
    /// `@P2`: the longest wait in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p2: Option<String>,
    /// `@P3`: the timer's ID.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p3: Option<String>,
}

/// A step at the Service Interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServiceStep {
    /// A slug; never a number.
    pub id: String,
    /// Milliseconds; those of the step before if there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// Channel; 1 if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<u32>,
    /// `program`, a service by its name, or `other`: anybody, with no role to keep.
    pub actor: String,
    /// What is done.
    pub action: ServiceAction,
    /// Variable that is read or written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variable: Option<String>,
    /// Its bytes, a text's NUL included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<Pieces>,
    /// Of a state: the number, in decimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// Service that is asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uuid: Option<String>,
    /// What it is asked, without a NUL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request: Option<Pieces>,
    /// Request state, in decimal; 1 if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request_state: Option<String>,
    /// How the program waits; for ever if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<WaitParameters>,
    /// What is answered, without a NUL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<Pieces>,
    /// Response state, in decimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response_state: Option<String>,
    /// A service may leave this write out, or do it after the steps that follow.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub optional: bool,
}

/// A program and services at the Service Interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServiceSequence {
    /// The services by name.
    pub services: BTreeMap<String, ExternalService>,
    /// What happens.
    pub steps: Vec<ServiceStep>,
}

/// What a case is about.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Given {
    /// A text to be put into packets.
    NcText(Pieces),
    /// A text, in packets, to be looked through for what streaming does not permit.
    NcCheck(Vec<Pieces>),
    /// Steps at the streaming interface.
    Streaming(Streaming),
    /// Steps at the Service Interface.
    Service(ServiceSequence),
}

/// The case holds.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequenceAccept {
    /// Of a text to be put into packets: these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Pieces>>,
}

/// The case does not hold: why, and where.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequenceReject {
    /// Sort of fault.
    pub class: String,
    /// Of a finding: the requirement it is about.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clause: Option<String>,
    /// Of a text: the line at fault, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// Of a text: the column at fault, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<u32>,
    /// Of a finding: the line of the label or of the program end it has to do with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refers_to: Option<u32>,
    /// Of steps: the one at fault, which is the last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<String>,
}

/// What has to come of a case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SequenceExpect {
    /// It holds.
    Accept(SequenceAccept),
    /// It does not.
    Reject(SequenceReject),
}

/// A text or a sequence of steps, and what has to come of it.
///
/// ```
/// use ads_cnc_vectors::{Given, sequence};
///
/// let example = sequence("square-root-3").unwrap();
/// let Given::Service(given) = &example.given else { panic!("it is about a service") };
/// let last = given.steps.iter().rfind(|step| step.actor == "root" && step.bytes.is_some()).unwrap();
/// assert_eq!(last.variable.as_deref(), Some("V.G.SERVICE.RESPONSE_STATE"));
/// assert_eq!(last.bytes.as_ref().unwrap().bytes(), [1, 0, 0, 0]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sequence {
    /// A slug. Never reused.
    pub id: String,
    /// A few words.
    pub title: String,
    /// IDs of the requirements, or of parts of them, that its texts, steps or outcome exercise; at
    /// least one.
    pub requirements: Vec<String>,
    /// IDs of the errata it bears on.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// Short names of the documents whose edition says so, if others say otherwise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub editions: Vec<String>,
    /// The text or the steps.
    pub given: Given,
    /// What has to come of it.
    pub expect: SequenceExpect,
    /// For a rejected one: the accepted case from which it differs by this fault alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sibling: Option<String>,
    /// Where it comes from.
    pub provenance: Provenance,
    /// What no document says but the case needs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumption>,
}

impl Sequence {
    /// Whether it holds.
    pub fn is_accepted(&self) -> bool {
        matches!(self.expect, SequenceExpect::Accept(_))
    }

    /// What failing it means: the weakest level of what it cites, and [`Level::Info`] if an
    /// assumption decides the outcome.
    ///
    /// ```
    /// use ads_cnc_vectors::{Level, sequence};
    ///
    /// assert_eq!(sequence("loop-for").unwrap().level(), Level::Must);
    /// assert_eq!(sequence("loop-lower-case").unwrap().level(), Level::Info);
    /// ```
    pub fn level(&self) -> Level {
        catalogue::level(&self.requirements, &self.assumed)
    }

    /// The requirements of what it cites, each once.
    pub fn cited(&self) -> Vec<&'static Requirement> {
        catalogue::requirements_of(&self.requirements)
    }

    /// Word for what it is about, as in its JSON.
    pub fn kind(&self) -> &'static str {
        match self.given {
            Given::NcText(_) => "nc-text",
            Given::NcCheck(_) => "nc-check",
            Given::Streaming(_) => "streaming",
            Given::Service(_) => "service",
        }
    }
}
