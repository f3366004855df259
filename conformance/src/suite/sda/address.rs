//! Addresses of instances.

use std::collections::HashSet;

use ads_cnc::Decode as _;
use ads_cnc::address::{
    Addressing, Attribute, AxisStride, Class, ClassGroup, ElementAddress, IndexOffset,
};
use ads_cnc::operation::{CountElements, FindInstance};
use ads_cnc::sda::ObjectAddress;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Rule, Step, assumed};
use crate::suite::kit::{OF_PLACES, Probe, RawCall, Steady, element_by_rank};

pub(super) fn object_address(probe: &mut Probe<'_>) -> Step {
    let mut seen = HashSet::new();
    for one in probe.instances()? {
        let ClassGroup { addressing, class, attribute, instance } = one.first.class_group();
        let group = one.first.group(Attribute::Content);
        let of_class = class == one.class && attribute == Attribute::Content;
        let expected = || format!("the content group of the {}", one.class);
        let found = || format!("{group} for {one}");
        probe.check(ADR_5, of_class, expected, found);
        let same = u32::from(instance) == one.channel;
        let rule = if one.class == Class::Spindle { ADR_2 } else { ADR_5 };
        probe.check(rule, same, || format!("the group of instance {}", one.channel), found);
        if one.class == Class::Spindle {
            let by_index = addressing == Addressing::Index;
            probe.check(ADR_2, by_index, "a group without the logical bit", found);
        } else {
            let logical = addressing == Addressing::Logical;
            probe.check(ADR_5, logical, "a group with the logical bit, as asked", found);
            if matches!(one.class, Class::Decoder | Class::Hld) {
                probe.check(SDA_3, logical, "a group as printed", found);
            }
        }
        offset(probe, one.class, (one.channel, one.axis), one.first);
        let own = seen.insert((group, one.first.index_offset()));
        let found = || format!("{}, which another instance has too", found());
        probe.check(SDA_1, own, "a place of its own", found);
    }
    // If several instances have the same address, the one after the last is not requested.
    for one in probe.instances()? {
        let beyond = probe.address_of(one.class, one.channel, one.axis.saturating_add(1))?;
        let Some(beyond) = beyond.filter(|address| *address != ObjectAddress::NONE) else {
            continue;
        };
        let own = beyond != ObjectAddress::from(one.first) || one.class == Class::Spindle;
        let found = || format!("{beyond:?} for the axis behind {one} too");
        probe.check(SDA_1, own, "a place of its own", found);
    }
    // In another order every instance has the same address.
    for one in probe.instances()?.iter().rev() {
        let again = probe.address_of(one.class, one.channel, one.axis)?;
        let first = ObjectAddress::from(one.first);
        let found = || format!("{again:?} of {one}");
        probe.check(SDA_1, again == Some(first), || format!("{first:?}, as before"), found);
    }
    let spindle = probe.address_of(Class::Spindle, 0, 0)?;
    if spindle.is_some_and(|address| address != ObjectAddress::NONE) {
        probe.pass(GEN_6);
    }
    Ok(())
}

/// The offset of an instance: printed for the decoder and for one axis of the HLD.
fn offset(probe: &mut Probe<'_>, class: Class, (channel, axis): (u32, u32), first: ElementAddress) {
    let offset = first.index_offset();
    let of = |stride| IndexOffset::for_axis(stride, axis, 0).ok();
    let (rule, expected) = match (class, axis) {
        (_, 0) => (Rule::from(SDA_1), vec![Some(IndexOffset::new(0))]),
        (Class::Hld, 1) if channel == 0 => (Rule::from(SDA_3), vec![of(AxisStride::X1000)]),
        (Class::Decoder, _) => (Rule::from(ADR_7), vec![of(AxisStride::X10000)]),
        _ => (assumed(ADR_7), vec![of(AxisStride::X10000), of(AxisStride::X1000)]),
    };
    let shown: Vec<String> = expected.iter().flatten().map(ToString::to_string).collect();
    let found = || format!("offset {offset} of the {}, axis {axis}", class);
    let swapped = Some(IndexOffset::new(offset.get().swap_bytes()));
    let is_swapped = axis > 0 && expected.contains(&swapped);
    probe.check(SDA_1, !is_swapped, "the lowest byte of the offset first", found);
    probe.check(rule, expected.contains(&Some(offset)), shown.join(" or "), found);
}

pub(super) fn address_by_index(probe: &mut Probe<'_>) -> Step {
    for (rank, channel) in (1_u8..).zip(probe.channels()?) {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            let number = channel.number().into();
            let Some(logical) = probe.address_of(class, number, 0)? else { continue };
            let Ok(Some(first)) = logical.first_element() else { continue };
            let by_index = element_by_rank(first, rank);
            // That channels can be given by rank in this function is not stated.
            let exchange = probe.send(FindInstance::new(class, rank.into(), 0).by_index())?;
            let found = exchange.success().and_then(|data| ObjectAddress::decode(data).ok());
            let same = found == Some(ObjectAddress::from(by_index)) || found == Some(logical);
            let expected =
                || format!("{} or the address by number", by_index.group(Attribute::Content));
            probe.check(assumed(SDA_1), same, expected, &exchange);
            let mut steady = Steady::default();
            let what = format!("the number of elements of the {} of channel {number}", class);
            let (one, other) = (CountElements::new(first)?, CountElements::new(by_index)?);
            steady.same(probe, [ADR_1, ADR_12], what, one, other)?;
            steady.finish()?;
        }
    }
    probe.finish("the target names no instance")
}

/// A request of another length, and a read length shorter than the reply.
pub(super) fn bad_queries(probe: &mut Probe<'_>) -> Step {
    let first = u32::from(probe.channel()?.number());
    for class in OF_PLACES.into_iter().chain([Class::Hld]) {
        if !probe.instances()?.iter().any(|one| one.class == class) {
            continue;
        }
        let good = RawCall::new(FindInstance::new(class, first, 0))?;
        for len in [9, 4, 0] {
            let what = format!("{len} bytes for channel and axis");
            let bad = good.with(|call| call.data.resize(len, 0));
            probe.refuses(assumed(SDA_1), &what, bad, &good)?;
        }
        let short = good.with(|call| call.read_length = 7);
        probe.refuses(assumed(SDA_1), "a read length of 7 for an address", short, &good)?;
    }
    Ok(())
}
