//! Cases of the handles and values at the axis indices (in the messages: places) of the axis
//! interface.

use std::collections::HashMap;

use ads_cnc::address::{Channel, ChannelAxis};
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, HandleByName, ReadByHandle, ReadByName, Request,
};
use ads_cnc::{CncString, Decode as _, Description, Handle, TextRef, U32List};
use ads_cnc_vectors::ids::*;

use super::kit::{
    AxisHandle, GAP_MAX, PLACES_MAX, Probe, RawCall, Steady, answering_places, axis_names,
    axis_variables, name_of,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, applicable, assumed};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("axis-handles", &[VAR_10, VAR_26, ADR_7, GEN_6], Needs::Queries, handles,
        "The axis interface returns the handle in the description of the axis variable"),
    case("axis-values", &[VAR_10, VAR_26], Needs::Queries, values,
        "The axis interface returns the same value as the variable name with the axis appended"),
    case("axis-unknown", &[VAR_26, ADS_4], Needs::Queries, unknown,
        "The axis interface rejects a name or an axis index that does not exist"),
    case("axis-zero", &[VAR_26], Needs::Malformed, zero,
        "The axis interface has no axis index 0: its offsets belong to other functions"),
];

/// Calls a function for each axis index at which the name of an axis variable has the handle of an
/// axis variable that the cases read. The function receives the description with this handle.
fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, AxisVariable<'_>, &Description) -> Step,
) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        let described = axis_variables(probe, channel)?;
        let by_handle: HashMap<u32, &(CncString, Description)> =
            described.iter().map(|one| (one.1.handle.0, one)).collect();
        for name in axis_names(&described) {
            for AxisHandle { axis, handle } in answering_places(probe, channel, name)? {
                // A handle that is in no description is skipped: it may be that of an axis index
                // without an axis.
                let Some((own, variable)) = by_handle.get(&handle.0) else { continue };
                any = true;
                let at = AxisVariable { channel, axis, name, own };
                judge(probe, at, variable)?;
            }
        }
    }
    applicable(any, "the target describes no axis variable")
}

/// A variable on the axis interface.
struct AxisVariable<'a> {
    channel: Channel,
    axis: ChannelAxis,
    /// The name in the request.
    name: &'a CncString,
    /// The name in the description with the same handle, without the axis.
    own: &'a CncString,
}

impl std::fmt::Display for AxisVariable<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of axis index {}", self.name, self.axis.index())
    }
}

fn handles(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let described = axis_variables(probe, channel)?;
        // If the channel describes axis variables, one of the first axis indices must have a
        // handle.
        let mut any = described.is_empty();
        let mut at_places: HashMap<u32, u32> = HashMap::new();
        for place in 1..=PLACES_MAX {
            let axis = ChannelAxis::new(place)?;
            for name in axis_names(&described) {
                let request = AxisHandleByName { channel, axis, name: name.as_cnc_str().into() };
                let Some(data) = probe.try_ask(request)? else { continue };
                any = true;
                let handle = Handle::decode(&data);
                let found = || format!("a success with {}", plural(data.len(), "byte"));
                let expected =
                    || format!("an error, or the 4-byte handle of {name} at axis index {place}");
                probe.check(VAR_26, handle.is_ok(), expected, found);
                let Ok(Handle(handle)) = handle else { continue };
                // A handle in a description must belong to only one axis index. Other handles are
                // not compared, because an axis index without an axis may return any handle.
                let known = described.iter().any(|(_, variable)| variable.handle.0 == handle);
                let other = at_places.insert(handle, place);
                let other = other.filter(|other| known && *other != place);
                let found = || {
                    let other = other.unwrap_or_default();
                    format!("the handle {handle:#x} at both axis indices {place} and {other}")
                };
                probe.check(
                    [VAR_10, VAR_26, ADR_7],
                    other.is_none(),
                    "a different handle at each axis index",
                    found,
                );
            }
            // At an axis index without an axis, the CNC need not return a handle.
            if !any && place > GAP_MAX {
                break;
            }
        }
        let found = || format!("no name has a handle in channel {}", channel.number());
        probe.check(VAR_26, any, "handles by name on the axis interface", found);
        // No manual states that a variable has only one handle. Therefore, the handles are compared
        // only if at least one axis index returned a handle from a description.
        let handles = described.iter().map(|(_, variable)| variable.handle.0);
        let is_one_number = handles.into_iter().any(|handle| at_places.contains_key(&handle));
        for (_, variable) in &described {
            // The handle in the description must belong to one of the axis indices, which start at
            // 1.
            let name = &variable.name.text;
            let has_place = !is_one_number || at_places.contains_key(&variable.handle.0);
            let expected = || format!("an axis index, counted from 1, with the handle of {name}");
            probe.check([VAR_26, GEN_6], has_place, expected, "no such axis index");
        }
    }
    each(probe, |probe, at, variable| {
        let found = || format!("the handle of {} for {at}", variable.name.text);
        let same = at.own == at.name;
        probe.check(VAR_26, same, || format!("the handle of a {}", at.name), found);
        probe.check(VAR_10, same, "a handle of this variable", found);
        Ok(())
    })
}

fn values(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    each(probe, |probe, at, variable| {
        let AxisVariable { channel, axis, name, .. } = at;
        let request = AxisReadByName { channel, axis, name: name.as_cnc_str().into() };
        let value = probe.ask(VAR_26, request)?;
        if variable.var_type.element_size().is_some() {
            let sized = u32::try_from(value.len()) == Ok(variable.size);
            let found = || format!("{} of {at}", plural(value.len(), "byte"));
            probe.check(
                VAR_26,
                sized,
                || format!("the {} of its description", plural(variable.size, "byte")),
                found,
            );
        }
        let by_name = ReadByName { channel, name: name_of(variable) };
        steady.same(probe, VAR_26, &at, by_name, request)?;
        // It is assumed that the channel interface accepts handles of axis variables.
        let by_handle = ReadByHandle::new(channel, variable.handle, U32List::EMPTY);
        steady.same(probe, assumed(VAR_10), &at, by_handle, request)
    })?;
    steady.finish()
}

fn unknown(probe: &mut Probe<'_>) -> Step {
    let mut first = None;
    each(probe, |_, at, variable| {
        first.get_or_insert((at.channel, at.axis, at.name.clone(), variable.clone()));
        Ok(())
    })?;
    let Some((channel, axis, name, variable)) = first else { return Ok(()) };
    let valid = TextRef::from(name.as_cnc_str());
    let handle = |axis, name| AxisHandleByName { channel, axis, name };
    let read = |axis, name| AxisReadByName { channel, axis, name };
    for unknown in ["V.A.no such variable", "V.A.", ""] {
        let (what, invalid) = (format!("the name {unknown:?}"), TextRef::new(unknown)?);
        probe.rejects(ADS_4, &what, handle(axis, invalid), handle(axis, valid))?;
        probe.rejects(ADS_4, &what, read(axis, invalid), read(axis, valid))?;
    }
    // A name on the axis interface must not contain an axis.
    let with_axis = name_of(&variable);
    let what = format!("{} on the axis interface", variable.name.text);
    probe.rejects(VAR_26, &what, handle(axis, with_axis), handle(axis, valid))?;
    probe.rejects(VAR_26, &what, read(axis, with_axis), read(axis, valid))?;
    // The name of an axis variable on the channel interface must contain an axis.
    let what = format!("{} on the channel interface", valid.text());
    let of_channel = |name| HandleByName { channel, name };
    probe.rejects(VAR_26, &what, of_channel(valid), of_channel(with_axis))?;
    let of_channel = |name| ReadByName { channel, name };
    probe.rejects(VAR_26, &what, of_channel(valid), of_channel(with_axis))?;
    let far = ChannelAxis::new(0xFFFF)?;
    let what = "an axis index that no channel has";
    probe.rejects(VAR_26, what, handle(far, valid), handle(axis, valid))?;
    probe.rejects(VAR_26, what, read(far, valid), read(axis, valid))
}

fn zero(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, at, _| {
        let AxisVariable { channel, axis, name, .. } = at;
        let name = TextRef::from(name.as_cnc_str());
        let requests: [Request<'_>; 2] = [
            AxisHandleByName { channel, axis, name }.into(),
            AxisReadByName { channel, axis, name }.into(),
        ];
        for request in requests {
            let valid = RawCall::new(request)?;
            let offset = valid.index_offset.get() & 0xFFFF;
            let invalid =
                valid.with(|call| call.index_offset = ads_cnc::address::IndexOffset::new(offset));
            let what = format!("a name at offset {offset:#x}, without an axis");
            probe.rejects(VAR_26, &what, &invalid, &valid)?;
        }
        Ok(())
    })
}
