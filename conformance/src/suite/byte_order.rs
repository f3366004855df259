//! Cases of the byte order of numbers.

use std::fmt::Display;

use ads_cnc::Handle;
use ads_cnc::address::{Class, Group, IndexGroup};
use ads_cnc::operation::{DynamicValueByIndex, DynamicValueByName, HandleByName, ReadByName};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{Counted, Probe, is_permutation, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, Step};

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("gen-number-order", &[GEN_1], Needs::Queries, number_order,
        "Counts and handles come with their lowest byte first"),
    case("gen-field-order", &[GEN_1], Needs::Queries, field_order,
        "Numbers in descriptors, descriptions and addresses come with their lowest byte first"),
    case("gen-value-order", &[GEN_1], Needs::Simulator, value_order,
        "Values of variables and parameters come with their lowest byte first"),
];

/// A number that is wrong, but right with reversed bytes, breaks the byte order.
fn number_order(probe: &mut Probe<'_>) -> Step {
    for (one, number) in Counted::all(probe)? {
        let from_behind = number.swap_bytes();
        if number == from_behind {
            continue;
        }
        let swapped = !one.has(probe, number)? && one.has(probe, from_behind)?;
        let found = || format!("{number:#x}, where the last is number {from_behind:#x}");
        probe.check(GEN_1, !swapped, || format!("the number of items of {one}"), found);
    }
    for channel in probe.channels()? {
        for variable in probe.variables(channel).if_known()?.unwrap_or_default() {
            let name = name_of(&variable);
            let handle: Option<Handle> = probe.try_read(HandleByName { channel, name })?;
            let Some(handle) = handle else { continue };
            let known = variable.handle.0;
            let swapped = handle.0 != known && handle.0.swap_bytes() == known;
            let expected = || format!("{:?} of {}", variable.handle, variable.name.text);
            probe.check(GEN_1, !swapped, expected, || format!("{handle:?}"));
        }
    }
    Ok(())
}

/// Checks a number: one that is implausible, but plausible with reversed bytes, breaks the byte
/// order.
fn in_order(
    probe: &mut Probe<'_>,
    what: impl Display,
    number: u32,
    makes_sense: impl Fn(u32) -> bool,
) {
    let swapped = !makes_sense(number) && makes_sense(number.swap_bytes());
    let found = || format!("{number:#x} for {what}");
    probe.check(GEN_1, !swapped, "the lowest byte first", found);
}

fn field_order(probe: &mut Probe<'_>) -> Step {
    let is_com = |group| matches!(IndexGroup::new(group).parts(), Some(Group::Com(_)));
    for object in probe.objects().if_known()?.unwrap_or_default() {
        let name = object.name.to_string();
        let Some((group, _)) = object.address.content() else { continue };
        in_order(probe, format_args!("the group of {name}"), group.get(), is_com);
        in_order(probe, format_args!("the size of {name}"), object.size(), |size| {
            size <= 0x00FF_FFFF
        });
    }
    for channel in probe.channels()? {
        for one in probe.variables(channel).if_known()?.unwrap_or_default() {
            let name = one.name.text.to_string();
            in_order(probe, format_args!("the type of {name}"), one.var_type.0, |code| {
                (1..=9).contains(&code)
            });
            in_order(probe, format_args!("the access of {name}"), one.access.0, |code| {
                (1..=2).contains(&code)
            });
            in_order(probe, format_args!("the size of {name}"), one.size, |size| {
                size <= 0x00FF_FFFF
            });
        }
        let number = u32::from(channel.number());
        let address = probe.address_of(Class::Decoder, number, 0).if_known()?.flatten();
        if let Some(address) = address {
            let of_class = |group| {
                matches!(IndexGroup::new(group).parts(), Some(Group::Class(_))) || group == 0
            };
            in_order(
                probe,
                format_args!("the group of the decoder of channel {number}"),
                address.index_group.get(),
                of_class,
            );
        }
    }
    Ok(())
}

/// Bytes that differ otherwise are judged by other cases.
fn order(probe: &mut Probe<'_>, what: &str, size: usize, held: &[u8], read: Option<Vec<u8>>) {
    let Some(read) = read.filter(|read| read.len() == held.len()) else { return };
    let mut pairs = held.chunks(size).zip(read.chunks(size));
    let permuted = pairs.any(|(one, other)| is_permutation(one, other));
    if held == read || permuted {
        let expected = || format!("{} of {what}", Hex(held.to_vec()));
        probe.check(GEN_1, !permuted, expected, || Hex(read));
    }
}

fn value_order(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let claimed = probe.channels()?;
    let of = |number: u8| claimed.iter().find(|channel| channel.number() == number).copied();
    for variable in cnc.current_variables() {
        let size = variable.var_type.element_size().and_then(|size| usize::try_from(size).ok());
        let (Some(channel), Some(size)) = (of(variable.channel), size) else { continue };
        let what = variable.name.to_string();
        let request = ReadByName { channel, name: variable.name.as_cnc_str().into() };
        if size > 1 && request.name.text().len() < ads_cnc::limits::TEXT_MAX {
            let read = probe.try_ask(request)?;
            order(probe, &what, size, &variable.value, read);
        }
    }
    let mut index = std::collections::HashMap::new();
    for parameter in cnc.current_parameters() {
        let Some(channel) = of(parameter.channel) else { continue };
        let (kind, name) = (parameter.kind, parameter.name.as_cnc_str().into());
        let index: &mut u32 = index.entry((parameter.channel, kind)).or_default();
        *index = index.saturating_add(1);
        let what = parameter.name.to_string();
        let held = parameter.value.to_le_bytes();
        let read = probe.try_ask(DynamicValueByName { channel, kind, name })?;
        order(probe, &what, held.len(), &held, read);
        let by_index = DynamicValueByIndex::new(channel, kind, *index)?;
        let read = probe.try_ask(by_index)?;
        order(probe, &what, held.len(), &held, read);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_order_is_told_from_other_bytes() {
        assert!(is_permutation(&[1, 2, 3, 4], &[3, 4, 1, 2]));
        assert!(!is_permutation(&[1, 2], &[1, 2]));
        assert!(!is_permutation(&[1, 2], &[1, 3]));
    }
}
