//! Cases of the extended description, and of the description by name.

use ads_cnc::address::Channel;
use ads_cnc::operation::{CountVariables, DescribeByName, DescribeExtended};
use ads_cnc::{Description, DescriptionByName, ExtendedReply, Kind, TextRef, VariableCount};
use ads_cnc_vectors::ids::*;

use super::kit::{ItemKind, Probe, name_of};
use super::row::{CaseRow, case};
use crate::edition::Feature;
use crate::judge::{Checks as _, Needs, OrStop as _, Step, Stop, assumed, online};
use crate::number::to_usize;
use crate::profile::Claim;
use crate::rules::check_extended;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("var-extended-descriptions", &[VAR_15, VAR_16, ADS_3], Needs::Queries, extended,
        "Every V.E variable has an extended description; V.G and V.A have none"),
    case("var-extended-beyond-last", &[VAR_3], Needs::Queries, extended_beyond,
        "The index after the last has no extended description"),
    case("var-described-by-name", &[VAR_28], Needs::Queries, described_by_name,
        "A variable has the same description by its name and by its index"),
    case("var-unknown-described", &[VAR_28], Needs::Queries, unknown_described,
        "A request for the description of an unknown name returns an error"),
];

/// The number of variables of a kind; 0 if it cannot be read, which other cases judge.
fn count(probe: &mut Probe<'_>, channel: Channel, kind: Kind<'_>) -> Step<u32> {
    let count = probe.try_read::<VariableCount>(CountVariables::new(channel, kind))?;
    Ok(count.map_or(0, |count| count.0))
}

fn extended(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (name, kind) in probe.kinds() {
            let count = count(probe, channel, kind)?;
            for index in probe.sample(ItemKind::Variable, 0..count) {
                let request = DescribeExtended::new(channel, index, kind);
                let at = format!("index {index} of {name}");
                if kind == Kind::V_E {
                    let reply: ExtendedReply = probe.read(VAR_15, request)?;
                    check_extended(probe, &reply, &at);
                } else {
                    of_others(probe, request, &at)?;
                }
            }
        }
    }
    Ok(())
}

/// Requests the extended description of a variable of another kind than V.E. The reply must have no
/// data; it is assumed that it must be a success.
fn of_others(probe: &mut Probe<'_>, request: DescribeExtended<'_>, at: &str) -> Step {
    let exchange = probe.send(request)?;
    let data = exchange.reply().and_then(|reply| reply.data.clone());
    let empty = data.as_ref().is_none_or(Vec::is_empty);
    let whole = to_usize(exchange.read_length);
    let padded = |data: &Vec<u8>| data.len() == whole && data.iter().all(|&byte| byte == 0);
    let is_padded = data.as_ref().is_some_and(padded);
    probe.check(ADS_3, !is_padded, "no bytes after the data", &exchange);
    let expected = || format!("no data for {at}");
    probe.check(VAR_16, empty && exchange.reply().is_some(), expected, &exchange);
    let success = exchange.success().is_some();
    probe.check(assumed(VAR_16), success, "the result 0", &exchange);
    Ok(())
}

fn extended_beyond(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for (name, kind) in probe.kinds() {
            let count = count(probe, channel, kind)?;
            let Some(last) = count.checked_sub(1) else { continue };
            for beyond in probe.beyond(count) {
                let what = format!("index {beyond} of {count} {name}");
                let describe = |index| DescribeExtended::new(channel, index, kind);
                if kind == Kind::V_E {
                    probe.rejects(VAR_3, &what, describe(beyond), describe(last))?;
                    continue;
                }
                // A kind without extended descriptions must also return no data for an index after
                // the last.
                let given = probe.try_ask(describe(beyond))?.unwrap_or_default();
                let found = || plural(given.len(), "byte");
                probe.check(VAR_3, given.is_empty(), || format!("no data for {what}"), found);
            }
        }
    }
    Ok(())
}

/// Ends the case as not applicable if the target does not support the description by name. If the
/// function is optional, a success for the first variable of any channel shows that the target
/// supports it.
fn is_there(probe: &mut Probe<'_>) -> Step {
    if probe.target.profile.claims(ads_cnc::operation::Function::DescribeByName) == Claim::Yes {
        return Ok(());
    }
    for channel in probe.channels()? {
        let Some(first) = probe.variables(channel)?.into_iter().next() else { continue };
        if probe.try_ask(DescribeByName { channel, name: name_of(&first) })?.is_some() {
            return Ok(());
        }
    }
    let clause = Feature::DescriptionByName.requirement();
    let why =
        format!("the target has no description by name, which only some versions have ({clause})");
    Err(Stop::NotApplicable(why))
}

fn described_by_name(probe: &mut Probe<'_>) -> Step {
    is_there(probe)?;
    for channel in probe.channels()? {
        for variable in &probe.variables(channel)? {
            let request = DescribeByName { channel, name: name_of(variable) };
            let described: DescriptionByName = probe.read(VAR_28, request)?;
            let name = &variable.name.text;
            let passed = (described.var_type, described.access, described.size)
                == (variable.var_type, variable.access, variable.size)
                && described.dimensions == variable.dimensions;
            let Description { var_type, access, size, dimensions, handle, .. } = variable;
            let by_index = format!(
                "{var_type}, {access}, {}, dimensions {dimensions:?}",
                plural(*size, "byte")
            );
            let DescriptionByName { var_type, access, size, dimensions, .. } = &described;
            let found = || {
                let size = plural(*size, "byte");
                format!("{var_type}, {access}, {size}, dimensions {dimensions:?} of {name}")
            };
            probe.check(VAR_28, passed, || format!("{by_index} of {name}, as by index"), found);
            let same = described.handle == *handle;
            let expected = || format!("the handle {handle} of {name}, as by index");
            probe.check(online(VAR_28), same, expected, || described.handle.to_string());
        }
    }
    Ok(())
}

fn unknown_described(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().or_inconclusive("no variable")?;
    is_there(probe)?;
    for name in ["V.E.no such variable", "V.E.", ""] {
        let unknown = TextRef::new(name)?;
        let valid = DescribeByName { channel, name: name_of(known) };
        let invalid = DescribeByName { name: unknown, ..valid };
        probe.rejects(VAR_28, &format!("the name {name:?}"), invalid, valid)?;
    }
    Ok(())
}
