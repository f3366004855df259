//! What a case is.

use std::fmt;

use ads_cnc_vectors::{Sequence, Vector, is_requirement};
use serde::{Deserialize, Serialize};

use crate::text::named;

/// One thing the suite tries.
#[derive(Clone, Debug)]
pub struct Case {
    /// A slug that keeps its meaning.
    pub id: String,
    /// What is tried, in a sentence.
    pub title: String,
    pub subject: CaseSubject,
    /// The requirements it can judge.
    pub requirements: Vec<&'static str>,
    /// What it asks of the target beyond a first channel.
    pub needs: Needs,
    pub body: Body,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseSubject {
    /// This project's codec.
    Codec,
    /// A codec that is asked over pipes.
    Testee,
    Target,
    /// What asks a CNC.
    Client,
    /// Clients in traffic that was captured.
    CapturedClient,
    /// CNCs in traffic that was captured.
    CapturedCnc,
}

named! { CaseSubject:
    Codec "codec", Testee "testee", Target "target", Client "client",
    CapturedClient "captured-client", CapturedCnc "captured-cnc",
}

impl fmt::Display for CaseSubject {
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
    /// The simulated CNC in this process, whose state the case reads or changes directly.
    Simulator,
    /// A target that claims to answer the manuals' examples.
    PrintedExamples,
    /// The frames that all other cases, or others altogether, exchanged.
    Frames,
    /// No target: the codec itself is judged.
    Codec,
}

/// How a case is done.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// By a function of the suite, which knows it by the case's ID.
    Probe,
    /// By sending a printed request and comparing the reply with the printed one.
    Printed(&'static Vector),
    /// By decoding and encoding a vector.
    Vector(&'static Vector),
    /// By putting an NC text into packets, or looking through one.
    Sequence(&'static Sequence),
    /// By watching how a testee answers all the others.
    Protocol,
    /// By watching what a client sends and says.
    Client,
    /// By looking through traffic of others.
    Traffic,
}

/// The IDs, each of which the catalogue has; a table with another does not compile.
#[allow(clippy::panic, reason = "runs when a table is compiled")]
pub(crate) const fn in_catalogue(ids: &'static [&'static str]) -> &'static [&'static str] {
    let mut rest = ids;
    while let [id, others @ ..] = rest {
        assert!(is_requirement(id), "no requirement has this ID");
        rest = others;
    }
    ids
}
