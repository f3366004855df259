//! Cases of values: by handle and by name, whole and by element.

use ads_cnc::address::Channel;
use ads_cnc::operation::{ReadByHandle, ReadByName, Request};
use ads_cnc::{CncString, Description, Handle, Numbers, VariableType};

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::probe::Probe;
use super::variable::name_of;

/// The most elements of an array that are read one by one.
const ELEMENTS_MAX: usize = 64;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "val-whole-by-handle",
            "Without an index, a handle gives the whole variable, in its described size",
            ["VAR-8", "VAR-11", "VAR-14"],
            Queries,
            whole_by_handle
        ),
        declare!(
            "val-whole-by-name",
            "A name gives the same bytes as its handle",
            ["VAR-9", "VAR-14"],
            Queries,
            whole_by_name
        ),
        declare!(
            "val-elements-by-handle",
            "An index gives the element of that place in the whole array",
            ["VAR-11", "VAR-14", "VAR-21"],
            Queries,
            elements_by_handle
        ),
        declare!(
            "val-elements-by-name",
            "A name with [index] gives the same element as the handle",
            ["VAR-20"],
            Queries,
            elements_by_name
        ),
        declare!(
            "val-index-out-of-bounds",
            "An index that the array does not have is answered by an error",
            ["VAR-11", "VAR-20"],
            Queries,
            index_out_of_bounds
        ),
        declare!(
            "val-number-of-indices",
            "Neither too few nor too many indices address anything",
            ["VAR-11"],
            Queries,
            number_of_indices
        ),
        declare!(
            "val-string-size",
            "A text is no longer than one can be declared",
            ["VAR-25"],
            Queries,
            string_size
        ),
        declare!(
            "val-unknown-handle",
            "A handle nobody has is answered by an error",
            ["ADS-4", "VAR-10"],
            Queries,
            unknown_handle
        ),
    ]
}

fn data<'a>(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    request: impl Into<Request<'a>>,
) -> Step<Vec<u8>> {
    probe.ask(rule, request)
}

/// Every variable of every channel.
fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description) -> Step,
) -> Step {
    for channel in probe.channels()? {
        for variable in probe.variables(channel)? {
            judge(probe, channel, &variable)?;
        }
    }
    Ok(())
}

/// Every array whose elements have a size.
fn each_array(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, &Description, usize) -> Step,
) -> Step {
    let mut any = false;
    each(probe, |probe, channel, variable| {
        let size = variable.var_type.element_size().and_then(|size| usize::try_from(size).ok());
        match size {
            Some(size) if !variable.dimensions.is_empty() => {
                any = true;
                judge(probe, channel, variable, size)
            }
            _ => Ok(()),
        }
    })?;
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("no variable is an array".to_owned())),
    }
}

fn whole(channel: Channel, variable: &Description) -> ReadByHandle<'static> {
    ReadByHandle::new(channel, variable.handle, Numbers::EMPTY)
}

fn whole_by_handle(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, variable| {
        let value = data(probe, "VAR-11", whole(channel, variable))?;
        let name = &variable.name.text;
        let expected = "at most 2048 bytes";
        let found = format!("{} bytes of {name}", value.len());
        probe.check("VAR-14", value.len() <= 2048, expected, &found);
        if variable.var_type.element_size().is_some() {
            let same = u32::try_from(value.len()) == Ok(variable.size);
            let expected = format!("the {} bytes of its description", variable.size);
            probe.check("VAR-8", same, expected, found);
        }
        Ok(())
    })
}

fn whole_by_name(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, variable| {
        let name = name_of(variable);
        let before = data(probe, "VAR-14", whole(channel, variable))?;
        let by_name = data(probe, "VAR-9", ReadByName { channel, name })?;
        if by_name != before {
            // A machine moves: only a value that stands still can be compared.
            let after = data(probe, "VAR-14", whole(channel, variable))?;
            if after != before && after != by_name {
                return Err(Stop::Inconclusive(format!("{} does not stand still", name.text())));
            }
            data(probe, "VAR-9", ReadByName { channel, name })?;
        }
        let expected = format!("{before:02x?} as by handle");
        let found = format!("{by_name:02x?} of {}", name.text());
        probe.check("VAR-14", by_name == before, expected, found);
        Ok(())
    })
}

/// Places in an array, in row-major order: the last index runs fastest.
fn places(dimensions: &[u32]) -> impl Iterator<Item = Vec<u32>> + use<'_> {
    let mut next = Some(vec![0; dimensions.len()]);
    std::iter::from_fn(move || {
        let place = next.take()?;
        let mut following = place.clone();
        let axes = following.iter_mut().zip(dimensions).rev();
        for (index, &dimension) in axes {
            let index: &mut u32 = index;
            *index = index.saturating_add(1);
            if *index < dimension {
                next = Some(following);
                break;
            }
            *index = 0;
        }
        Some(place)
    })
}

/// The order in more dimensions is assumed; that of one is printed.
fn order(variable: &Description) -> Rule {
    if variable.dimensions.len() > 1 { assumed("VAR-21") } else { "VAR-14".into() }
}

fn elements_by_handle(probe: &mut Probe<'_>) -> Step {
    each_array(probe, |probe, channel, variable, size| {
        let value = data(probe, "VAR-11", whole(channel, variable))?;
        for (place, slice) in
            places(&variable.dimensions).zip(value.chunks(size)).take(ELEMENTS_MAX)
        {
            let request = ReadByHandle::new(channel, variable.handle, place.as_slice().into());
            let element = data(probe, "VAR-11", request)?;
            let name = &variable.name.text;
            let found = format!("{element:02x?} of {name} {place:?}");
            let sized = element.len() == size;
            probe.check("VAR-14", sized, format!("{size} bytes of one element"), &found);
            let expected = format!("{slice:02x?} as in the whole array");
            probe.check(order(variable), element == slice, expected, found);
        }
        Ok(())
    })
}

/// A variable's name with indices behind it.
fn element_name(variable: &Description, place: &[u32]) -> Step<CncString> {
    let mut name = variable.name.text.to_string();
    place.iter().for_each(|index| name.push_str(&format!("[{index}]")));
    name.parse().map_err(super::probe::harness)
}

fn elements_by_name(probe: &mut Probe<'_>) -> Step {
    each_array(probe, |probe, channel, variable, _| {
        for place in places(&variable.dimensions).take(ELEMENTS_MAX) {
            // More than one pair of brackets is assumed.
            let rule = if place.len() > 1 { assumed("VAR-20") } else { Rule::from("VAR-20") };
            let name = element_name(variable, &place)?;
            let by_handle = ReadByHandle::new(channel, variable.handle, place.as_slice().into());
            let by_handle = data(probe, rule, by_handle)?;
            let by_name = ReadByName { channel, name: name.as_cnc_str().into() };
            let by_name = data(probe, rule, by_name)?;
            let expected = format!("{by_handle:02x?} as by handle");
            let found = format!("{by_name:02x?} of {name}");
            probe.check(rule, by_name == by_handle, expected, found);
        }
        Ok(())
    })
}

fn index_out_of_bounds(probe: &mut Probe<'_>) -> Step {
    each_array(probe, |probe, channel, variable, _| {
        let first = vec![0; variable.dimensions.len()];
        for (axis, &dimension) in variable.dimensions.iter().enumerate() {
            for beyond in [dimension, u32::MAX] {
                let mut place = first.clone();
                if let Some(index) = place.get_mut(axis) {
                    *index = beyond;
                }
                let what = format!("{place:?} of {:?}", variable.dimensions);
                let (bad, good) = (place.as_slice().into(), first.as_slice().into());
                probe.refuses(
                    "VAR-11",
                    &what,
                    ReadByHandle::new(channel, variable.handle, bad),
                    ReadByHandle::new(channel, variable.handle, good),
                )?;
            }
            let mut place = first.clone();
            if let Some(index) = place.get_mut(axis) {
                *index = dimension;
            }
            let rule = if place.len() > 1 { assumed("VAR-20") } else { Rule::from("VAR-20") };
            let (bad, good) = (element_name(variable, &place)?, element_name(variable, &first)?);
            probe.refuses(
                rule,
                &format!("the name {bad}"),
                ReadByName { channel, name: bad.as_cnc_str().into() },
                ReadByName { channel, name: good.as_cnc_str().into() },
            )?;
        }
        Ok(())
    })
}

fn number_of_indices(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, variable| {
        let m = variable.dimensions.len();
        let zeros = vec![0; m.saturating_add(1)];
        for n in [m.saturating_sub(1), m.saturating_add(1)] {
            if n == 0 {
                continue;
            }
            let few = zeros.get(..n).unwrap_or_default();
            let good = zeros.get(..m).unwrap_or_default();
            probe.refuses(
                assumed("VAR-11"),
                &format!("{n} indices for {m} dimensions"),
                ReadByHandle::new(channel, variable.handle, few.into()),
                ReadByHandle::new(channel, variable.handle, good.into()),
            )?;
        }
        Ok(())
    })
}

fn string_size(probe: &mut Probe<'_>) -> Step {
    let mut any = false;
    each(probe, |probe, _, variable| {
        if variable.var_type == VariableType::STRING {
            any = true;
            let texts =
                variable.dimensions.iter().fold(1, |texts: u32, &n| texts.saturating_mul(n));
            let one = variable.size.checked_div(texts).unwrap_or(0);
            let found = format!("{one} bytes for each text of {}", variable.name.text);
            probe.check("VAR-25", (1..=800).contains(&one), "1 to 800 bytes", found);
        }
        Ok(())
    })?;
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("no variable is a STRING".to_owned())),
    }
}

fn unknown_handle(probe: &mut Probe<'_>) -> Step {
    let channel = probe.channel()?;
    let variables = probe.variables(channel)?;
    let known = variables.first().ok_or(Stop::Inconclusive("no variable".to_owned()))?;
    let taken = |number: u32| variables.iter().any(|variable| variable.handle.0 == number);
    for number in [0, 1, 0x7FFF_FFFF, u32::MAX].into_iter().filter(|&number| !taken(number)) {
        probe.refuses(
            "ADS-4",
            &format!("the handle {number:#x}"),
            ReadByHandle::new(channel, Handle(number), Numbers::EMPTY),
            whole(channel, known),
        )?;
    }
    probe.check("VAR-10", true, "", "");
    Ok(())
}
