//! Cases of SDA and GEO: which instances there are, and where.

use std::collections::HashSet;

use ads_cnc::Decode as _;
use ads_cnc::address::{
    Addressing, Attribute, AxisStride, Class, ClassGroup, ElementAddress, Group, IndexOffset,
};
use ads_cnc::operation::{FindInstance, ReadElement, ReadElementLength, Request};
use ads_cnc::sda::{ElementLength, ObjectAddress};
use ads_cnc_vectors::Hex;

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::inventory::{INSTANCES_MAX, OF_PLACES, class_name};
use super::probe::{Probe, harness};
use super::still::Still;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "sda-object-address",
            "The address of an instance is in its class's group, and no other's",
            ["SDA-1", "ADR-2", "ADR-5", "ADR-7", "GEN-6"],
            Queries,
            object_address
        ),
        declare!(
            "sda-configured-instances",
            "Every class has the instances that the configuration makes",
            ["SDA-2", "SDA-5", "ADR-5"],
            Queries,
            configured
        ),
        declare!(
            "sda-no-such-instance",
            "An instance that is not there is at (0, 0)",
            ["SDA-1", "SDA-2"],
            Queries,
            no_such_instance
        ),
        declare!(
            "sda-address-by-index",
            "By rank the address is that of the same channel, without the logical bit",
            ["SDA-1", "ADR-1", "ADR-12"],
            Queries,
            address_by_index
        ),
        declare!(
            "sda-platform-axes-of-hld",
            "The HLD of the first channel has the axes of the whole platform",
            ["SDA-5", "SDA-13"],
            Queries,
            platform_axes_of_hld
        ),
        declare!(
            "sda-empty-place",
            "A place without an axis reads as blank",
            ["SDA-11"],
            Queries,
            empty_place
        ),
    ]
}

/// That of another class may be what another task serves.
fn rule_of(class: Class, id: &'static str) -> Rule {
    if class == Class::Decoder { id.into() } else { assumed(id) }
}

fn object_address(probe: &mut Probe<'_>) -> Step {
    let mut seen = HashSet::new();
    for one in probe.instances()? {
        let ClassGroup { addressing, class, attribute, instance } = one.first.class_group();
        let group = one.first.group(Attribute::Content);
        let of_class = class == one.class && attribute == Attribute::Content;
        let expected = format!("the content group of the {}", class_name(one.class));
        let found = format!("{group} for {one}");
        probe.check("ADR-5", of_class, expected, &found);
        let same = u32::from(instance) == one.channel;
        let rule = if one.class == Class::Spindle { "ADR-2" } else { "ADR-5" };
        probe.check(rule, same, format!("the group of instance {}", one.channel), &found);
        if one.class == Class::Spindle {
            let by_index = addressing == Addressing::Index;
            probe.check("ADR-2", by_index, "a group without the logical bit", &found);
        } else {
            let logical = addressing == Addressing::Logical;
            probe.check("ADR-5", logical, "a group with the logical bit, as asked", &found);
        }
        offset(probe, one.class, one.axis, one.first);
        let own = seen.insert((group, one.first.index_offset()));
        let found = format!("{found}, which another instance has too");
        probe.check("SDA-1", own, "a place of its own", found);
    }
    let spindle = probe.address_of(Class::Spindle, 0, 0)?;
    if spindle.is_some_and(|address| address != ObjectAddress::NONE) {
        probe.check("GEN-6", true, "", "");
    }
    Ok(())
}

/// The offset of an instance: printed for the decoder and, otherwise, for one axis of the HLD.
fn offset(probe: &mut Probe<'_>, class: Class, axis: u32, first: ElementAddress) {
    let offset = first.index_offset();
    let of = |stride| IndexOffset::of_axis(stride, axis, 0).ok();
    let (rule, expected) = match (class, axis) {
        (_, 0) => (Rule::from("SDA-1"), vec![Some(IndexOffset::new(0))]),
        (Class::Decoder, _) => (Rule::from("ADR-7"), vec![of(AxisStride::X10000)]),
        _ => (assumed("ADR-7"), vec![of(AxisStride::X10000), of(AxisStride::X1000)]),
    };
    let shown: Vec<String> = expected.iter().flatten().map(ToString::to_string).collect();
    let found = format!("offset {offset} of the {}, axis {axis}", class_name(class));
    probe.check(rule, expected.contains(&Some(offset)), shown.join(" or "), found);
}

/// Asks for what has to be there. Another task may serve a class: who refuses to say is not judged
/// but for the decoder, which SDA has.
fn is_there(probe: &mut Probe<'_>, class: Class, channel: u32, axis: u32) -> Step {
    let request = Request::from(FindInstance::new(class, channel, axis));
    let exchange = probe.send(request)?;
    let data = exchange.answer().and_then(|answer| answer.success());
    if data.is_none() && class != Class::Decoder {
        return Ok(());
    }
    let address = data.and_then(|data| ObjectAddress::decode(data).ok());
    let first = address.and_then(|address| address.first_element().ok()).flatten();
    let expected = format!("the {} ({channel}, {axis}) in a group of its class", class_name(class));
    let found = match address {
        Some(address) => format!("{}, {}", address.index_group, address.index_offset),
        None => exchange.result(),
    };
    for rule in ["SDA-5", "ADR-5"] {
        probe.check(rule, first.is_some(), &expected, &found);
    }
    Ok(())
}

/// Asks for what cannot be there.
fn is_nowhere(probe: &mut Probe<'_>, class: Class, channel: u32, axis: u32) -> Step {
    let request = Request::from(FindInstance::new(class, channel, axis));
    let exchange = probe.send(request)?;
    let data = exchange.answer().and_then(|answer| answer.success());
    let Some(data) = data else {
        // By an error instead: that the result is 0 is assumed.
        let found = exchange.result();
        probe.check(assumed("SDA-2"), false, "the answer (0, 0)", found);
        return Ok(());
    };
    let none = ObjectAddress::decode(data) == Ok(ObjectAddress::NONE);
    let what = format!("(0, 0) for the {} ({channel}, {axis})", class_name(class));
    probe.check("SDA-2", none, what, Hex(data.to_vec()));
    Ok(())
}

fn configured(probe: &mut Probe<'_>) -> Step {
    let numbers: Vec<u32> =
        probe.channels()?.into_iter().map(|channel| channel.number().into()).collect();
    for &channel in &numbers {
        for class in OF_PLACES {
            is_there(probe, class, channel, 0)?;
        }
        is_there(probe, Class::Hld, channel, 0)?;
    }
    let axes = probe.session.profile.platform_axes;
    for axis in 1..=axes {
        is_there(probe, Class::PositionController, 0, axis)?;
        is_there(probe, Class::Hld, 0, axis)?;
        for &channel in &numbers {
            is_there(probe, Class::Hld, channel, axis)?;
        }
    }
    if axes > 0 {
        is_nowhere(probe, Class::PositionController, 0, axes.saturating_add(1))?;
        is_nowhere(probe, Class::Hld, 0, axes.saturating_add(1))?;
    }
    if let Some(spindles) = probe.session.profile.spindles {
        for index in 0..spindles {
            is_there(probe, Class::Spindle, index, 0)?;
        }
        is_nowhere(probe, Class::Spindle, spindles, 0)?;
    }
    if let Some(absent) = probe.session.profile.absent_channel {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            is_nowhere(probe, class, absent, 0)?;
        }
    }
    Ok(())
}

/// Every class has an end, whatever is configured.
fn no_such_instance(probe: &mut Probe<'_>) -> Step {
    let first = u32::from(probe.channel()?.number());
    let all = probe.instances()?;
    let ends = |class: Class, channel: u32| {
        let there = all.iter().filter(|one| one.class == class && one.channel == channel);
        there.map(|one| one.axis).max()
    };
    for (class, channel) in OF_PLACES.into_iter().map(|class| (class, first)) {
        // What has nothing at all may be with another task.
        let Some(last) = ends(class, channel) else { continue };
        let beyond = last.saturating_add(1);
        let data =
            probe.ask_for(&[rule_of(class, "SDA-1")], FindInstance::new(class, channel, beyond))?;
        let address = ObjectAddress::decode(&data);
        let found = Hex(data);
        probe.check("SDA-1", address.is_ok(), "an address of 8 bytes", &found);
        let none = address == Ok(ObjectAddress::NONE) || last == INSTANCES_MAX;
        let what = format!("(0, 0) for axis {beyond} of the {}", class_name(class));
        probe.check("SDA-2", none, what, &found);
    }
    if ends(Class::Interpolator, first).is_some() {
        // Channels start at 1: 0 is the platform, which these classes have not.
        for class in OF_PLACES {
            is_nowhere(probe, class, 0, 0)?;
        }
    }
    Ok(())
}

fn address_by_index(probe: &mut Probe<'_>) -> Step {
    let mut any = false;
    for (rank, channel) in (1_u32..).zip(probe.channels()?) {
        for class in OF_PLACES.into_iter().chain([Class::Hld]) {
            let number = channel.number().into();
            let Some(logical) = probe.address_of(class, number, 0)? else { continue };
            let Ok(Some(first)) = logical.first_element() else { continue };
            any = true;
            let group = ClassGroup {
                addressing: Addressing::Index,
                instance: u8::try_from(rank).map_err(harness)?,
                ..first.class_group()
            };
            let by_index = ElementAddress::new(group, first.index_offset());
            let request = Request::from(FindInstance::new(class, rank, 0).by_index());
            // That objects are asked for by rank too is not said of this function.
            let exchange = probe.send(request)?;
            let data = exchange.answer().and_then(|answer| answer.success());
            let found = data.and_then(|data| ObjectAddress::decode(data).ok());
            let same = found == Some(ObjectAddress::from(by_index)) || found == Some(logical);
            let expected =
                format!("{} or the address by number", by_index.group(Attribute::Content));
            probe.check(assumed("SDA-1"), same, expected, exchange.result());
            let mut still = Still::default();
            let rules = ["ADR-1", "ADR-12"].map(Rule::from);
            let what =
                format!("the number of elements of the {} of channel {number}", class_name(class));
            let count = |address| ads_cnc::operation::CountElements::new(address).map_err(harness);
            still.same(probe, &rules, &what, count(first)?, count(by_index)?.into())?;
            still.finish()?;
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("the target names no instance".to_owned())),
    }
}

/// The length of an element, as it says itself.
pub(super) fn length_of(probe: &mut Probe<'_>, element: ElementAddress) -> Step<Option<u32>> {
    let data = probe.try_ask(ReadElementLength::new(element))?;
    Ok(data.and_then(|data| ElementLength::decode(&data).ok()).map(ElementLength::get))
}

fn platform_axes_of_hld(probe: &mut Probe<'_>) -> Step {
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
        return Err(Stop::NotApplicable("the HLD names no axis of the platform".to_owned()));
    }
    let mut still = Still::default();
    for axis in &platform {
        let mine = own.iter().find(|one| one.axis == axis.axis);
        let expected = format!("axis {} under channel {first} as under channel 0", axis.axis);
        for rule in ["SDA-5", "SDA-13"] {
            probe.check(rule, mine.is_some(), &expected, "no such instance");
        }
        let Some(mine) = mine else { continue };
        let counts = format!("{} elements, of {axis} {}", mine.count, axis.count);
        probe.check("SDA-13", mine.count == axis.count, "the same elements", counts);
        for (one, other) in axis.elements().zip(mine.elements()) {
            let Some(length) = length_of(probe, one)? else { continue };
            let read = |address| ReadElement::new(address, length);
            let (Ok(read_one), Ok(read_other)) = (read(one), read(other)) else { continue };
            let what = format!("element {} of {axis}", one.index_offset());
            still.same(probe, &["SDA-13".into()], &what, read_one, read_other.into())?;
        }
    }
    still.finish()
}

fn empty_place(probe: &mut Probe<'_>) -> Step {
    let places = probe.session.profile.empty_places.clone();
    if places.is_empty() {
        let why = "no place is known to be empty; a profile can name one".to_owned();
        return Err(Stop::NotApplicable(why));
    }
    let all = probe.instances()?;
    for &(channel, place) in places.iter() {
        let there = all.iter().filter(|one| {
            OF_PLACES.contains(&one.class) && (one.channel, one.axis) == (channel, place)
        });
        for element in there.flat_map(|one| one.elements()) {
            let Some(length) = length_of(probe, element)? else { continue };
            let Ok(read) = ReadElement::new(element, length) else { continue };
            let content = probe.ask("SDA-11", read)?;
            let blank = content.iter().all(|&byte| byte == 0);
            let expected = format!("zeros at place {place} of channel {channel}");
            probe.check(assumed("SDA-11"), blank, expected, Hex(content));
        }
        blank_objects(probe, channel, place)?;
    }
    Ok(())
}

/// The objects of a channel's axes have a stride that only their descriptors tell.
fn blank_objects(probe: &mut Probe<'_>, channel: u32, place: u32) -> Step {
    let list = ads_cnc::operation::ObjectList::from(probe.channel_of(channel)?);
    let at = |offset: IndexOffset| {
        let strides = [AxisStride::X1000, AxisStride::X10000];
        let mut split = strides.iter().filter_map(|&stride| offset.axis_and_element(stride).ok());
        split.any(|(axis, element)| axis == place && element > 0)
    };
    for object in probe.objects()?.into_iter().filter(|one| one.list == list && at(one.offset)) {
        let is_com = matches!(object.group.parts(), Some(Group::Com(_)));
        let read = ads_cnc::operation::ReadObject::new(object.group, object.offset, object.size);
        let (true, Ok(read)) = (is_com, read) else { continue };
        let content = probe.ask("SDA-11", read)?;
        let blank = content.iter().all(|&byte| byte == 0);
        let expected = format!("zeros of {} at place {place} of channel {channel}", object.name);
        probe.check(assumed("SDA-11"), blank, expected, Hex(content));
    }
    Ok(())
}
