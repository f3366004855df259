//! Cases of invalid writes, each of which must be rejected. Except for writes of the current value,
//! the cases also check that the write has no effect.

use ads_cnc::address::Channel;
use ads_cnc::operation::{Request, WriteByHandle, WriteByName};
use ads_cnc::{CncString, Description, Handle, U32List, VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{
    IntoRawCall, NOTHING_WRITABLE, Probe, RawCall, WritableNumber, WriteCheck, axis_address,
    changed_value, each_of_access, elements_with_flag, handle_of, in_channel, is_sendable,
    may_write_whole, require_taken, writable_numbers, write_check,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, OrStop as _, Rule, Step, Stop, applicable};
use crate::objects::{ListedValue, ValueAddress};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-read-only", &[VAR_6], Needs::Writes, read_only,
        "A write to a variable that is READ_ONLY is rejected"),
    case("write-read-only-changed", &[VAR_6], Needs::MalformedWrites, read_only_changed,
        "A write of a different value to a READ_ONLY variable is rejected and changes nothing"),
    case("write-unknown", &[VAR_12, VAR_13, ADS_4], Needs::MalformedWrites, unknown,
        "A write to a variable that does not exist is rejected"),
    case("write-absent-channel", &[ADS_4], Needs::MalformedWrites, to_absent_channel,
        "A write to a channel that is not configured is rejected"),
    case("write-index-out-of-bounds", &[VAR_12, VAR_13], Needs::MalformedWrites, out_of_bounds,
        "A write outside the array is rejected and changes no other element"),
    case("write-bad-requests", &[VAR_12, VAR_13, VAR_24], Needs::MalformedWrites, bad_requests,
        "A write with an unterminated name or a wrong index count is rejected and changes nothing"),
];

fn first(probe: &mut Probe<'_>) -> Step<WritableNumber> {
    let first = writable_numbers(probe)?.into_iter().next();
    first.or_not_applicable("no number may be written")
}

/// Calls a function for every READ_ONLY variable that the cases read, except those of the Service
/// Interface. Its addresses by name and by handle are passed separately, if the [gate](crate::gate)
/// and the profile permit a write there.
fn each_read_only(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, &WriteCheck<'_>, &ValueAddress) -> Step,
) -> Step {
    each_of_access(probe, VariableAccess::READ_ONLY, |probe, channel, variable| {
        let name = variable.name.text.to_string();
        let handle = handle_of(probe, channel, variable)?;
        for address in [
            ValueAddress::Name { channel, name: variable.name.text.clone() },
            ValueAddress::of_handle(channel, handle),
        ] {
            if may_write_whole(probe, &address, variable)? {
                let rules = [Rule::from(VAR_6)];
                judge(probe, &write_check(variable, &name, &rules), &address)?;
            }
        }
        Ok(())
    })
}

fn read_only(probe: &mut Probe<'_>) -> Step {
    let sibling = first(probe)?.address();
    each_read_only(probe, |probe, write_check, address| {
        probe.write_rejected(write_check, address, Some(&sibling))
    })
}

fn read_only_changed(probe: &mut Probe<'_>) -> Step {
    each_read_only(probe, |probe, write_check, address| {
        probe.found_subject();
        let Some(before) = probe.filled_value_at(address)? else {
            return Ok(());
        };
        let moved = probe.value_at(address)?.as_ref() != Some(&before);
        let other = changed_value(&before, write_check.is_text);
        let Some(write) = address.write(&other).ok().filter(is_sendable) else { return Ok(()) };
        let exchange = probe.send(write)?;
        let rejected = exchange.is_error();
        let expected = || format!("an error number for a write of {}", write_check.what);
        probe.check(VAR_6, rejected, expected, &exchange);
        let after = probe.value_at(address)?.unwrap_or_default();
        // A value that changes by itself is not judged.
        if after != before && (moved || probe.moves(address, false)?) {
            return Ok(());
        }
        let expected = || format!("{} of {}, unchanged", Hex(before.clone()), write_check.what);
        probe
            .check(VAR_6, after == before, expected, || Hex(after))
            .then_some(())
            .ok_or(Stop::Judged)
    })
}

/// Sends the valid write, then the invalid write, which must be rejected without an effect on
/// `watched`, and then the valid write again. If the target rejects the first valid write, the case
/// is inconclusive. Sends nothing if a write cannot be encoded.
fn rejected<'a>(
    probe: &mut Probe<'_>,
    rules: &[ClauseId],
    what: &str,
    (invalid, valid): (impl IntoRawCall<'a>, Request<'_>),
    watched: &ValueAddress,
) -> Step {
    let Ok(invalid) = invalid.into_raw_call() else { return Ok(()) };
    let Some(&rule) = rules.first() else { return Ok(()) };
    if !is_sendable(&valid) {
        return Ok(());
    }
    require_taken(probe, rule, valid)?;
    let before = probe.value_at(watched)?;
    let exchange = probe.call(&invalid)?;
    let rejected = exchange.is_error();
    let expected = || format!("an error number for {what}");
    probe.check(rules, rejected, expected, &exchange);
    let after = probe.value_at(watched)?;
    if after != before && probe.moves(watched, false)? {
        return probe.send(valid).map(drop);
    }
    let same = after == before;
    let found = || Hex(after.clone().unwrap_or_default());
    probe.check(rules, same, || format!("the value before {what}"), found);
    probe.send(valid).map(drop)
}

fn unknown(probe: &mut Probe<'_>) -> Step {
    let known = first(probe)?;
    let (channel, watched, value) = (known.channel, known.address(), &known.value);
    let variables = probe.variables(channel)?;
    let is_free = |free: &u32| variables.iter().all(|one| one.handle.0 != *free);
    // The invalid write has another value than the current one: if the CNC wrote the current value
    // to the watched variable, the case would not detect this effect.
    let other = changed_value(value, false);
    let valid = known.by_handle(U32List::EMPTY, value);
    if let Some(free) = [0, 1, u32::MAX].into_iter().find(is_free) {
        let invalid = WriteByHandle::new(channel, Handle(free), U32List::EMPTY, &other[..]);
        let what = format!("a write to the handle {free:#x}");
        rejected(probe, &[ADS_4, VAR_12], &what, (invalid, valid), &watched)?;
    }
    let invalid = known.by_handle((&[0]).into(), &other);
    rejected(
        probe,
        &[VAR_12],
        "an index of a variable that is not an array",
        (invalid, valid),
        &watched,
    )?;
    let valid = known.by_name(value);
    let text = known.name().to_string();
    let (longer, shorter) = (format!("{text}x"), text.get(..text.len().saturating_sub(1)));
    let near = [longer.as_str(), shorter.unwrap_or_default()];
    for unknown in ["V.E.no such variable", ""].into_iter().chain(near) {
        let unknown: CncString = unknown.parse()?;
        let is_there =
            |one: &Description| one.name.text.as_bytes().eq_ignore_ascii_case(unknown.as_bytes());
        // Upper and lower case are taken as equal, because no manual states whether names are
        // case-sensitive.
        if variables.iter().any(is_there) {
            continue;
        }
        let what = format!("a write to the name \"{unknown}\"");
        let value = other.as_slice().into();
        let invalid = WriteByName { channel, name: unknown.as_cnc_str(), value };
        rejected(probe, &[ADS_4, VAR_13], &what, (invalid, valid), &watched)?;
    }
    let element: CncString = format!("{text}[0]").parse()?;
    let value = other.as_slice().into();
    let invalid = WriteByName { channel, name: element.as_cnc_str(), value };
    rejected(
        probe,
        &[VAR_13],
        "an element of a variable that is not an array",
        (invalid, valid),
        &watched,
    )
}

/// Writes to a channel that is not configured: at most once with each function that writes an
/// element, an object or an axis variable.
fn to_absent_channel(probe: &mut Probe<'_>) -> Step {
    let absent = probe.target.profile.absent_channel;
    let absent = Channel::new(absent.or_not_applicable("no channel is known to be absent")?)?;
    let channel = probe.channel()?;
    let variables = probe.variables(channel).if_known()?.unwrap_or_default();
    let mut all = Vec::new();
    let elements = elements_with_flag(probe, true).if_applicable()?.unwrap_or_default();
    all.extend(elements.into_iter().map(|one| one.address));
    let objects = probe.objects().if_applicable()?.unwrap_or_default();
    all.extend(objects.into_iter().filter(ListedValue::is_writable).map(|one| one.address));
    for variable in variables.iter().filter(|one| one.access == VariableAccess::READ_WRITE) {
        all.extend(axis_address(probe, channel, variable)?);
    }
    let mut functions = Vec::new();
    for address in all {
        let Some(value) = probe.filled_value_at(&address)? else { continue };
        let valid = address.write(&value)?;
        if functions.contains(&valid.function()) || !probe.may(valid)? {
            continue;
        }
        let other = changed_value(&value, false);
        let invalid = RawCall::new(address.write(&other)?)?;
        let Some(invalid) = in_channel(&invalid, channel, absent) else { continue };
        functions.push(valid.function());
        let what = format!("a write to channel {}, which is not configured", absent.number());
        rejected(probe, &[ADS_4], &what, (invalid, valid), &address)?;
    }
    applicable(!functions.is_empty(), NOTHING_WRITABLE)
}

/// Maximum number of arrays to which the case writes.
const ARRAYS_MAX: usize = 16;

fn out_of_bounds(probe: &mut Probe<'_>) -> Step {
    let mut tried = 0_usize;
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let Description { handle, dimensions, var_type, name, .. } = variable;
        let &[count] = dimensions.as_slice() else { return Ok(()) };
        let by_name = |index: u32| format!("{}[{index}]", name.text).parse::<CncString>();
        let first = ValueAddress::Handle { channel, handle: *handle, indices: vec![0] };
        if *var_type == VariableType::STRING
            || tried >= ARRAYS_MAX
            || !probe.may_write(&first, &name.text.to_string())?
        {
            return Ok(());
        }
        tried = tried.saturating_add(1);
        let whole = ValueAddress::of_handle(channel, *handle);
        let Some(value) = probe.value_at(&first)? else { return Ok(()) };
        probe.found_subject();
        let other = changed_value(&value, false);
        let valid = first.write(&value)?;
        let named = by_name(0)?;
        let good_by_name = ValueAddress::Name { channel, name: named };
        for beyond in probe.beyond(count) {
            let what = format!("a write to {}[{beyond}] of {count} elements", name.text);
            let invalid = ValueAddress::Handle { channel, handle: *handle, indices: vec![beyond] };
            let invalid = invalid.write(&other)?;
            rejected(probe, &[VAR_12], &what, (invalid, valid), &whole)?;
            let invalid = ValueAddress::Name { channel, name: by_name(beyond)? };
            let invalid = invalid.write(&other)?;
            let valid = good_by_name.write(&value)?;
            rejected(probe, &[VAR_13], &what, (invalid, valid), &whole)?;
        }
        Ok(())
    })
}

fn bad_requests(probe: &mut Probe<'_>) -> Step {
    for known in writable_numbers(probe)? {
        let watched = known.address();
        // Without a NUL after the name, the name extends to the end of the data, so the request
        // contains no value.
        let valid = known.by_name(&known.value);
        let call = RawCall::new(valid)?;
        let name: Vec<u8> = known.name().bytes().collect();
        for size in [known.value.len(), 4, 8] {
            let data = [&name[..], &vec![b'A'; size]].concat();
            let what = format!("a write of {} to a name without NUL", plural(size, "byte"));
            let invalid = call.with(|call| call.data = data);
            rejected(probe, &[VAR_13], &what, (invalid, valid), &watched)?;
        }
        let valid = known.by_handle(U32List::EMPTY, &known.value);
        let call = RawCall::new(valid)?;
        for count in [0x4000_0000_u32, 0x8000_0001, u32::MAX] {
            let mut data = call.data.to_vec();
            data.get_mut(4..8)
                .into_iter()
                .for_each(|four| four.copy_from_slice(&count.to_le_bytes()));
            let what = format!("a write with a count of {count:#x} indices");
            let invalid = call.with(|call| call.data = data);
            rejected(probe, &[VAR_24, VAR_12], &what, (invalid, valid), &watched)?;
        }
    }
    Ok(())
}
