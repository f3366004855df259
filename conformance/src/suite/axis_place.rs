//! Cases of the axis indices of the axis interface (in the messages: places): the variable at each
//! index, indices above 255, and reserved index offsets.

use std::collections::HashSet;

use ads_cnc::address::{Channel, ChannelAxis, IndexOffset};
use ads_cnc::operation::{AxisHandleByName, AxisReadByName, ReadByName, Request};
use ads_cnc::{CncString, Description, Handle, TextRef};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{
    AxisHandle, Compared, Probe, RawCall, answering_places, axis_names, axis_variables, compare,
    name_of,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, Stop};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("axis-places", &[VAR_10, VAR_26, GEN_6], Needs::Queries, places,
        "Every axis with variables has exactly one axis index, counted from 1"),
    case("axis-place-too-far", &[VAR_26], Needs::Malformed, too_far,
        "All 16 bits of the axis index count: no two indices address the same axis"),
    case("axis-reserved", &[VAR_26], Needs::Malformed, reserved,
        "The reserved offsets of the axis interface return an error"),
];

fn places(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let described = axis_variables(probe, channel)?;
        let handles: HashSet<u32> = described.iter().map(|one| one.1.handle.0).collect();
        for name in axis_names(&described) {
            let places = answering_places(probe, channel, name)?;
            let own: Vec<&Description> =
                described.iter().filter(|one| one.0 == *name).map(|one| &one.1).collect();
            let found = || {
                format!("{} of channel {}", plural(places.len(), "axis index"), channel.number())
            };
            let expected = || {
                format!("one axis index for each of the {} with {name}", plural(own.len(), "axis"))
            };
            probe.check([VAR_26, GEN_6], places.len() >= own.len(), expected, found);
            // An axis has only one axis index. A handle that is in no description is not compared,
            // because an axis index without an axis may return any handle.
            let mut seen = HashSet::new();
            for at in places.iter().filter(|at| handles.contains(&at.handle.0)) {
                let found =
                    || format!("handle {} also at axis index {}", at.handle, at.axis.index());
                let expected = || format!("a different handle of {name} at each axis index");
                let own = seen.insert(at.handle.0);
                probe.check([VAR_10, VAR_26], own, expected, found);
            }
            for variable in own {
                at_a_place(probe, channel, name, variable, &places)?;
            }
        }
    }
    probe.finish("the target describes no axis variable")
}

/// Checks that the value of a variable by its whole name, which ends with the axis, is also read at
/// one of the axis indices in `places`.
fn at_a_place(
    probe: &mut Probe<'_>,
    channel: Channel,
    name: &CncString,
    variable: &Description,
    places: &[AxisHandle],
) -> Step {
    let by_name = ReadByName { channel, name: name_of(variable) };
    let find = |probe: &mut Probe<'_>, value: &Vec<u8>| -> Step<Option<bool>> {
        for at in places {
            let name = name.as_cnc_str().into();
            let read = probe.try_ask(AxisReadByName { channel, axis: at.axis, name })?;
            if read.as_ref() == Some(value) {
                return Ok(Some(true));
            }
        }
        Ok(Some(false))
    };
    match compare(probe, |probe| probe.try_ask(by_name), find, |_, is_found| *is_found)? {
        Compared::Same => probe.pass(VAR_26),
        Compared::Differs(value, ..) => {
            let expected =
                || format!("{} of {} at one of the axis indices", Hex(value), variable.name.text);
            let found = || format!("other values at all {}", plural(places.len(), "axis index"));
            probe.check(VAR_26, false, expected, found);
        }
        Compared::NoValue | Compared::NoReply | Compared::Moved => {}
    }
    Ok(())
}

/// The first channel and the first name of an axis variable for which the axis interface returns a
/// handle from a description, and the last axis index at which it does so for this name.
fn one(probe: &mut Probe<'_>) -> Step<(Channel, AxisHandle, CncString)> {
    for channel in probe.channels()? {
        let described = axis_variables(probe, channel)?;
        let handles: HashSet<u32> = described.iter().map(|one| one.1.handle.0).collect();
        for name in axis_names(&described) {
            let mut places = answering_places(probe, channel, name)?.into_iter();
            if let Some(at) = places.rfind(|at| handles.contains(&at.handle.0)) {
                return Ok((channel, at, name.clone()));
            }
        }
    }
    Err(Stop::not_applicable("no axis variable is on the axis interface"))
}

/// Requests handles at axis indices above 255, which have the lower 8 bits of a valid index. The
/// reply is not specified, but it must not be the handle at the valid index.
fn too_far(probe: &mut Probe<'_>) -> Step {
    let (channel, AxisHandle { axis, handle }, name) = one(probe)?;
    for bit in [0x100_u32, 0x200, 0x1000, 0x4000, 0x8000] {
        let far = ChannelAxis::new(u32::from(axis.index()) | bit)?;
        let request = AxisHandleByName { channel, axis: far, name: name.as_cnc_str().into() };
        let given = probe.try_read::<Handle>(request)?;
        let expected = || {
            format!(
                "a handle other than that of axis index {} at axis index {}",
                axis.index(),
                far.index()
            )
        };
        probe.check(VAR_26, given != Some(handle), expected, || handle.to_string());
    }
    Ok(())
}

fn reserved(probe: &mut Probe<'_>) -> Step {
    let (channel, AxisHandle { axis, .. }, name) = one(probe)?;
    let name = TextRef::from(name.as_cnc_str());
    let request = Request::from(AxisReadByName { channel, axis, name });
    let valid = RawCall::new(request)?;
    let of_place = valid.index_offset.get() & 0xFFFF_0000;
    for function in 7..=9 {
        let offset = IndexOffset::new(of_place | function);
        let what = format!("a name at offset {:#x}", offset.get());
        let invalid = valid.with(|call| call.index_offset = offset);
        probe.rejects(VAR_26, &what, &invalid, &valid)?;
    }
    Ok(())
}
