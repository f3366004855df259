//! Cases of values: by handle and by name, whole and by element.

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByHandle, ReadByName, Request};
use ads_cnc::{Description, U32List, VariableType};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{
    Compared, Probe, Steady, brackets, compare, each_array, each_variable, element_name, name_of,
    order, part, places_tried, same,
};
use super::row::{CaseRow, case};
use crate::evidence::Evidence;
use crate::judge::{Checks as _, Needs, Rule, Step};
use crate::rules::element_count;
use crate::text::hex::spaced;
use crate::text::plural;
use crate::value_format::{ValueFormat, type_by_name};

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("val-whole-by-handle", &[VAR_8, VAR_11, VAR_14], Needs::Queries, whole_by_handle,
        "Without an index, a handle returns the whole variable in its described size"),
    case("val-whole-by-name", &[VAR_9, VAR_14], Needs::Queries, whole_by_name,
        "A name returns the same bytes as its handle"),
    case("val-elements-by-handle", &[VAR_11, VAR_14, VAR_21], Needs::Queries, elements_by_handle,
        "A handle with an index returns the element at that position of the whole array"),
    case("val-elements-by-name", &[VAR_14, VAR_20], Needs::Queries, elements_by_name,
        "A name with [index] returns the same element as the handle"),
    case("val-string-size", &[VAR_25], Needs::Queries, string_size,
        "A text is at most as long as the maximum that can be declared"),
];

/// Compares the value that `request` reads with what `part` extracts from the value of the whole
/// variable.
fn compare_with_whole<'r>(
    steady: &mut Steady,
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    (channel, variable): (Channel, &Description),
    request: impl Into<Request<'r>>,
    part: impl Fn(&[u8]) -> Vec<u8>,
) -> Step {
    let (request, name) = (request.into(), &variable.name.text);
    let compared = compare(
        probe,
        |probe| probe.ask(VAR_14, whole(channel, variable)).map(Some),
        |probe, _| probe.try_ask(request),
        |whole, read| part(whole) == *read,
    )?;
    steady.judge(probe, rule.into(), name, compared, |probe, rules, (whole, read, evidence)| {
        let expected = part(&whole);
        let dimensions: &[u32] = if expected == whole { &variable.dimensions } else { &[] };
        let values = value_type(variable, dimensions);
        probe.set_evidence(evidence.map(|evidence| Evidence { values, ..*evidence }));
        let words = || format!("{} in the whole value of {name}", spaced(&expected));
        probe.check_reply(rules, false, &expected, words, || Hex(read));
    });
    Ok(())
}

/// The format of a variable's value, for the report.
fn value_type(variable: &Description, dimensions: &[u32]) -> ValueFormat {
    let ty = variable.var_type.name().and_then(|name| type_by_name(name).ok());
    ValueFormat { ty, dimensions: dimensions.to_vec() }
}

fn whole(channel: Channel, variable: &Description) -> ReadByHandle<'static> {
    ReadByHandle::new(channel, variable.handle, U32List::EMPTY)
}

fn whole_by_handle(probe: &mut Probe<'_>) -> Step {
    each_variable(probe, |probe, channel, variable| {
        let value = probe.ask(VAR_11, whole(channel, variable))?;
        let name = &variable.name.text;
        let expected = "at most 2048 bytes";
        let found = || format!("{} of {name}", plural(value.len(), "byte"));
        probe.check(VAR_14, value.len() <= 2048, expected, found);
        if variable.var_type.element_size().is_some() {
            let same = u32::try_from(value.len()) == Ok(variable.size);
            let expected = || format!("the {} of its description", plural(variable.size, "byte"));
            probe.check([VAR_8, VAR_14], same, expected, found);
        }
        Ok(())
    })
}

fn whole_by_name(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    each_variable(probe, |probe, channel, variable| {
        let request = ReadByName { channel, name: name_of(variable) };
        if variable.var_type.element_size().is_some()
            && let Some(value) = probe.try_ask(request)?
        {
            let same = u32::try_from(value.len()) == Ok(variable.size);
            let expected = || format!("the {} of its description", plural(variable.size, "byte"));
            let found = || format!("{} of {}", plural(value.len(), "byte"), variable.name.text);
            probe.check(VAR_14, same, expected, found);
        }
        let at = (channel, variable);
        compare_with_whole(&mut steady, probe, VAR_9, at, request, <[u8]>::to_vec)
    })?;
    steady.finish()
}

fn elements_by_handle(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    each_array(probe, |probe, channel, variable, size| {
        for (number, place) in places_tried(&variable.dimensions) {
            let indices = place.as_slice();
            let request = ReadByHandle::new(channel, variable.handle, indices);
            if variable.var_type.element_size().is_some() {
                let element = probe.ask(VAR_11, request)?;
                let found = || {
                    format!("{} of {} {place:?}", plural(element.len(), "byte"), variable.name.text)
                };
                let sized = element.len() == size;
                probe.check(
                    VAR_14,
                    sized,
                    || format!("{} of one element", plural(size, "byte")),
                    found,
                );
            }
            if let ([_], VariableType::STRING) = (&place[..], variable.var_type) {
                text_by_name(probe, channel, variable, &place)?;
            }
            let (at, part) = ((channel, variable), part(number, size));
            compare_with_whole(&mut steady, probe, order(variable), at, request, part)?;
        }
        Ok(())
    })?;
    steady.finish()
}

/// Checks that an index selects the same text of an array by handle and by name, whatever the
/// layout of the array.
fn text_by_name(
    probe: &mut Probe<'_>,
    channel: Channel,
    variable: &Description,
    place: &[u32],
) -> Step {
    let Some(name) = element_name(variable, place)? else { return Ok(()) };
    let by_name = ReadByName { channel, name: name.as_cnc_str().into() };
    let by_handle = ReadByHandle::new(channel, variable.handle, place);
    let compared = compare(
        probe,
        |probe| probe.try_ask(by_name),
        |probe, _| probe.try_ask(by_handle),
        |named, handled| same(handled, named, true),
    )?;
    match compared {
        Compared::Same => probe.pass(VAR_11),
        Compared::Differs(named, handled, _) => {
            let expected = || format!("{} of {name}, also by handle", Hex(named));
            probe.check(VAR_11, false, expected, || Hex(handled));
        }
        Compared::NoValue | Compared::NoReply | Compared::Moved => {}
    }
    Ok(())
}

fn elements_by_name(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    each_array(probe, |probe, channel, variable, size| {
        for (number, place) in places_tried(&variable.dimensions) {
            let Some(name) = element_name(variable, &place)? else { continue };
            let request = ReadByName { channel, name: name.as_cnc_str().into() };
            if variable.var_type.element_size().is_some()
                && let Some(element) = probe.try_ask(request)?
            {
                let found = || format!("{} of {name}", plural(element.len(), "byte"));
                let sized = element.len() == size;
                probe.check(
                    VAR_14,
                    sized,
                    || format!("{} of one element", plural(size, "byte")),
                    found,
                );
            }
            let (at, part) = ((channel, variable), part(number, size));
            compare_with_whole(&mut steady, probe, brackets(variable), at, request, part)?;
        }
        Ok(())
    })?;
    steady.finish()
}

fn string_size(probe: &mut Probe<'_>) -> Step {
    each_variable(probe, |probe, _, variable| {
        if variable.var_type == VariableType::STRING {
            let texts = element_count(&variable.dimensions);
            let one = variable.size.checked_div(texts).unwrap_or(0);
            let found =
                || format!("{} for each text of {}", plural(one, "byte"), variable.name.text);
            probe.check(VAR_25, (1..=800).contains(&one), "1 to 800 bytes", found);
        }
        Ok(())
    })?;
    probe.finish("no variable is a STRING")
}
