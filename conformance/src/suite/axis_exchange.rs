//! Cases that exchange axes.

use ads_cnc::address::{AxisStride, Channel, ChannelAxis, Class};
use ads_cnc::operation::{AxisHandleByName, ReadElement, Request};
use ads_cnc_vectors::ids::*;

use super::kit::{OF_PLACES, Probe};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, Stop};
use crate::objects::List;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("axis-exchange", &[ADR_13, SDA_13, VAR_10], Needs::Simulator, exchange,
        "An axis takes its values along to another place; the platform's place stays"),
];

/// A content, if it did not change by itself: an axis may move at any time.
type Content = Option<Vec<u8>>;

/// A content that is the same when it is read again.
fn steady_content<'r>(probe: &mut Probe<'_>, read: impl Into<Request<'r>>) -> Step<Content> {
    let read = read.into();
    let first = probe.ask(ADR_13, read)?;
    Ok(Some(first.clone()).filter(|_| probe.try_ask(read).is_ok_and(|now| now == Some(first))))
}

/// Whether all contents that were steady both times are the same; `None` without one.
fn are_same(before: &[Content], after: &[Content]) -> Option<bool> {
    let both = before.iter().zip(after).filter_map(|(one, other)| one.as_ref().zip(other.as_ref()));
    let same: Vec<bool> = both.map(|(one, other)| one == other).collect();
    let judged = before.is_empty() || !same.is_empty();
    judged.then(|| before.len() == after.len() && same.iter().all(|same| *same))
}

/// The contents of all readable elements of instances.
fn contents(
    probe: &mut Probe<'_>,
    classes: &[Class],
    channel: u32,
    axis: u32,
) -> Step<Vec<Content>> {
    let mut all = Vec::new();
    for instance in probe.instances()? {
        if !classes.contains(&instance.class)
            || (instance.channel, instance.axis) != (channel, axis)
        {
            continue;
        }
        for element in instance.elements() {
            let Some(length) = probe.length_of(element)? else { continue };
            let Ok(read) = ReadElement::new(element, length) else { continue };
            all.push(steady_content(probe, read)?);
        }
    }
    Ok(all)
}

/// The contents of the objects of a list for an axis, by the stride of the simulated CNC; of all
/// without an axis.
fn objects(probe: &mut Probe<'_>, list: List, axis: Option<u32>) -> Step<Vec<Content>> {
    let mut all = Vec::new();
    for object in probe.objects()?.into_iter().filter(|object| object.list == list) {
        let offset = object.address.content().map(|(_, offset)| offset);
        let split = offset.and_then(|offset| offset.axis_and_element(AxisStride::X10000).ok());
        let at = split.map_or(0, |(axis, _)| axis);
        let (true, Ok(read)) = (axis.is_none_or(|axis| axis == at), object.address.read()) else {
            continue;
        };
        all.push(steady_content(probe, read)?);
    }
    Ok(all)
}

const OF_PLATFORM: [Class; 2] = [Class::PositionController, Class::Hld];

/// In the default model the second place of channel 1 has the axis 2, the third the axis 3.
fn exchange(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    if (cnc.axis_at(1, 2), cnc.axis_at(1, 3)) != (2, 3) {
        return Err(Stop::not_applicable(
            "the places 2 and 3 of channel 1 have not the axes 2 and 3",
        ));
    }
    let places = |probe: &mut Probe<'_>, place| -> Step<Vec<Content>> {
        let mut all = contents(probe, &OF_PLACES, 1, place)?;
        let list = probe.list_of(1)?;
        all.extend(objects(probe, list, Some(place))?);
        Ok(all)
    };
    let platform = |probe: &mut Probe<'_>| -> Step<Vec<Content>> {
        let mut all = contents(probe, &OF_PLATFORM, 0, 2)?;
        all.extend(contents(probe, &OF_PLATFORM, 0, 3)?);
        all.extend(contents(probe, &[Class::Hld], 1, 3)?);
        for place in [2, 3_u8] {
            let list = List::Axis(place);
            all.extend(objects(probe, list, None)?);
        }
        Ok(all)
    };
    let handle_of = |probe: &mut Probe<'_>| {
        let (channel, axis) = (Channel::new(1)?, ChannelAxis::new(2)?);
        probe.try_ask(AxisHandleByName::new(channel, axis, "V.A.WCS")?)
    };
    let (before, of_platform, handle) = (places(probe, 3)?, platform(probe)?, handle_of(probe)?);
    if cnc.exchange_axis(1, 2, 3).is_err() {
        return Err(Stop::not_applicable("channel 1 has no axis 3 to be exchanged"));
    }
    let after = (places(probe, 2), places(probe, 3), platform(probe), handle_of(probe));
    // In an order without conflicts.
    cnc.exchange_axis(1, 2, 2).and_then(|()| cnc.exchange_axis(1, 3, 3))?;
    let (second, third, platform_after, handle_after) = after;
    if let Some(moved) = are_same(&before, &second?) {
        probe.check(ADR_13, moved, "the values of axis 3 at place 2 now", "others");
    }
    let blank = third?.iter().flatten().flatten().all(|&byte| byte == 0);
    probe.check(ADR_13, blank, "nothing at place 3 any more", "values");
    let platform_after = platform_after?;
    let same = are_same(&of_platform, &platform_after);
    for (rule, same) in [ADR_13, SDA_13].into_iter().filter_map(|rule| Some((rule, same?))) {
        probe.check(rule, same, "the platform's axes where they were", "others");
    }
    let handle_after = handle_after?;
    let (same, expected) = (
        handle_after.is_some() && handle_after == handle,
        "the handle of the place, whichever axis is there",
    );
    probe.check(VAR_10, same, expected, "another");
    match are_same(&before, &places(probe, 3)?) {
        Some(back) => probe.require(ADR_13, back, "axis 3 at place 3 again", "others"),
        None => Err(Stop::inconclusive("no axis stands still")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_still_is_held_against_each_other() {
        let still = |byte: u8| Some(vec![byte]);
        assert_eq!(are_same(&[still(1), None], &[still(1), still(2)]), Some(true));
        assert_eq!(are_same(&[still(1), None], &[still(2), None]), Some(false));
        assert_eq!(are_same(&[still(1)], &[still(1), still(2)]), Some(false));
        assert_eq!(are_same(&[None, still(1)], &[still(1), None]), None);
        assert_eq!(are_same(&[], &[]), Some(true));
    }
}
