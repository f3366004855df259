//! Numbers of dynamic parameters, and their names by index.

use std::collections::HashSet;

use ads_cnc::Decode as _;
use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind, DynamicName};
use ads_cnc::limits::DYNAMIC_NAME_MAX;
use ads_cnc::operation::{
    CountDynamic, CountVariables, DynamicNameByIndex, DynamicValueByIndex, Function, Request,
};
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Hex};

use super::parameters::{PARAMETERS_MAX, each, nothing, number, prefix};
use crate::evidence::Evidence;
use crate::judge::{Checks as _, Step, Stop, assumed};
use crate::objects::KINDS;
use crate::profile::Claim;
use crate::suite::kit::{PendingCheck, Probe, between, steadily};
use crate::text::plural;

pub(super) fn count(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        let rules = [DYN_1, SDA_12];
        for kind in DynamicKind::ALL {
            let data = probe.ask(rules, CountDynamic::new(channel, kind))?;
            let count = DynamicCount::decode(&data);
            let found = || format!("{} for {}", plural(data.len(), "byte"), prefix(kind));
            probe.check(rules, count.is_ok(), "a number of 4 bytes", found);
            // A number in the wrong byte order usually exceeds this limit.
            let plausible = count.is_ok_and(|count| count.0 <= 0x00FF_FFFF);
            probe.check(rules, plausible, "a number of parameters", || format!("{count:?}"));
        }
        // The numbers of variables, which a function at another offset of the same index group
        // returns, must be available, too.
        if probe.claims(Function::CountVariables) == Claim::Yes {
            for (_, kind) in KINDS {
                let kind = CountVariables::new(channel, kind);
                let answered = probe.try_ask(kind)?.is_some();
                probe.check(SDA_12, answered, "a number of variables", "an error");
            }
        }
    }
    Ok(())
}

/// The reply to a request for the name of the parameter at an index.
struct NameReply {
    index: u32,
    data: Option<Vec<u8>>,
    result: String,
    evidence: Option<Evidence>,
}

fn ask_name(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    index: u32,
) -> Step<NameReply> {
    let request = DynamicNameByIndex::new(channel, kind, index)?;
    let exchange = probe.send(request)?;
    let data = exchange.success().map(<[u8]>::to_vec);
    Ok(NameReply { index, data, result: exchange.result(), evidence: probe.evidence() })
}

/// The names of the parameters of a kind, read while the number of parameters did not change.
struct ParameterList {
    count: u32,
    /// The replies for the indices 1 to `count` (at most [`PARAMETERS_MAX`]), up to and including
    /// that for the first rejected index.
    names: Vec<NameReply>,
    /// The reply for the index after the last.
    beyond: NameReply,
    /// For the first index whose reply depends on the order of the requests: its reply in
    /// descending order. `None` if there is no such index.
    unsteady: Option<NameReply>,
}

impl ParameterList {
    fn is_doubtful(&self) -> bool {
        let rejected = self.names.iter().any(|reply| reply.data.is_none());
        rejected || self.beyond.data.is_some() || self.unsteady.is_some()
    }

    fn is_same(&self, other: &Self) -> bool {
        let beyond = self.beyond.data == other.beyond.data;
        self.count == other.count && same(&self.names, &other.names) && beyond
    }
}

/// Maximum number of attempts to read a list that changes meanwhile or has a fault.
const TRIES: usize = 5;

fn names_ascending(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    count: u32,
) -> Step<Vec<NameReply>> {
    let mut all = Vec::new();
    for index in 1..=count.min(PARAMETERS_MAX) {
        let one = ask_name(probe, channel, kind, index)?;
        let is_rejected = one.data.is_none();
        all.push(one);
        if is_rejected {
            break;
        }
    }
    Ok(all)
}

fn names_descending(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    names: &[NameReply],
) -> Step<Vec<NameReply>> {
    let mut all = Vec::new();
    for one in names.iter().rev() {
        all.push(ask_name(probe, channel, kind, one.index)?);
    }
    all.reverse();
    Ok(all)
}

fn same(one: &[NameReply], other: &[NameReply]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one.data == other.data)
}

/// The list of a kind, read while it did not change. A list with a fault is returned only if two
/// such attempts in succession read the same list. `None` if [`TRIES`] attempts give no such list.
fn steady_list(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
) -> Step<Option<ParameterList>> {
    let mut doubtful: Option<ParameterList> = None;
    for _ in 0..TRIES {
        let count = |probe: &mut Probe<'_>| number(probe, channel, kind).map(Some);
        let list = between(probe, count, |probe, &count| listed(probe, channel, kind, count))?;
        let Some(list) = list.flatten() else { continue };
        // A fault in the list, such as a rejected index, must be reproducible.
        if !list.is_doubtful() || doubtful.is_some_and(|before| before.is_same(&list)) {
            return Ok(Some(list));
        }
        doubtful = Some(list);
    }
    Ok(None)
}

/// The list of a kind with `count` parameters, read in ascending and in descending order of the
/// indices; `None` if its names changed meanwhile.
fn listed(
    probe: &mut Probe<'_>,
    channel: Channel,
    kind: DynamicKind,
    count: u32,
) -> Step<Option<ParameterList>> {
    let names = names_ascending(probe, channel, kind, count)?;
    let beyond = ask_name(probe, channel, kind, count.saturating_add(1))?;
    let back = names_descending(probe, channel, kind, &names)?;
    let mut unsteady = None;
    if !same(&names, &back) {
        let once_more = names_ascending(probe, channel, kind, count)?;
        let and_back = names_descending(probe, channel, kind, &names)?;
        if !same(&names, &once_more) || !same(&back, &and_back) {
            return Ok(None);
        }
        let mut pairs = names.iter().zip(back);
        unsteady = pairs.find(|(one, other)| one.data != other.data).map(|(_, other)| other);
    }
    Ok(Some(ParameterList { count, names, beyond, unsteady }))
}

pub(super) fn names(probe: &mut Probe<'_>) -> Step {
    let (mut any, mut moved) = (false, None);
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            match steady_list(probe, channel, kind)? {
                Some(list) => {
                    any |= list.count > 0;
                    judge(probe, kind, &list);
                }
                None => {
                    moved = Some(format!("{} are created and deleted during the run", prefix(kind)))
                }
            }
        }
    }
    match (any, moved) {
        (true, _) => Ok(()),
        (false, Some(moved)) => Err(Stop::Inconclusive(moved)),
        (false, None) => Err(nothing()),
    }
}

fn judge(probe: &mut Probe<'_>, kind: DynamicKind, list: &ParameterList) {
    let ParameterList { count, names, beyond, unsteady } = list;
    let mut seen = HashSet::new();
    for reply in names {
        probe.set_evidence(reply.evidence.clone());
        let expected = || format!("a name for index {} of {count} {}", reply.index, prefix(kind));
        // If there is no name, the count, the range of indices or the offset of the function may be
        // wrong; at index 1, the function that returns names may be wrong, too.
        let rules: &[ClauseId] = match reply.index {
            1 => &[DYN_1, DYN_5, SDA_12, DYN_2],
            _ => &[DYN_1, DYN_5, SDA_12],
        };
        probe.check(rules, reply.data.is_some(), expected, &reply.result);
        let Some(data) = &reply.data else { continue };
        let found = || format!("{} of index {}", plural(data.len(), "byte"), reply.index);
        let expected = || format!("at most {DYNAMIC_NAME_MAX} bytes");
        probe.check(DYN_6, data.len() <= DYNAMIC_NAME_MAX, expected, found);
        let name = DynamicName::decode(data);
        if !probe.check(DYN_2, name.is_ok(), "a name", found) {
            continue;
        }
        let name = name.map(|name| name.name.text.to_string()).unwrap_or_default();
        let found = || format!("{name:?} at index {}", reply.index);
        let ended = name.chars().count() < DYNAMIC_NAME_MAX;
        probe.check(assumed(DYN_6), ended, "a name with space for its NUL", found);
        let of_kind = is_of(kind, &name);
        probe.check(DYN_2, of_kind, || format!("a name with the prefix {}", prefix(kind)), found);
        let own = seen.insert(name.clone());
        let is_valid_twice = of_kind && !own;
        probe.check([DYN_2, DYN_5], !is_valid_twice, "a different name at each index", found);
    }
    if let Some(other) = unsteady {
        probe.set_evidence(other.evidence.clone());
        let found = || format!("{}, requested in descending order", other.result);
        let expected =
            || format!("the same name for index {} in any order of requests", other.index);
        probe.check(DYN_2, false, expected, found);
    }
    // A CNC that has one parameter more than it reports returns the name of this parameter.
    probe.set_evidence(beyond.evidence.clone());
    let data = beyond.data.as_deref().unwrap_or_default();
    let name = DynamicName::decode(data).map(|name| name.name.text.to_string());
    let another = name.is_ok_and(|name| is_of(kind, &name) && !seen.contains(&name));
    let is_whole = *count <= PARAMETERS_MAX;
    let expected = || format!("only {} names of {}", count, prefix(kind));
    let found = || format!("index {} is {}", beyond.index, Hex(data.to_vec()));
    probe.check(DYN_1, !(another && is_whole), expected, found);
}

fn is_of(kind: DynamicKind, name: &str) -> bool {
    name.strip_prefix(prefix(kind)).is_some_and(|rest| !rest.is_empty())
}

/// Indices greater than `count`, including some with the lower bits of a valid index.
fn beyond(probe: &Probe<'_>, count: u32) -> Vec<u32> {
    let mut all = probe.beyond(count.saturating_add(1));
    if all.len() > 1 {
        let folded = [0x100, 0x1_0000, 0x100_0000, 0x8000_0000].map(|bit: u32| bit.wrapping_add(1));
        all.extend(folded.into_iter().filter(|&index| index > count));
    }
    all
}

/// Sends a request with an index that does not exist, and returns the check that the request is
/// rejected. Returns no check if the number of parameters, the first of the `answers`, is not
/// `count`.
fn rejected_of(
    probe: &mut Probe<'_>,
    count: u32,
    what: &str,
    answers: &[Vec<u8>],
    invalid: Request<'_>,
) -> Step<Vec<PendingCheck>> {
    let now = answers.first().and_then(|data| DynamicCount::decode(data).ok());
    if now != Some(DynamicCount(count)) {
        return Ok(Vec::new());
    }
    let exchange = probe.send(invalid)?;
    let expected = || format!("an error number for {what}");
    Ok(vec![PendingCheck::new(probe, DYN_5, exchange.is_rejected(), expected, &exchange)])
}

pub(super) fn index_beyond_last(probe: &mut Probe<'_>) -> Step {
    for channel in probe.channels()? {
        for kind in DynamicKind::ALL {
            let first: [Request<'_>; 2] = [
                DynamicNameByIndex::new(channel, kind, 1)?.into(),
                DynamicValueByIndex::new(channel, kind, 1)?.into(),
            ];
            let what = format!("index 1 of an empty {} list", prefix(kind));
            for first in first {
                let guards = [CountDynamic::new(channel, kind).into()];
                steadily(probe, &guards, |probe, answers| {
                    rejected_of(probe, 0, &what, answers, first)
                })?;
            }
        }
    }
    each(probe, |probe, channel, kind, count| {
        if count == PARAMETERS_MAX {
            return Ok(());
        }
        let requests = |index| -> Step<[Request<'_>; 2]> {
            let name = DynamicNameByIndex::new(channel, kind, index)?;
            let value = DynamicValueByIndex::new(channel, kind, index)?;
            Ok([name.into(), value.into()])
        };
        for beyond in beyond(probe, count) {
            let what = format!("index {beyond} of {count} {}", prefix(kind));
            for (invalid, valid) in requests(beyond)?.into_iter().zip(requests(count)?) {
                let guards = [CountDynamic::new(channel, kind).into(), valid];
                steadily(probe, &guards, |probe, answers| {
                    rejected_of(probe, count, &what, answers, invalid)
                })?;
            }
        }
        Ok(())
    })
}
