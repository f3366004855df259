//! Cases of the elements of SDA and GEO: their number, attributes and contents.

use std::collections::HashSet;

use ads_cnc::address::{Class, ElementAddress};
use ads_cnc::operation::{
    CountElements, ReadElement, ReadElementLength, ReadElementName, ReadElementType,
    ReadElementUnit, ReadElementWriteFlag, Request,
};
use ads_cnc::sda::{ElementLength, ElementText, ElementWriteFlag};
use ads_cnc::{Decode, ErrorKind};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::kit::{Instance, OF_PLACES, Probe, RawCall, Steady, attribute_reads, element_by_rank};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, OrStop as _, Step, assumed};
use crate::objects::decode_element_count;
use crate::rules::{check_length, check_type};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("sda-elements", &[SDA_4, ADR_2, ADR_6, ADR_7], Needs::Queries, elements,
        "The first element has the element count and the name of the instance; the list then ends"),
    case("sda-first-element", &[SDA_4, SDA_8], Needs::Queries, first_element,
        "The first element has all attributes, and its length is that of the element count"),
    case("sda-attributes", &[SDA_4, SDA_6, SDA_7, SDA_8, SDA_9, ADR_6, GEN_3, GEN_5],
        Needs::Queries, attributes,
        "Every element has a valid name, type, length, unit and write flag"),
    case("sda-content", &[SDA_8, ADR_6, GEN_5], Needs::Queries, content,
        "The content of an element has the element's length; a BOOLEAN is 0 or 1"),
    case("sda-content-by-index", &[ADR_1, ADR_12], Needs::Queries, content_by_index,
        "An element has the same content and attributes by the channel's number and rank"),
    case("sda-read-lengths", &[ADS_1], Needs::Malformed, read_lengths,
        "A read length shorter than the reply returns an error"),
];

/// Reads an attribute of an element. A valid reply passes `rule` and the requirement on the index
/// group of the attribute; any other reply fails `rule` and ends the case.
/// ADR-6
fn attribute<T>(
    probe: &mut Probe<'_>,
    rule: ClauseId,
    request: impl Into<Request<'static>>,
) -> Step<T>
where
    T: for<'b> Decode<'b>,
{
    let value = probe.read(rule, request)?;
    probe.pass(ADR_6);
    Ok(value)
}

fn elements(probe: &mut Probe<'_>) -> Step {
    let mut names = HashSet::new();
    let (mut alone, mut with_first) = (None, None);
    for instance in probe.instances()? {
        let first = instance.first;
        // If the request fails, the part of the address that selects the instance may be wrong: the
        // group of a spindle (ADR-2), or the offset of an axis (ADR-7).
        let of_address: &[ClauseId] = match instance.class {
            Class::Spindle => &[SDA_4, ADR_2],
            class if instance.axis > 0 && OF_PLACES.contains(&class) => &[SDA_4, ADR_7],
            _ => &[SDA_4],
        };
        let data = probe.ask(of_address, CountElements::new(first)?)?;
        probe.pass(of_address);
        probe.pass(ADR_6);
        let found = || format!("{} for the number of {instance}", plural(data.len(), "byte"));
        probe.check(assumed(SDA_4), data.len() == 4, "a number of 4 bytes", found);
        let reported = decode_element_count(&data);
        probe.check(SDA_4, reported.is_some(), "a number", found);
        let same = reported == Some(instance.reported);
        let found = || match reported {
            Some(number) => format!("{} of {instance}", plural(number, "element")),
            None => format!("no number of elements of {instance}"),
        };
        probe.check(SDA_4, same, || format!("{}, as before", instance.reported), found);
        let count = instance.count;
        match (instance.counts_itself(), instance.reported) {
            (true, _) => with_first = Some((instance.to_string(), probe.evidence())),
            (false, 1..) => alone = Some(instance.to_string()),
            (false, 0) => {}
        }
        let found = || format!("{} of {instance}", plural(count, "element"));
        probe.check(SDA_4, count <= 0xFFFF, "at most the number that fits into an offset", found);
        let name: ElementText = attribute(probe, SDA_4, ReadElementName::new(first))?;
        let name = name.text.text.to_string();
        let found = || format!("{name:?} of {instance}");
        // The name of an instance is not specified at an axis index without an axis, nor if the
        // instance has only element 0.
        let is_bare = count == 0 || probe.is_at_empty_place(&instance);
        let rule = if is_bare { assumed(SDA_4) } else { SDA_4.into() };
        probe.check(rule, !name.is_empty(), "the name of the instance", found);
        // The HLDs of several channels may have the same platform axes, so names are compared only
        // within a channel.
        let is_new = names.insert((instance.channel, name.clone()));
        probe.check(assumed(SDA_4), is_new, "a name that no other instance has", found);
        ends(probe, &instance, count)?;
    }
    // It is assumed that the number of elements does not include element 0, but all instances must
    // count alike.
    if let Some((with_first, evidence)) = with_first {
        probe.set_evidence(evidence);
        let found = || format!("one more element for {with_first}");
        let rule = if alone.is_some() { SDA_4.into() } else { assumed(SDA_4) };
        let like = alone.map(|alone| format!(", as for {alone}")).unwrap_or_default();
        probe.check(rule, false, || format!("the number of elements after the first{like}"), found);
    }
    Ok(())
}

/// Checks that element `count`, the last one, has a name, and that no element follows it.
fn ends(probe: &mut Probe<'_>, instance: &Instance, count: u32) -> Step {
    let (last, beyond) = (instance.first.nth(count), instance.first.nth(count.saturating_add(1)));
    let (Ok(last), Ok(beyond)) = (last, beyond) else { return Ok(()) };
    if count > 0 {
        attribute::<ElementText>(probe, SDA_4, ReadElementName::new(last))?;
    }
    let at_place = OF_PLACES.contains(&instance.class) && instance.axis > 0;
    // At an axis index without an axis, the number of elements may be 0, because all contents may
    // be zero there.
    let rule = if at_place && count == 0 { assumed(SDA_4) } else { SDA_4.into() };
    let what = format!("element {} of {instance}, which has {count}", beyond.index_offset());
    for (beyond, last) in attribute_reads(beyond).into_iter().zip(attribute_reads(last)) {
        // If the instance has only element 0, this element need not have all attributes.
        if count > 0 || probe.try_ask(last)?.is_some() {
            probe.rejects(rule, &what, beyond, last)?;
        }
    }
    // Contents of the decoder are not judged: some of its offsets are functions, and not all of
    // these functions are documented.
    let Some(length) = probe.length_of(last)?.filter(|_| instance.class != Class::Decoder) else {
        return Ok(());
    };
    let (Ok(beyond), Ok(last)) = (ReadElement::new(beyond, length), ReadElement::new(last, length))
    else {
        return Ok(());
    };
    match count {
        0 => Ok(()),
        _ => probe.rejects(rule, &what, beyond, last),
    }
}

fn first_element(probe: &mut Probe<'_>) -> Step {
    for instance in probe.instances()? {
        let first = instance.first;
        let number = probe.try_ask(CountElements::new(first)?)?;
        let Some(number) = number else { continue };
        let length = probe.try_ask(ReadElementLength::new(first))?;
        probe.check(assumed(SDA_4), length.is_some(), "a length of the number", "an error");
        let length = length.and_then(|data| ElementLength::decode(&data).ok());
        if let Some(length) = length {
            let same = u32::try_from(number.len()) == Ok(length.get());
            let found = || format!("a length of {} for element 0 of {instance}", length.get());
            let expected = || format!("the {} of the number", plural(number.len(), "byte"));
            probe.check(SDA_8, same, expected, found);
        }
        let requests: [Request<'_>; 3] = [
            ReadElementType::new(first).into(),
            ReadElementUnit::new(first).into(),
            ReadElementWriteFlag::new(first).into(),
        ];
        for request in requests {
            let answered = probe.try_ask(request)?.is_some();
            let expected = || format!("{} of element 0", request.function().spec().name);
            probe.check(assumed(SDA_4), answered, expected, "an error");
        }
    }
    Ok(())
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
    let (mut types, mut known) = (0_usize, 0_usize);
    for instance in probe.instances()? {
        let of_instance = probe.try_read::<ElementText>(ReadElementName::new(instance.first))?;
        let mut units = Vec::new();
        for element in instance.elements() {
            let (is_known, unit) = attributes_of(probe, &instance, of_instance.as_ref(), element)?;
            types = types.saturating_add(1);
            known = known.saturating_add(usize::from(is_known));
            units.push((element, unit));
        }
        // Reads of other elements must not change a unit.
        for (element, unit) in units.iter().rev() {
            let again = probe.try_read::<ElementText>(ReadElementUnit::new(*element))?;
            let same = again.is_none_or(|again| again.text.text == unit.text.text);
            let found =
                || format!("another unit of element {} of {instance}", element.index_offset());
            probe.check(SDA_6, same, "the unit as before", found);
        }
    }
    // If no element has a known type, the texts are wrong (SDA-6) rather than the types.
    let found = || format!("{}, none of the manual", plural(types, "type"));
    probe.check(SDA_6, types == 0 || known > 0, "texts", found);
    Ok(())
}

fn attributes_of(
    probe: &mut Probe<'_>,
    instance: &Instance,
    of_instance: Option<&ElementText>,
    element: ElementAddress,
) -> Step<(bool, ElementText)> {
    let text = |text: &ElementText| text.text.text.to_string();
    let name: ElementText = attribute(probe, SDA_6, ReadElementName::new(element))?;
    let at = format!("element {} of {instance}", element.index_offset());
    let found = || format!("{:?} of {at}", text(&name));
    probe.check(SDA_6, !text(&name).is_empty(), "a name", found);
    let is_own = of_instance.is_none_or(|of_instance| text(of_instance) != text(&name));
    probe.check(
        SDA_4,
        is_own,
        "a name other than that of element 0, which is the instance's",
        found,
    );
    let of_name = probe.evidence();
    let ty: ElementText = attribute(probe, SDA_7, ReadElementType::new(element))?;
    let of_type = probe.evidence();
    let length: ElementLength = attribute(probe, SDA_8, ReadElementLength::new(element))?;
    let of_length = probe.evidence();
    let unit: ElementText = attribute(probe, SDA_6, ReadElementUnit::new(element))?;
    let of_unit = probe.evidence();
    let flag = probe.try_ask(ReadElementWriteFlag::new(element))?;
    probe.check(ADR_6, flag.is_some(), || format!("a write flag of {at}"), "an error");
    let flag: ElementWriteFlag = attribute(probe, SDA_9, ReadElementWriteFlag::new(element))?;
    let found = || format!("{} of {at}", flag.0);
    probe.check(assumed(SDA_9), flag.0 <= 1, "a write flag of 0 or 1", found);
    for (one, evidence) in [(&name, of_name), (&unit, of_unit), (&ty, of_type.clone())] {
        probe.set_evidence(evidence);
        let found = || format!("{:?} of {at}", text(one));
        let is_string = !text(one).chars().any(|char| char.is_ascii_control());
        probe.check(SDA_6, is_string, "a string", found);
        let readable = !text(one).chars().any(char::is_control);
        let found = || format!("{:?} of {at}", text(one));
        probe.check(assumed(GEN_3), readable, "CP1252 characters", found);
    }
    probe.set_evidence(of_type);
    let data_type = check_type(probe, &text(&ty), &at);
    probe.set_evidence(of_length);
    check_length(probe, data_type, length.get(), &at);
    Ok((data_type.is_some(), unit))
}

fn content(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, instance, element| {
        let Some(length) = probe.length_of(element)? else { return Ok(()) };
        let ty = probe.try_read::<ElementText>(ReadElementType::new(element))?;
        let type_name = ty.map(|ty| ty.text.text.to_string()).unwrap_or_default();
        let at = format!("element {} of {instance}", element.index_offset());
        let read = match ReadElement::new(element, length) {
            Ok(read) => read,
            Err(error) => {
                // Some offsets of the decoder are functions (SDA-12).
                let function = error.kind() == ErrorKind::Function;
                let found = || format!("{} of {at}", plural(length, "byte"));
                probe.check(
                    SDA_8,
                    function,
                    "at most the number of bytes that fits into a frame",
                    found,
                );
                return Ok(());
            }
        };
        let content = probe.ask([SDA_8, ADR_6], read)?;
        let found = || format!("{} of {at}", plural(content.len(), "byte"));
        let sized = u32::try_from(content.len()) == Ok(length);
        probe.check(
            SDA_8,
            sized,
            || format!("the {} of its length attribute", plural(length, "byte")),
            found,
        );
        if type_name == "BOOLEAN" {
            let bit = matches!(*content, [0 | 1]);
            let found = || format!("{content:?} of {at}");
            probe.check(assumed(GEN_5), bit, "a BOOLEAN of 0 or 1", found);
        }
        // A longer read may be rejected, but must not return more data.
        if let Ok(longer) = ReadElement::new(element, length.saturating_add(1))
            && let Some(content) = probe.try_ask(longer)?
        {
            let found = || format!("{} for a longer read", plural(content.len(), "byte"));
            let fits = u32::try_from(content.len()).is_ok_and(|len| len <= length);
            probe.check(
                SDA_8,
                fits,
                || format!("at most the {} of {at}", plural(length, "byte")),
                found,
            );
        }
        Ok(())
    })
}

fn content_by_index(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    each(probe, |probe, instance, element| {
        let rank = probe.rank_of(instance.channel).filter(|_| instance.class != Class::Spindle);
        let Some(rank) = rank else { return Ok(()) };
        let by_index = element_by_rank(element, rank);
        let Some(length) = probe.length_of(element)? else { return Ok(()) };
        let what = format!("element {} of {instance}", element.index_offset());
        let pairs = attribute_reads(element).into_iter().zip(attribute_reads(by_index));
        for (one, other) in pairs {
            let what = format!("{} of {what}", one.function().spec().name);
            steady.by_index(probe, ADR_1, what, one, other)?;
        }
        match (ReadElement::new(element, length), ReadElement::new(by_index, length)) {
            (Ok(one), Ok(other)) => steady.by_index(probe, ADR_1, what, one, other),
            _ => Ok(()),
        }
    })?;
    steady.finish()
}

fn read_lengths(probe: &mut Probe<'_>) -> Step {
    let all = probe.instances()?;
    let one = all.iter().find_map(|one| one.elements().next());
    let element = one.or_not_applicable("no instance has an element")?;
    let Some(length) = probe.length_of(element)? else { return Ok(()) };
    let requests: [Request<'_>; 2] =
        [ReadElementLength::new(element).into(), ReadElementWriteFlag::new(element).into()];
    let content = ReadElement::new(element, length).ok().map(Request::from);
    for request in requests.into_iter().chain(content) {
        let valid = RawCall::new(request)?;
        let invalid = valid.with(|call| call.read_length = 0);
        let what = format!("a read length of 0 for {}", request.function().spec().name);
        probe.rejects(assumed(ADS_1), &what, invalid, &valid)?;
    }
    Ok(())
}
