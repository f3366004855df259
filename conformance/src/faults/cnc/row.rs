//! A row of the tables of defects of a CNC.

use ads_cnc::ads::FrameRef;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ClauseId;

use super::Upstream;
use crate::edition::Edition;
use crate::simulator::ReplyData;
use crate::simulator::program::Policy;

/// How a defect or valid variant of a CNC works.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CncFault {
    /// Replies to every request.
    Answer(fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// Replies to every request for one of these functions; the correct CNC replies to all others.
    Function(&'static [Function], fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// Replaces the frame of every reply, by a changed frame or by none or several frames.
    Frame(fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>),
    /// Sends frames in pieces of at most this many bytes.
    Pieces(usize),
    /// Changes the behaviour of NC programs and of the streaming interface.
    Program(Policy),
    /// Uses this data model, which is TOML text.
    Model(&'static str),
}

/// A row of the tables of defects.
pub(in crate::faults) struct CncDefect {
    pub(in crate::faults) id: &'static str,
    pub(in crate::faults) breaks: &'static [ClauseId],
    pub(in crate::faults) what: &'static str,
    pub(in crate::faults) fault: CncFault,
    /// The only edition in which the defect is detectable; `None` if the defect is not limited to
    /// an edition.
    pub(in crate::faults) edition: Option<Edition>,
    /// Whether the CNC still claims to reply literally as in the manuals' printed examples.
    pub(in crate::faults) printed: bool,
}

/// A row whose function replies to all requests.
pub(in crate::faults) const fn row(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncDefect {
    fault(id, breaks, what, CncFault::Answer(answer))
}

/// A row whose function replies to the requests for these functions.
pub(in crate::faults) const fn on(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    functions: &'static [Function],
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncDefect {
    fault(id, breaks, what, CncFault::Function(functions, answer))
}

/// A row with any fault.
pub(in crate::faults) const fn fault(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    fault: CncFault,
) -> CncDefect {
    CncDefect { id, breaks, what, fault, edition: None, printed: true }
}

/// A row that changes the behaviour of NC programs and of the streaming interface.
pub(in crate::faults) const fn program(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    policy: Policy,
) -> CncDefect {
    fault(id, breaks, what, CncFault::Program(policy))
}
