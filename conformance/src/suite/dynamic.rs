//! Cases of dynamic parameters.

use std::collections::HashSet;

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName, DynamicValue};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    Call, CountDynamic, DynamicNameByIndex, DynamicValueByIndex, DynamicValueByName, Request,
};
use ads_cnc::{CncString, Decode as _, TextRef};

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::probe::{Probe, harness};
use super::still::Still;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "dyn-count",
            "Each kind has a number, where the decoder's elements have none",
            ["DYN-1", "SDA-12"],
            Queries,
            count
        ),
        declare!(
            "dyn-names",
            "Every index from 1 on has a name of its kind, unlike the others",
            ["DYN-2", "DYN-5", "DYN-6"],
            Queries,
            names
        ),
        declare!(
            "dyn-index-beyond-last",
            "The index behind the last is answered by an error",
            ["DYN-5"],
            Queries,
            index_beyond_last
        ),
        declare!(
            "dyn-values",
            "A parameter has the same value by its name and by its index",
            ["DYN-3", "DYN-4"],
            Queries,
            values
        ),
        declare!(
            "dyn-unknown-name",
            "A name that no parameter has is answered by an error",
            ["DYN-3"],
            Queries,
            unknown_name
        ),
        declare!(
            "dyn-kinds-apart",
            "A parameter is found among those of its own kind only",
            ["DYN-3"],
            Queries,
            kinds_apart
        ),
        declare!(
            "dyn-bad-requests",
            "Index 0 and requests of another length are answered by an error",
            ["DYN-2", "DYN-4", "DYN-5", "DYN-6"],
            Malformed,
            bad_requests
        ),
    ]
}

/// The most parameters of a kind that are looked at.
const PARAMETERS_MAX: u32 = 1_000;

/// What the names of a kind begin with, and its name.
const fn prefix(kind: DynamicKind) -> &'static str {
    match kind {
        DynamicKind::P => "P",
        DynamicKind::VL => "V.L.",
        DynamicKind::VP => "V.P.",
        DynamicKind::VS => "V.S.",
    }
}

/// How many there are, if the target says; that is judged elsewhere.
fn number(probe: &mut Probe<'_>, channel: Channel, kind: DynamicKind) -> Step<u32> {
    let data = probe.try_ask(CountDynamic::new(channel, kind))?;
    let count = data.and_then(|data| DynamicCount::decode(&data).ok());
    Ok(count.map_or(0, |count| count.0.min(PARAMETERS_MAX)))
}

/// Every kind of every channel that has a parameter.
fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, DynamicKind, u32) -> Step,
) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            let count = number(probe, channel, kind)?;
            if count > 0 {
                any = true;
                judge(probe, channel, kind, count)?;
            }
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("there is no parameter at the moment".to_owned())),
    }
}

fn count(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            let data = probe
                .ask_for(&["DYN-1", "SDA-12"].map(Rule::from), CountDynamic::new(channel, kind))?;
            let count = DynamicCount::decode(&data);
            let found = format!("{} bytes for {}", data.len(), prefix(kind));
            for rule in ["DYN-1", "SDA-12"] {
                probe.check(rule, count.is_ok(), "a number of 4 bytes", &found);
            }
            // A number in the wrong order of bytes is the first to leave all limits.
            let plausible = count.is_ok_and(|count| count.0 <= 0x00FF_FFFF);
            probe.check("DYN-1", plausible, "a number of parameters", format!("{count:?}"));
        }
    }
    Ok(())
}

fn name(probe: &mut Probe<'_>, channel: Channel, kind: DynamicKind, index: u32) -> Step<CncString> {
    let request = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
    let data = probe.try_ask(request)?.unwrap_or_default();
    let name = DynamicName::decode(&data).ok();
    let name = name.map(|name| name.name.text);
    // A program may have deleted it meanwhile.
    name.ok_or_else(|| Stop::Inconclusive(format!("{}: no name of index {index}", prefix(kind))))
}

fn names(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, count| {
        let mut seen = HashSet::new();
        for index in 1..=count {
            let request = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
            let rules = ["DYN-5", "DYN-2"].map(Rule::from);
            let data = probe.ask_for(&rules, request)?;
            let found = format!("{} bytes of index {index}", data.len());
            let expected = format!("at most {DYNAMIC_NAME_MAX} bytes");
            probe.check("DYN-6", data.len() <= DYNAMIC_NAME_MAX, expected, &found);
            let name = DynamicName::decode(&data);
            probe.require(&["DYN-2".into()], name.is_ok(), "a name", found)?;
            let name = name.map(|name| name.name.text.to_string()).unwrap_or_default();
            let of_kind = name.strip_prefix(prefix(kind)).is_some_and(|rest| !rest.is_empty());
            let found = format!("{name:?} at index {index}");
            probe.check("DYN-2", of_kind, format!("a name of {}", prefix(kind)), &found);
            probe.check("DYN-5", seen.insert(name), "another at each index", found);
        }
        Ok(())
    })
}

fn index_beyond_last(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            if number(probe, channel, kind)? == 0 {
                let what = format!("index 1 of no {}", prefix(kind));
                let first = DynamicNameByIndex::new(channel, kind, 1).map_err(harness)?;
                probe.refuses_alone("DYN-5", &what, first)?;
            }
        }
    }
    each(probe, |probe, channel, kind, count| {
        for beyond in probe.beyond(count.saturating_add(1)) {
            let what = format!("index {beyond} of {count} of {}", prefix(kind));
            let name = |index| DynamicNameByIndex::new(channel, kind, index).map_err(harness);
            probe.refuses("DYN-5", &what, name(beyond)?, name(count)?)?;
            let value = |index| DynamicValueByIndex::new(channel, kind, index).map_err(harness);
            probe.refuses("DYN-5", &what, value(beyond)?, value(count)?)?;
        }
        Ok(())
    })
}

fn values(probe: &mut Probe<'_>) -> Step {
    let mut still = Still::default();
    each(probe, |probe, channel, kind, count| {
        for index in 1..=count {
            let name = name(probe, channel, kind, index)?;
            let text = TextRef::from(name.as_cnc_str());
            let by_name = DynamicValueByName { channel, kind, name: text };
            let by_index = DynamicValueByIndex::new(channel, kind, index).map_err(harness)?;
            for (rule, request) in [("DYN-3", Request::from(by_name)), ("DYN-4", by_index.into())] {
                let _value: DynamicValue = probe.read(rule, request)?;
            }
            let what = name.to_string();
            let rules = ["DYN-3", "DYN-4"].map(Rule::from);
            still.same_part(
                probe,
                &rules,
                &what,
                by_name.into(),
                by_index.into(),
                <[u8]>::to_vec,
            )?;
        }
        Ok(())
    })?;
    still.finish()
}

fn unknown_name(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = name(probe, channel, kind, 1)?;
        let good = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        for unknown in [format!("{}no such parameter", prefix(kind)), String::new()] {
            let what = format!("the name {unknown:?}");
            let bad = DynamicValueByName::new(channel, kind, &unknown).map_err(harness)?;
            probe.refuses("DYN-3", &what, bad, good)?;
        }
        Ok(())
    })
}

fn kinds_apart(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = name(probe, channel, kind, 1)?;
        let good = DynamicValueByName { channel, kind, name: known.as_cnc_str().into() };
        for other in DynamicKind::ALL.into_iter().filter(|other| *other != kind) {
            let what = format!("{known} among the {}", prefix(other));
            let bad = DynamicValueByName { kind: other, ..good };
            probe.refuses(assumed("DYN-3"), &what, bad, good)?;
        }
        Ok(())
    })
}

fn bad_requests(probe: &mut Probe<'_>) -> Step {
    each(probe, |probe, channel, kind, _| {
        let known = name(probe, channel, kind, 1)?;
        let index = DynamicNameByIndex::new(channel, kind, 1).map_err(harness)?;
        let value = DynamicValueByIndex::new(channel, kind, 1).map_err(harness)?;
        for (id, request) in [("DYN-2", Request::from(index)), ("DYN-4", value.into())] {
            let mut buf = [0; 4];
            let good = request.encode(&mut buf).map_err(harness)?;
            let zero = Call { data: &[0; 4], ..good };
            probe.refused("DYN-5", "index 0", &zero, &good)?;
            for data in [&[][..], &[1], &[1, 0], &[1, 0, 0, 0, 0]] {
                let what = format!("an index of {} bytes", data.len());
                probe.refused(assumed(id), &what, &Call { data, ..good }, &good)?;
            }
        }
        let text = TextRef::from(known.as_cnc_str());
        let request = Request::from(DynamicValueByName { channel, kind, name: text });
        let mut buf = [0; 128];
        let good = request.encode(&mut buf).map_err(harness)?;
        let mut long = good.data.to_vec();
        long.resize(DYNAMIC_NAME_MAX.saturating_add(1), b'x');
        let what = "a name of 97 bytes";
        probe.refused(assumed("DYN-6"), what, &Call { data: &long, ..good }, &good)?;
        let read = good.read_length.saturating_sub(1);
        let short = Call { read_length: read, ..good };
        probe.refused(assumed("DYN-4"), "a read length of 7 for a value", &short, &good)
    })
}
