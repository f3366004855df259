//! Axis places without an axis.

use std::sync::Arc;

use ads_cnc::address::{Class, ElementAddress, Group};
use ads_cnc::operation::{CountElements, ReadElement};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, Stop, assumed};
use crate::simulator::Cnc;
use crate::suite::kit::{Instance, OBJECTS_MAX, OF_PLACES, Probe};

pub(super) fn empty_place(probe: &mut Probe<'_>) -> Step {
    let places = probe.target.profile.empty_places.clone();
    if places.is_empty() {
        return Err(Stop::not_applicable("no place is known to be empty; a profile can name one"));
    }
    let all = probe.instances()?;
    for &(channel, place) in places.iter() {
        let there = all.iter().filter(|one| {
            OF_PLACES.contains(&one.class) && (one.channel, one.axis) == (channel, place)
        });
        for one in there {
            let occupied = |other: &&Instance| {
                other.class == one.class
                    && other.axis > 0
                    && !places.contains(&(other.channel, other.axis))
            };
            let occupied: Vec<&Instance> = all.iter().filter(occupied).collect();
            blank_elements(probe, one, &occupied)?;
        }
        blank_objects(probe, channel, place)?;
    }
    Ok(())
}

/// The content of an element; `None` if it has none.
fn content(probe: &mut Probe<'_>, element: ElementAddress) -> Step<Option<Vec<u8>>> {
    let Some(length) = probe.length_of(element)? else { return Ok(None) };
    match ReadElement::new(element, length) {
        Ok(read) => probe.try_ask(read),
        Err(_) => Ok(None),
    }
}

fn is_blank(bytes: &[u8]) -> bool {
    bytes.iter().all(|&byte| byte == 0)
}

fn blank_elements(probe: &mut Probe<'_>, one: &Instance, occupied: &[&Instance]) -> Step {
    // The number of elements is a content, too.
    probe.ask(SDA_11, CountElements::new(one.first)?)?;
    let count = occupied.iter().map(|other| other.count).chain([one.count]).max();
    for place in 1..=count.unwrap_or_default().min(OBJECTS_MAX) {
        let Ok(element) = one.first.nth(place) else { continue };
        let mut theirs = Vec::new();
        for other in occupied {
            let Ok(other) = other.first.nth(place) else { continue };
            theirs.extend(content(probe, other)?);
        }
        let length = match probe.length_of(element)? {
            Some(length) => Some(length),
            None => theirs.first().and_then(|bytes| u32::try_from(bytes.len()).ok()),
        };
        let Some(Ok(read)) = length.map(|length| ReadElement::new(element, length)) else {
            continue;
        };
        let content = probe.ask(SDA_11, read)?;
        let found = || format!("{} of element {place} of {one}", Hex(content.clone()));
        // A content that equals that of an axis must not be one at an empty place, unless it is
        // zero.
        let of_axis = !is_blank(&content) && theirs.contains(&content);
        probe.check(SDA_11, !of_axis, "blank, not what an axis has elsewhere", found);
        probe.check(assumed(SDA_11), is_blank(&content), "zeros", found);
    }
    Ok(())
}

fn blank_objects(probe: &mut Probe<'_>, channel: u32, place: u32) -> Step {
    let list = probe.list_of(channel)?;
    for object in probe.objects()?.into_iter().filter(|one| one.list == list) {
        let group = object.address.content().and_then(|(group, _)| group.parts());
        let is_com = matches!(group, Some(Group::Com(_)));
        let (true, true, Ok(read)) = (object.is_of_axis(place), is_com, object.address.read())
        else {
            continue;
        };
        let content = probe.ask(SDA_11, read)?;
        let expected = || format!("zeros of {} at place {place} of channel {channel}", object.name);
        probe.check(assumed(SDA_11), is_blank(&content), expected, || Hex(content));
    }
    Ok(())
}

/// In the default model the first places of these channels have the axes 4 and 5, the others no
/// axis.
const CHANNELS: [(u8, u32); 2] = [(2, 4), (6, 5)];

/// The element with this number at a place; `None` if its offset is a function.
type ClassElement = (Class, u32);

pub(super) fn axis_number(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let [(one, mine), (other, theirs)] = CHANNELS;
    let at = |probe: &mut Probe<'_>, channel: u8, number: u32| {
        let number = u64::from(number).to_le_bytes();
        elements_with(probe, channel.into(), 1, |bytes| {
            number.starts_with(bytes) && number.iter().skip(bytes.len()).all(|&byte| byte == 0)
        })
    };
    let before = at(probe, one, mine)?;
    let objects = numbers_of(probe, one, mine)?;
    let none = || Stop::not_applicable("nothing is the number of an axis");
    if before.is_empty() && objects.is_empty() {
        return Err(none());
    }
    // The other channel's axis moves here: an element that changes to its number is the axis
    // number.
    cnc.exchange_axis(one, 1, theirs)?;
    let moved = (at(probe, one, theirs), numbers_of(probe, one, theirs));
    let blank = blank_at(probe, other.into(), 1, &before);
    exchange_back(&cnc)?;
    let numbers: Vec<ClassElement> =
        moved.0?.into_iter().filter(|one| before.contains(one)).collect();
    let of_com: Vec<_> = moved.1?.into_iter().filter(|one| objects.contains(one)).collect();
    if numbers.is_empty() && of_com.is_empty() {
        return Err(none());
    }
    let is_number = |(element, _): &&(ClassElement, Vec<u8>)| numbers.contains(element);
    for ((class, element), content) in blank?.iter().filter(is_number) {
        let found = || format!("{} of element {element} of {class:?}", Hex(content.clone()));
        probe.check(SDA_11, is_blank(content), "0 where the axis was", found);
    }
    for &(channel, place) in probe.target.profile.empty_places.clone().iter() {
        for ((class, element), content) in blank_at(probe, channel, place, &numbers)? {
            let found = || format!("{} of element {element} of {class:?}", Hex(content.clone()));
            let expected = || format!("0 at place {place} of channel {channel}");
            probe.check(SDA_11, is_blank(&content), expected, found);
        }
    }
    let list = probe.list_of(one.into())?;
    for object in probe.objects()?.into_iter().filter(|object| object.list == list) {
        let name = object.name.to_string();
        let (true, false, Ok(read), Some((_, offset))) = (
            of_com.contains(&name),
            object.is_of_axis(1),
            object.address.read(),
            object.address.content(),
        ) else {
            continue;
        };
        let content = probe.ask(SDA_11, read)?;
        let expected = || format!("0 of {name} at {offset}");
        probe.check(SDA_11, is_blank(&content), expected, || Hex(content));
    }
    Ok(())
}

/// In an order without conflicts.
fn exchange_back(cnc: &Arc<Cnc>) -> Step {
    for (channel, axis) in CHANNELS {
        cnc.exchange_axis(channel, 1, axis)?;
    }
    Ok(())
}

/// The elements at a place whose contents satisfy a condition.
fn elements_with(
    probe: &mut Probe<'_>,
    channel: u32,
    place: u32,
    is_such: impl Fn(&[u8]) -> bool,
) -> Step<Vec<ClassElement>> {
    let mut all = Vec::new();
    for one in probe.instances()? {
        if !OF_PLACES.contains(&one.class) || (one.channel, one.axis) != (channel, place) {
            continue;
        }
        for (number, element) in one.numbered() {
            if content(probe, element)?.is_some_and(|bytes| is_such(&bytes)) {
                all.push((one.class, number));
            }
        }
    }
    Ok(all)
}

/// The contents of these elements at a place.
fn blank_at(
    probe: &mut Probe<'_>,
    channel: u32,
    place: u32,
    elements: &[ClassElement],
) -> Step<Vec<(ClassElement, Vec<u8>)>> {
    let mut all = Vec::new();
    for one in probe.instances()? {
        if (one.channel, one.axis) != (channel, place) {
            continue;
        }
        for &(class, number) in elements.iter().filter(|(class, _)| *class == one.class) {
            let Ok(element) = one.first.nth(number) else { continue };
            let content = content(probe, element)?.unwrap_or_default();
            all.push(((class, number), content));
        }
    }
    Ok(all)
}

/// The names of objects at the first place whose content is this number.
fn numbers_of(probe: &mut Probe<'_>, channel: u8, number: u32) -> Step<Vec<String>> {
    let list = probe.list_of(channel.into())?;
    let number = u64::from(number).to_le_bytes();
    let mut all = Vec::new();
    for object in probe.objects()?.into_iter().filter(|object| object.list == list) {
        let (true, Ok(read)) = (object.is_of_axis(1), object.address.read()) else { continue };
        let content = probe.try_ask(read)?.unwrap_or_default();
        if !content.is_empty() && number.starts_with(&content) {
            all.push(object.name.to_string());
        }
    }
    Ok(all)
}
