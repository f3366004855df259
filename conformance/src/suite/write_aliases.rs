//! Cases that write a value at one of its addresses and read it at another. The addresses are those
//! by the rank and by the number of a channel, and in the HLDs of the platform and of the first
//! channel.

use ads_cnc::address::Class;
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{NOTHING_WRITABLE, Probe, WritableElement, WriteCheck, elements_with_flag};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step};
use crate::objects::ValueAddress;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-objects-by-index", &[ADR_12], Needs::Writes, objects_by_index,
        "An object accepts and returns a value by the channel's rank as by its number"),
    case("write-platform-axes-of-hld", &[SDA_13], Needs::Writes, axes_of_hld,
        "A platform axis has the same values in the first channel's HLD and in the platform's HLD"),
];

fn objects_by_index(probe: &mut Probe<'_>) -> Step {
    for object in probe.objects()? {
        let (logical, what) = (&object.address, object.name.to_string());
        if !object.is_writable() || probe.is_blank(&object) || logical.read().is_err() {
            continue;
        }
        let Some(address) = probe.address_by_rank(&object) else { continue };
        if address.read().is_err()
            || !probe.may_write(logical, &what)?
            || !probe.may_write(&address, &what)?
        {
            continue;
        }
        // If the value cannot be read or written by the channel's number either, another case
        // judges this.
        let Some(value) = probe.filled_value_at(logical)? else {
            continue;
        };
        if probe.try_ask(logical.write(&value)?)?.is_none() {
            continue;
        }
        let rules = [Rule::from(ADR_12)];
        let is_text = object.is_text();
        let write_check =
            WriteCheck { what: &format!("{what} by index"), rules: &rules, is_text, name: None };
        probe.try_write(&write_check, &address, |probe, _, _| {
            let (read, number) = (probe.value_at(&address)?, probe.value_at(logical)?);
            let same = number == read || probe.value_at(&address)? != read;
            let expected =
                || format!("{} of {what}, also by number", Hex(read.unwrap_or_default()));
            probe.check(ADR_12, same, expected, || Hex(number.unwrap_or_default()));
            Ok(())
        })?;
    }
    probe.finish(NOTHING_WRITABLE)
}

fn axes_of_hld(probe: &mut Probe<'_>) -> Step {
    let first = u32::from(probe.channel()?.number());
    let all = probe.instances()?;
    for one in elements_with_flag(probe, true)? {
        let WritableElement { instance, element, address, what, is_text } = &one;
        let other = match instance.channel {
            _ if instance.class != Class::Hld || instance.axis == 0 => continue,
            0 => first,
            channel if channel == first => 0,
            _ => continue,
        };
        let at = (Class::Hld, other, instance.axis);
        let twin = all.iter().find(|one| (one.class, one.channel, one.axis) == at);
        let (start, at) = (instance.first.index_offset().get(), element.index_offset().get());
        let twin = twin.and_then(|twin| twin.first.nth(at.saturating_sub(start)).ok());
        let (Some(element), ValueAddress::Element { length, .. }) = (twin, address) else {
            continue;
        };
        let twin = ValueAddress::of_element(element, *length);
        let write_check = WriteCheck { what, rules: &[], is_text: *is_text, name: None };
        probe.try_write(&write_check, address, |probe, _, new| {
            let (before, read) = (probe.value_at(address)?, probe.value_at(&twin)?);
            let stood = probe.value_at(address)? == before && before.as_deref() == Some(new);
            let expected =
                || format!("{} of {what}, also in the HLD of {other}", Hex(new.to_vec()));
            let found = || Hex(read.clone().unwrap_or_default());
            probe.check(SDA_13, !stood || read == before, expected, found);
            Ok(())
        })?;
    }
    probe.finish("no axis of the HLD may be written")
}
