//! Values of dynamic parameters, by name and by index.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicKind, DynamicName, DynamicValue};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};
use ads_cnc::{CncString, Decode as _, TextRef};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::parameters::{PARAMETERS_MAX, each, first, names_of, number, prefix, rejects_steadily};
use crate::exchange::Exchange;
use crate::judge::{Step, Stop, assumed};
use crate::suite::kit::{PendingCheck, Probe, is_sendable, rules_by_index, steadily};
use crate::text::hex::spaced;

/// Names of at least this number of bytes are also judged by DYN-6, the requirement on the length
/// of names.
const LONG: usize = 20;

pub(super) fn values(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        // The order is descending, because the meaning of an index must not depend on earlier
        // requests.
        for index in (1..=count).rev() {
            let by_index = DynamicNameByIndex::new(channel, kind, index)?;
            steadily(probe, &[by_index.into()], |probe, answers| {
                let name = answers.first().and_then(|data| DynamicName::decode(data).ok());
                let name = name.map(|name| name.name.text);
                // A name without space for its NUL cannot be requested.
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
) -> Step<Vec<PendingCheck>> {
    let text = TextRef::from(name.as_cnc_str());
    let by_name = Request::from(DynamicValueByName { channel, kind, name: text });
    let by_index = DynamicValueByIndex::new(channel, kind, index)?;
    let named = probe.send(by_name)?;
    // A request with the name that the CNC returned must succeed.
    let rules: &[ClauseId] = match name.as_bytes().len() {
        LONG.. => &[DYN_3, DYN_2, DYN_6],
        _ => &[DYN_3, DYN_2],
    };
    let expected = || format!("the value of {name}, the name of index {index}");
    let mut checks =
        vec![PendingCheck::new(probe, rules, named.success().is_some(), expected, &named)];
    let mut real = |probe: &mut Probe<'_>, rule: ClauseId, exchange: &Exchange| {
        let is_real = exchange.success().is_some_and(|data| DynamicValue::decode(data).is_ok());
        let expected = || format!("a REAL64 of {name}");
        checks.push(PendingCheck::new(probe, rule, is_real, expected, exchange));
    };
    if named.success().is_some() {
        real(probe, DYN_3, &named);
    }
    let indexed = probe.send(by_index)?;
    real(probe, DYN_4, &indexed);
    // A value that changes by itself is not compared.
    let named_again = probe.try_ask(by_name)?;
    let steady = named.success().filter(|named| named_again.as_deref() == Some(named));
    if let (Some(named), Some(indexed)) = (steady, indexed.success()) {
        let expected = || format!("{} of {name}, also at index {index}", spaced(named));
        let found = || spaced(indexed);
        checks.push(PendingCheck::new(probe, [DYN_3, DYN_4], named == indexed, expected, found));
    }
    Ok(checks)
}

/// Names of the kind that are similar to the existing name `known`: longer, shorter, or with
/// another last character.
fn near(kind: DynamicKind, known: &str) -> Vec<String> {
    let mut shorter = known.to_owned();
    let last = shorter.pop();
    let other = if last == Some('x') { 'y' } else { 'x' };
    let passed =
        |name: &String| name.strip_prefix(prefix(kind)).is_some_and(|rest| !rest.is_empty());
    let shorter = Some(shorter).filter(passed);
    let changed = shorter.as_ref().map(|shorter| format!("{shorter}{other}"));
    let longer = ["x", ".x"].map(|more| format!("{known}{more}"));
    longer.into_iter().chain(shorter).chain(changed).collect()
}

pub(super) fn unknown_name(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        let names = names_of(probe, channel, kind, count)?;
        let Some((_, known)) = names.first() else {
            return Err(Stop::Inconclusive(format!("{}: index 1 has no name", prefix(kind))));
        };
        let valid = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        let mut unknown = vec![format!("{}no such parameter", prefix(kind)), String::new()];
        unknown.push(prefix(kind).to_owned());
        unknown.extend(near(kind, &known.to_string()));
        for unknown in unknown {
            let is_there = names.iter().any(|(_, name)| name.to_string() == unknown);
            let Ok(invalid) = DynamicValueByName::new(channel, kind, &unknown) else { continue };
            // Another case sends names without space for their NUL.
            if is_there || !is_sendable(&invalid.into()) {
                continue;
            }
            let what = format!("the name {unknown:?}");
            rejects_steadily(probe, DYN_3, &what, (channel, kind), invalid, valid.into())?;
        }
        Ok(())
    })
}

pub(super) fn kinds_apart(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = first(probe, channel, kind)?;
        let valid = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        for other in DynamicKind::ALL.into_iter().filter(|other| *other != kind) {
            let what = format!("{known} among the {}", prefix(other));
            let invalid = DynamicValueByName { kind: other, ..valid };
            let rule = assumed(DYN_3);
            rejects_steadily(probe, rule, &what, (channel, kind), invalid, valid.into())?;
        }
        Ok(())
    })
}

/// Compares the replies for a channel by its rank and by its number, for each function of dynamic
/// parameters.
pub(super) fn by_rank(probe: &mut Probe<'_>) -> Step {
    for (rank, channel) in probe.ranks()? {
        for kind in DynamicKind::ALL {
            let count = |channel| CountDynamic::new(channel, kind).into();
            same_by_rank(probe, count(channel), count(rank))?;
            let count = number(probe, channel, kind)?.min(PARAMETERS_MAX);
            for (index, name) in names_of(probe, channel, kind, count)? {
                let text = TextRef::from(name.as_cnc_str());
                let of = |channel| -> Step<[Request<'_>; 3]> {
                    let name = DynamicNameByIndex::new(channel, kind, index)?;
                    let by_index = DynamicValueByIndex::new(channel, kind, index)?;
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
        let by_number = answers.first().map(Vec::as_slice);
        let expected = || format!("{}, as by number", spaced(by_number.unwrap_or_default()));
        let same = exchange.success().map(|found| Some(found) == by_number);
        let rules = rules_by_index(probe, ADR_1, one, other, same)?;
        Ok(vec![PendingCheck::new(probe, &rules[..], same == Some(true), expected, &exchange)])
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
