//! A case of the platform axes in the HLD of the first channel.

use ads_cnc::address::Class;
use ads_cnc::operation::{ReadElement, ReadElementName};
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, Stop};
use crate::suite::kit::{Instance, Probe, Steady};
use crate::text::plural;

pub(super) fn platform_axes_of_hld(probe: &mut Probe<'_>) -> Step {
    let first = u32::from(probe.channel()?.number());
    let all = probe.instances()?;
    let of = |channel: u32| {
        let axes = all
            .iter()
            .filter(move |one| (one.class, one.channel) == (Class::Hld, channel) && one.axis > 0);
        axes.cloned().collect::<Vec<_>>()
    };
    let (platform, own) = (of(0), of(first));
    if platform.is_empty() {
        return Err(Stop::not_applicable("the HLD names no axis of the platform"));
    }
    let mut steady = Steady::default();
    for axis in &platform {
        let own_axis = own.iter().find(|one| one.axis == axis.axis);
        let expected = || format!("axis {} in channel {first}, as in channel 0", axis.axis);
        probe.check(SDA_13, own_axis.is_some(), expected, "no such instance");
        let Some(own_axis) = own_axis else { continue };
        if own_axis.count != axis.count {
            // If both instances have the element after the smaller number, or neither has it, only
            // a reported number is wrong, which SDA-4 judges.
            let next = own_axis.count.min(axis.count).saturating_add(1);
            let mut has_next = |one: &Instance| -> Step<bool> {
                let Ok(element) = one.first.nth(next) else { return Ok(false) };
                Ok(probe.try_ask(ReadElementName::new(element))?.is_some())
            };
            let same = has_next(own_axis)? == has_next(axis)?;
            let counts =
                || format!("{}, but {axis} has {}", plural(own_axis.count, "element"), axis.count);
            probe.check(SDA_13, same, "the same number of elements", counts);
        }
        for (one, other) in axis.elements().zip(own_axis.elements()) {
            let Some(length) = probe.length_of(one)? else { continue };
            let read = |address| ReadElement::new(address, length);
            let (Ok(read_one), Ok(read_other)) = (read(one), read(other)) else { continue };
            let what = format!("element {} of {axis}", one.index_offset());
            steady.same(probe, SDA_13, what, read_one, read_other)?;
        }
    }
    steady.finish()
}
