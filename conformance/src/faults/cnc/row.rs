//! A row of the tables of defects of a CNC.

use ads_cnc::ads::FrameRef;
use ads_cnc::operation::{Call, Function};

use super::Upstream;
use crate::edition::Edition;
use crate::judge::in_catalogue;
use crate::simulator::ReplyData;
use crate::simulator::program::Policy;

/// How a CNC does something wrong, or otherwise.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CncFault {
    /// Around each request.
    Answer(fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// Around each request for one of these functions.
    Function(&'static [Function], fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// After each frame that answers one: what is sent instead.
    Frame(fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>),
    /// Bytes are sent in pieces of at most this size.
    Pieces(usize),
    /// In its NC programs.
    Program(Policy),
    /// It is another CNC: one with this model.
    Model(&'static str),
}

/// A row of the tables of defects.
pub(in crate::faults) struct CncSeed {
    pub(in crate::faults) id: &'static str,
    pub(in crate::faults) breaks: &'static [&'static str],
    pub(in crate::faults) what: &'static str,
    pub(in crate::faults) fault: CncFault,
    /// The edition it shows in, if it does not in any.
    pub(in crate::faults) edition: Option<Edition>,
    /// Whether printed examples are answered as printed, as far as it is about.
    pub(in crate::faults) printed: bool,
}

/// A row about requests.
pub(in crate::faults) const fn row(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Answer(answer))
}

/// A row about requests for functions.
pub(in crate::faults) const fn on(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    functions: &'static [Function],
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Function(functions, answer))
}

/// A row about something else.
pub(in crate::faults) const fn fault(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    fault: CncFault,
) -> CncSeed {
    CncSeed { id, breaks: in_catalogue(breaks), what, fault, edition: None, printed: true }
}

/// A row about the NC program.
pub(in crate::faults) const fn program(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    policy: Policy,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Program(policy))
}
