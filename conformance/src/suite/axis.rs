//! Cases of the axis interface, and of axes that change their place.

use std::collections::HashMap;

use ads_cnc::address::{Channel, ChannelAxis, Class};
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, Call, ReadByHandle, ReadByName, ReadElement, Request,
};
use ads_cnc::{CncString, Decode as _, Description, Handle, Kind, Numbers, TextRef, VariablePath};
use ads_cnc_vectors::Hex;

use super::case::{Case, Step, Stop, assumed};
use super::declare;
use super::inventory::OF_PLACES;
use super::probe::{Probe, harness};
use super::sda::length_of;
use super::still::Still;
use super::variable::name_of;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "axis-handles",
            "On the axis interface a name has the handle that its place is described with",
            ["VAR-10", "VAR-26"],
            Queries,
            handles
        ),
        declare!(
            "axis-values",
            "On the axis interface a name reads what it reads with the axis behind it",
            ["VAR-10", "VAR-26"],
            Queries,
            values
        ),
        declare!(
            "axis-unknown",
            "What no axis has is answered by an error on the axis interface",
            ["VAR-26", "ADS-4"],
            Queries,
            unknown
        ),
        declare!(
            "axis-zero",
            "At axis 0 the offsets of the axis interface are other functions",
            ["VAR-26"],
            Malformed,
            zero
        ),
        declare!(
            "axis-exchange",
            "An axis takes its values along to another place; the platform's place stays",
            ["ADR-13", "SDA-13", "VAR-10"],
            Embedded,
            exchange
        ),
    ]
}

/// The most places of a channel that are looked at.
const PLACES_MAX: u32 = 64;

/// The axis variables of a channel as described, with their names on the axis interface.
pub(super) fn described(
    probe: &mut Probe<'_>,
    channel: Channel,
) -> Step<Vec<(CncString, Description)>> {
    let all = probe.variables(channel)?;
    let of_axes = all.into_iter().filter_map(|variable| {
        let path = VariablePath::from_text(variable.name.text.as_cnc_str()).ok()?;
        if path.kind() != Kind::V_A {
            return None;
        }
        path.axis()?;
        Some((path.without_axis().ok()?, variable))
    });
    Ok(of_axes.collect())
}

/// Each place of each channel at which a variable with this name answers: with its handle.
fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, At<'_>, &Description) -> Step,
) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        let described = described(probe, channel)?;
        let by_handle: HashMap<u32, &(CncString, Description)> =
            described.iter().map(|one| (one.1.handle.0, one)).collect();
        for place in 1..=PLACES_MAX {
            let axis = ChannelAxis::new(place).map_err(harness)?;
            let mut answered = false;
            for name in names(&described) {
                let request = AxisHandleByName { channel, axis, name: name.as_cnc_str().into() };
                let Some(data) = probe.try_ask(request)? else { continue };
                answered = true;
                let Ok(handle) = Handle::decode(&data) else { continue };
                // Where no axis is nothing is described.
                let Some((own, variable)) = by_handle.get(&handle.0) else { continue };
                any = true;
                let at = At { channel, axis, name, own };
                judge(probe, at, variable)?;
            }
            if !answered {
                break;
            }
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("the target describes no axis variable".to_owned())),
    }
}

pub(super) fn names(described: &[(CncString, Description)]) -> Vec<&CncString> {
    let mut names: Vec<&CncString> = described.iter().map(|(name, _)| name).collect();
    names.sort_by_key(|name| name.as_bytes());
    names.dedup();
    names
}

/// A variable on the axis interface.
struct At<'a> {
    channel: Channel,
    axis: ChannelAxis,
    /// The name it was asked for by.
    name: &'a CncString,
    /// The name of what the handle describes.
    own: &'a CncString,
}

impl std::fmt::Display for At<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of place {}", self.name, self.axis.place())
    }
}

fn handles(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let described = described(probe, channel)?;
        let first = ChannelAxis::new(1).map_err(harness)?;
        // An axis is at one place at least of a channel that describes one.
        let mut any = described.is_empty();
        for place in 1..=PLACES_MAX {
            let axis = ChannelAxis::new(place).map_err(harness)?;
            for name in names(&described) {
                let request = AxisHandleByName { channel, axis, name: name.as_cnc_str().into() };
                let Some(data) = probe.try_ask(request)? else { continue };
                any = true;
                let handle = Handle::decode(&data);
                let found = format!("{} for {name} of place {place}", Hex(data));
                probe.check("VAR-26", handle.is_ok(), "a handle of 4 bytes", found);
            }
            if !any && axis != first {
                break;
            }
        }
        let found = format!("none answers in channel {}", channel.number());
        probe.check("VAR-26", any, "handles by name on the axis interface", found);
    }
    each(probe, |probe, at, variable| {
        let found = format!("that of {} for {at}", variable.name.text);
        let same = at.own == at.name;
        probe.check("VAR-26", same, format!("the handle of a {}", at.name), &found);
        probe.check("VAR-10", same, "a handle of this variable", found);
        Ok(())
    })
}

fn values(probe: &mut Probe<'_>) -> Step {
    let mut still = Still::default();
    each(probe, |probe, at, variable| {
        let At { channel, axis, name, .. } = at;
        let request = AxisReadByName { channel, axis, name: name.as_cnc_str().into() };
        let value = probe.ask("VAR-26", request)?;
        if variable.var_type.element_size().is_some() {
            let sized = u32::try_from(value.len()) == Ok(variable.size);
            let found = format!("{} bytes of {at}", value.len());
            probe.check("VAR-26", sized, format!("its {} bytes", variable.size), found);
        }
        let what = at.to_string();
        let by_name = ReadByName { channel, name: name_of(variable) };
        still.same_part(
            probe,
            &["VAR-26".into()],
            &what,
            by_name.into(),
            request.into(),
            <[u8]>::to_vec,
        )?;
        // That handles of this interface are used there is assumed.
        let by_handle = ReadByHandle::new(channel, variable.handle, Numbers::EMPTY);
        let rules = [assumed("VAR-10")];
        still.same_part(probe, &rules, &what, by_handle.into(), request.into(), <[u8]>::to_vec)
    })?;
    still.finish()
}

fn unknown(probe: &mut Probe<'_>) -> Step {
    let mut first = None;
    each(probe, |_, at, variable| {
        first.get_or_insert((at.channel, at.axis, at.name.clone(), variable.clone()));
        Ok(())
    })?;
    let Some((channel, axis, name, variable)) = first else { return Ok(()) };
    let good = TextRef::from(name.as_cnc_str());
    let handle = |axis, name| AxisHandleByName { channel, axis, name };
    let read = |axis, name| AxisReadByName { channel, axis, name };
    for unknown in ["V.A.no such variable", "V.A.", ""] {
        let (what, bad) =
            (format!("the name {unknown:?}"), TextRef::new(unknown).map_err(harness)?);
        probe.refuses("ADS-4", &what, handle(axis, bad), handle(axis, good))?;
        probe.refuses("ADS-4", &what, read(axis, bad), read(axis, good))?;
    }
    // Names carry no axis there.
    let with_axis = name_of(&variable);
    let what = format!("{} on the axis interface", variable.name.text);
    probe.refuses("VAR-26", &what, handle(axis, with_axis), handle(axis, good))?;
    probe.refuses("VAR-26", &what, read(axis, with_axis), read(axis, good))?;
    let far = ChannelAxis::new(0xFFFF).map_err(harness)?;
    let what = "a place that no channel has";
    probe.refuses("VAR-26", what, handle(far, good), handle(axis, good))?;
    probe.refuses("VAR-26", what, read(far, good), read(axis, good))
}

fn zero(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, at, _| {
        let At { channel, axis, name, .. } = at;
        let name = TextRef::from(name.as_cnc_str());
        let requests: [Request<'_>; 2] = [
            AxisHandleByName { channel, axis, name }.into(),
            AxisReadByName { channel, axis, name }.into(),
        ];
        for request in requests {
            let mut buf = [0; 256];
            let good = request.encode(&mut buf).map_err(harness)?;
            let offset = good.index_offset.get() & 0xFFFF;
            let bad = Call { index_offset: ads_cnc::address::IndexOffset::new(offset), ..good };
            let what = format!("a name at offset {offset:#x}, without an axis");
            probe.refused("VAR-26", &what, &bad, &good)?;
        }
        Ok(())
    })
}

/// The contents of all elements of instances; only what is there to be read.
fn contents(
    probe: &mut Probe<'_>,
    classes: &[Class],
    channel: u32,
    axis: u32,
) -> Step<Vec<Vec<u8>>> {
    let mut all = Vec::new();
    for instance in probe.instances()? {
        if !classes.contains(&instance.class)
            || (instance.channel, instance.axis) != (channel, axis)
        {
            continue;
        }
        for element in instance.elements() {
            let Some(length) = length_of(probe, element)? else { continue };
            let Ok(read) = ReadElement::new(element, length) else { continue };
            all.push(probe.ask("ADR-13", read)?);
        }
    }
    Ok(all)
}

const OF_PLATFORM: [Class; 2] = [Class::PositionController, Class::Hld];

/// What the suite knows of the default model: the second place of channel 1 has the axis 2, the
/// third the axis 3.
fn exchange(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    if (cnc.axis_at(1, 2), cnc.axis_at(1, 3)) != (2, 3) {
        let why = "the places 2 and 3 of channel 1 have not the axes 2 and 3";
        return Err(Stop::NotApplicable(why.to_owned()));
    }
    let places = |probe: &mut Probe<'_>, place| contents(probe, &OF_PLACES, 1, place);
    let platform = |probe: &mut Probe<'_>| -> Step<Vec<Vec<u8>>> {
        let mut all = contents(probe, &OF_PLATFORM, 0, 2)?;
        all.extend(contents(probe, &OF_PLATFORM, 0, 3)?);
        all.extend(contents(probe, &[Class::Hld], 1, 3)?);
        Ok(all)
    };
    let handle_of = |probe: &mut Probe<'_>| {
        let (channel, axis) =
            (Channel::new(1).map_err(harness)?, ChannelAxis::new(2).map_err(harness)?);
        probe.try_ask(AxisHandleByName::new(channel, axis, "V.A.WCS").map_err(harness)?)
    };
    let (before, of_platform, handle) = (places(probe, 3)?, platform(probe)?, handle_of(probe)?);
    if cnc.exchange_axis(1, 2, 3).is_err() {
        return Err(Stop::NotApplicable("channel 1 has no axis 3 to be exchanged".to_owned()));
    }
    let after = (places(probe, 2), places(probe, 3), platform(probe), handle_of(probe));
    // In the order in which they do not get into each other's way.
    cnc.exchange_axis(1, 2, 2).and_then(|()| cnc.exchange_axis(1, 3, 3)).map_err(harness)?;
    let (second, third, platform_after, handle_after) = after;
    let moved = second? == before;
    probe.check("ADR-13", moved, "the values of axis 3 at place 2 now", "others");
    let blank = third?.iter().flatten().all(|&byte| byte == 0);
    probe.check("ADR-13", blank, "nothing at place 3 any more", "values");
    let platform_after = platform_after?;
    for rule in ["ADR-13", "SDA-13"] {
        let same = platform_after == of_platform;
        probe.check(rule, same, "the platform's axes where they were", "others");
    }
    let handle_after = handle_after?;
    let (same, expected) = (
        handle_after.is_some() && handle_after == handle,
        "the handle of the place, whichever axis is there",
    );
    probe.check("VAR-10", same, expected, "another");
    let back = places(probe, 3)? == before;
    probe.require(&["ADR-13".into()], back, "axis 3 at place 3 again", "others")
}
