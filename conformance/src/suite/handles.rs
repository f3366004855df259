//! Cases of handles: the variable to which a handle belongs, how long the handle is valid, and
//! unknown handles.

use std::collections::HashSet;

use ads_cnc::address::Channel;
use ads_cnc::operation::{HandleByName, ReadByHandle, ReadByName};
use ads_cnc::{Decode as _, Description, Handle, Kind, TextRef, U32List, VariablePath};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, Steady, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, OrStop as _, Step, Stop, assumed};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    // This case reads each variable by the handle in its description before it requests a handle by
    // name.
    case("var-described-handle", &[VAR_4, VAR_9, VAR_10], Needs::Queries, described,
        "The name and the handle in a description read the variable"),
    case("var-handle-by-name", &[VAR_9, VAR_10], Needs::Queries, by_name,
        "A name has the handle in its description, and no two names share a handle"),
    case("var-handle-stays", &[VAR_10], Needs::Queries, stays,
        "A handle keeps its variable after other requests, reads and rejected requests"),
    case("val-unknown-handle", &[ADS_4, VAR_11], Needs::Malformed, unknown,
        "A request with an unknown handle returns an error"),
];

pub(super) fn whole(channel: Channel, handle: Handle) -> ReadByHandle<'static> {
    ReadByHandle::new(channel, handle, U32List::EMPTY)
}

fn described(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    for channel in probe.channels()? {
        for variable in probe.readable(channel)? {
            let what = variable.name.text.to_string();
            probe.set_subject(&what);
            let by_handle = whole(channel, variable.handle);
            let by_name = ReadByName { channel, name: name_of(&variable) };
            let answered = probe.try_ask(by_handle)?.is_some();
            // If the handle that is requested by name does not read the variable either, another
            // case judges this failure.
            if answered || reads_by_own_handle(probe, channel, &variable)? {
                let expected = || format!("a success for the handle in the description of {what}");
                probe.check([VAR_4, VAR_10], answered, expected, "an error");
            }
            let exchange = probe.send(by_name)?;
            let named = exchange.success().is_some();
            let expected = || format!("a success for the name {what}");
            probe.check([VAR_4, VAR_9], named, expected, &exchange);
            if answered && named {
                steady.same(probe, [VAR_4, VAR_10], &what, by_handle, by_name)?;
            }
        }
    }
    steady.finish()
}

/// Whether the variable can be read by the handle that is requested by its name; also true if the
/// target returns no handle for the name.
fn reads_by_own_handle(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
) -> Step<bool> {
    let name = name_of(variable);
    let handle: Option<Handle> = probe.try_read(HandleByName { channel, name })?;
    match handle {
        Some(handle) => Ok(probe.try_ask(whole(channel, handle))?.is_some()),
        None => Ok(true),
    }
}

/// Requests the handle of a name, and checks that the reply is a handle; a failure ends the case,
/// so the function never returns `None`.
fn handle_of(probe: &mut Probe<'_>, channel: Channel, name: TextRef<'_>) -> Step<Option<Handle>> {
    let rules = [VAR_9, VAR_10];
    let data = probe.ask(rules, HandleByName { channel, name })?;
    let handle = Handle::decode(&data);
    probe.require(VAR_10, handle.is_ok(), "a handle of four bytes", || Hex(data))?;
    Ok(handle.ok())
}

fn by_name(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let variables = probe.readable(channel)?;
        let mut handles = HashSet::new();
        for variable in &variables {
            let name = name_of(variable);
            probe.set_subject(name.text());
            let Some(handle) = handle_of(probe, channel, name)? else { continue };
            // The manuals do not state that a variable has only one handle. Therefore, the next two
            // checks are assumed. A handle other than the description's must read a value, which
            // must have the described size if the type has a fixed size.
            let expected =
                || format!("the description's handle {} for {}", variable.handle, name.text());
            let rule = assumed(VAR_10);
            probe.check(rule, handle == variable.handle, expected, || handle.to_string());
            let found = || format!("{handle} for {} too", name.text());
            probe.check(rule, handles.insert(handle), "a handle that no other name has", found);
            if handle == variable.handle {
                continue;
            }
            let read = probe.ask(VAR_10, whole(channel, handle))?;
            let sized = u32::try_from(read.len()) == Ok(variable.size)
                || variable.var_type.element_size().is_none();
            let found = || format!("{} of {}", plural(read.len(), "byte"), name.text());
            probe.check(
                VAR_10,
                sized,
                || format!("the {} of its description", plural(variable.size, "byte")),
                found,
            );
        }
    }
    Ok(())
}

fn stays(probe: &mut Probe<'_>) -> Step {
    let mut all: Vec<(Channel, Description, Handle)> = Vec::new();
    for channel in probe.channels()? {
        for variable in probe.readable(channel)? {
            let asked = HandleByName { channel, name: name_of(&variable) };
            let handle = probe.try_read::<Handle>(asked)?;
            all.extend(handle.map(|handle| (channel, variable, handle)));
        }
        let unknown = TextRef::new("V.E.no such variable")?;
        probe.try_ask(HandleByName { channel, name: unknown })?;
    }
    if all.is_empty() {
        return Err(Stop::inconclusive("no name has a handle"));
    }
    let mut steady = Steady::default();
    for (channel, variable, handle) in &all {
        let (channel, by_handle) = (*channel, whole(*channel, *handle));
        // The variable is read twice, because its handle must stay valid after a read.
        for time in ["once", "again"] {
            let read = probe.try_ask(by_handle)?.is_some();
            let expected = || format!("{} read by its handle {time}", variable.name.text);
            probe.check(VAR_10, read, expected, "an error");
        }
        let by_name = ReadByName { channel, name: name_of(variable) };
        steady.same(probe, VAR_10, &variable.name.text, by_handle, by_name)?;
    }
    steady.finish()
}

fn unknown(probe: &mut Probe<'_>) -> Step {
    let mut taken = HashSet::new();
    for channel in probe.channels()? {
        let Some(all) = probe.all_variables(channel)? else {
            return Err(Stop::not_applicable(
                "the target has too many variables to know all handles",
            ));
        };
        taken.extend(all.into_iter().map(|variable| variable.handle.0));
    }
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    // The valid handle should not be that of an axis variable, which may belong to an axis index
    // without an axis.
    let is_of_axis = |variable: &&Description| {
        let path = VariablePath::from_text(variable.name.text.as_cnc_str());
        path.is_ok_and(|path| path.kind() == Kind::V_A)
    };
    let known = variables.iter().find(|one| !is_of_axis(one)).or(variables.first());
    let known = known.or_inconclusive("no variable")?;
    let near = [0x80_0000, 0x8000_0000].map(|bit| known.handle.0 ^ bit);
    let numbers = [0, 1, 0x7FFF_FFFF, u32::MAX].into_iter().chain(near);
    for number in numbers.filter(|number| !taken.contains(number)) {
        let what = format!("the handle {number:#x}");
        let unknown = whole(channel, Handle(number));
        probe.rejects([ADS_4, VAR_11], &what, unknown, whole(channel, known.handle))?;
    }
    Ok(())
}
