//! Cases of the elements of SDA and GEO: what they say of themselves, and what they hold.

use std::collections::HashSet;

use ads_cnc::address::{Addressing, Channel, Class, ClassGroup, ElementAddress};
use ads_cnc::operation::{
    CountElements, ReadElement, ReadElementLength, ReadElementName, ReadElementType,
    ReadElementUnit, ReadElementWriteFlag, Request,
};
use ads_cnc::sda::{ElementCount, ElementLength, ElementText, ElementWriteFlag};
use ads_cnc::{Decode, ErrorKind};

use super::case::{Case, Rule, Step, Stop, assumed, online};
use super::declare;
use super::inventory::Instance;
use super::probe::{Probe, harness};
use super::sda::length_of;
use super::still::Still;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "sda-elements",
            "The first element says how many follow, and whose they are; then the list ends",
            ["SDA-4", "ADR-6"],
            Queries,
            elements
        ),
        declare!(
            "sda-attributes",
            "Every element has a name, a type, a length, a unit and a write flag that make sense",
            ["SDA-6", "SDA-7", "SDA-8", "SDA-9", "ADR-6", "GEN-3", "GEN-5"],
            Queries,
            attributes
        ),
        declare!(
            "sda-content",
            "The content of an element has the length it says, and a value its type has",
            ["SDA-8", "ADR-6", "GEN-5"],
            Queries,
            content
        ),
        declare!(
            "sda-content-by-index",
            "By number and by rank of the channel, an element has the same content",
            ["ADR-1", "ADR-12"],
            Queries,
            content_by_index
        ),
        declare!(
            "sda-read-lengths",
            "A read length that does not hold the answer is answered by an error",
            ["ADS-1"],
            Malformed,
            read_lengths
        ),
    ]
}

/// Reads an attribute: an answer speaks for its stream, and for its group.
fn attribute<T>(
    probe: &mut Probe<'_>,
    rule: &'static str,
    request: impl Into<Request<'static>>,
) -> Step<T>
where
    T: for<'b> Decode<'b>,
{
    let value = probe.read(rule, request)?;
    probe.check("ADR-6", true, "", "");
    Ok(value)
}

fn elements(probe: &mut Probe<'_>) -> Step {
    let mut names = HashSet::new();
    for instance in probe.instances()? {
        let first = instance.first;
        let count = CountElements::new(first).map_err(harness)?;
        let ElementCount(count) = attribute(probe, "SDA-4", count)?;
        let found = format!("{count} elements of {instance}");
        probe.check("SDA-4", count <= 0xFFFF, "no more than an offset has room for", found);
        let name: ElementText = attribute(probe, "SDA-4", ReadElementName::new(first))?;
        let name = name.text.text.to_string();
        let rule = assumed("SDA-4");
        let found = format!("{name:?} of {instance}");
        probe.check(rule, !name.is_empty(), "the name of the instance", &found);
        // Axes of the platform are in several HLDs.
        let shared = instance.class == Class::Hld && instance.axis > 0;
        if !shared {
            probe.check(rule, names.insert((instance.channel, name)), "a name of its own", found);
        }
        ends(probe, &instance, count)?;
    }
    Ok(())
}

/// The last element has a name, and behind it there is none.
fn ends(probe: &mut Probe<'_>, instance: &Instance, count: u32) -> Step {
    let (last, beyond) =
        (instance.first.following(count), instance.first.following(count.saturating_add(1)));
    let (Ok(last), Ok(beyond)) = (last, beyond) else { return Ok(()) };
    if count > 0 {
        attribute::<ElementText>(probe, "SDA-4", ReadElementName::new(last))?;
    }
    let what = format!("element {} of {instance}, which has {count}", beyond.index_offset());
    probe.refuses("SDA-4", &what, ReadElementName::new(beyond), ReadElementName::new(last))?;
    probe.refuses("SDA-4", &what, ReadElementLength::new(beyond), ReadElementLength::new(last))
}

/// What the sizes of the types are; BOOLEAN's is printed.
fn size_of(type_name: &str) -> Option<(Rule, u32)> {
    let size = match type_name {
        "BOOLEAN" => return Some(("GEN-5".into(), 1)),
        "UNS08" | "SGN08" => 1,
        "UNS16" | "SGN16" => 2,
        "UNS32" | "SGN32" | "REAL32" => 4,
        "REAL64" => 8,
        _ => return None,
    };
    Some((online("GEN-5"), size))
}

fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, &Instance, ElementAddress) -> Step,
) -> Step {
    for instance in probe.instances()? {
        for element in instance.elements() {
            judge(probe, &instance, element)?;
        }
    }
    Ok(())
}

fn attributes(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, instance, element| {
        let name: ElementText = attribute(probe, "SDA-6", ReadElementName::new(element))?;
        let ty: ElementText = attribute(probe, "SDA-7", ReadElementType::new(element))?;
        let length: ElementLength = attribute(probe, "SDA-8", ReadElementLength::new(element))?;
        let unit: ElementText = attribute(probe, "SDA-6", ReadElementUnit::new(element))?;
        let flag: ElementWriteFlag = attribute(probe, "SDA-9", ReadElementWriteFlag::new(element))?;
        let at = format!("element {} of {instance}", element.index_offset());
        let text = |text: &ElementText| text.text.text.to_string();
        let found = format!("{:?} of {at}", text(&name));
        probe.check("SDA-6", !text(&name).is_empty(), "a name", &found);
        for one in [&name, &unit, &ty] {
            let readable = !text(one).chars().any(char::is_control);
            let found = format!("{:?} of {at}", text(one));
            probe.check(assumed("GEN-3"), readable, "CP1252 characters", found);
        }
        let type_name = text(&ty);
        let known = size_of(&type_name);
        let found = format!("{type_name:?} of {at}");
        let is_known = known.is_some() || type_name == "STRING";
        probe.check(assumed("SDA-7"), is_known, "one of the types of the manual", &found);
        probe.check("SDA-7", !type_name.is_empty(), "the name of a type", found);
        if let Some((rule, size)) = known {
            let (length, same) = (length.get(), length.get() == size);
            let found = format!("{length} bytes of {at}, {type_name}");
            // A value of its type in another number of bytes.
            probe.check(rule, same, format!("the {size} bytes of {type_name}"), &found);
            probe.check("SDA-8", length > 0, "a number of bytes", found);
        }
        let found = format!("{} of {at}", flag.0);
        probe.check(assumed("SDA-9"), flag.0 <= 1, "a write flag of 0 or 1", found);
        Ok(())
    })
}

fn content(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, instance, element| {
        let Some(length) = length_of(probe, element)? else { return Ok(()) };
        let ty = probe.try_ask(ReadElementType::new(element))?;
        let ty = ty.and_then(|data| ElementText::decode(&data).ok());
        let type_name = ty.map(|ty| ty.text.text.to_string()).unwrap_or_default();
        let at = format!("element {} of {instance}", element.index_offset());
        let read = match ReadElement::new(element, length) {
            Ok(read) => read,
            Err(error) => {
                // At some offsets of the decoder functions are (SDA-12).
                let function = error.kind() == ErrorKind::Function;
                let found = format!("{length} bytes of {at}");
                probe.check("SDA-8", function, "no more bytes than a frame carries", found);
                return Ok(());
            }
        };
        let rules = ["SDA-8", "ADR-6"].map(Rule::from);
        let content = probe.ask_for(&rules, read)?;
        let found = format!("{} bytes of {at}", content.len());
        let sized = u32::try_from(content.len()) == Ok(length);
        probe.check("SDA-8", sized, format!("the {length} bytes it says to have"), found);
        if type_name == "BOOLEAN" {
            let bit = matches!(*content, [0 | 1]);
            let found = format!("{content:?} of {at}");
            probe.check(assumed("GEN-5"), bit, "a BOOLEAN of 0 or 1", found);
        }
        Ok(())
    })
}

fn content_by_index(probe: &mut Probe<'_>) -> Step {
    let ranks: Vec<(u8, Channel)> = (1_u8..).zip(probe.channels()?).collect();
    let mut still = Still::default();
    each(probe, |probe, instance, element| {
        let rank =
            ranks.iter().find(|(_, channel)| u32::from(channel.number()) == instance.channel);
        let (Some((rank, _)), false) = (rank, instance.class == Class::Spindle) else {
            return Ok(());
        };
        let group =
            ClassGroup { addressing: Addressing::Index, instance: *rank, ..element.class_group() };
        let by_index = ElementAddress::new(group, element.index_offset());
        let Some(length) = length_of(probe, element)? else { return Ok(()) };
        let (Ok(one), Ok(other)) =
            (ReadElement::new(element, length), ReadElement::new(by_index, length))
        else {
            return Ok(());
        };
        let rules = ["ADR-1", "ADR-12"].map(Rule::from);
        let what = format!("element {} of {instance}", element.index_offset());
        still.same(probe, &rules, &what, one, other.into())
    })?;
    still.finish()
}

fn read_lengths(probe: &mut Probe<'_>) -> Step {
    let all = probe.instances()?;
    let one = all.iter().find_map(|one| one.elements().next());
    let element = one.ok_or(Stop::NotApplicable("no instance has an element".to_owned()))?;
    let Some(length) = length_of(probe, element)? else { return Ok(()) };
    let requests: [Request<'_>; 2] =
        [ReadElementLength::new(element).into(), ReadElementWriteFlag::new(element).into()];
    let content = ReadElement::new(element, length).ok().map(Request::from);
    for request in requests.into_iter().chain(content) {
        let mut buf = [0; 0];
        let good = request.encode(&mut buf).map_err(harness)?;
        let bad = ads_cnc::operation::Call { read_length: 0, ..good };
        let what = format!("a read length of 0 for {}", request.function().spec().name);
        probe.refused(assumed("ADS-1"), &what, &bad, &good)?;
    }
    Ok(())
}
