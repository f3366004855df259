//! Cases of instances that must exist, and of instances that cannot exist.

use ads_cnc::Decode as _;
use ads_cnc::address::{Class, ElementAddress, IndexOffset};
use ads_cnc::operation::{CountElements, FindInstance, ReadElement, Request};
use ads_cnc::sda::ObjectAddress;
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use crate::judge::{Checks as _, OrStop as _, Rule, Step, applicable, assumed};
use crate::suite::kit::{INSTANCES_MAX, Instance, OF_PLACES, Probe, attribute_reads};

/// Requests an instance that must exist, and the number of its elements. Another task than SDA may
/// serve a class, so an error in reply to the first request is judged only for the decoder, which
/// SDA serves.
fn is_there(probe: &mut Probe<'_>, rules: &[Rule], class: Class, channel: u32, axis: u32) -> Step {
    let request = Request::from(FindInstance::new(class, channel, axis));
    let exchange = probe.send(request)?;
    let data = exchange.success();
    if data.is_none() && class != Class::Decoder {
        return Ok(());
    }
    let address = data.and_then(|data| ObjectAddress::decode(data).ok());
    let first = address.and_then(|address| address.first_element().ok()).flatten();
    let expected = || format!("the {} ({channel}, {axis}) in a group of its class", class);
    let found = || match address {
        Some(address) => format!("{}, {}", address.index_group, address.index_offset),
        None => exchange.result(),
    };
    let is_address = first.is_some() || address == Some(ObjectAddress::NONE);
    if data.is_some() && !probe.check(SDA_1, is_address, "an address, or (0, 0)", found) {
        return Ok(());
    }
    if class == Class::Decoder {
        let expected = || format!("an address of the {class} ({channel}, {axis})");
        probe.check(SDA_1, data.is_some(), expected, found);
    }
    probe.check(rules, first.is_some(), expected, found);
    if let Some(first) = first {
        let group = first.class_group();
        let same = (group.class, u32::from(group.instance)) == (class, channel);
        let expected =
            || format!("the {} ({channel}, {axis}) in a group that no other class has", class);
        probe.check(SDA_1, same, expected, found);
        // The number of elements must be readable at the address of the instance.
        let count = CountElements::new(first)?;
        let exchange = probe.send(count)?;
        let read = exchange.success().is_some();
        let expected = || format!("elements of the {} ({channel}, {axis})", class);
        let of_range: Vec<Rule> =
            rules.iter().filter(|rule| rule.id == SDA_5.as_str()).copied().collect();
        probe.check(&of_range[..], read, expected, &exchange);
    }
    Ok(())
}

/// The rule for axes of a class. For path preparation it is assumed, because only one of two
/// sections of the manual mentions axes of this class (E-40).
fn of_axes(class: Class, id: ClauseId) -> Rule {
    if class == Class::PathPreparation { assumed(id) } else { id.into() }
}

/// Requests an instance that cannot exist. The reply must be (0, 0); it is only assumed that an
/// error is wrong, too. If the reply is the address of an element, `rules` are also violated.
fn is_nowhere(
    probe: &mut Probe<'_>,
    rules: &[ClauseId],
    class: Class,
    channel: u32,
    axis: u32,
) -> Step {
    let request = Request::from(FindInstance::new(class, channel, axis));
    let exchange = probe.send(request)?;
    probe.expect_rejection();
    let data = exchange.success();
    let Some(data) = data else {
        // It is assumed that an error instead of the address (0, 0) is wrong.
        let found = exchange.result();
        probe.check(assumed(SDA_2), false, "the reply (0, 0)", found);
        return Ok(());
    };
    let address = ObjectAddress::decode(data);
    let none = address == Ok(ObjectAddress::NONE);
    let expected = || format!("(0, 0) for the {} ({channel}, {axis})", class);
    let found = || Hex(data.to_vec());
    probe.check(SDA_2, none, expected, found);
    // This check fails if the reply contains the address of an element.
    let is_found = address.is_ok_and(|address| matches!(address.first_element(), Ok(Some(_))));
    probe.check(rules, !is_found, expected, found);
    Ok(())
}

pub(super) fn configured(probe: &mut Probe<'_>) -> Step {
    let rules = [SDA_5, ADR_5].map(Rule::from);
    let numbers: Vec<u32> =
        probe.channels()?.into_iter().map(|channel| channel.number().into()).collect();
    for &channel in &numbers {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            is_there(probe, &rules, class, channel, 0)?;
            let axis = probe.address_of(class, channel, 1)?;
            let is_address = axis.is_none_or(|axis| axis.first_element().is_ok());
            let found = || format!("{axis:?}");
            probe.check(SDA_1, is_address, "an address of the first axis, or (0, 0)", found);
        }
    }
    // An axis index must have an instance even if it has no axis.
    let empty_places = probe.target.profile.empty_places.clone();
    for class in OF_PLACES.into_iter().filter(|_| !empty_places.is_empty()) {
        // If no instance of the first channel is found, the group of the class may be wrong.
        let first = numbers.first().or_inconclusive("no channel")?;
        let first = probe.address_of(class, *first, 0)?;
        let has_group = first.is_some_and(|first| matches!(first.first_element(), Ok(Some(_))));
        let clauses = if has_group { &[SDA_5][..] } else { &[SDA_5, ADR_5] };
        let rules: Vec<Rule> = clauses.iter().map(|id| of_axes(class, *id)).collect();
        for &(channel, place) in empty_places.iter() {
            is_there(probe, &rules, class, channel, place)?;
        }
    }
    let axes = probe.target.profile.platform_axes;
    for axis in 1..=axes {
        is_there(probe, &rules, Class::PositionController, 0, axis)?;
        is_there(probe, &rules, Class::Hld, 0, axis)?;
        for (rank, &channel) in numbers.iter().enumerate() {
            // The manual gives the platform's axes to the HLD of the first channel only.
            let rules = if rank == 0 { rules } else { [SDA_5, ADR_5].map(assumed) };
            is_there(probe, &rules, Class::Hld, channel, axis)?;
        }
    }
    let beyond = axes.saturating_add(1);
    if axes > 0 {
        is_nowhere(probe, &[SDA_5], Class::PositionController, 0, beyond)?;
        is_nowhere(probe, &[SDA_5], Class::Hld, 0, beyond)?;
        for &channel in &numbers {
            is_nowhere(probe, &[SDA_5], Class::Hld, channel, beyond)?;
        }
    }
    if let Some(spindles) = probe.target.profile.spindles {
        for index in 0..spindles {
            is_there(probe, &rules, Class::Spindle, index, 0)?;
        }
        is_nowhere(probe, &[SDA_5], Class::Spindle, spindles, 0)?;
    }
    if let Some(absent) = probe.target.profile.absent_channel {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            is_nowhere(probe, &[SDA_5], class, absent, 0)?;
            is_nowhere(probe, &[SDA_5], class, absent, 1)?;
        }
    }
    Ok(())
}

/// The highest axis index of a channel in a class; `None` if the class has no instance of the
/// channel.
fn last_axis(all: &[Instance], class: Class, channel: u32) -> Option<u32> {
    let class_last = all.iter().filter(|one| (one.class, one.channel) == (class, channel));
    class_last.map(|one| one.axis).max()
}

/// Checks that the interpolator, the decoder and the path preparation have the same number of axes
/// of a channel, and likewise the position controller and the HLD for the platform. A class without
/// an instance of the channel, or of the platform, is left out.
pub(super) fn axes_agree(probe: &mut Probe<'_>) -> Step {
    let all = probe.instances()?;
    let mut any = false;
    // A channel must have the same number of axes in all classes of `OF_PLACES` that have it.
    for channel in probe.channels()?.into_iter().map(|channel| u32::from(channel.number())) {
        let lasts = OF_PLACES.map(|class| (class, last_axis(&all, class, channel)));
        let last = lasts.iter().filter_map(|(_, last)| *last).max().unwrap_or_default();
        for (class, class_last) in lasts {
            let Some(class_last) = class_last.filter(|_| last > 0) else { continue };
            any = true;
            let axis = if class_last < last { class_last.saturating_add(1) } else { last };
            is_there(probe, &[of_axes(class, SDA_5)], class, channel, axis)?;
        }
    }
    // The platform must have the same number of axes in the position controller and in the HLD.
    let lasts =
        [Class::PositionController, Class::Hld].map(|class| (class, last_axis(&all, class, 0)));
    let last = lasts.iter().filter_map(|(_, last)| *last).max().unwrap_or_default();
    for (class, class_last) in lasts {
        let Some(class_last) = class_last.filter(|_| last > 0) else { continue };
        any = true;
        let axis = if class_last < last { class_last.saturating_add(1) } else { last };
        is_there(probe, &[Rule::from(SDA_5)], class, 0, axis)?;
    }
    applicable(any, "no class has an axis")
}

/// Checks that the class has no axis `last + 1`, and no axis `last | 0x10000`, whose number has the
/// lower 16 bits of `last`.
fn axes_end(probe: &mut Probe<'_>, class: Class, channel: u32, last: u32) -> Step {
    is_nowhere(probe, &[SDA_5], class, channel, last.saturating_add(1))?;
    is_nowhere(probe, &[SDA_5], class, channel, last | 0x1_0000)
}

/// Checks that no instance exists after the last one that was found: no axis of a channel
/// (interpolator, decoder, path preparation), no axis of the platform (position controller, HLD),
/// and no spindle. Also checks that the three classes with axes of a channel have no instance with
/// the axis 0 or 1 in channel 0. In the claimed channels, the position controller must have none
/// with the axis 1. The numbers of axes and spindles in the profile are not used.
pub(super) fn no_such_instance(probe: &mut Probe<'_>) -> Step {
    let all = probe.instances()?;
    let has = |class| all.iter().any(|one| one.class == class);
    let channels: Vec<u32> =
        probe.channels()?.into_iter().map(|channel| channel.number().into()).collect();
    // A class without any instance is left out, because another task may serve it.
    for class in OF_PLACES.into_iter().filter(|class| has(*class)) {
        for &channel in &channels {
            let last = last_axis(&all, class, channel).unwrap_or(INSTANCES_MAX);
            if last < INSTANCES_MAX {
                axes_end(probe, class, channel, last)?;
            }
        }
        // Channels start at 1; 0 is the platform, which these classes do not have.
        is_nowhere(probe, &[SDA_5, GEN_6], class, 0, 0)?;
        is_nowhere(probe, &[SDA_5, GEN_6], class, 0, 1)?;
    }
    if has(Class::PositionController) {
        for &channel in &channels {
            is_nowhere(probe, &[SDA_5], Class::PositionController, channel, 1)?;
        }
    }
    for class in [Class::PositionController, Class::Hld] {
        let last = last_axis(&all, class, 0).filter(|last| (1..INSTANCES_MAX).contains(last));
        if let Some(last) = last {
            axes_end(probe, class, 0, last)?;
        }
    }
    let spindles = all.iter().filter(|one| one.class == Class::Spindle);
    let last = spindles.map(|one| one.channel).max().filter(|last| *last < INSTANCES_MAX);
    if let Some(last) = last {
        is_nowhere(probe, &[SDA_5], Class::Spindle, last.saturating_add(1), 0)?;
    }
    Ok(())
}

/// Requests instances whose channel, spindle or axis number does not fit into an address, but has
/// the lower bits of an existing one. A group has 8 bits for the channel; an offset has 16 bits for
/// the axis.
pub(super) fn far(probe: &mut Probe<'_>) -> Step {
    for one in probe.instances()? {
        let channels: &[u32] = match one.axis {
            0 | 1 => &[0x100, 0x1_0000, 0x100_0000, 0x8000_0000],
            _ => &[],
        };
        for &bit in channels {
            let channel = one.channel.wrapping_add(bit);
            is_nowhere(probe, &[SDA_5], one.class, channel, one.axis)?;
        }
        // A read at an axis that does not exist must fail, too. This is checked for the decoder
        // only, because only for this class do the manuals print the stride 0x10000 between axes
        // (ADR-7).
        if one.class == Class::Decoder && one.axis < 0x100 {
            let group = one.first.class_group();
            for bit in [0x100_0000, 0x8000_0000_u32] {
                let far = |element: ElementAddress| {
                    let offset = IndexOffset::new(element.index_offset().get() | bit);
                    ElementAddress::new(group, offset)
                };
                let what = format!("an axis {:#x} after {one}", bit >> 16);
                let (there, first) = (CountElements::new(one.first)?, far(one.first));
                probe.rejects(ADR_7, &what, CountElements::new(first)?, there)?;
                let Some(element) = one.elements().next() else { continue };
                for (there, far) in
                    attribute_reads(element).into_iter().zip(attribute_reads(far(element)))
                {
                    probe.rejects(ADR_7, &what, far, there)?;
                }
                let Some(length) = probe.length_of(element)? else { continue };
                if let (Ok(there), Ok(far)) =
                    (ReadElement::new(element, length), ReadElement::new(far(element), length))
                {
                    probe.rejects(ADR_7, &what, far, there)?;
                }
            }
        }
        // The axis is not used in requests for a spindle.
        if one.class != Class::Spindle {
            for bit in [0x1_0000, 0x100_0000, 0x8000_0000] {
                let axis = one.axis.wrapping_add(bit);
                is_nowhere(probe, &[SDA_5], one.class, one.channel, axis)?;
            }
        }
    }
    Ok(())
}
