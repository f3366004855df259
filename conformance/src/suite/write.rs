//! Cases that write whole variables and restore them, and that write to read-only axis variables.

use ads_cnc::address::Channel;
use ads_cnc::{CncString, Description, VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{
    NOTHING_WRITABLE, Probe, WriteCheck, axis_address, dynamic_among_variables, each_of_access,
    handle_of, may_write_whole, same, write_check,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step, assumed};
use crate::objects::ValueAddress;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-by-handle", &[VAR_6, VAR_10, VAR_12, VAR_17], Needs::Writes, by_handle,
        "A value written by handle is read back, and then the restored value"),
    case("write-by-name", &[VAR_6, VAR_13, VAR_14, VAR_17], Needs::Writes, by_name,
        "A value written by name is read back by name and by handle"),
    case("write-axis-variable", &[VAR_17, VAR_26], Needs::Writes, axis_variables,
        "A value written on the axis interface is read by the name with the axis appended"),
    case("write-axis-read-only", &[VAR_6, VAR_26], Needs::Writes, axis_read_only,
        "The axis interface rejects a write to an axis variable that is READ_ONLY"),
    case("write-by-name-only", &[VAR_18], Needs::Writes, by_name_only,
        "A variable accessible only by name is written by its name"),
    case("write-dynamic-by-name", &[VAR_19], Needs::Writes, dynamic_by_name,
        "V.P, V.L and V.S are written as variables, by name"),
];

fn by_handle(probe: &mut Probe<'_>) -> Step {
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let handle = handle_of(probe, channel, variable)?;
        let address = ValueAddress::of_handle(channel, handle);
        let name = variable.name.text.to_string();
        if !may_write_whole(probe, &address, variable)? {
            return Ok(());
        }
        let rules = [VAR_12, VAR_17, VAR_6, VAR_10].map(Rule::from);
        probe.try_write(&write_check(variable, &name, &rules), &address, |_, _, _| Ok(()))?;
        Ok(())
    })
}

fn by_name(probe: &mut Probe<'_>) -> Step {
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let address = ValueAddress::Name { channel, name: variable.name.text.clone() };
        let name = variable.name.text.to_string();
        if !may_write_whole(probe, &address, variable)? {
            return Ok(());
        }
        let handle = variable.handle;
        let by_handle = ValueAddress::of_handle(channel, handle);
        let rules = [VAR_13, VAR_17, VAR_6].map(Rule::from);
        probe.try_write(&write_check(variable, &name, &rules), &address, |probe, _, new| {
            let named = probe.value_at(&address)?.unwrap_or_default();
            let read = probe.value_at(&by_handle)?.unwrap_or_default();
            let is_text = variable.var_type == VariableType::STRING;
            let expected = || format!("{} of {name}, read by its handle", Hex(new.to_vec()));
            let passed = same(&read, new, is_text);
            probe.check(VAR_13, passed, expected, || Hex(read.clone()));
            // If a read by name returns the new value, a read by handle must return it, too.
            let passed = passed || !same(&named, new, is_text);
            probe.check(VAR_14, passed, expected, || Hex(read));
            Ok(())
        })?;
        Ok(())
    })
}

/// Calls a function for every axis variable that the cases read, that has this access, and for
/// which the [gate](crate::gate) and the profile permit a write on the axis interface. The address
/// has the first axis index that returns the handle in the description; without such an axis index,
/// the variable is left out.
fn each_of_axes(
    probe: &mut Probe<'_>,
    access: VariableAccess,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description, &ValueAddress, &str) -> Step,
) -> Step {
    each_of_access(probe, access, |probe, channel, variable| {
        let Some(at) = axis_address(probe, channel, variable)? else { return Ok(()) };
        let what = format!("{} on the axis interface", variable.name.text);
        if !may_write_whole(probe, &at, variable)? {
            return Ok(());
        }
        judge(probe, channel, variable, &at, &what)?;
        Ok(())
    })
}

fn axis_variables(probe: &mut Probe<'_>) -> Step {
    let rules = [VAR_26, VAR_17].map(Rule::from);
    each_of_axes(probe, VariableAccess::READ_WRITE, |probe, channel, variable, at, what| {
        let named = ValueAddress::Name { channel, name: variable.name.text.clone() };
        probe.try_write(&write_check(variable, what, &rules), at, |probe, _, new| {
            let read = probe.value_at(&named)?.unwrap_or_default();
            let expected = || format!("{} of {}", Hex(new.to_vec()), variable.name.text);
            probe.check(VAR_26, read == new, expected, || Hex(read));
            Ok(())
        })
    })
}

fn axis_read_only(probe: &mut Probe<'_>) -> Step {
    let rules = [VAR_6, VAR_26].map(Rule::from);
    each_of_axes(probe, VariableAccess::READ_ONLY, |probe, _, variable, at, what| {
        probe.write_rejected(&write_check(variable, what, &rules), at, None)
    })
}

/// Writes variables without a handle in the first channel by their names. It is assumed that the
/// CNC accepts such a write, because the manuals limit the access to such variables without
/// details.
fn by_names(probe: &mut Probe<'_>, rule: ClauseId, names: Vec<CncString>) -> Step {
    let channel = probe.channel()?;
    for name in names {
        let what = name.to_string();
        let address = ValueAddress::Name { channel, name };
        if probe.may_write(&address, &what)? {
            let rules = [assumed(rule)];
            let write_check = WriteCheck { what: &what, rules: &rules, is_text: false, name: None };
            probe.try_write(&write_check, &address, |probe, _, new| {
                // A value that the CNC has accepted must be read back.
                let read = probe.value_at(&address)?.unwrap_or_default();
                let expected = || format!("{} of {what}, as written", Hex(new.to_vec()));
                probe.check(rule, read == new, expected, || Hex(read));
                Ok(())
            })?;
        }
    }
    probe.finish(NOTHING_WRITABLE)
}

fn by_name_only(probe: &mut Probe<'_>) -> Step {
    let names = probe.target.profile.by_name_only.clone();
    let names: Result<Vec<CncString>, _> = names.iter().map(|name| name.parse()).collect();
    by_names(probe, VAR_18, names?)
}

fn dynamic_by_name(probe: &mut Probe<'_>) -> Step {
    let all = dynamic_among_variables(probe)?;
    by_names(probe, VAR_19, all.into_iter().map(|(_, name)| name).collect())
}
