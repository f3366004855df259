//! The objects of one list of the COM task.

use ads_cnc::operation::{CountObjects, ObjectList, ReadDescriptors};
use ads_cnc::{Decode as _, Descriptors, ObjectCount};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::judge::{Step, Stop};
use crate::suite::kit::{OBJECTS_MAX, Probe};

pub(crate) fn object_count(probe: &mut Probe<'_>, list: ObjectList) -> Step<u32> {
    let ObjectCount(number) = probe.read(COM_1, CountObjects::new(list))?;
    if number == 0 {
        return Err(Stop::not_applicable("the list has no object"));
    }
    Ok(number)
}

/// Like [`object_count`], but records no check, because other cases judge the number. If the number
/// cannot be read, the case is inconclusive.
pub(crate) fn known_object_count(probe: &mut Probe<'_>, list: ObjectList) -> Step<u32> {
    let exchange = probe.send(CountObjects::new(list))?;
    let data = exchange.success().unwrap_or_default();
    match ObjectCount::decode(data) {
        Ok(ObjectCount(number)) if number > 0 => Ok(number),
        Ok(_) => Err(Stop::not_applicable("the list has no object")),
        Err(_) => Err(Stop::inconclusive("the number of objects could not be read")),
    }
}

/// Requests `count` descriptors, starting with object number `first`. A reply that is not a
/// success, or does not consist of descriptors, violates `rule` and ends the case.
pub(crate) fn read_descriptors(
    probe: &mut Probe<'_>,
    rule: ClauseId,
    list: ObjectList,
    first: u32,
    count: u32,
) -> Step<Descriptors> {
    let request = ReadDescriptors::new(list, first, count)?;
    probe.read(rule, request)
}

/// Reads the descriptors of the first `number` objects, at most [`OBJECTS_MAX`], each with a
/// separate request, because other cases judge reads of several descriptors.
pub(crate) fn descriptors_one_by_one(
    probe: &mut Probe<'_>,
    rule: ClauseId,
    list: ObjectList,
    number: u32,
) -> Step<Descriptors> {
    let mut all = Descriptors::default();
    for first in 1..=number.min(OBJECTS_MAX) {
        let one = read_descriptors(probe, rule, list, first, 1)?;
        one.as_ref().iter().for_each(|object| all.push(object.to_owned()));
    }
    Ok(all)
}
