//! Cases of the platform and its axes in the COM task.

use std::collections::HashSet;
use std::iter;

use ads_cnc::address::{
    Access, Channel, ComGroup, ComTable, Group, IndexGroup, IndexOffset, PlatformAxis,
};
use ads_cnc::operation::{CountObjects, ObjectList, ReadDescriptors, ReadObject};
use ads_cnc::{Decode as _, Descriptors, ObjectCount};
use ads_cnc_vectors::ids::*;

use super::kit::{
    OBJECTS_MAX, Probe, Steady, descriptors_one_by_one, known_object_count, object_count,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, Stop, applicable, assumed};
use crate::objects::{ListedValue, ValueList};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("com-platform-objects", &[COM_1, COM_4, ADR_3], Needs::Queries, platform_objects,
        "The platform's objects are in the platform's list and in the first channel's list"),
    case("com-platform-content", &[COM_4, ADR_3], Needs::Queries, platform_content,
        "The platform's objects have the same content in the platform's list and in the channel's"),
    case("com-platform-axes", &[COM_7, ADR_3], Needs::Queries, platform_axes,
        "Platform axes have their own object lists"),
    case("com-printed-content-address", &[COM_6], Needs::PrintedExamples, printed_content_address,
        "The contents are at the addresses printed in the manuals"),
];

/// Channel 1, which the manuals name for the objects of the platform; `None` if the first channel
/// has another number.
fn platform_channel(probe: &Probe<'_>) -> Step<Option<Channel>> {
    Ok(Some(probe.channel()?).filter(|channel| channel.number() == 1))
}

fn platform_objects(probe: &mut Probe<'_>) -> Step {
    let platform = object_count(probe, ObjectList::PLATFORM).map_err(|stop| match stop {
        Stop::NotApplicable(_) => Stop::not_applicable("the platform has no object"),
        other => other,
    });
    let platform = match platform {
        // The number of objects could not be read, so the list of the platform (channel 0) is taken
        // to be missing.
        Err(Stop::Judged) => {
            probe.check(COM_4, false, "the platform's list in channel 0", "no list");
            return Err(Stop::Judged);
        }
        other => other?,
    };
    let own = descriptors_one_by_one(probe, COM_4, ObjectList::PLATFORM, platform)?;
    let Some(first) = platform_channel(probe)? else {
        return Err(Stop::not_applicable("the first channel is not channel 1"));
    };
    let all = known_object_count(probe, first.into())?;
    let listed = descriptors_one_by_one(probe, COM_4, first.into(), all)?;
    let names: HashSet<String> =
        listed.as_ref().iter().map(|object| object.name().to_string()).collect();
    for object in own.as_ref().iter() {
        let name = object.name().to_string();
        let expected = "each of the platform's objects in the list of channel 1";
        let found = || format!("{name} is missing there");
        probe.check(COM_4, names.contains(&name), expected, found);
        let com = matches!(object.index_group().parts(), Some(Group::Com(_)));
        probe.check(assumed(ADR_3), com, "a group of COM", || object.index_group());
    }
    Ok(())
}

fn platform_axes(probe: &mut Probe<'_>) -> Step {
    let axes = probe.target.profile.platform_axes;
    if axes == 0 {
        return Err(Stop::not_applicable("no platform axis is claimed"));
    }
    let mut seen: HashSet<u32> = HashSet::new();
    for place in 1..=axes {
        let axis = PlatformAxis::new(place)?;
        let data = probe.ask(assumed(COM_7), CountObjects::new(axis))?;
        let number = ObjectCount::decode(&data).map_or(0, |count| count.0.min(OBJECTS_MAX));
        let expected = "the axis's objects";
        probe.check(assumed(COM_7), number > 0, expected, || plural(number, "object"));
        if number == 0 {
            continue;
        }
        let objects: Descriptors =
            probe.read(assumed(COM_7), ReadDescriptors::new(axis, 1, number)?)?;
        let ids: Vec<u32> = objects.as_ref().iter().map(|object| object.id()).collect();
        let own = ids.iter().all(|&id| seen.insert(id));
        let found = || format!("IDs {ids:?}, some of them of another axis");
        probe.check(assumed(COM_7), own, || format!("objects of axis {place} only"), found);
        for object in objects.as_ref().iter() {
            let group = object.index_group();
            let of_axes =
                matches!(group.parts(), Some(Group::Com(ComGroup { table: ComTable::Axis, .. })));
            let expected = "content in a group of platform axes";
            probe.check(assumed(ADR_3), of_axes, expected, || group);
        }
    }
    Ok(())
}

/// Checks that an object in the list of channel 0 (the platform) has the same content at its offset
/// in the groups of channels 0 and 1. An object with the same name and size in the list of channel
/// 1 must have this content, too. Without channel 1, only channel 0 is checked.
fn platform_content(probe: &mut Probe<'_>) -> Step {
    let all = probe.objects()?;
    let first = platform_channel(probe)?.map(ObjectList::from);
    let of = |list| all.iter().filter(move |one| one.list == ValueList::from(list));
    let mut steady = Steady::default();
    let mut any = false;
    for object in of(ObjectList::PLATFORM) {
        let (Ok(one), Some((_, offset))) = (object.address.read(), object.address.content()) else {
            continue;
        };
        any = true;
        let what = object.name.to_string();
        let same = |one: &&ListedValue| one.name == object.name && one.size() == object.size();
        let other = first.and_then(|first| of(first).find(same));
        if let Some(other) = other.and_then(|other| other.address.read().ok()) {
            steady.same(probe, COM_4, &what, one, other)?;
        }
        // The content must also be readable at the object's offset in the groups of channels 0 and
        // 1, even if the descriptor contains another group.
        for list in iter::once(ObjectList::PLATFORM).chain(first) {
            let group = ComGroup { access: Access::Element, ..list.parts() }.index_group();
            let there = ReadObject::new(group, offset, object.size())?;
            let answered = probe.try_ask(there)?.is_some();
            let expected = || format!("{what} in group {group}");
            probe.check([COM_4, ADR_3], answered, expected, "an error");
            steady.same(probe, COM_4, &what, one, there)?;
        }
    }
    applicable(any, "the platform has no object")?;
    steady.finish()
}

/// The objects whose addresses the manuals print: owner, index group and index offset (COM-6).
pub(super) const PRINTED: [(&str, u32, u32); 4] = [
    ("platform", 0x12_0100, 0x251),
    ("axis", 0x12_0200, 0x1_0001),
    ("channel", 0x12_0101, 0x1),
    ("channel axis", 0x12_0101, 0x1_0001),
];

fn printed_content_address(probe: &mut Probe<'_>) -> Step {
    for (what, group, offset) in PRINTED {
        let (group, offset) = (IndexGroup::new(group), IndexOffset::new(offset));
        let objects = probe.objects()?;
        let named = objects.iter().find(|one| one.address.content() == Some((group, offset)));
        // If no descriptor has the printed address, the content must still be at this address. Its
        // size is unknown then, so 8 bytes are read.
        let read = |size| ReadObject::new(group, offset, size);
        let described = named.and_then(|object| read(object.size()).ok());
        let read = described.map_or_else(|| read(8), Ok)?;
        let exchange = probe.send(read)?;
        let answered = exchange.success();
        let answered = answered.is_some_and(|content| !content.is_empty());
        let expected = || format!("content of the {what} at ({group}, {offset})");
        probe.check(COM_6, answered, expected, &exchange);
    }
    let list = ObjectList::from(Channel::new(1)?);
    let number = known_object_count(probe, list)?;
    let listed = descriptors_one_by_one(probe, COM_6, list, number)?;
    let printed = "mc_command_single_block_w";
    let object = listed.as_ref().iter().find(|object| object.name() == printed);
    let address = object.map(|object| (object.index_group(), object.index_offset()));
    let found = || match address {
        Some((group, offset)) => format!("the object at ({group}, {offset})"),
        None => "no such object".to_owned(),
    };
    let is_printed =
        address.is_some_and(|(group, offset)| (group.get(), offset.get()) == (0x12_0101, 1));
    probe.check(COM_6, is_printed, || format!("{printed} at (0x120101, 0x1)"), found);
    Ok(())
}
