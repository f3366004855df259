//! Defects of a CNC, as middleware around the simulated CNC or another policy of its NC programs.

mod address;
mod ads;
mod axis;
mod bounds;
mod bytes;
mod code;
mod com;
mod consistency;
mod content;
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
mod row;
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
pub(in crate::faults) use self::com::{each, set};
pub(in crate::faults) use self::content::empty_place;
pub use self::faulty::Faulty;
pub(in crate::faults) use self::handle::{joined, parts, value_at};
pub(in crate::faults) use self::instance::absent;
pub(in crate::faults) use self::lookup::{descriptions, indexed, name_in, with_indices};
pub(in crate::faults) use self::request::{
    DESCRIPTIONS, ELEMENT_TEXTS, INDEXED, LOGICAL, NAMED, VALUES, WRITES, at, class, com_group,
    first, function, functions, group, is, is_at, is_lookup, of_decoder, offset,
};
pub(crate) use self::row::CncFault;
pub(in crate::faults) use self::row::{CncDefect, fault, on, program, row};
use self::upstream::Memory;
pub(crate) use self::upstream::Upstream;
pub(in crate::faults) use self::upstream::{
    Key, changed, delay_write, forgiven, later, or_short, reply, within_length,
};
pub(in crate::faults) use crate::simulator::ReplyData;
pub(in crate::faults) use crate::values::until_nul as text;
pub(in crate::faults) use frame::measured;

/// The rows of all tables of defects of a CNC.
pub(super) fn rows() -> impl Iterator<Item = &'static CncDefect> {
    let areas: [&'static [CncDefect]; 29] = [
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
