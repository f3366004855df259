//! Cases of the byte order of numbers.

use std::fmt::Display;

use ads_cnc::Handle;
use ads_cnc::address::{Class, Group, IndexGroup};
use ads_cnc::operation::HandleByName;
use ads_cnc_vectors::ids::*;

use super::kit::{Counted, Probe, name_of};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, Step};

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("gen-number-order", &[GEN_1], Needs::Queries, number_order,
        "Counts and handles are little-endian"),
    case("gen-field-order", &[GEN_1], Needs::Queries, field_order,
        "Numbers in descriptors, descriptions and addresses are little-endian"),
];

/// Checks the numbers of items of lists, and the handles that are requested by name. A wrong number
/// that is correct with reversed bytes violates GEN-1.
fn number_order(probe: &mut Probe<'_>) -> Step {
    for (one, number) in Counted::all(probe)? {
        let from_behind = number.swap_bytes();
        if number == from_behind {
            continue;
        }
        let swapped = !one.has(probe, number)? && one.has(probe, from_behind)?;
        let found = || format!("{number:#x}, but the list ends after item {from_behind:#x}");
        probe.check(GEN_1, !swapped, || format!("the number of items of {one}"), found);
    }
    for channel in probe.channels()? {
        for variable in probe.variables(channel).if_known()?.unwrap_or_default() {
            let name = name_of(&variable);
            let handle: Option<Handle> = probe.try_read(HandleByName { channel, name })?;
            let Some(handle) = handle else { continue };
            let known = variable.handle.0;
            let swapped = handle.0 != known && handle.0.swap_bytes() == known;
            let expected = || format!("handle {} of {}", variable.handle, variable.name.text);
            let found = || format!("{handle} of {}", variable.name.text);
            probe.check(GEN_1, !swapped, expected, found);
        }
    }
    Ok(())
}

/// Checks a number. A value that is plausible (according to `makes_sense`) only with reversed bytes
/// violates GEN-1.
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
                format_args!("the group of the decoder in channel {number}"),
                address.index_group.get(),
                of_class,
            );
        }
    }
    Ok(())
}
