//! A case that writes texts and restores them.

use ads_cnc::{CncString, VariableAccess, VariableType};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::kit::{Probe, WriteCheck, each_of_access};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, online};
use crate::objects::ValueAddress;
use crate::text::plural;
use crate::values::until_nul;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-texts", &[VAR_12, VAR_13, VAR_25], Needs::Writes, texts,
        "A text of the described length is read back as written, and so is a shorter one after it"),
];

fn texts(probe: &mut Probe<'_>) -> Step {
    each_of_access(probe, VariableAccess::READ_WRITE, |probe, channel, variable| {
        let name = variable.name.text.clone();
        if variable.var_type != VariableType::STRING || !variable.dimensions.is_empty() {
            return Ok(());
        }
        for (id, address) in [
            (VAR_13, ValueAddress::Name { channel, name: name.clone() }),
            (VAR_12, ValueAddress::of_handle(channel, variable.handle)),
        ] {
            if !probe.may_write(&address, &name.to_string())? {
                continue;
            }
            let Some(before) = probe.filled_value_at(&address)? else {
                continue;
            };
            let what = name.to_string();
            let write_check =
                WriteCheck { what: &what, rules: &[], is_text: true, name: Some(&name) };
            probe.changing(
                &write_check,
                &address,
                &before,
                |probe| of_lengths(probe, id, &address, (&name, variable.size)),
                |probe| {
                    probe.write_value(&address, &before)?;
                    // Without a successful read, the value is unknown.
                    let Some(after) = probe.value_at(&address)? else { return Ok(false) };
                    let passed = until_nul(&after) == until_nul(&before);
                    let expected = || format!("{} of {name}, restored", Hex(before.clone()));
                    Ok(probe.check(id, passed, expected, || Hex(after)))
                },
            )?;
        }
        Ok(())
    })
}

/// Writes texts of several lengths. The maximum length of a text is documented online only; the
/// manuals state that an accepted text is stored.
fn of_lengths(
    probe: &mut Probe<'_>,
    id: ClauseId,
    address: &ValueAddress,
    (name, size): (&CncString, u32),
) -> Step {
    let size = usize::try_from(size).unwrap_or_default().min(800);
    for len in [size.saturating_sub(1), size.checked_div(2).unwrap_or(0), 1] {
        let mut value = vec![b'x'; len];
        value.push(0);
        // The value is padded to the described size, because it is only assumed that the CNC
        // accepts fewer bytes.
        value.resize(size.max(1), 0);
        let accepted = probe.write_value(address, &value)?;
        let expected = || format!("{name} accepts a text of {}", plural(len, "character"));
        probe.check(online(VAR_25), accepted, expected, "an error");
        if !accepted {
            continue;
        }
        let read = probe.value_at(address)?.unwrap_or_default();
        let same = until_nul(&read) == until_nul(&value);
        let expected = || format!("{} of {name}, as written", plural(len, "character"));
        let found = || format!("{}: {}", plural(read.len(), "byte"), Hex(read.clone()));
        probe.check(id, same, expected, found);
        probe.check(online(VAR_25), same, expected, found);
    }
    shorter(probe, id, address, (name, size))
}

/// Writes a text of the maximum length, and then a shorter text without padding. That the CNC
/// accepts the shorter text is assumed. If the CNC accepts it, exactly the shorter text must be
/// read back.
fn shorter(
    probe: &mut Probe<'_>,
    id: ClauseId,
    address: &ValueAddress,
    (name, size): (&CncString, usize),
) -> Step {
    let mut longest = vec![b'y'; size.saturating_sub(1)];
    longest.push(0);
    let short = b"zz\0".get(..size.min(3)).unwrap_or_default();
    if short.last() != Some(&0)
        || !probe.write_value(address, &longest)?
        || !probe.write_value(address, short)?
    {
        return Ok(());
    }
    let read = probe.value_at(address)?.unwrap_or_default();
    let expected = || format!("{:?} of {name}, as written", "zz");
    probe.check(id, until_nul(&read) == until_nul(short), expected, || Hex(read));
    Ok(())
}
