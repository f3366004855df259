//! Cases of the contents of COM objects, and a case that reads the lists of COM, SDA and GEO.

use std::collections::HashSet;

use ads_cnc::address::{ComGroup, ComTable, Group};
use ads_cnc::operation::{CountObjects, ReadDescriptors, ReadElementName, ReadObject};
use ads_cnc::{Descriptors, ErrorKind, ObjectCount};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{OBJECTS_MAX, Probe, RawCall, Steady};
use super::platform::PRINTED;
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, IfPresent as _, Needs, OrStop as _, Step, applicable, assumed};
use crate::objects::ListedValue;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("com-content", &[COM_2, COM_5, COM_6, GEN_5], Needs::Queries, content,
        "Every object is readable at the address and in the size of its descriptor"),
    case("com-content-by-index", &[ADR_1, ADR_12], Needs::Queries, content_by_index,
        "An object has the same content by the channel's number and by its rank"),
    case("com-content-room", &[COM_2, COM_5, ADS_1], Needs::Queries, room,
        "A read longer than the object returns exactly the size in the descriptor, or an error"),
    case("com-places", &[COM_2, COM_5], Needs::Queries, places,
        "No two objects of a list have the same address"),
    case("com-read-lengths", &[ADS_1], Needs::Malformed, read_lengths,
        "A read length shorter than the content returns an error"),
    case("obj-everything", &[OBJ_1], Needs::Queries, everything,
        "Every counted object and element can be listed, exactly once"),
];

fn content(probe: &mut Probe<'_>) -> Step {
    for object in probe.objects()? {
        probe.set_subject(&object.name);
        let rules = [COM_5, COM_2];
        let size = object.size();
        let read = match object.address.read() {
            Ok(read) => read,
            Err(error) => {
                // The object may be the program stream, whose reads are not documented.
                let stream = error.kind() == ErrorKind::Function;
                let found = || {
                    format!(
                        "{} of {} at {}: {error}",
                        plural(size, "byte"),
                        object.name,
                        at(&object)
                    )
                };
                probe.check(rules, stream, "a content that can be read", found);
                continue;
            }
        };
        if let Err(Some(_)) = probe.check_gate(&read)? {
            let found =
                || format!("{} at {}, an address that no query has", object.name, at(&object));
            probe.check(rules, false, "a content that can be read", found);
            continue;
        }
        let place = object.address.content().map(|(group, offset)| (group.get(), offset.get()));
        if PRINTED.iter().any(|&(_, group, offset)| place == Some((group, offset))) {
            let exchange = probe.send(read)?;
            let expected = || format!("{} at the address printed in the manual", object.name);
            probe.check(COM_6, exchange.success().is_some(), expected, &exchange);
        }
        let content = probe.ask(rules, read)?;
        let found = || format!("{} of {}", plural(content.len(), "byte"), object.name);
        let sized = u32::try_from(content.len()) == Ok(size);
        let expected = || format!("the {} of its descriptor", plural(size, "byte"));
        probe.check(rules, sized, expected, found);
        if object.ty.name == "BOOL" {
            let bit = matches!(*content, [0 | 1]);
            let found = || format!("{content:?} of {}", object.name);
            probe.check(assumed(GEN_5), bit, "a BOOL of 0 or 1", found);
        }
    }
    Ok(())
}

/// Checks reads with a read length that exceeds the size of the object. Such a read may be
/// rejected, but a success must return exactly as many bytes as the size of the object.
fn room(probe: &mut Probe<'_>) -> Step {
    for object in probe.objects()? {
        let Some((group, offset)) = object.address.content() else { continue };
        if object.address.read().is_err() {
            continue;
        }
        probe.set_subject(&object.name);
        for more in [1, 7, 64] {
            let size = object.size().saturating_add(more);
            let Ok(read) = ReadObject::new(group, offset, size) else { continue };
            if !probe.may(read)? {
                continue;
            }
            let Some(content) = probe.try_ask(read)? else { continue };
            let expected = || format!("the {} of {}", plural(object.size(), "byte"), object.name);
            let found = || format!("{} for a read length of {size}", plural(content.len(), "byte"));
            let sized = u32::try_from(content.len()) == Ok(object.size());
            probe.check([COM_2, COM_5], sized, expected, found);
            let is_padded = !sized && u32::try_from(content.len()) == Ok(size);
            probe.check(ADS_1, !is_padded, "no bytes after the data", found);
        }
    }
    probe.finish("no content can be read with a longer read length")
}

/// Index group and index offset of the content of an object, as text for a message.
pub(super) fn at(object: &ListedValue) -> String {
    let content = object.address.content();
    content.map(|(group, offset)| format!("{group}, {offset}")).unwrap_or_default()
}

fn is_of_channel(object: &ListedValue) -> bool {
    let com = object.address.content().and_then(|(group, _)| group.parts());
    matches!(com, Some(Group::Com(ComGroup { table: ComTable::Channel, instance: 1.., .. })))
}

fn content_by_index(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    let mut any = false;
    for object in probe.objects()?.into_iter().filter(is_of_channel) {
        let Some(by_rank) = probe.address_by_rank(&object) else { continue };
        let (Ok(one), Ok(other)) = (object.address.read(), by_rank.read()) else { continue };
        any = true;
        steady.by_index(probe, ADR_1, &object.name, one, other)?;
    }
    applicable(any, "no object is in the group of a channel")?;
    steady.finish()
}

fn places(probe: &mut Probe<'_>) -> Step {
    let mut seen = HashSet::new();
    for object in probe.objects()? {
        let found = || format!("{} at {}, the address of another object", object.name, at(&object));
        let own = seen.insert((object.list, object.address.content()));
        probe.check([COM_2, COM_5], own, "an address that no other object has", found);
    }
    Ok(())
}

fn read_lengths(probe: &mut Probe<'_>) -> Step {
    let all = probe.objects()?;
    let read = all.iter().filter(|one| one.size() > 1).find_map(|one| one.address.read().ok());
    let valid = RawCall::new(read.or_not_applicable("no object has two bytes")?)?;
    for read_length in [0, valid.read_length.saturating_sub(1)] {
        let what =
            format!("a read length of {read_length} for {}", plural(valid.read_length, "byte"));
        let invalid = valid.with(|call| call.read_length = read_length);
        probe.rejects(assumed(ADS_1), &what, invalid, &valid)?;
    }
    Ok(())
}

/// Reads the claimed lists like an object browser: the numbers of COM objects, and the COM
/// descriptors and names of SDA and GEO elements that the cases read.
fn everything(probe: &mut Probe<'_>) -> Step {
    for list in probe.lists()? {
        // No manual states that platform axes (`ComTable::Axis`) have object lists.
        let rule = match list.parts().table {
            ComTable::Axis => assumed(OBJ_1),
            ComTable::Channel => OBJ_1.into(),
        };
        let ObjectCount(count) = probe.read(rule, CountObjects::new(list))?;
        let mut ids = HashSet::new();
        for first in probe.object_numbers(count) {
            let one = ReadDescriptors::new(list, first, 1)?;
            let one: Descriptors = probe.read(rule, one)?;
            let id = one.as_ref().get(0).map(|object| object.id());
            let found = || format!("the object {id:?} again, at number {first} of {count}");
            probe.check(rule, id.is_some_and(|id| ids.insert(id)), "another object", found);
        }
    }
    for instance in probe.instances().if_applicable()?.unwrap_or_default() {
        for element in instance.elements() {
            let name = probe.ask(OBJ_1, ReadElementName::new(element))?;
            let found = || format!("{} of {instance}", Hex(name.clone()));
            let named = name.first().is_some_and(|&byte| byte != 0);
            probe.check(OBJ_1, named, "an element with a name", found);
        }
        let listed = instance.reached == instance.count.min(OBJECTS_MAX);
        let found = || format!("{} of {instance}", instance.reached);
        probe.check(OBJ_1, listed, || plural(instance.count, "element"), found);
    }
    Ok(())
}
