//! Values of dynamic parameters, by name and by index.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicKind, DynamicValue};
use ads_cnc::operation::{
    CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};
use ads_cnc::{CncString, TextRef};

use super::super::case::{Rule, Step, Stop, assumed};
use super::super::probe::{Probe, harness};
use super::super::still::Still;
use super::{PARAMETERS_MAX, each, first, number, prefix, refuses_still, told};

/// Names from this length on are judged by how long a name may be, too.
const LONG: usize = 20;

pub(super) fn values(probe: &mut Probe<'_>) -> Step {
    let mut still = Still::default();
    each(probe, |probe, channel, kind, count| {
        let names = told(probe, channel, kind, count)?;
        // Backwards: what an index means does not depend on what was asked before.
        for (index, name) in names.iter().rev() {
            value(probe, &mut still, (channel, kind), *index, name)?;
        }
        Ok(())
    })?;
    still.finish()
}

fn value(
    probe: &mut Probe<'_>,
    still: &mut Still,
    (channel, kind): (Channel, DynamicKind),
    index: u32,
    name: &CncString,
) -> Step {
    let text = TextRef::from(name.as_cnc_str());
    let by_name = DynamicValueByName { channel, kind, name: text };
    let by_index = DynamicValueByIndex::new(channel, kind, index).map_err(harness)?;
    // As it is told it has to be found, if it has not gone meanwhile.
    let exchange = probe.send(by_name)?;
    let is_found = exchange.answer().is_some_and(|answer| answer.success().is_some());
    if !is_found && !told(probe, channel, kind, index)?.contains(&(index, name.clone())) {
        return Ok(());
    }
    let rules: &[&str] = match name.as_bytes().len() {
        LONG.. => &["DYN-6", "DYN-3", "DYN-2"],
        _ => &["DYN-3", "DYN-2"],
    };
    for &rule in rules {
        let expected = format!("the value of {name}, as index {index} is called");
        probe.check(rule, is_found, expected, exchange.result());
    }
    if !is_found {
        return Ok(());
    }
    for (rule, request) in [("DYN-3", Request::from(by_name)), ("DYN-4", by_index.into())] {
        let _value: DynamicValue = probe.read(rule, request)?;
    }
    let rules = ["DYN-3", "DYN-4"].map(Rule::from);
    let what = name.to_string();
    still.same_part(probe, &rules, &what, by_name.into(), by_index.into(), <[u8]>::to_vec)
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
    let mut still = Still::default();
    let rules = ["ADR-1", "ADR-12"].map(Rule::from);
    for (rank, channel) in (1_u32..).zip(probe.channels()?) {
        let rank = Channel::by_index(rank).map_err(harness)?;
        for kind in DynamicKind::ALL {
            let what = format!("the number of {}", prefix(kind));
            let count = |channel| CountDynamic::new(channel, kind);
            still.same(probe, &rules, &what, count(channel), count(rank).into())?;
            let count = number(probe, channel, kind)?.min(PARAMETERS_MAX);
            for (index, name) in told(probe, channel, kind, count)? {
                let text = TextRef::from(name.as_cnc_str());
                let pairs = |channel| -> Step<[Request<'_>; 3]> {
                    let name = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
                    let by_index =
                        DynamicValueByIndex::new(channel, kind, index).map_err(harness)?;
                    let by_name = DynamicValueByName { channel, kind, name: text };
                    Ok([name.into(), by_index.into(), by_name.into()])
                };
                for (one, other) in pairs(channel)?.into_iter().zip(pairs(rank)?) {
                    let what = name.to_string();
                    still.same_part(probe, &rules, &what, one, other, <[u8]>::to_vec)?;
                }
            }
        }
    }
    still.finish()
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
