//! Checks of the contents of objects and elements. Each content has a value made from its number,
//! so that the checks detect contents that are mixed up.

use ads_cnc::address::Channel;
use ads_cnc::operation::{
    CountElements, CountObjects, ObjectList, ReadDescriptors, ReadElementLength, ReadElementName,
    ReadElementType, ReadElementUnit, Request,
};
use ads_cnc::sda::{ElementLength, ElementText};
use ads_cnc::{Decode as _, Descriptors, DescriptorsRef, ObjectCount};
use ads_cnc_conformance::simulator::{ContentOwner, StoredContent};

use crate::addresses::{addresses, element};
use crate::checks::checks;
use crate::target::{CheckResult, TestCnc, ensure, same};

checks! {
    contents_are_read_at_their_addresses,
    a_write_changes_its_content_alone,
    every_object_is_in_its_list,
    elements_have_the_attributes_of_their_contents,
}

/// Number of rounds with new values. In each round, a BOOLEAN has one of the lowest bits of its
/// number.
const ROUNDS: u32 = 6;
/// Number of rounds in which contents other than BOOLEANs are read.
const ROUNDS_OF_NUMBERS: u32 = 2;

fn is_bit(content: &StoredContent) -> bool {
    matches!(content.type_name, "BOOL" | "BOOLEAN")
}

/// The value of the content with this number in a round. All bytes of a numeric value differ, and
/// REALs are finite.
fn value(content: &StoredContent, number: u32, round: u32) -> Vec<u8> {
    if is_bit(content) {
        return vec![u8::from(number >> round & 1 == 1)];
    }
    let mut seed = number.wrapping_mul(0x9E37_79B9) ^ round.wrapping_mul(0x85EB_CA6B);
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        seed.to_le_bytes()[3]
    };
    let len = content.value.len();
    match content.type_name {
        "STRING" => (1..len).map(|_| b'a' + next() % 26).chain([0]).collect(),
        _ if len == 1 => vec![next()],
        _ => (0_u8..).map(|place| next() & 0x1F | place.wrapping_shl(5)).take(len).collect(),
    }
}

fn what(content: &StoredContent) -> String {
    format!("{} of {:?}", content.name, content.holder)
}

/// The part of a value that is compared: a text up to its NUL, or the whole value.
fn counting<'v>(content: &StoredContent, value: &'v [u8]) -> &'v [u8] {
    match content.type_name {
        "STRING" => value.split(|&byte| byte == 0).next().unwrap_or_default(),
        _ => value,
    }
}

/// Each content that can be read is little-endian, and has the same value at each of its addresses.
fn contents_are_read_at_their_addresses(target: &TestCnc) -> CheckResult {
    let all = target.cnc().stored_contents();
    ensure(all.len() > 100, format_args!("{} contents", all.len()))?;
    for round in 0..ROUNDS {
        let values: Vec<Vec<u8>> =
            (1..).zip(&all).map(|(number, content)| value(content, number, round)).collect();
        for (content, value) in all.iter().zip(&values) {
            target.cnc().set_content(content, value);
        }
        let of_round = |content: &StoredContent| is_bit(content) || round < ROUNDS_OF_NUMBERS;
        for (content, value) in all.iter().zip(&values).filter(|(content, _)| of_round(content)) {
            for address in addresses(target, content)? {
                // The program stream, and contents at the offsets of functions, cannot be read.
                let Ok(request) = address.read() else { continue };
                let found = target.ask(request)??;
                let at = format!("{} at {address:?}", what(content));
                same(at, counting(content, &found), counting(content, value))?;
            }
        }
    }
    Ok(())
}

fn a_write_changes_its_content_alone(target: &TestCnc) -> CheckResult {
    let all = target.cnc().stored_contents();
    let profile = target.cnc().model().profile();
    for (number, content) in (1..).zip(&all).filter(|(_, content)| content.writable) {
        if profile.leaves(&content.name.to_string()) {
            continue;
        }
        let new = match is_bit(content) {
            true => content.value.iter().map(|bit| bit ^ 1).collect(),
            false => value(content, number, 0),
        };
        for address in addresses(target, content)? {
            let Ok(request) = address.write(&new) else { continue };
            target.ask(request)??;
            for (now, before) in target.cnc().stored_contents().iter().zip(&all) {
                let is_written = (now.holder, now.element) == (content.holder, content.element);
                let expected = if is_written { &new } else { &before.value };
                let after = format!("{} after a write to {address:?}", what(now));
                same(after, counting(now, &now.value), counting(now, expected))?;
            }
            target.cnc().set_content(content, &content.value);
        }
    }
    Ok(())
}

/// All descriptors of a list.
fn descriptors(target: &TestCnc, list: impl Into<ObjectList>) -> CheckResult<Descriptors> {
    let list = list.into();
    let count = target.read::<ObjectCount>(CountObjects::new(list))?.0;
    let mut all = Descriptors::default();
    for number in 1..=count {
        let data = target.ask(ReadDescriptors::new(list, number, 1)?)??;
        for one in DescriptorsRef::decode(&data)? {
            all.push(one.to_owned());
        }
    }
    Ok(all)
}

/// Each object of the platform or of a channel has a descriptor in its list, with the name, the
/// size and an address of the object.
fn every_object_is_in_its_list(target: &TestCnc) -> CheckResult {
    let all = target.cnc().stored_contents();
    let mut lists = vec![(0, descriptors(target, ObjectList::PLATFORM)?)];
    for channel in target.channels() {
        lists.push((channel, descriptors(target, Channel::new(channel.into())?)?));
    }
    for content in &all {
        let list = match content.holder {
            ContentOwner::Platform => 0,
            ContentOwner::Channel(channel) | ContentOwner::ChannelAxis { channel, .. } => channel,
            _ => continue,
        };
        let Some((_, list)) = lists.iter().find(|(of, _)| *of == list) else { continue };
        let addresses = addresses(target, content)?;
        let listed = list.iter().find(|one| {
            let content = Some((one.index_group(), one.index_offset()));
            addresses.iter().any(|address| address.content() == content)
        });
        ensure(listed.is_some(), format_args!("{} is in no list", what(content)))?;
        let Some(listed) = listed else { continue };
        same(what(content), usize::try_from(listed.size())?, content.value.len())?;
        same(what(content), listed.name(), content.name.as_cnc_str())?;
    }
    Ok(())
}

fn elements_have_the_attributes_of_their_contents(target: &TestCnc) -> CheckResult {
    for content in target.cnc().stored_contents() {
        let Some(element) = element(target, &content)? else { continue };
        let texts: [(Request<'_>, &[u8]); 3] = [
            (ReadElementName::new(element).into(), content.name.as_bytes()),
            (ReadElementType::new(element).into(), content.type_name.as_bytes()),
            (ReadElementUnit::new(element).into(), content.unit.as_bytes()),
        ];
        for (request, expected) in texts {
            let read = target.read::<ElementText>(request)?;
            same(what(&content), read.text.text.as_bytes(), expected)?;
        }
        let length = target.read::<ElementLength>(ReadElementLength::new(element))?.get();
        same(what(&content), usize::try_from(length)?, content.value.len())?;
        let first = element.index_offset().get() - content.element;
        let first = ads_cnc::address::ElementAddress::new(
            element.class_group(),
            ads_cnc::address::IndexOffset::new(first),
        );
        let count = target.ask(CountElements::new(first)?)??;
        let count = count.iter().rev().fold(0, |count, &byte| count << 8 | u32::from(byte));
        ensure(content.element <= count, format_args!("{} of {count}", what(&content)))?;
    }
    Ok(())
}
