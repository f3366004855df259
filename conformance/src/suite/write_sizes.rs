//! A case of writes of values whose size is not that of the variable.

use ads_cnc::address::Channel;
use ads_cnc::{CncString, Description, VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{
    Probe, axis_address, changed_value, each_of_access, is_of_service, is_sendable, is_taken,
    require_taken,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step, assumed, online};
use crate::objects::ValueAddress;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-wrong-size", &[VAR_12, VAR_13, VAR_25, VAR_26], Needs::MalformedWrites, wrong_size,
        "A write with a wrong size returns an error, or the variable has the value sent"),
];

/// An address of a value, and the requirement for writes to it.
struct WriteAddress {
    id: ClauseId,
    address: ValueAddress,
}

fn write_addresses(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
) -> Step<Vec<WriteAddress>> {
    let (name, handle) = (&variable.name.text, variable.handle);
    let by_name = |name: CncString| WriteAddress {
        id: VAR_13,
        address: ValueAddress::Name { channel, name },
    };
    let by_handle = |indices| WriteAddress {
        id: VAR_12,
        address: ValueAddress::Handle { channel, handle, indices },
    };
    let mut all = vec![by_handle(Vec::new()), by_name(name.clone())];
    if variable.dimensions.len() == 1 {
        all.push(by_handle(vec![0]));
        all.push(by_name(format!("{name}[0]").parse()?));
    }
    let of_axis = axis_address(probe, channel, variable)?;
    all.extend(of_axis.map(|address| WriteAddress { id: VAR_26, address }));
    Ok(all)
}

/// For each type, writes values of wrong sizes to the first writable variable without dimensions
/// and to the first writable array with one dimension, separately for axis variables and for
/// others.
fn wrong_size(probe: &mut Probe<'_>) -> Step {
    let mut tried = Vec::new();
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let is_of_axis = variable.name.text.as_bytes().starts_with(b"V.A.");
        let sort = (variable.var_type, variable.dimensions.len(), is_of_axis);
        if is_of_service(variable) || tried.contains(&sort) || variable.dimensions.len() > 1 {
            return Ok(());
        }
        for at in write_addresses(probe, channel, variable)? {
            if probe.may_write(&at.address, &variable.name.text.to_string())? {
                tried.push(sort);
                probe.found_subject();
                of_address(probe, channel, variable, &at)?;
            }
        }
        Ok(())
    })
}

fn of_address(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
    at: &WriteAddress,
) -> Step {
    let is_text = variable.var_type == VariableType::STRING;
    let Some(value) = probe.filled_value_at(&at.address)? else {
        return Ok(());
    };
    let whole = ValueAddress::of_handle(channel, variable.handle);
    // The written number differs from the current one in its first byte, so that a write of a part
    // of the data is detected.
    let other = if is_text { vec![b'x'; value.len()] } else { changed_value(&value, false) };
    let size = variable.var_type.element_size().and_then(|size| usize::try_from(size).ok());
    let one = size.unwrap_or(1);
    let longer = |more: usize| [&other[..], &vec![1; more]].concat();
    let shorter = |fewer: usize| other.get(..other.len().saturating_sub(fewer));
    let mut all = vec![longer(1), longer(one), longer(64)];
    // Shorter data is not a wrong size for a text, which may be shorter than its variable.
    if !is_text {
        all.push(Vec::new());
        all.extend([1, one].into_iter().filter_map(shorter).map(<[u8]>::to_vec));
    }
    let mut sizes = Vec::new();
    for data in all {
        if data.len() != value.len() && !sizes.contains(&data.len()) {
            sizes.push(data.len());
            let sent = WrongSizeWrite { at, watched: &whole, is_text, value: &value, other: &data };
            let what = format!(
                "{} instead of {} for {}",
                plural(data.len(), "byte"),
                value.len(),
                variable.name.text
            );
            sent.judge(probe, &what)?;
        }
    }
    Ok(())
}

/// A write of a wrong size to an address.
struct WrongSizeWrite<'a> {
    at: &'a WriteAddress,
    watched: &'a ValueAddress,
    is_text: bool,
    value: &'a [u8],
    other: &'a [u8],
}

impl WrongSizeWrite<'_> {
    /// Sends the write and checks its effect. For texts, the rejection is documented only online
    /// (VAR-25); for numbers, it is assumed. After an error, the value must be unchanged. After a
    /// success, the value that is read back must start with the value sent.
    fn judge(&self, probe: &mut Probe<'_>, what: &str) -> Step {
        let Self { at, watched, is_text, value, other } = *self;
        let (invalid, valid) = (at.address.write(other), at.address.write(value));
        let (Ok(invalid), Ok(valid)) = (invalid, valid) else { return Ok(()) };
        if !is_sendable(&invalid) || !is_sendable(&valid) {
            return Ok(());
        }
        let of_size: Rule = if is_text { online(VAR_25) } else { at.id.into() };
        require_taken(probe, at.id, valid)?;
        let before = probe.value_at(watched)?;
        let is_taken = is_taken(probe, at.id, what, invalid)?;
        let evidence = probe.evidence();
        let (read, after) = (probe.value_at(&at.address)?, probe.value_at(watched)?);
        probe.set_evidence(evidence);
        let rule = if is_text { of_size } else { assumed(at.id) };
        probe.check(rule, !is_taken, || format!("an error number for {what}"), "a success");
        if is_taken {
            let read = read.unwrap_or_default();
            let expected = || format!("an error, or {what} read back");
            probe.check(of_size, read.starts_with(other), expected, || Hex(read));
        } else {
            // A value that changes by itself is not judged.
            if after != before && probe.moves(watched, false)? {
                return probe.send(valid).map(drop);
            }
            let expected = || format!("the value before {what}");
            let shown = || Hex(after.clone().unwrap_or_default());
            probe.check(at.id, after == before, expected, shown);
        }
        probe.send(valid).map(drop)
    }
}
