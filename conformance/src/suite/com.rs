//! Cases of the object lists and descriptors of the COM task.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use ads_cnc::address::ComTable;
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{CountObjects, ObjectList, ReadDescriptors, Request};
use ads_cnc::{Decode, DescriptorRef, DescriptorsRef, ObjectCount};
use ads_cnc_vectors::ids::*;

use super::kit::{OBJECTS_MAX, Probe, RawCall, known_object_count, read_descriptors};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, Step, assumed};
use crate::number::to_usize;
use crate::rules::check_descriptor;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("com-count", &[COM_1, COM_2], Needs::Queries, count,
        "Offset 0 returns the number of objects, and the last object exists"),
    case("com-descriptors", &[COM_2, COM_5, GEN_5], Needs::Queries, descriptors,
        "Every object has a valid descriptor of 84 bytes"),
    case("com-descriptors-in-sequence", &[COM_3], Needs::Queries, in_sequence,
        "A read of k × 84 bytes returns the same k descriptors as k separate reads"),
    case("com-end-of-list", &[COM_2, COM_3], Needs::Queries, end_of_list,
        "A read beyond the last object returns only the existing descriptors, or an error"),
    case("com-odd-length", &[COM_3], Needs::Queries, odd_length,
        "A read length that is not a multiple of 84 returns one descriptor"),
];

/// The object lists of the channels, and that of the platform if the target returns its number of
/// objects. Another case judges whether the list of the platform is missing.
fn lists(probe: &mut Probe<'_>) -> Step<Vec<ObjectList>> {
    let mut all = Vec::new();
    for list in probe.lists()? {
        if list.parts().table == ComTable::Channel
            && (list != ObjectList::PLATFORM || probe.try_ask(CountObjects::new(list))?.is_some())
        {
            all.push(list);
        }
    }
    Ok(all)
}

fn count(probe: &mut Probe<'_>) -> Step {
    for list in lists(probe)? {
        let ObjectCount(number) = probe.read(COM_1, CountObjects::new(list))?;
        ends(probe, list, number)?;
        // The list is static, so the requests in between must not change the number of objects.
        let again: ObjectCount = probe.read(COM_1, CountObjects::new(list))?;
        let found = || format!("{} of {}", plural(again.0, "object"), list.parts().index_group());
        probe.check(COM_1, again.0 == number, || format!("{number} as before"), found);
    }
    Ok(())
}

/// Checks that object `number`, the last one, exists and that no object follows it. In a list with
/// more than [`OBJECTS_MAX`] objects, checks only that object [`OBJECTS_MAX`] exists. A failure
/// violates the requirements on the number and on the list, because it does not show which of them
/// is wrong.
/// COM-1, COM-2
fn ends(probe: &mut Probe<'_>, list: ObjectList, number: u32) -> Step {
    let rules = [COM_1, COM_2];
    let asked = number.min(OBJECTS_MAX);
    if asked == 0 {
        let first = ReadDescriptors::new(list, 1, 1)?;
        return probe.rejects_alone(rules, "the first of no object", first);
    }
    let last = ReadDescriptors::new(list, asked, 1)?;
    let there = probe.try_ask(last)?;
    let there = there.is_some_and(|data| DescriptorsRef::decode(&data).is_ok());
    let expected =
        || format!("object {asked}: {} has {number} objects", list.parts().index_group());
    if !probe.check(rules, there, expected, "no descriptor") || asked < number {
        return Ok(());
    }
    for beyond in probe.beyond(number.saturating_add(1)) {
        let beyond = ReadDescriptors::new(list, beyond, 1)?;
        let what = format!("object {}, after the last of {number}", beyond.first());
        probe.rejects(rules, &what, beyond, last)?;
    }
    Ok(())
}

fn descriptors(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let list = ObjectList::from(channel);
        let mut ids = HashSet::new();
        let number = known_object_count(probe, list)?;
        for first in probe.object_numbers(number) {
            probe.end_subject();
            let one = read_descriptors(probe, COM_2, list, first, 1)?;
            let Some(object) = one.as_ref().get(0) else { continue };
            probe.set_subject(object.name());
            let id = object.id();
            probe.check(COM_2, ids.insert(id), "an ID that no other object has", || {
                format!("ID {id}")
            });
            check_descriptor(probe, object);
            // Objects are static: a second read must return the same descriptor. The write access
            // is not compared.
            let again = read_descriptors(probe, COM_2, list, first, 1)?;
            let what = |one: DescriptorRef<'_>| {
                let at = (one.index_group(), one.index_offset());
                (one.id(), one.size(), at, one.name().to_string(), one.type_name().to_string())
            };
            let same = again.as_ref().get(0).map(what) == Some(what(object));
            let found = || format!("another descriptor for number {first} in the second read");
            probe.check(COM_2, same, || format!("the descriptor of ID {id} again"), found);
        }
    }
    Ok(())
}

fn in_sequence(probe: &mut Probe<'_>) -> Step {
    for list in lists(probe)? {
        let Some(number) = known_object_count(probe, list).if_applicable()? else { continue };
        sequence(probe, list, number)?;
    }
    probe.finish("no list has an object")
}

fn sequence(probe: &mut Probe<'_>, list: ObjectList, number: u32) -> Step {
    let chosen = probe.object_numbers(number);
    let half = number.div_ceil(2);
    let mut reads = vec![(1, number), (half, 3), (2, number.saturating_sub(1)), (number, 1)];
    reads.extend(chosen.iter().map(|&first| (first, 2)));
    let in_list = |&(first, count): &(u32, u32)| {
        count > 0 && first.saturating_sub(1).saturating_add(count) <= number
    };
    reads.retain(in_list);
    let short = reads.iter().filter(|(_, count)| *count <= 3);
    let mut numbers: BTreeSet<u32> =
        short.flat_map(|&(first, count)| (first..=number).take(to_usize(count))).collect();
    numbers.extend(chosen);
    let mut singles = BTreeMap::new();
    for &first in &numbers {
        let request = ReadDescriptors::new(list, first, 1)?;
        singles.insert(first, probe.ask(COM_3, request)?);
    }
    for (first, count) in reads {
        // `ReadDescriptors` rejects a count of descriptors that exceeds its maximum.
        let Ok(request) = ReadDescriptors::new(list, first, count) else { continue };
        let together = probe.ask(COM_3, request)?;
        // A descriptor that was not read alone is not compared: the expected bytes are the received
        // ones.
        let mut parts = together.chunks(DESCRIPTOR_LEN);
        let alone = (first..=number).take(to_usize(count)).map(|number| {
            let part = parts.next().unwrap_or_default();
            singles.get(&number).map_or(part, Vec::as_slice)
        });
        let alone: Vec<u8> = alone.flatten().copied().collect();
        let expected = || {
            format!("{} from {first}, equal to those read one by one", plural(count, "descriptor"))
        };
        let found = if together.len() == alone.len() {
            "other bytes".to_owned()
        } else {
            format!("{} instead of {}", plural(together.len(), "byte"), alone.len())
        };
        probe.check(COM_3, together == alone, expected, found);
    }
    Ok(())
}

fn end_of_list(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(probe.channel()?);
    let number = known_object_count(probe, list)?;
    let request = ReadDescriptors::new(list, number, 3)?;
    let exchange = probe.send(request)?;
    let data = exchange.success();
    let given = data.and_then(|data| DescriptorsRef::decode(data).ok()).map(|list| list.len());
    let expected = "only the last descriptor";
    probe.check(assumed(COM_3), given == Some(1), expected, &exchange);
    probe.rejects(
        COM_2,
        "an object after the last",
        ReadDescriptors::new(list, number.saturating_add(1), 2)?,
        ReadDescriptors::new(list, number, 1)?,
    )
}

fn odd_length(probe: &mut Probe<'_>) -> Step {
    let list = ObjectList::from(probe.channel()?);
    known_object_count(probe, list)?;
    let request = Request::from(ReadDescriptors::new(list, 1, 1)?);
    let one = RawCall::new(request)?;
    for read_length in [85, 100, 167, 169] {
        let exchange = probe.call(&one.with(|call| call.read_length = read_length))?;
        let data = exchange.success();
        let passed = data.is_some_and(|data| data.len() == DESCRIPTOR_LEN);
        let expected = || format!("one descriptor for a read length of {read_length}");
        probe.check(assumed(COM_3), passed, expected, &exchange);
    }
    Ok(())
}
