//! The dynamic parameters that the cases read.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{CountDynamic, DynamicNameByIndex, Request};
use ads_cnc::{CncString, Decode as _};

use crate::judge::{Rule, Step, Stop};
use crate::suite::kit::{IntoRawCall, PendingCheck, Probe, steadily};

/// Maximum number of parameters of a kind that are read.
pub(super) const PARAMETERS_MAX: u32 = 1_000;

/// The prefix of the names of a kind, which also denotes the kind in messages.
pub(super) const fn prefix(kind: DynamicKind) -> &'static str {
    match kind {
        DynamicKind::P => "P",
        DynamicKind::VL => "V.L.",
        DynamicKind::VP => "V.P.",
        DynamicKind::VS => "V.S.",
    }
}

/// The number of parameters of a kind; 0 if the target does not return it, which other cases judge.
pub(super) fn number(probe: &mut Probe<'_>, channel: Channel, kind: DynamicKind) -> Step<u32> {
    let count = probe.try_read::<DynamicCount>(CountDynamic::new(channel, kind))?;
    Ok(count.map_or(0, |count| count.0))
}

/// Calls a function for every kind of parameters that a claimed channel has, with their number, at
/// most [`PARAMETERS_MAX`]. Ends the case as not applicable if there are none.
pub(super) fn each(
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

pub(super) fn nothing() -> Stop {
    Stop::not_applicable("no dynamic parameter exists at the moment")
}

/// The indices and names of the first `count` parameters of a kind, up to the first index that is
/// rejected; other cases judge the rejection. A name that no request can contain is left out.
pub(super) fn names_of(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    count: u32,
) -> Step<Vec<(u32, CncString)>> {
    let mut all = Vec::new();
    for index in 1..=count {
        let request = DynamicNameByIndex::new(channel, kind, index)?;
        // A missing index ends the list.
        let Some(data) = probe.try_ask(request)? else { break };
        let name = DynamicName::decode(&data).ok().map(|name| name.name.text);
        // A name without space for its NUL cannot be requested.
        let name = name.filter(|name| name.as_bytes().len() < DYNAMIC_NAME_MAX);
        all.extend(name.map(|name| (index, name)));
    }
    Ok(all)
}

/// The name at index 1 of a kind. The case is inconclusive if index 1 has no name that a request
/// can contain, because an NC program may have deleted the parameter meanwhile.
pub(super) fn first(probe: &mut Probe<'_>, channel: Channel, kind: DynamicKind) -> Step<CncString> {
    let first = names_of(probe, channel, kind, 1)?.into_iter().next();
    let lacks = || Stop::Inconclusive(format!("{}: index 1 has no name", prefix(kind)));
    first.map(|(_, name)| name).ok_or_else(lacks)
}

/// Checks that a request is rejected. The check counts only if `valid`, the same request without
/// the fault, returns the same data before and after it, and the number of parameters does not
/// change.
pub(super) fn rejects_steadily<'a>(
    probe: &mut Probe<'_>,
    rule: impl Into<Rule>,
    what: &str,
    (channel, kind): (Channel, DynamicKind),
    invalid: impl IntoRawCall<'a>,
    valid: Request<'_>,
) -> Step {
    let (rule, invalid) = (rule.into(), invalid.into_raw_call()?);
    let count = CountDynamic::new(channel, kind).into();
    steadily(probe, &[count, valid], |probe, _| {
        let exchange = probe.call(&invalid)?;
        let expected = || format!("an error number for {what}");
        Ok(vec![PendingCheck::new(probe, rule, exchange.is_rejected(), expected, &exchange)])
    })
}
