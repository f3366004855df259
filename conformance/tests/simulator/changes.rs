//! Checks of changes by an operator: exchange of axes, and deactivation of channels.

use ads_cnc::address::{Channel, ChannelAxis, Class};
use ads_cnc::operation::{
    AxisHandleByName, AxisReadByName, CountElements, CountObjects, CountVariables, DescribeByIndex,
    FindInstance, HandleByName, ReadByHandle, ReadByName, ReadElement, ReadElementLength, Request,
};
use ads_cnc::sda::{ElementLength, ObjectAddress};
use ads_cnc::{Handle, Kind, U32List};
use ads_cnc_conformance::simulator::{ContentOwner, StoredContent};

use crate::addresses::addresses;
use crate::checks::checks;
use crate::target::{CheckResult, Failed, Reply, TestCnc, ensure, same};

checks! {
    an_axis_takes_its_values_to_another_place,
    a_place_without_an_axis_is_blank,
    names_and_handles_of_a_place_are_of_its_axis,
    ranks_are_those_of_the_active_channels,
}

/// The place in channel 1 of the axis that owns a content; 0 for a platform axis; `None` for other
/// owners.
fn place_of(content: &StoredContent) -> Option<u8> {
    match content.holder {
        ContentOwner::ChannelAxis { channel: 1, place }
        | ContentOwner::OfPlace { channel: 1, place, .. } => Some(place),
        ContentOwner::PlatformAxis(_) | ContentOwner::OfAxis { .. } => Some(0),
        _ => None,
    }
}

/// The name and the value of each content for which [`place_of`] returns `place`, read at each of
/// its addresses that can be read.
fn contents(target: &TestCnc, place: u8) -> CheckResult<Vec<(String, Reply)>> {
    let mut all = Vec::new();
    for content in target.cnc().stored_contents() {
        if place_of(&content) == Some(place) {
            for address in addresses(target, &content)? {
                let Ok(request) = address.read() else { continue };
                all.push((content.name.to_string(), target.ask(request)?));
            }
        }
    }
    Ok(all)
}

/// Axis 3 moves from place 3 to place 2 of channel 1, where axis 2 was: its values move with it, and
/// place 3 is blank.
fn an_axis_takes_its_values_to_another_place(target: &TestCnc) -> CheckResult {
    let cnc = target.cnc();
    same("the axes", (cnc.axis_at(1, 2), cnc.axis_at(1, 3)), (2, 3))?;
    let (third, platform) = (contents(target, 3)?, contents(target, 0)?);
    let mut addresses_of_third = Vec::new();
    for content in cnc.stored_contents().iter().filter(|content| place_of(content) == Some(3)) {
        addresses_of_third.extend(addresses(target, content)?);
    }
    cnc.exchange_axis(1, 2, 3)?;
    same("place 2", contents(target, 2)?, third)?;
    same("the axes of the platform", contents(target, 0)?, platform)?;
    for address in addresses_of_third {
        let Ok(request) = address.read() else { continue };
        let value = target.ask(request)?.unwrap_or_default();
        ensure(value.iter().all(|&byte| byte == 0), format_args!("{address:?} is {value:02x?}"))?;
    }
    Ok(())
}

/// The requests that read the elements of a class at a place of a channel, whose number and lengths
/// are those of place 1 of channel 1.
fn elements(
    target: &TestCnc,
    class: Class,
    channel: u32,
    place: u32,
) -> CheckResult<Vec<ReadElement>> {
    let at = |channel, place| -> CheckResult<_> {
        let address = target.read::<ObjectAddress>(FindInstance::new(class, channel, place))?;
        address.first_element()?.ok_or_else(|| Failed(format!("no {class:?} at place {place}")))
    };
    let (first, known) = (at(channel, place)?, at(1, 1)?);
    let count = target.ask(CountElements::new(known)?)??.into_iter().next().unwrap_or_default();
    let mut all = Vec::new();
    for number in (1..=count).map(u32::from) {
        let length = ReadElementLength::new(known.nth(number)?);
        let Ok(length) = target.read::<ElementLength>(length) else { continue };
        all.push(ReadElement::new(first.nth(number)?, length.get())?);
    }
    Ok(all)
}

/// The elements of a place without an axis are zero: in the initial state, and after axis 4 has left
/// the first place of channel 2.
fn a_place_without_an_axis_is_blank(target: &TestCnc) -> CheckResult {
    let cnc = target.cnc();
    let is_blank = |read: &ReadElement| -> CheckResult<bool> {
        Ok(target.ask(*read)??.iter().all(|&byte| byte == 0))
    };
    let empty = cnc.model().profile().empty_places;
    ensure(!empty.is_empty(), "every place has an axis")?;
    for class in [Class::Interpolator, Class::Decoder, Class::PathPreparation] {
        let left = elements(target, class, 2, 1)?;
        for &(channel, place) in empty.iter() {
            for read in elements(target, class, channel, place)? {
                ensure(is_blank(&read)?, format_args!("{read:?} has a value"))?;
            }
        }
        let mut values = 0;
        for read in &left {
            values += u32::from(!is_blank(read)?);
        }
        ensure(values > 0, format_args!("axis 4 has no values of {class:?}"))?;
        cnc.exchange_axis(2, 1, 0)?;
        for read in &left {
            ensure(is_blank(read)?, format_args!("{read:?} has a value"))?;
        }
        cnc.exchange_axis(2, 1, 4)?;
    }
    Ok(())
}

const NAME: &str = "V.A.WCS";

/// The handle and the value of the variable `NAME` at a place of channel 1.
fn by_place(target: &TestCnc, place: u32) -> CheckResult<(Handle, Reply)> {
    let (channel, axis) = (Channel::new(1)?, ChannelAxis::new(place)?);
    let handle = target.read(AxisHandleByName::new(channel, axis, NAME)?)?;
    Ok((handle, target.ask(AxisReadByName::new(channel, axis, NAME)?)?))
}

fn names_and_handles_of_a_place_are_of_its_axis(target: &TestCnc) -> CheckResult {
    let channel = Channel::new(1)?;
    let by_handle = |handle| target.ask(ReadByHandle::new(channel, handle, U32List::EMPTY));
    let ((second, of_y), (third, of_z)) = (by_place(target, 2)?, by_place(target, 3)?);
    same("by handle", (by_handle(second)?, by_handle(third)?), (of_y.clone(), of_z.clone()))?;
    target.cnc().exchange_axis(1, 2, 3)?;
    same("axis 3 at place 2", by_place(target, 2)?, (second, of_z.clone()))?;
    same("axis 3 by the handle of place 2", by_handle(second)?, of_z.clone())?;
    let left = target.ask(AxisReadByName::new(channel, ChannelAxis::new(3)?, NAME)?)?;
    ensure(left != of_z, "axis 3 is at place 3, too")?;
    let name = format!("{NAME}.Z");
    same("the handle", target.read::<Handle>(HandleByName::new(channel, &name)?)?, second)?;
    same("by its name", target.ask(ReadByName::new(channel, &name)?)?, of_z.clone())?;
    target.cnc().exchange_axis(1, 3, 2)?;
    same("axis 3", by_place(target, 2)?, (second, of_z.clone()))?;
    same("axis 2", by_place(target, 3)?, (third, of_y.clone()))?;
    same("by handle", (by_handle(second)?, by_handle(third)?), (of_z, of_y))
}

/// The replies by which a channel can be identified.
fn known_by(target: &TestCnc, channel: Channel) -> CheckResult<Vec<Reply>> {
    let mut requests: Vec<Request<'_>> =
        vec![CountObjects::new(channel).into(), CountVariables::new(channel, Kind::V_E).into()];
    requests
        .extend((0..8).map(|index| Request::from(DescribeByIndex::new(channel, index, Kind::V_E))));
    requests.into_iter().map(|request| target.ask(request)).collect()
}

fn ranks_are_those_of_the_active_channels(target: &TestCnc) -> CheckResult {
    let all = target.channels();
    for &gone in &all {
        target.cnc().set_active(gone, false)?;
        let active: Vec<u8> = all.iter().copied().filter(|one| *one != gone).collect();
        ranks_are(target, &active)?;
        target.cnc().set_active(gone, true)?;
    }
    ranks_are(target, &all)
}

fn ranks_are(target: &TestCnc, active: &[u8]) -> CheckResult {
    for (rank, &number) in (1..).zip(active) {
        let by_number = known_by(target, Channel::new(number.into())?)?;
        ensure(by_number[1].is_ok(), format_args!("channel {number} rejects requests"))?;
        same(format_args!("rank {rank}"), known_by(target, Channel::by_index(rank)?)?, by_number)?;
    }
    let beyond = Channel::by_index(u32::try_from(active.len())? + 1)?;
    let beyond = target.ask(CountVariables::new(beyond, Kind::V_E))?;
    ensure(beyond.is_err(), format_args!("a rank after the last: {beyond:02x?}"))
}
