//! The metadata of a case.

use std::fmt;

use ads_cnc_vectors::{Sequence, Vector};
use serde::{Deserialize, Serialize};

use crate::text::{Pattern, named};

/// A case of the suite.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its ID, whose meaning never changes.
    pub id: String,
    /// The verified behaviour, as a sentence.
    pub title: String,
    pub subject: CaseSubject,
    /// The requirements that it can judge.
    pub requirements: Vec<&'static str>,
    /// What the target must permit or support.
    pub needs: Needs,
    pub body: Body,
}

impl Case {
    /// The stream of its vector, or the kind of its NC text.
    pub fn stream(&self) -> Option<&'static str> {
        match self.body {
            Body::Vector(vector) => Some(&vector.stream),
            Body::Sequence(sequence) => Some(sequence.kind()),
            _ => None,
        }
    }

    /// Whether a word or pattern is the ID of the case, the ID of its vector, or the name of its
    /// stream.
    pub(crate) fn is_called(&self, word: &str) -> bool {
        let vector = self.stream().and_then(|_| Some(self.id.split_once('-')?.1));
        let names = [Some(self.id.as_str()), vector, self.stream()];
        names.into_iter().flatten().any(|name| matches(word, name))
    }
}

/// Whether a word is this name, or a pattern that matches it because it has a `*` or a `?`.
pub(crate) fn matches(word: &str, name: &str) -> bool {
    if word.contains(['*', '?']) {
        Pattern::whole(word).matches(name)
    } else {
        word.eq_ignore_ascii_case(name)
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseSubject {
    /// This project's codec.
    Codec,
    /// A codec in another process.
    Testee,
    Target,
    /// A client of a CNC.
    Client,
    /// Clients in captured traffic.
    CapturedClient,
    /// CNCs in captured traffic.
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

/// What a case requires of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Well-formed queries.
    Queries,
    /// Malformed requests, which are sent only to a target that cannot move.
    Malformed,
    /// Writes of values that may be written; each is restored.
    Writes,
    /// Malformed writes, which are sent only to a target that cannot move.
    MalformedWrites,
    /// A target whose profile claims the manuals' printed examples.
    PrintedExamples,
    /// The frames exchanged by the other cases or by other clients.
    Frames,
    /// No target: the case judges this project's codec.
    Codec,
}

/// How a case is executed.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// By the function of the suite for the case's ID.
    Probe,
    /// By sending a printed request and comparing the reply with the printed one.
    Printed(&'static Vector),
    /// By decoding and encoding a vector.
    Vector(&'static Vector),
    /// By splitting an NC text into packets, or checking its packets.
    Sequence(&'static Sequence),
    /// By checking the protocol in a testee's answers in all other cases.
    Protocol,
    /// By checking a client's requests and actions.
    Client,
    /// By checking captured traffic.
    Traffic,
}
