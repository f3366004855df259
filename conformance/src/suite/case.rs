//! What a case is and what it finds.

use std::fmt;

use ads_cnc::ads::FrameRef;
use ads_cnc_vectors::{Level, Sequence, Vector, clause};
use serde::{Deserialize, Serialize};

use super::Probe;
use crate::client::{Inquired, Inquiry};
use crate::exchange::Exchange;
use crate::explain::Values;
use crate::gate::Gate;
use crate::profile::Profile;
use crate::verdict::Verdict;

/// One thing the suite tries.
#[derive(Clone, Debug)]
pub struct Case {
    /// A slug that keeps its meaning.
    pub id: String,
    /// What is tried, in a sentence.
    pub title: String,
    /// Who is judged.
    pub subject: Subject,
    /// The requirements it can judge.
    pub requirements: Vec<&'static str>,
    /// What it asks of the target beyond a first channel.
    pub needs: Needs,
    /// How it is done.
    pub body: Body,
}

/// Who is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Subject {
    /// This project's codec.
    Codec,
    /// A codec behind a pipe.
    Testee,
    /// A CNC.
    Target,
    /// What asks a CNC.
    Client,
    /// Clients in traffic that was captured.
    CapturedClient,
    /// CNCs in traffic that was captured.
    CapturedCnc,
}

impl Subject {
    /// All of them, in the order of reports.
    pub const ALL: [Self; 6] = [
        Self::Codec,
        Self::Testee,
        Self::Target,
        Self::Client,
        Self::CapturedClient,
        Self::CapturedCnc,
    ];

    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Codec => "codec",
            Self::Testee => "testee",
            Self::Target => "target",
            Self::Client => "client",
            Self::CapturedClient => "captured-client",
            Self::CapturedCnc => "captured-cnc",
        }
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What a case asks of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Well-formed queries.
    Queries,
    /// Requests that no client should send: only for a target that cannot move.
    Malformed,
    /// Writes, which are undone: only what may be written.
    Writes,
    /// Writes that no client should send: only to a target that cannot move.
    MalformedWrites,
    /// A CNC in this process, to which something is done from within.
    Embedded,
    /// A target that claims to answer the manuals' examples.
    PrintedExamples,
    /// The frames that all other cases, or others altogether, exchanged.
    Frames,
    /// No target: the codec itself is judged.
    Codec,
}

impl Needs {
    /// Why a case that needs this is not run: with which verdict, and the reason. `inside` is
    /// whether the CNC is in this process, open to be changed from within.
    pub fn unmet(
        self,
        gate: &Gate,
        profile: &Profile,
        inside: bool,
    ) -> Option<(Verdict, &'static str)> {
        let not_run = |why| Some((Verdict::NotRun, why));
        match self {
            Self::Malformed if !gate.lets_malformed_pass() => {
                not_run("sends what no client should: not sent to a device")
            }
            Self::Writes if !gate.may_let_writes_pass() => {
                not_run("writes: only what a file for --allow-write names")
            }
            Self::MalformedWrites if gate.embedded().is_none() => {
                not_run("writes what no client should: to the embedded CNC only")
            }
            Self::Embedded if !inside => not_run(
                "takes something that is done to a CNC from within: to the embedded one only",
            ),
            Self::PrintedExamples if !profile.printed_examples => Some((
                Verdict::NotApplicable,
                "the target does not claim to answer the printed examples",
            )),
            _ => None,
        }
    }
}

/// How a case is done.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// By a function.
    Probe(fn(&mut Probe<'_>) -> Step),
    /// By sending a printed request and comparing the reply with the printed one.
    Printed(&'static Vector),
    /// By decoding and encoding a vector.
    Vector(&'static Vector),
    /// By putting an NC text into packets, or looking through one.
    Sequence(&'static Sequence),
    /// By watching how a testee answers all the others.
    Manners,
    /// By watching what a client sends and says.
    Client,
    /// By looking through traffic of others.
    Traffic,
}

/// How a step of a case goes on.
pub type Step<T = ()> = Result<T, Stop>;

/// Why a case ends before its end.
#[derive(Clone, Debug)]
pub enum Stop {
    /// A judgement has been made that leaves nothing to go on with.
    Judged,
    /// The target has nothing to try this on.
    NotApplicable(String),
    /// What came back does not tell.
    Inconclusive(String),
    /// The gate refused.
    Refused(String),
    /// The run is to end.
    Interrupted,
    /// The suite itself is wrong.
    Harness(String),
}

/// A requirement at a level: that of the catalogue, or of an assumed part.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The requirement.
    pub id: &'static str,
    /// The level it is judged at.
    pub level: Option<Level>,
}

impl From<&'static str> for Rule {
    fn from(id: &'static str) -> Self {
        let clause = clause(id);
        let id = clause.map_or(id, |clause| clause.requirement.id.as_str());
        Self { id, level: clause.map(|clause| clause.level()) }
    }
}

/// A part of a requirement that is assumed, whatever its rest is.
pub const fn assumed(id: &'static str) -> Rule {
    Rule { id, level: Some(Level::Info) }
}

/// A part of a requirement that is known from help pages only, whatever its rest is.
pub const fn online(id: &'static str) -> Rule {
    Rule { id, level: Some(Level::Should) }
}

/// One check of one requirement.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// The requirement.
    pub requirement: &'static str,
    /// The level it was judged at; that of an assumed part may be lower.
    pub level: Option<Level>,
    /// What came of it.
    pub verdict: Verdict,
    /// What was expected; empty for a pass.
    pub expected: String,
    /// What was there; empty for a pass.
    pub found: String,
    /// The request and the answer in question.
    pub evidence: Option<Evidence>,
    /// Checks with the same verdict that are not kept.
    pub more: usize,
}

/// The bytes of an exchange, as a report shows them.
#[derive(Clone, Debug, Default)]
pub struct Evidence {
    /// Where the request went.
    pub call: String,
    /// Stream of the request's data, by name, if a documented function was asked.
    pub request_stream: Option<&'static str>,
    /// Stream of the reply's data.
    pub reply_stream: Option<&'static str>,
    /// Data of the request.
    pub sent: Vec<u8>,
    /// Data of the reply.
    pub received: Option<Vec<u8>>,
    /// What the data of the reply should have been, where that is known to the byte.
    pub expected: Option<Vec<u8>>,
    /// How values among the data are to be read.
    pub values: Values,
    /// What came of it, in a few words.
    pub result: String,
    /// The whole frame sent.
    pub frame_sent: Vec<u8>,
    /// The whole frame received, or as much as came.
    pub frame_received: Vec<u8>,
}

/// The most bytes that are kept of each part of an exchange.
const EVIDENCE_MAX: usize = 4096;

impl Evidence {
    /// The bytes, or the first that are kept of many.
    pub(crate) fn start(bytes: &[u8]) -> &[u8] {
        bytes.get(..EVIDENCE_MAX).unwrap_or(bytes)
    }

    /// Adds what the data of the reply should have been.
    pub(super) fn expect(&mut self, reply: &[u8]) {
        self.expected = Some(Self::start(reply).to_vec());
    }

    /// Keeps the first bytes of a long exchange, and says so.
    fn cut(mut self, sent: &[u8], received: &[u8]) -> Self {
        (self.frame_sent, self.frame_received) =
            (Self::start(sent).to_vec(), Self::start(received).to_vec());
        for (whole, stream) in
            [(sent, &mut self.request_stream), (received, &mut self.reply_stream)]
        {
            if whole.len() > EVIDENCE_MAX {
                // Half of a stream would be read as a faulty one.
                *stream = None;
                let note = format!(" (of {} bytes the first {EVIDENCE_MAX} are kept)", whole.len());
                self.result.push_str(&note);
            }
        }
        self
    }
}

impl<R: Inquiry> From<&Inquired<R>> for Evidence {
    fn from(inquired: &Inquired<R>) -> Self {
        let received = inquired.received.get(FrameRef::HEADERS_LEN..);
        let evidence = Self {
            call: inquired.to_string(),
            reply_stream: Some(R::STREAM.layout().name),
            received: received.map(|data| Self::start(data).to_vec()),
            result: inquired.result(),
            ..Self::default()
        };
        evidence.cut(&inquired.sent, &inquired.received)
    }
}

impl From<&Exchange> for Evidence {
    fn from(exchange: &Exchange) -> Self {
        let function = exchange.call().dispatch().ok().map(|request| request.function().spec());
        let data = exchange.answer().and_then(|answer| answer.data.as_deref());
        let evidence = Self {
            call: exchange.to_string(),
            request_stream: function
                .and_then(|spec| spec.request)
                .map(|stream| stream.layout().name),
            reply_stream: function.and_then(|spec| spec.reply).map(|stream| stream.layout().name),
            sent: Self::start(&exchange.data).to_vec(),
            received: data.map(|data| Self::start(data).to_vec()),
            result: exchange.result(),
            ..Self::default()
        };
        evidence.cut(&exchange.sent, &exchange.received)
    }
}
