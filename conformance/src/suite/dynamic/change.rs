//! Dynamic parameters that an NC program creates and deletes.

use ads_cnc::Decode as _;
use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicKind, DynamicName, DynamicValue};
use ads_cnc::operation::{DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName};

use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::parameters::{number, prefix};
use crate::judge::{Checks as _, Step};
use crate::simulator::Cnc;
use crate::suite::kit::Probe;

/// More than fit into a byte.
const MANY: u32 = 300;

pub(super) fn come_and_go(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    for kind in DynamicKind::ALL {
        // Without parameters none have to be restored.
        let mut none = None;
        for channel in probe.channels()?.into_iter().rev() {
            if none.is_none() && number(probe, channel, kind)? == 0 {
                none = Some(channel);
            }
        }
        let Some(channel) = none else { continue };
        let judged = stages(probe, &cnc, channel, kind);
        cnc.set_parameters(channel.number(), kind, &[])?;
        judged?;
        let gone = number(probe, channel, kind)?;
        probe.check(DYN_1, gone == 0, "0, as all are deleted", gone);
    }
    Ok(())
}

/// Name and value of the parameter at a place of the list.
fn one(kind: DynamicKind, place: u32) -> (String, f64) {
    let mut name = format!("{}{place}", prefix(kind));
    // Each tenth has the maximum length, including the NUL.
    if place.is_multiple_of(10) {
        let digits = name.len();
        name = format!("{name}{}", "x".repeat(95_usize.saturating_sub(digits)));
    }
    // Of any magnitude, and with more digits than are usually shown.
    let value = match place % 4 {
        0 => f64::from(place) * 1e-300,
        1 => f64::from(place) / 3.0,
        2 => f64::from(place) * -1e200,
        _ => f64::from(place) + 0.125,
    };
    (name, value)
}

fn set(cnc: &Cnc, channel: Channel, kind: DynamicKind, all: &[(String, f64)]) -> Step {
    let all: Vec<(&str, f64)> = all.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    Ok(cnc.set_parameters(channel.number(), kind, &all)?)
}

fn stages(probe: &mut Probe<'_>, cnc: &Cnc, channel: Channel, kind: DynamicKind) -> Step {
    let mut all: Vec<(String, f64)> = (1..=MANY).map(|place| one(kind, place)).collect();
    set(cnc, channel, kind, &all)?;
    listed(probe, channel, kind, &all)?;
    // The first is deleted: the indices of the others decrease.
    let gone = all.remove(0);
    set(cnc, channel, kind, &all)?;
    listed(probe, channel, kind, &all)?;
    let (gone, there) = (gone.0, all.first().map(|(name, _)| name.clone()).unwrap_or_default());
    let by_name = |name| DynamicValueByName::new(channel, kind, name);
    let what = format!("{gone}, which is deleted");
    probe.refuses(DYN_3, &what, by_name(&gone)?, by_name(&there)?)?;
    // One is inserted at the front.
    all.insert(0, (format!("{}7654", prefix(kind)), -7.5));
    set(cnc, channel, kind, &all)?;
    listed(probe, channel, kind, &all)
}

/// Compares the list with the parameters that were set: at the ends, and around 255.
fn listed(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    all: &[(String, f64)],
) -> Step {
    let count = u32::try_from(all.len())?;
    let found = number(probe, channel, kind)?;
    probe.check(DYN_1, found == count, count, found);
    for index in [1, 2, 10, 11, 127, 128, 255, 256, 257, count] {
        let place = usize::try_from(index).ok().and_then(|index| index.checked_sub(1));
        let Some((name, value)) = place.and_then(|place| all.get(place)) else { continue };
        let by_index = DynamicNameByIndex::new(channel, kind, index)?;
        let data = probe.try_ask(by_index)?.unwrap_or_default();
        let told = DynamicName::decode(&data).map(|name| name.name.text.to_string());
        let told = told.unwrap_or_default();
        let found = || format!("{told:?} at index {index} of {count}");
        let same = told == *name;
        probe.check([DYN_2, DYN_5], same, || format!("{name:?}"), found);
        // A rejected request has no effect.
        let beyond = DynamicNameByIndex::new(channel, kind, count.saturating_add(1));
        probe.try_ask(beyond?)?;
        let again = probe.try_ask(by_index)?.unwrap_or_default();
        let found = || Hex(again.clone());
        let expected = || format!("{name:?} behind an index that was refused");
        probe.check(DYN_2, again == data, expected, found);
        let by_name = DynamicValueByName::new(channel, kind, name)?;
        let by_name = value_of(probe.try_ask(by_name)?);
        let found = || format!("{by_name:?} of {name:?}");
        let same = by_name == Some(*value);
        probe.check(DYN_3, same, || value, found);
        if name.len() > 20 {
            probe.check(DYN_6, told == *name && same, || format!("{value} of {name:?}"), found);
        }
        let by_index = DynamicValueByIndex::new(channel, kind, index)?;
        let by_index = value_of(probe.try_ask(by_index)?);
        let found = || format!("{by_index:?} at index {index}");
        probe.check(DYN_4, by_index == Some(*value), || value, found);
    }
    Ok(())
}

fn value_of(data: Option<Vec<u8>>) -> Option<f64> {
    data.and_then(|data| DynamicValue::decode(&data).ok()).map(DynamicValue::get)
}
