//! Verifies that a reply belongs to its own request, not to an earlier one.

use std::collections::BTreeMap;

use ads_cnc::operation::{
    CountObjects, CountVariables, DescribeByIndex, Function, ReadDescriptors,
};

use crate::ads_service::clause;
use crate::judge::{Checks as _, Rule, Step};
use crate::profile::Claim;
use crate::suite::kit::{ChannelItems, Probe, RawCall, content_reads};

/// Maximum number of requests of a function that are tried to find two requests with different
/// replies.
const CALLS_MAX: usize = 6;
/// Number of attempts. The check fails only if all attempts return a wrong reply, because a value
/// may change between two requests.
const TRIES: usize = 3;

pub(super) fn own_reply(probe: &mut Probe<'_>) -> Step {
    for (function, calls) in calls_by_function(probe)? {
        let Some((call, other, earlier)) = different(probe, calls)? else { continue };
        let rules = [clause(call.service).into(), Rule::of(function.spec().clause)];
        let mut is_own = false;
        for _ in 0..TRIES {
            probe.call(&other)?;
            let first = data_of(probe, &call)?;
            let evidence = probe.evidence();
            let (second, third) = (data_of(probe, &call)?, data_of(probe, &call)?);
            // If `second` and `third` differ, the value changes by itself, and `first` may equal
            // the reply to the other request by chance.
            let is_another = first.as_ref().is_some_and(|first| *first != earlier);
            is_own |= first == second || second != third || is_another;
            probe.set_evidence(evidence);
        }
        let expected = || format!("{}: the reply to this request", function.spec().name);
        probe.check(
            &rules[..],
            is_own,
            expected,
            "a different reply than to the same request sent again",
        );
    }
    probe.finish("no function has two different replies")
}

/// Queries about the lists and the first items of the claimed channels, by function: at most
/// [`CALLS_MAX`] of a function, and none of a function that the profile does not claim.
fn calls_by_function(probe: &mut Probe<'_>) -> Step<BTreeMap<Function, Vec<RawCall>>> {
    let mut all: BTreeMap<Function, Vec<RawCall>> = BTreeMap::new();
    for channel in probe.channels()? {
        let mut calls = vec![RawCall::new(CountObjects::new(channel))?];
        for first in 1..=2 {
            calls.push(RawCall::new(ReadDescriptors::new(channel, first, 1)?)?);
        }
        for (_, kind) in probe.kinds() {
            calls.push(RawCall::new(CountVariables::new(channel, kind))?);
            calls.push(RawCall::new(DescribeByIndex::new(channel, 0, kind))?);
        }
        let items = ChannelItems::read(probe, channel)?;
        for request in items.requests(channel)? {
            calls.push(RawCall::new(request)?);
        }
        calls.extend(content_reads(probe, channel)?);
        for call in calls {
            let Ok(request) = call.call().dispatch() else { continue };
            let function = request.function();
            // Extended descriptions belong to VAR-15, which this case does not judge.
            if function == Function::DescribeExtended {
                continue;
            }
            let of_function = all.entry(function).or_default();
            if of_function.len() < CALLS_MAX && probe.claims(function) != Claim::No {
                of_function.push(call);
            }
        }
    }
    Ok(all)
}

/// Two requests with different replies, and the reply to the second of them. Each request is sent
/// twice, because the first reply may belong to an earlier request.
fn different(
    probe: &mut Probe<'_>,
    calls: Vec<RawCall>,
) -> Step<Option<(RawCall, RawCall, Vec<u8>)>> {
    let mut known: Option<(RawCall, Vec<u8>)> = None;
    for call in calls {
        probe.call(&call)?;
        let Some(data) = data_of(probe, &call)? else { continue };
        match &known {
            Some((other, theirs)) if *theirs != data => {
                return Ok(Some((call, other.clone(), theirs.clone())));
            }
            Some(_) => {}
            None => known = Some((call, data)),
        }
    }
    Ok(None)
}

fn data_of(probe: &mut Probe<'_>, call: &RawCall) -> Step<Option<Vec<u8>>> {
    Ok(probe.call(call)?.success().map(<[u8]>::to_vec))
}
