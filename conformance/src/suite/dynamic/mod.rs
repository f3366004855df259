//! Cases of dynamic parameters.

mod change;
mod list;
mod malformed;
mod steady;
mod value;

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{Call, CountDynamic, DynamicNameByIndex, Request};
use ads_cnc::{CncString, Decode as _};

use super::probe::{Probe, harness};
use super::{Declared, declare};
use crate::judge::{Rule, Step, Stop};
use steady::Checked;

pub(super) fn cases() -> Vec<Declared> {
    vec![
        declare!(
            "dyn-count",
            "Each kind has a number, where the decoder's elements have none",
            ["DYN-1", "SDA-12"],
            Queries,
            list::count
        ),
        declare!(
            "dyn-names",
            "Every index from 1 on has a name of its kind, unlike the others, and no other has",
            ["DYN-1", "DYN-2", "DYN-5", "DYN-6", "SDA-12"],
            Queries,
            list::names
        ),
        declare!(
            "dyn-index-beyond-last",
            "The index behind the last is answered by an error",
            ["DYN-5"],
            Queries,
            list::index_beyond_last
        ),
        declare!(
            "dyn-values",
            "A parameter has the same value by its name and by its index",
            ["DYN-2", "DYN-3", "DYN-4", "DYN-6"],
            Queries,
            value::values
        ),
        declare!(
            "dyn-unknown-name",
            "A name that no parameter has is answered by an error",
            ["DYN-3"],
            Queries,
            value::unknown_name
        ),
        declare!(
            "dyn-kinds-apart",
            "A parameter is found among those of its own kind only",
            ["DYN-3"],
            Queries,
            value::kinds_apart
        ),
        declare!(
            "dyn-by-index-of-channel",
            "A channel's parameters are the same by its number and by its rank",
            ["ADR-1", "ADR-12"],
            Queries,
            value::by_rank
        ),
        declare!(
            "dyn-come-and-go",
            "Parameters that are made and deleted change numbers and indices, and no name",
            ["DYN-1", "DYN-2", "DYN-3", "DYN-4", "DYN-5", "DYN-6"],
            Embedded,
            change::come_and_go
        ),
        declare!(
            "dyn-bad-requests",
            "Index 0 and requests of another length are answered by an error",
            ["ADS-1", "DYN-2", "DYN-3", "DYN-4", "DYN-5", "DYN-6"],
            Malformed,
            malformed::bad_requests
        ),
        declare!(
            "dyn-name-forms",
            "A name is found without its NUL, and with more of them",
            ["DYN-3"],
            Malformed,
            malformed::forms
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
    Ok(count.map_or(0, |count| count.0))
}

/// Every kind of every channel that has a parameter.
fn each(
    probe: &mut Probe<'_>,
    mut judge: impl FnMut(&mut Probe<'_>, Channel, DynamicKind, u32) -> Step,
) -> Step {
    let mut any = false;
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            let count = number(probe, channel, kind)?.min(PARAMETERS_MAX);
            if count > 0 {
                any = true;
                judge(probe, channel, kind, count)?;
            }
        }
    }
    if any { Ok(()) } else { Err(nothing()) }
}

fn nothing() -> Stop {
    Stop::NotApplicable("there is no parameter at the moment".to_owned())
}

/// The names of a kind that are told, without those that are not; that is judged elsewhere.
fn told(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    count: u32,
) -> Step<Vec<(u32, CncString)>> {
    let mut all = Vec::new();
    for index in 1..=count {
        let request = DynamicNameByIndex::new(channel, kind, index).map_err(harness)?;
        // Where one is not there, none is behind it.
        let Some(data) = probe.try_ask(request)? else { break };
        let name = DynamicName::decode(&data).ok().map(|name| name.name.text);
        // One that leaves no room for its NUL cannot be asked for.
        let name = name.filter(|name| name.as_bytes().len() < DYNAMIC_NAME_MAX);
        all.extend(name.map(|name| (index, name)));
    }
    Ok(all)
}

/// The first name of a kind. A program may have deleted it meanwhile.
fn first(probe: &mut Probe<'_>, channel: Channel, kind: DynamicKind) -> Step<CncString> {
    let first = told(probe, channel, kind, 1)?.into_iter().next();
    let lacks = || Stop::Inconclusive(format!("{}: no name of index 1", prefix(kind)));
    first.map(|(_, name)| name).ok_or_else(lacks)
}

/// Sends what must be refused, beside a request that differs by the fault only and is answered.
fn refuses_still(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    what: &str,
    at: (Channel, DynamicKind),
    bad: Request<'_>,
    good: Request<'_>,
) -> Step {
    let mut buf = vec![0; bad.encoded_len()];
    let bad = bad.encode(&mut buf).map_err(harness)?;
    refused_still(probe, rule, what, at, &bad, good)
}

/// As [`refuses_still`], for what is no request.
fn refused_still(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    what: &str,
    (channel, kind): (Channel, DynamicKind),
    bad: &Call<'_>,
    good: Request<'_>,
) -> Step {
    let rule = rule.into();
    let count = CountDynamic::new(channel, kind).into();
    steady::steadily(probe, &[count, good], |probe, _| {
        let exchange = probe.call(bad)?;
        let given = exchange.answer().map(|answer| answer.success().unwrap_or_default());
        let refused = given.is_some_and(<[u8]>::is_empty);
        let expected = format!("an error number for {what}");
        Ok(vec![Checked::new(probe, rule, refused, expected, exchange.result())])
    })
}
