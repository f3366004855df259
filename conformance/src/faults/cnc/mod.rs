//! Defects of a CNC, as middleware around the simulated CNC.

mod address;
mod ads;
mod axis;
mod bounds;
mod bytes;
mod code;
mod com;
mod consistency;
mod content;
mod device;
mod dynamic;
mod element;
mod faulty;
mod frame;
mod general;
mod handle;
mod indices;
mod instance;
mod lookup;
mod name;
mod number;
mod object;
mod off_by_one;
mod partial;
mod request;
mod service;
mod stale;
mod stream_program;
mod stream_write;
mod upstream;
mod value;
mod variable;
mod variable_consistency;
mod write;
mod write_sequence;

pub(in crate::faults) use self::bytes::{
    after_nul, dimensions, fours, number, records, records_mut, set_u32, u32_at,
};
pub use self::faulty::Faulty;
pub(in crate::faults) use self::request::{
    DESCRIPTIONS, ELEMENT_TEXTS, INDEXED, LOGICAL, NAMED, VALUES, WRITES, at, class, com_group,
    first, function, functions, group, is, is_at, is_lookup, of_decoder, offset,
};
use self::upstream::Memory;
pub(crate) use self::upstream::Upstream;
pub(in crate::faults) use self::upstream::{Key, later, put_off, reply, within_length};
pub(in crate::faults) use crate::values::until_nul as text;
pub(in crate::faults) use frame::measured;

use ads_cnc::ads::FrameRef;
use ads_cnc::operation::{Call, Function};

use crate::edition::Edition;
use crate::judge::in_catalogue;
pub(in crate::faults) use crate::simulator::ReplyData;
use crate::simulator::program::Policy;

/// How a defect or valid variant of a CNC works.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CncFault {
    /// Handles each request.
    Answer(fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// Handles each request for one of these functions.
    Function(&'static [Function], fn(&Upstream<'_>, &Call<'_>) -> ReplyData),
    /// Changes the frame of each reply.
    Frame(fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>),
    /// Frames are sent in pieces of at most this size.
    Pieces(usize),
    /// Changes the execution of NC programs.
    Program(Policy),
    /// Uses this model.
    Model(&'static str),
}

/// A row of the tables of defects.
pub(super) struct CncSeed {
    pub(super) id: &'static str,
    pub(super) breaks: &'static [&'static str],
    pub(super) what: &'static str,
    pub(super) fault: CncFault,
    /// The only edition in which it is detectable; `None` for both.
    pub(super) edition: Option<Edition>,
    /// Whether the printed examples that it concerns are still answered literally.
    pub(super) printed: bool,
}

/// A row that handles requests.
pub(super) const fn row(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Answer(answer))
}

/// A row that handles requests for functions.
pub(super) const fn on(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    functions: &'static [Function],
    answer: fn(&Upstream<'_>, &Call<'_>) -> ReplyData,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Function(functions, answer))
}

/// A row with another fault.
pub(super) const fn fault(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    fault: CncFault,
) -> CncSeed {
    CncSeed { id, breaks: in_catalogue(breaks), what, fault, edition: None, printed: true }
}

/// A row about NC programs.
pub(super) const fn program(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    policy: Policy,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Program(policy))
}

/// All rows.
pub(super) fn rows() -> impl Iterator<Item = &'static CncSeed> {
    let areas: [&'static [CncSeed]; 30] = [
        variable_consistency::ROWS,
        address::ROWS,
        ads::ROWS,
        general::ROWS,
        axis::ROWS,
        bounds::ROWS,
        code::ROWS,
        com::ROWS,
        content::ROWS,
        consistency::ROWS,
        device::ROWS,
        dynamic::ROWS,
        element::ROWS,
        frame::ROWS,
        handle::ROWS,
        indices::ROWS,
        instance::ROWS,
        stale::ROWS,
        name::ROWS,
        off_by_one::ROWS,
        number::ROWS,
        object::ROWS,
        stream_write::ROWS,
        write_sequence::ROWS,
        stream_program::ROWS,
        partial::ROWS,
        service::ROWS,
        value::ROWS,
        variable::ROWS,
        write::ROWS,
    ];
    areas.into_iter().flatten()
}
