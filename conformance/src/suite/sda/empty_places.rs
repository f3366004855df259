//! A case of the contents at axis indices without an axis.

use ads_cnc::address::{Channel, ElementAddress, Group};
use ads_cnc::operation::{CountElements, ReadElement};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, Stop, assumed};
use crate::objects::ValueList;
use crate::suite::kit::{Instance, OBJECTS_MAX, OF_PLACES, Probe};

pub(super) fn empty_place(probe: &mut Probe<'_>) -> Step {
    let places = probe.target.profile.empty_places.clone();
    if places.is_empty() {
        return Err(Stop::not_applicable(
            "no axis index without an axis is known; a profile can name one",
        ));
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

/// The content of an element; `None` if it cannot be read.
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
    // The number of elements is the content of element 0, so it must be readable too.
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
        // The content at an axis index without an axis must not equal that of an axis, unless it is
        // zero.
        let of_axis = !is_blank(&content) && theirs.contains(&content);
        probe.check(SDA_11, !of_axis, "blank content, different from that of any axis", found);
        probe.check(assumed(SDA_11), is_blank(&content), "zeros", found);
    }
    Ok(())
}

fn blank_objects(probe: &mut Probe<'_>, channel: u32, place: u32) -> Step {
    let list = ValueList::Channel(Channel::new(channel)?.number());
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
