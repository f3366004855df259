//! Cases of the COM task.

use std::collections::HashSet;

use ads_cnc::address::{Access, Channel, ComGroup, ComTable, Group, PlatformAxis};
use ads_cnc::operation::{CountObjects, ObjectList, ReadDescriptors, Request};
use ads_cnc::{Decode, DescriptorRef, Descriptors, DescriptorsRef, ObjectCount};

use super::case::{Case, Step, Stop, assumed, online};
use super::declare;
use super::probe::{Probe, harness};
use super::record::Checks;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "com-count",
            "Offset 0 gives the number of objects, and the last of them is there",
            ["COM-1", "COM-2"],
            Queries,
            count
        ),
        declare!(
            "com-descriptors",
            "Every object has a descriptor of 84 bytes that makes sense",
            ["COM-2", "COM-5", "GEN-5"],
            Queries,
            descriptors
        ),
        declare!(
            "com-descriptors-in-sequence",
            "A read of k × 84 bytes gives k descriptors, the same as k reads",
            ["COM-3"],
            Queries,
            in_sequence
        ),
        declare!(
            "com-end-of-list",
            "Reading beyond the last object gives what there is, or an error",
            ["COM-2", "COM-3"],
            Queries,
            end_of_list
        ),
        declare!(
            "com-odd-length",
            "A read length that is no multiple of 84 gives one descriptor",
            ["COM-3"],
            Queries,
            odd_length
        ),
        declare!(
            "com-platform-objects",
            "The platform's objects are in its own list and in that of the first channel",
            ["COM-1", "COM-4", "ADR-3"],
            Queries,
            platform_objects
        ),
        declare!(
            "com-platform-axes",
            "Platform axes have object lists of their own",
            ["COM-7", "ADR-3"],
            Queries,
            platform_axes
        ),
        declare!(
            "com-printed-content-address",
            "mc_command_single_block_w is where the manuals print it",
            ["COM-6"],
            PrintedExamples,
            printed_content_address
        ),
    ]
}

/// The most objects of a list that are looked at, whatever number the target gives.
const OBJECTS_MAX: u32 = 10_000;

/// Asks for descriptors and takes at most as many as were asked for.
fn read(
    probe: &mut Probe<'_>,
    rule: &'static str,
    list: ObjectList,
    first: u32,
    count: u32,
) -> Step<Descriptors> {
    let request = ReadDescriptors::new(list, first, count).map_err(harness)?;
    probe.read(rule, request)
}

/// Every descriptor by a read of its own: that several come together is judged elsewhere.
fn one_by_one(
    probe: &mut Probe<'_>,
    rule: &'static str,
    list: ObjectList,
    number: u32,
) -> Step<Descriptors> {
    let mut all = Descriptors::default();
    for first in 1..=number {
        let one = read(probe, rule, list, first, 1)?;
        one.as_ref().iter().for_each(|object| all.push(object.to_owned()));
    }
    Ok(all)
}

fn number(probe: &mut Probe<'_>, list: ObjectList) -> Step<u32> {
    let ObjectCount(number) = probe.read("COM-1", CountObjects::new(list))?;
    if number == 0 {
        return Err(Stop::NotApplicable("the list has no object".to_owned()));
    }
    Ok(number.min(OBJECTS_MAX))
}

/// As [`number`], where it is not this case that judges it.
fn known_number(probe: &mut Probe<'_>, list: ObjectList) -> Step<u32> {
    let exchange = probe.send(CountObjects::new(list))?;
    let data = exchange.answer().and_then(|answer| answer.success()).unwrap_or_default();
    match ObjectCount::decode(data) {
        Ok(ObjectCount(number)) if number > 0 => Ok(number.min(OBJECTS_MAX)),
        Ok(_) => Err(Stop::NotApplicable("the list has no object".to_owned())),
        Err(_) => Err(Stop::Inconclusive("the number of objects could not be read".to_owned())),
    }
}

fn count(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let list = ObjectList::from(channel);
        let ObjectCount(number) = probe.read("COM-1", CountObjects::new(list))?;
        let number = number.min(OBJECTS_MAX);
        if number == 0 {
            let first = ReadDescriptors::new(list, 1, 1).map_err(harness)?;
            probe.refuses_alone("COM-2", "the first of no object", first)?;
            continue;
        }
        read(probe, "COM-2", list, number, 1)?;
        let (beyond, last) = (number.saturating_add(1), number);
        probe.refuses(
            "COM-2",
            "the object behind the last",
            ReadDescriptors::new(list, beyond, 1).map_err(harness)?,
            ReadDescriptors::new(list, last, 1).map_err(harness)?,
        )?;
    }
    Ok(())
}

fn descriptors(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let list = ObjectList::from(channel);
        let mut ids = HashSet::new();
        for first in 1..=known_number(probe, list)? {
            let one = read(probe, "COM-2", list, first, 1)?;
            let Some(object) = one.as_ref().get(0) else { continue };
            let id = object.id();
            probe.check("COM-2", ids.insert(id), "an ID no other object has", format!("ID {id}"));
            descriptor_holds_together(probe, object);
        }
    }
    Ok(())
}

/// What a descriptor says of its object.
pub(crate) fn descriptor_holds_together(probe: &mut impl Checks, object: DescriptorRef<'_>) {
    let name = object.name().to_string();
    let rule = assumed("COM-2");
    probe.check(rule, !name.is_empty(), "an object with a name", "an empty name");
    let type_name = object.type_name().to_string();
    probe.check(rule, !type_name.is_empty(), "the name of a type", "an empty type");
    if let Some(size) = object.type_size() {
        let whole = object.size() > 0 && object.size().checked_rem(size) == Some(0);
        let expected = format!("a multiple of the {size} bytes of {type_name}");
        let found = format!("size {} of {name}", object.size());
        probe.check(online("GEN-5"), whole, expected, found);
    }
    let group = object.index_group();
    let content =
        matches!(group.parts(), Some(Group::Com(ComGroup { access: Access::Element, .. })));
    let expected = "the group of an element of COM, 0x120100 or 0x120200 and the like";
    probe.check(assumed("COM-5"), content, expected, format!("group {group} of {name}"));
    let access = object.write_access().0;
    let expected = "write access 0 or 1";
    probe.check(assumed("COM-2"), access <= 1, expected, format!("{access} of {name}"));
}

fn in_sequence(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(probe.channel()?);
    let number = known_number(probe, list)?;
    let mut singles = Vec::new();
    for first in 1..=number {
        let request = ReadDescriptors::new(list, first, 1).map_err(harness)?;
        singles.push(probe.ask("COM-3", request)?);
    }
    let half = number.div_ceil(2);
    let reads =
        [(1, number), (1, 1), (1, 2), (half, 2), (2, number.saturating_sub(1)), (number, 1)];
    for (first, count) in reads {
        let skip = first.saturating_sub(1);
        if count == 0 || skip.saturating_add(count) > number {
            continue;
        }
        let request = ReadDescriptors::new(list, first, count).map_err(harness)?;
        let together = probe.ask("COM-3", request)?;
        let alone = singles.iter().skip(usize_of(skip)).take(usize_of(count));
        let alone: Vec<u8> = alone.flatten().copied().collect();
        let expected = format!("{count} descriptors from {first} on, as they read one by one");
        let found = match together.len() == alone.len() {
            true => "other bytes".to_owned(),
            false => format!("{} bytes instead of {}", together.len(), alone.len()),
        };
        probe.check("COM-3", together == alone, expected, found);
    }
    Ok(())
}

fn usize_of(number: u32) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

fn end_of_list(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(probe.channel()?);
    let number = known_number(probe, list)?;
    let request = ReadDescriptors::new(list, number, 3).map_err(harness)?;
    let exchange = probe.send(request)?;
    let data = exchange.answer().and_then(|answer| answer.success());
    let given = data.and_then(|data| DescriptorsRef::decode(data).ok()).map(|list| list.len());
    let expected = "the one descriptor there is";
    probe.check(assumed("COM-3"), given == Some(1), expected, exchange.result());
    probe.refuses(
        "COM-2",
        "an object behind the last",
        ReadDescriptors::new(list, number.saturating_add(1), 2).map_err(harness)?,
        ReadDescriptors::new(list, number, 1).map_err(harness)?,
    )
}

fn odd_length(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(probe.channel()?);
    known_number(probe, list)?;
    let request = Request::from(ReadDescriptors::new(list, 1, 1).map_err(harness)?);
    let mut buf = [0; 0];
    let one = request.encode(&mut buf).map_err(harness)?;
    for read_length in [85, 100, 167, 169] {
        let exchange = probe.call(&ads_cnc::operation::Call { read_length, ..one })?;
        let data = exchange.answer().and_then(|answer| answer.success());
        let kept = data.is_some_and(|data| data.len() == ads_cnc::limits::DESCRIPTOR_LEN);
        let expected = format!("one descriptor for a read length of {read_length}");
        probe.check(assumed("COM-3"), kept, expected, exchange.result());
    }
    Ok(())
}

fn platform_objects(probe: &mut Probe<'_>) -> Step {
    let platform = number(probe, ObjectList::PLATFORM).map_err(|stop| match stop {
        Stop::NotApplicable(_) => Stop::NotApplicable("the platform has no object".to_owned()),
        other => other,
    });
    let platform = match platform {
        // Nothing of it is this case's to judge but that the list is there.
        Err(Stop::Judged) => {
            probe.check("COM-4", false, "the platform's list under channel 0", "none");
            return Err(Stop::Judged);
        }
        other => other?,
    };
    let own = one_by_one(probe, "COM-4", ObjectList::PLATFORM, platform)?;
    let first = Channel::new(1).map_err(harness)?;
    let all = known_number(probe, first.into())?;
    let listed = one_by_one(probe, "COM-4", first.into(), all)?;
    let names: HashSet<String> =
        listed.as_ref().iter().map(|object| object.name().to_string()).collect();
    for object in own.as_ref().iter() {
        let name = object.name().to_string();
        let expected = "each of the platform's objects in the list of channel 1";
        let found = format!("{name} is not in it");
        probe.check("COM-4", names.contains(&name), expected, found);
        let com = matches!(object.index_group().parts(), Some(Group::Com(_)));
        probe.check(assumed("ADR-3"), com, "a group of COM", object.index_group());
    }
    Ok(())
}

fn platform_axes(probe: &mut Probe<'_>) -> Step {
    let axes = probe.session.profile.platform_axes;
    if axes == 0 {
        return Err(Stop::NotApplicable("no platform axis is claimed".to_owned()));
    }
    let mut seen: HashSet<u32> = HashSet::new();
    for place in 1..=axes {
        let axis = PlatformAxis::new(place).map_err(harness)?;
        let data = probe.ask(assumed("COM-7"), CountObjects::new(axis))?;
        let number = ObjectCount::decode(&data).map_or(0, |count| count.0.min(OBJECTS_MAX));
        let expected = "the axis's objects";
        probe.check(assumed("COM-7"), number > 0, expected, format!("{number} objects"));
        if number == 0 {
            continue;
        }
        let objects: Descriptors = probe
            .read(assumed("COM-7"), ReadDescriptors::new(axis, 1, number).map_err(harness)?)?;
        let ids: Vec<u32> = objects.as_ref().iter().map(|object| object.id()).collect();
        let own = ids.iter().all(|&id| seen.insert(id));
        let found = format!("IDs {ids:?}, some of them of another axis");
        probe.check(assumed("COM-7"), own, format!("objects of axis {place} alone"), found);
        for object in objects.as_ref().iter() {
            let group = object.index_group();
            let of_axes =
                matches!(group.parts(), Some(Group::Com(ComGroup { table: ComTable::Axis, .. })));
            let expected = "content in a group of platform axes";
            probe.check(assumed("ADR-3"), of_axes, expected, group);
        }
    }
    Ok(())
}

fn printed_content_address(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(Channel::new(1).map_err(harness)?);
    let number = known_number(probe, list)?;
    let listed = one_by_one(probe, "COM-6", list, number)?;
    let printed = "mc_command_single_block_w";
    let object = listed.as_ref().iter().find(|object| object.name() == printed);
    let address = object.map(|object| (object.index_group().get(), object.index_offset().get()));
    let expected = format!("{printed} at (0x120101, 0x1)");
    probe.check("COM-6", address == Some((0x12_0101, 1)), expected, format!("{address:#x?}"));
    Ok(())
}
