//! Sequences: cases that need a text or several steps. Unknown fields are errors.

use crate::catalogue::{self, Assumption, Level, Requirement};
use crate::hex::Hex;
use crate::vector::Provenance;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A part of [`Pieces`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Piece {
    /// ASCII characters; each character is one byte.
    Text(String),
    /// Bytes.
    Hex(HexPiece),
    /// Repeated ASCII characters.
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
    /// The repeated text, usually one character.
    pub fill: String,
    /// How many times the text is repeated.
    pub count: usize,
}

/// Bytes in a readable form: long repetitions and bytes outside ASCII have their own pieces.
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

/// The response to a write at the streaming interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StreamingAck {
    /// The interface accepted the write.
    Accepted,
    /// The interface rejected the write for now; the client has to write the same bytes again.
    Later,
    /// The interface rejected the write permanently.
    Rejected,
}

/// The fault that the CNC finds in the data that it has read, and its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreamingFault {
    /// Number of the CNC error, if the manual prints it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<u32>,
    /// Line, counted from the start of the program, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
}

/// An action at the streaming interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StreamingAction {
    /// The streaming program is started.
    Start,
    /// The client writes bytes.
    Write,
    /// The CNC reads and removes all bytes that the interface contains.
    Take,
    /// The NC channel is reset.
    Reset,
}

/// A step at the streaming interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreamingStep {
    /// ID of the step, unique in the case: a slug, never a number.
    pub id: String,
    /// Time in milliseconds; `None` for the time of the previous step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// The action.
    pub action: StreamingAction,
    /// The bytes that are written or taken.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<Pieces>,
    /// For a write: the response.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ack: Option<StreamingAck>,
    /// For a take: the fault that the CNC finds in the bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<StreamingFault>,
    /// For a take: the program end in the bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<String>,
    /// For a take: the lines after the program end, which are discarded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub discarded: Option<Pieces>,
    /// The number of bytes that the interface contains after the step.
    pub buffered: usize,
}

/// A client and the CNC at the streaming interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Streaming {
    /// The text that the client streams; `None` if the case does not test a client, but only a CNC.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub text: Option<Pieces>,
    /// The steps, in their order.
    pub steps: Vec<StreamingStep>,
}

/// A service that listens on channel 1.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExternalService {
    /// UUID of the service.
    pub uuid: String,
    /// The task of the service, if its answer follows from the request: `square-root`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub does: Option<String>,
}

/// An action at the Service Interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ServiceAction {
    /// The actor reads a variable.
    Read,
    /// The actor writes a variable.
    Write,
    /// The program decides to send a request; its writes follow.
    Ask,
    /// The program checks for the response and continues to wait.
    Wait,
    /// The program continues with the response.
    Done,
    /// The program gives up.
    Timeout,
    /// The service starts its task.
    Serve,
    /// The service has finished its task; its writes follow.
    Answer,
    /// The service checks for a request and has nothing to do.
    Idle,
}

/// Parameters of the cycle SysServiceWait, in decimal.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaitParameters {
    /// `@P1`: the response state in which the program continues to wait.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p1: Option<String>,
    /// `@P2`: the maximum wait in milliseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p2: Option<String>,
    /// `@P3`: the ID of the timer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub p3: Option<String>,
}

/// A step at the Service Interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServiceStep {
    /// ID of the step, unique in the case: a slug, never a number.
    pub id: String,
    /// Time in milliseconds; `None` for the time of the previous step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<u64>,
    /// Channel; `None` for channel 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<u32>,
    /// `program`, the name of a service, or `other`: any other party, which has no prescribed role.
    pub actor: String,
    /// The action.
    pub action: ServiceAction,
    /// Variable that is read or written.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variable: Option<String>,
    /// The bytes of the variable, including the NUL of a text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bytes: Option<Pieces>,
    /// For a variable that contains a state: its number, in decimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// UUID of the service to which the request is sent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uuid: Option<String>,
    /// The request, without a NUL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request: Option<Pieces>,
    /// Request state, in decimal; `None` for 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub request_state: Option<String>,
    /// The parameters of the cycle SysServiceWait with which the program waits; `None` if it waits,
    /// without a limit, until RESPONSE_STATE is not 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wait: Option<WaitParameters>,
    /// The response, without a NUL.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<Pieces>,
    /// Response state, in decimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response_state: Option<String>,
    /// Whether a service may omit this write, or perform it after later steps.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub optional: bool,
}

/// A program and services at the Service Interface.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServiceSequence {
    /// The services by name.
    pub services: BTreeMap<String, ExternalService>,
    /// The steps, in their order.
    pub steps: Vec<ServiceStep>,
}

/// The input of a case; its variant is the kind of the case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum SequenceInput {
    /// A text to be divided into packets.
    NcText(Pieces),
    /// A text, in packets, to be checked for constructs that streaming does not permit.
    NcCheck(Vec<Pieces>),
    /// Steps at the streaming interface.
    Streaming(Streaming),
    /// Steps at the Service Interface.
    Service(ServiceSequence),
}

/// The outcome of a case without a fault: the text can be sent, the check finds no fault, or all steps
/// proceed as stated.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequenceAccept {
    /// For a text to be divided into packets: the packets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packets: Option<Vec<Pieces>>,
}

/// The fault of a case, and its position.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SequenceReject {
    /// Class of the fault.
    pub class: String,
    /// For a fault that a check finds: the violated requirement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clause: Option<String>,
    /// For a text: the faulty line, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// For a text: the faulty column, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub column: Option<u32>,
    /// For a fault that a check finds: the line of the label or program end to which it refers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refers_to: Option<u32>,
    /// For steps: the faulty step, which is the last one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<String>,
}

/// The expected outcome of a case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SequenceExpect {
    /// The case has no fault.
    Accept(SequenceAccept),
    /// The case has a fault.
    Reject(SequenceReject),
}

/// A text or a sequence of steps, and the expected outcome.
///
/// ```
/// use ads_cnc_vectors::{SequenceInput, sequence};
///
/// let example = sequence("square-root-3").unwrap();
/// let SequenceInput::Service(given) = &example.given else { panic!("it is about a service") };
/// let last = given.steps.iter().rfind(|step| step.actor == "root" && step.bytes.is_some()).unwrap();
/// assert_eq!(last.variable.as_deref(), Some("V.G.SERVICE.RESPONSE_STATE"));
/// assert_eq!(last.bytes.as_ref().unwrap().bytes(), [1, 0, 0, 0]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sequence {
    /// ID: a slug, which is never reused.
    pub id: String,
    /// Title of a few words.
    pub title: String,
    /// IDs of the requirements, or of parts of requirements, that the texts, steps or outcome of the case
    /// exercise; at least one.
    pub requirements: Vec<String>,
    /// IDs of the errata that affect the case.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// Documents that state the expected outcome, if another edition contradicts it or omits it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub editions: Vec<String>,
    /// The text or the steps.
    pub given: SequenceInput,
    /// The expected outcome.
    pub expect: SequenceExpect,
    /// For a rejected case: an accepted case that differs only in lacking this fault.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sibling: Option<String>,
    /// Origin of the case.
    pub provenance: Provenance,
    /// The assumptions that the case needs and that no document states.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<Assumption>,
}

impl Sequence {
    /// Whether the expected outcome is [`SequenceExpect::Accept`].
    pub fn is_accepted(&self) -> bool {
        matches!(self.expect, SequenceExpect::Accept(_))
    }

    /// The level of the case: [`Level::Info`] if an assumption decides the outcome, otherwise the
    /// weakest level among the cited clauses.
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

    /// The cited requirements, and the requirements of the cited parts, each only once.
    pub fn cited(&self) -> Vec<&'static Requirement> {
        catalogue::requirements_of(&self.requirements)
    }

    /// The name of the kind of the case in the JSON files.
    pub fn kind(&self) -> &'static str {
        match self.given {
            SequenceInput::NcText(_) => "nc-text",
            SequenceInput::NcCheck(_) => "nc-check",
            SequenceInput::Streaming(_) => "streaming",
            SequenceInput::Service(_) => "service",
        }
    }
}
