//! A case of characters: a written text is read back unchanged.

use ads_cnc::VariableType;
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, WriteCheck, is_of_service, same};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, Rule, Step, assumed};
use crate::objects::ValueAddress;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("gen-characters-written", &[GEN_3], Needs::Writes, written,
        "Every byte from 0x80 to 0xFF written to a text is read back"),
];

/// Bytes without a character in CP1252.
pub(super) const UNASSIGNED: [u8; 5] = [0x81, 0x8D, 0x8F, 0x90, 0x9D];

/// The writable texts that the cases read, with their names: objects except those at axis indices
/// that have no axis, or may have none, and single variables except those of the Service Interface.
fn texts(probe: &mut Probe<'_>) -> Step<Vec<(ValueAddress, String)>> {
    let mut all = Vec::new();
    for object in probe.objects().if_applicable()?.unwrap_or_default() {
        if object.is_text() && object.is_writable() && !probe.is_blank(&object) {
            all.push((object.address, object.name.to_string()));
        }
    }
    for channel in probe.channels()? {
        let variables = probe.variables(channel).if_known()?.unwrap_or_default();
        all.extend(variables.into_iter().filter_map(|variable| {
            let is_text = variable.var_type == VariableType::STRING
                && variable.dimensions.is_empty()
                && variable.access == ads_cnc::VariableAccess::READ_WRITE;
            // The texts of the Service Interface are not written here, because an NC program reads
            // them.
            let own = !is_of_service(&variable);
            let name = variable.name.text;
            let what = name.to_string();
            (is_text && own).then_some((ValueAddress::Name { channel, name }, what))
        }));
    }
    Ok(all)
}

fn written(probe: &mut Probe<'_>) -> Step {
    for (address, what) in texts(probe)? {
        if address.read().is_err() || !probe.may_write(&address, &what)? {
            continue;
        }
        let Some(before) = probe.value_at(&address)?.filter(|value| value.len() > 1) else {
            continue;
        };
        let rules = [Rule::from(GEN_3)];
        let write_check = WriteCheck { what: &what, rules: &rules, is_text: true, name: None };
        probe.changing(
            &write_check,
            &address,
            &before,
            |probe| characters(probe, &address, &what, before.len()),
            |probe| {
                let taken = probe.write_checked(&write_check, &address, &before)?;
                Ok(taken
                    && probe.value_at(&address)?.is_some_and(|read| same(&read, &before, true)))
            },
        )?;
    }
    probe.finish("no text may be written")
}

/// Writes all bytes from 0x80 to 0xFF, as many at a time as fit into the text, and the unassigned
/// bytes separately.
fn characters(probe: &mut Probe<'_>, address: &ValueAddress, what: &str, size: usize) -> Step {
    let all: Vec<u8> = (0x80..=0xFF).filter(|byte| !UNASSIGNED.contains(byte)).collect();
    for (bytes, rule) in [(&all[..], Rule::from(GEN_3)), (&UNASSIGNED, assumed(GEN_3))] {
        // The last byte of the text is reserved for the NUL.
        for piece in bytes.chunks(size.saturating_sub(1)) {
            // The value is padded to the length of the original text, because another length may be
            // rejected.
            let mut value = piece.to_vec();
            value.resize(size, 0);
            is_read_again(probe, (address, what), rule, &value)?;
        }
    }
    Ok(())
}

fn is_read_again(
    probe: &mut Probe<'_>,
    (address, what): (&ValueAddress, &str),
    rule: Rule,
    value: &[u8],
) -> Step {
    // It is assumed that the CNC accepts the text.
    let taken = [assumed(GEN_3)];
    if !probe.write_checked(
        &WriteCheck { what, rules: &taken, is_text: true, name: None },
        address,
        value,
    )? {
        return Ok(());
    }
    let read = probe.value_at(address)?.unwrap_or_default();
    let passed = same(&read, value, true);
    let expected = || format!("{} of {what}, as written", Hex(value.to_vec()));
    probe.check(rule, passed, expected, || Hex(read));
    Ok(())
}
