//! Cases of the addresses of instances.

use std::collections::HashSet;

use ads_cnc::Decode as _;
use ads_cnc::address::{Attribute, Class};
use ads_cnc::operation::{CountElements, FindInstance};
use ads_cnc::sda::ObjectAddress;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, assumed};
use crate::rules::{check_group, check_offset};
use crate::suite::kit::{OF_PLACES, Probe, RawCall, Steady, element_by_rank};
use crate::text::plural;

pub(super) fn object_address(probe: &mut Probe<'_>) -> Step {
    let mut seen = HashSet::new();
    for one in probe.instances()? {
        let group = one.first.group(Attribute::Content);
        check_group(probe, (one.class, Some(one.channel)), one.first.class_group());
        let offset = one.first.index_offset();
        check_offset(probe, (one.class, one.channel, one.axis), offset);
        let found = || format!("{group} and {offset} for {one} and for another instance");
        let own = seen.insert((group, offset));
        probe.check(SDA_1, own, "an address that no other instance has", found);
    }
    // The list of instances ends before an axis that has the address of another instance.
    // Therefore, the axis after each instance is requested here.
    for one in probe.instances()? {
        let beyond = probe.address_of(one.class, one.channel, one.axis.saturating_add(1))?;
        let Some(beyond) = beyond.filter(|address| *address != ObjectAddress::NONE) else {
            continue;
        };
        let own = beyond != ObjectAddress::from(one.first) || one.class == Class::Spindle;
        let found = || format!("{beyond:?} also for the axis after {one}");
        probe.check(SDA_1, own, "an address that no other instance has", found);
    }
    // If the addresses are requested in reverse order, every instance must have the same address as
    // before.
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

pub(super) fn address_by_index(probe: &mut Probe<'_>) -> Step {
    for (rank, channel) in (1_u8..).zip(probe.channels()?) {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            let number = channel.number().into();
            let Some(logical) = probe.address_of(class, number, 0)? else { continue };
            let Ok(Some(first)) = logical.first_element() else { continue };
            let by_index = element_by_rank(first, rank);
            // It is assumed that FindInstance accepts ranks of channels.
            let exchange = probe.send(FindInstance::new(class, rank.into(), 0).by_index())?;
            let found = exchange.success().and_then(|data| ObjectAddress::decode(data).ok());
            let same = found == Some(ObjectAddress::from(by_index)) || found == Some(logical);
            let expected =
                || format!("{} or the address by number", by_index.group(Attribute::Content));
            probe.check(assumed(SDA_1), same, expected, &exchange);
            let mut steady = Steady::default();
            let what = format!("the number of elements of the {} of channel {number}", class);
            let (one, other) = (CountElements::new(first)?, CountElements::new(by_index)?);
            steady.by_index(probe, ADR_1, what, one, other)?;
            steady.finish()?;
        }
    }
    probe.finish("the target names no instance")
}

/// Sends requests for an address with too many or too few bytes, and with a read length shorter
/// than the reply.
pub(super) fn bad_queries(probe: &mut Probe<'_>) -> Step {
    let first = u32::from(probe.channel()?.number());
    for class in OF_PLACES.into_iter().chain([Class::Hld]) {
        if !probe.instances()?.iter().any(|one| one.class == class) {
            continue;
        }
        let valid = RawCall::new(FindInstance::new(class, first, 0))?;
        for len in [9, 4, 0] {
            let what = format!("{} for channel and axis", plural(len, "byte"));
            let invalid = valid.with(|call| call.data.resize(len, 0));
            probe.rejects(assumed(SDA_1), &what, invalid, &valid)?;
        }
        let short = valid.with(|call| call.read_length = 7);
        probe.rejects(assumed(SDA_1), "a read length of 7 for an address", short, &valid)?;
    }
    Ok(())
}
