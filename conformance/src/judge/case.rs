//! The metadata of a case.

use std::fmt;

use ads_cnc_vectors::{Sequence, Vector};
use serde::{Deserialize, Serialize};

use crate::text::{Pattern, named};

/// A case of the suite.
#[derive(Clone, Debug)]
pub struct Case {
    /// The ID of the case, whose meaning must not change.
    pub id: String,
    /// The verified behaviour, as a sentence; for a case of a vector or sequence, the title of the
    /// vector or sequence.
    pub title: String,
    pub subject: CaseSubject,
    /// The requirements that the case can judge.
    pub requirements: Vec<&'static str>,
    /// What the target must permit or support.
    pub needs: Needs,
    pub body: Body,
}

impl Case {
    /// The stream of the vector, or the kind of the sequence, with which the case tests a codec;
    /// `None` for other cases.
    pub fn stream(&self) -> Option<&'static str> {
        match self.body {
            Body::Vector(vector) => Some(&vector.stream),
            Body::Sequence(sequence) => Some(sequence.kind()),
            _ => None,
        }
    }

    /// Whether a word is, or a pattern matches, the ID of the case, the ID of the vector or
    /// sequence with which the case tests a codec, or the name that [`stream`](Self::stream)
    /// returns.
    pub(crate) fn is_called(&self, word: &str) -> bool {
        let vector = self.stream().and_then(|_| Some(self.id.split_once('-')?.1));
        let names = [Some(self.id.as_str()), vector, self.stream()];
        names.into_iter().flatten().any(|name| matches(word, name))
    }
}

/// Whether a word is this name. A word with a `*` or a `?` is a pattern, which must match the whole
/// name. Case is ignored.
pub(crate) fn matches(word: &str, name: &str) -> bool {
    let is_pattern = || word.bytes().any(|byte| matches!(byte, b'*' | b'?'));
    word.eq_ignore_ascii_case(name) || is_pattern() && Pattern::whole(word).matches(name)
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
    /// Well-formed queries. The cases for a client have this value too, although they need no
    /// target.
    Queries,
    /// Malformed requests, which are sent only to the simulated CNC or with `--malformed`.
    Malformed,
    /// Writes, which a device receives only for values that the file of `--allow-write` names; the
    /// suite tries to restore the changed values.
    Writes,
    /// Malformed writes, and other writes that are sent only to the simulated CNC.
    MalformedWrites,
    /// A target whose profile claims the manuals' printed examples.
    PrintedExamples,
    /// The frames exchanged by the other cases or by other clients.
    Frames,
    /// No target: the case judges a codec, which is this project's codec or a testee.
    Codec,
}

/// How a case is executed.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// By the function of the suite for the case's ID.
    Probe,
    /// By sending a printed request and comparing the reply with the printed reply.
    Printed(&'static Vector),
    /// By decoding the bytes of a vector and, if they are accepted, encoding the value.
    Vector(&'static Vector),
    /// By splitting an NC text into packets, or checking its packets.
    Sequence(&'static Sequence),
    /// By checking whether a testee follows the testee protocol, for example with repeated
    /// questions and unknown operations.
    Protocol,
    /// By checking a client's requests and actions.
    Client,
    /// By the rules of [`rules`](crate::rules), for the replies in a run against a target, or for
    /// the requests or the replies in captured traffic.
    Traffic,
}
