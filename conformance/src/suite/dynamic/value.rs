//! Values of dynamic parameters, by name and by index.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicKind, DynamicName, DynamicValue};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};
use ads_cnc::{CncString, Decode as _, TextRef};
use ads_cnc_vectors::Hex;

use super::super::probe::{Probe, harness};
use super::steady::{Checked, steadily};
use super::{PARAMETERS_MAX, each, first, number, prefix, refuses_still, told};
use crate::judge::{Step, Stop, assumed};

/// Names from this length on are judged by how long a name may be, too.
const LONG: usize = 20;

pub(super) fn values(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        // Backwards: what an index means does not depend on what was asked before.
        for index in (1..=count).rev() {
            let by_index = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
            steadily(probe, &[by_index.into()], |probe, answers| {
                let name = answers.first().and_then(|data| DynamicName::decode(data).ok());
                let name = name.map(|name| name.name.text);
                // One that leaves no room for its NUL cannot be asked for.
                match name.filter(|name| name.as_bytes().len() < DYNAMIC_NAME_MAX) {
                    Some(name) => value(probe, channel, kind, index, &name),
                    None => Ok(Vec::new()),
                }
            })?;
        }
        Ok(())
    })
}

fn value(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    index: u32,
    name: &CncString,
) -> Step<Vec<Checked>> {
    let text = TextRef::from(name.as_cnc_str());
    let by_name = Request::from(DynamicValueByName { channel, kind, name: text });
    let by_index = DynamicValueByIndex::new(channel, kind, index).map_err(harness)?;
    let mut checks = Vec::new();
    let read = |probe: &mut Probe<'_>, request| -> Step<(Option<Vec<u8>>, String)> {
        let exchange = probe.send(request)?;
        let data = exchange.answer().and_then(|answer| answer.success()).map(<[u8]>::to_vec);
        Ok((data, exchange.result()))
    };
    let (named, result) = read(probe, by_name)?;
    // As it is told it has to be found.
    let rules: &[&str] = match name.as_bytes().len() {
        LONG.. => &["DYN-3", "DYN-2", "DYN-6"],
        _ => &["DYN-3", "DYN-2"],
    };
    for &rule in rules {
        let expected = format!("the value of {name}, as index {index} is called");
        checks.push(Checked::new(probe, rule, named.is_some(), expected, &result));
    }
    let mut real = |probe: &Probe<'_>, rule, data: &Option<Vec<u8>>, result: &str| {
        let is_real = data.as_ref().is_some_and(|data| DynamicValue::decode(data).is_ok());
        checks.push(Checked::new(probe, rule, is_real, format!("a REAL64 of {name}"), result));
    };
    if named.is_some() {
        real(probe, "DYN-3", &named, &result);
    }
    let (indexed, result) = read(probe, by_index.into())?;
    real(probe, "DYN-4", &indexed, &result);
    let (named_again, _) = read(probe, by_name)?;
    // A value that moves is held against nothing.
    let still = named.filter(|named| named_again.as_ref() == Some(named));
    if let (Some(named), Some(indexed)) = (still, indexed) {
        for rule in ["DYN-3", "DYN-4"] {
            let expected = format!("{} of {name}, at index {index} too", Hex(named.clone()));
            let found = Hex(indexed.clone());
            checks.push(Checked::new(probe, rule, named == indexed, expected, found));
        }
    }
    Ok(checks)
}

/// Names near one that is there: longer, shorter, with another end.
fn near(kind: DynamicKind, known: &str) -> Vec<String> {
    let mut shorter = known.to_owned();
    let last = shorter.pop();
    let other = if last == Some('x') { 'y' } else { 'x' };
    let kept = |name: &String| name.strip_prefix(prefix(kind)).is_some_and(|rest| !rest.is_empty());
    let shorter = Some(shorter).filter(kept);
    let changed = shorter.as_ref().map(|shorter| format!("{shorter}{other}"));
    let longer = ["x", ".x"].map(|more| format!("{known}{more}"));
    longer.into_iter().chain(shorter).chain(changed).collect()
}

pub(super) fn unknown_name(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        let names = told(probe, channel, kind, count)?;
        let Some((_, known)) = names.first() else {
            return Err(Stop::Inconclusive(format!("{}: no name of index 1", prefix(kind))));
        };
        let good = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        let mut unknown = vec![format!("{}no such parameter", prefix(kind)), String::new()];
        unknown.push(prefix(kind).to_owned());
        unknown.extend(near(kind, &known.to_string()));
        for unknown in unknown {
            let is_there = names.iter().any(|(_, name)| name.to_string() == unknown);
            let Ok(bad) = DynamicValueByName::new(channel, kind, &unknown) else { continue };
            let mut buf = [0; 256];
            // One with no room for its end is another case's.
            if is_there || Request::from(bad).encode(&mut buf).is_err() {
                continue;
            }
            let what = format!("the name {unknown:?}");
            refuses_still(probe, "DYN-3", &what, (channel, kind), bad.into(), good.into())?;
        }
        Ok(())
    })
}

pub(super) fn kinds_apart(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = first(probe, channel, kind)?;
        let good = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        for other in DynamicKind::ALL.into_iter().filter(|other| *other != kind) {
            let what = format!("{known} among the {}", prefix(other));
            let bad = DynamicValueByName { kind: other, ..good };
            let rule = assumed("DYN-3");
            refuses_still(probe, rule, &what, (channel, kind), bad.into(), good.into())?;
        }
        Ok(())
    })
}

/// Each function by the channel's rank, beside the same by its number.
pub(super) fn by_rank(probe: &mut Probe<'_>) -> Step {
    for (rank, channel) in (1_u32..).zip(probe.channels()?) {
        let rank = Channel::by_index(rank).map_err(harness)?;
        for kind in DynamicKind::ALL {
            let count = |channel| CountDynamic::new(channel, kind).into();
            same_by_rank(probe, count(channel), count(rank))?;
            let count = number(probe, channel, kind)?.min(PARAMETERS_MAX);
            for (index, name) in told(probe, channel, kind, count)? {
                let text = TextRef::from(name.as_cnc_str());
                let of = |channel| -> Step<[Request<'_>; 3]> {
                    let name = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
                    let by_index =
                        DynamicValueByIndex::new(channel, kind, index).map_err(harness)?;
                    let by_name = DynamicValueByName { channel, kind, name: text };
                    Ok([name.into(), by_index.into(), by_name.into()])
                };
                for (one, other) in of(channel)?.into_iter().zip(of(rank)?) {
                    same_by_rank(probe, one, other)?;
                }
            }
        }
    }
    Ok(())
}

fn same_by_rank(probe: &mut Probe<'_>, one: Request<'_>, other: Request<'_>) -> Step {
    steadily(probe, &[one], |probe, answers| {
        let exchange = probe.send(other)?;
        let by_rank = exchange.answer().and_then(|answer| answer.success());
        let by_number = answers.first().map(Vec::as_slice);
        let expected = Hex(by_number.unwrap_or_default().to_vec());
        let check = |rule| {
            let kept = by_rank == by_number;
            Checked::new(probe, rule, kept, format!("{expected}, by number"), exchange.result())
        };
        Ok(["ADR-1", "ADR-12"].map(check).into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_near_one() {
        let near_p1 = ["P1x", "P1.x"];
        assert_eq!(near(DynamicKind::P, "P1"), near_p1);
        let near_x = near(DynamicKind::VL, "V.L.ax");
        assert_eq!(near_x, ["V.L.axx", "V.L.ax.x", "V.L.a", "V.L.ay"]);
    }
}
