//! A Write, and a read of the same value by another service.

use ads_cnc::{CncString, VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use crate::judge::{Checks as _, Rule, Step, applicable};
use crate::objects::ValueAddress;
use crate::suite::kit::{NOTHING_WRITABLE, Probe, WriteCheck, is_of_service, may_write_whole};

/// Maximum number of variables of a channel that are written, and maximum number of objects.
const ITEMS_MAX: usize = 3;

const RULE: ClauseId = ADS_2;

/// Checks that another service (Read or ReadWrite) reads the written value, and that a write to a
/// variable does not change the variable on which the case made its previous write.
pub(super) fn arrives(probe: &mut Probe<'_>) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        let Ok(variables) = probe.variables(channel) else { continue };
        let written = variables.iter().filter(|one| one.access == VariableAccess::READ_WRITE);
        let mut tried: Vec<(ValueAddress, CncString)> = Vec::new();
        for variable in written.filter(|one| !is_of_service(one)) {
            let name = variable.name.text.clone();
            let address = ValueAddress::Name { channel, name: name.clone() };
            if tried.len() >= ITEMS_MAX || !may_write_whole(probe, &address, variable)? {
                continue;
            }
            let is_text = variable.var_type == VariableType::STRING;
            let neighbour = tried.last().map(|(address, _)| address.clone());
            write_beside(probe, &address, &name.to_string(), is_text, neighbour.as_ref())?;
            tried.push((address, name));
        }
        any |= !tried.is_empty();
    }
    any |= objects(probe)?;
    applicable(any, NOTHING_WRITABLE)
}

fn objects(probe: &mut Probe<'_>) -> Step<bool> {
    let Ok(objects) = probe.objects() else { return Ok(false) };
    let mut tried = 0_usize;
    for object in objects.iter().filter(|one| one.is_writable() && !one.is_text()) {
        let address = &object.address;
        let name = object.name.to_string();
        // At an axis index without an axis, a written value may be lost. The contents there should
        // be zero, so objects of axes whose content is zero are skipped.
        let of_axis = address.content().is_some_and(|(_, offset)| offset.get() >= 0x1000);
        let filled = match address.read() {
            Ok(read) if !probe.is_blank(object) && probe.may(read)? => {
                probe.value_at(address)?.is_some_and(|was| !of_axis || any(&was))
            }
            _ => false,
        };
        if tried >= ITEMS_MAX || !filled || !probe.may_write(address, &name)? {
            continue;
        }
        write_beside(probe, address, &name, false, None)?;
        tried = tried.saturating_add(1);
    }
    Ok(tried > 0)
}

fn any(value: &[u8]) -> bool {
    value.iter().any(|&byte| byte != 0)
}

fn write_beside(
    probe: &mut Probe<'_>,
    address: &ValueAddress,
    what: &str,
    is_text: bool,
    neighbour: Option<&ValueAddress>,
) -> Step {
    let rules: [Rule; 1] = [RULE.into()];
    let look = |probe: &mut Probe<'_>| match neighbour {
        Some(neighbour) => probe.value_at(neighbour),
        None => Ok(None),
    };
    let (before, mut meanwhile) = (look(probe)?, None);
    probe.try_write(
        &WriteCheck { what, rules: &rules, is_text, name: None },
        address,
        |probe, _, _| {
            meanwhile = look(probe)?;
            Ok(())
        },
    )?;
    let after = look(probe)?;
    // If the value of the neighbour changes by itself, it is not judged.
    if let (Some(before), Some(meanwhile)) = (&before, meanwhile)
        && after.as_ref() == Some(before)
    {
        let expected =
            || format!("{} at an address next to {what}, unchanged", Hex(before.clone()));
        probe.check(RULE, meanwhile == *before, expected, || Hex(meanwhile));
    }
    Ok(())
}
