//! Numbers, descriptions and handles of variables, compared across exchanges.

use ads_cnc::limits::TEXT_MAX;
use ads_cnc::operation::{Call, Reply, Request};
use ads_cnc::{
    CncStr, Description, ExtendedReply, Kind, Synchronisation, Validity, VariableAccess,
    VariablePath, VariableType,
};
use ads_cnc_vectors::ids::*;

use super::knowledge::{ChannelVariables, ExchangeJudge, MemoryBudget, TargetVariable, Variables};
use super::topic::Topic;
use crate::judge::{Checks, assumed};
use crate::text::plural;

/// Maximum number of index groups of channels of a CNC whose variables are stored.
const CHANNELS_MAX: usize = 512;

impl ChannelVariables {
    /// Stores the name of a handle and the first handle of the name, if enough memory is left.
    fn handle(&mut self, handle: u32, name: &str, budget: &mut MemoryBudget) {
        if self.handles.contains_key(&handle) || budget.take(name.len()) {
            self.handles.insert(handle, name.to_owned());
        }
        if !self.names.contains_key(name) && budget.take(name.len()) {
            self.names.insert(name.to_owned(), handle);
        }
    }
}

impl Variables {
    fn channel(&mut self, call: &Call<'_>) -> Option<&mut ChannelVariables> {
        let group = call.index_group.get();
        if !self.channels.contains_key(&group) && self.channels.len() >= CHANNELS_MAX {
            return None;
        }
        Some(self.channels.entry(group).or_default())
    }

    /// The name of a handle, if an observed reply contained this handle.
    pub(super) fn name_of(&self, group: u32, handle: u32) -> Option<&str> {
        self.channels.get(&group)?.handles.get(&handle).map(String::as_str)
    }

    /// The variable that a request reads or writes, if its description is known, and the indices.
    pub(super) fn described(&self, request: &Request<'_>) -> Option<TargetVariable> {
        let by_handle = |group: u32, handle: u32, indices: Vec<u32>| {
            let channel = self.channels.get(&group)?;
            let (description, ..) = channel.described.get(channel.handles.get(&handle)?)?;
            Some(TargetVariable { description: description.clone(), indices })
        };
        let group = |channel: ads_cnc::address::Channel| {
            use ads_cnc::address::{Attribute, Class};
            channel.class(Class::Decoder, Attribute::Content).get()
        };
        match request {
            Request::ReadByHandle(read) => {
                by_handle(group(read.channel), read.handle.0, read.indices.iter().collect())
            }
            Request::WriteByHandle(write) => {
                by_handle(group(write.channel), write.handle.0, write.indices.iter().collect())
            }
            Request::ReadByName(read) => self.by_name(group(read.channel), read.name.text()),
            Request::WriteByName(write) => self.by_name(group(write.channel), write.name),
            _ => None,
        }
    }

    fn by_name(&self, group: u32, name: CncStr<'_>) -> Option<TargetVariable> {
        let channel = self.channels.get(&group)?;
        let of = |name: String, indices| {
            let (description, ..) = channel.described.get(&name)?;
            Some(TargetVariable { description: description.clone(), indices })
        };
        let path = VariablePath::from_text(name).ok()?;
        of(name.to_string(), Vec::new())
            .or_else(|| of(path.variable().text().to_string(), path.elements().iter().collect()))
    }
}

/// The kinds of variables that programs can create and delete.
const OF_PROGRAM: [&str; 3] = ["V.P", "V.L", "V.S"];

impl ExchangeJudge<'_> {
    pub(super) fn variables(&mut self, request: &Request<'_>, reply: Option<&Reply<'_>>) {
        match (request, reply) {
            (Request::CountVariables(count), Some(Reply::VariableCount(number))) => {
                self.number(count.kind.text().to_string(), number.0);
            }
            (Request::DescribeByIndex(describe), reply) => {
                let kind = describe.kind.text().to_string();
                let known = self.bound(&kind).filter(|count| describe.index >= *count);
                if let Some(count) = known {
                    let (index, none) = (describe.index, reply.is_none());
                    let expected = || format!("an index below {count}");
                    let found = || format!("index {index}");
                    self.judge_nonexistent(request, VAR_2, expected, found);
                    let expected = || format!("an error number for index {index} of {count}");
                    let mut record = self.records.on(Topic::CncVar, self.observation);
                    record.check(VAR_2, none, expected, "a description");
                    return;
                }
                if let Some(Reply::Description(variable)) = reply {
                    self.description(variable.to_owned(), kind, describe.index);
                }
            }
            (Request::HandleByName(handle), Some(Reply::Handle(given))) => {
                self.handle(handle.name.text(), given.0);
            }
            (Request::DescribeExtended(describe), Some(Reply::Extended(given))) => {
                let mut record = self.records.on(Topic::CncVar, self.observation);
                let at = format!("index {} of {}", describe.index, describe.kind.text());
                if describe.kind == Kind::V_E {
                    check_extended(&mut record, given, &at);
                } else if [Kind::V_G, Kind::V_A].contains(&describe.kind) {
                    let expected = || format!("no data for {at}");
                    record.check(VAR_16, given.0.is_none(), expected, "an extended description");
                }
            }
            (Request::DescribeByName(describe), Some(Reply::DescriptionByName(given))) => {
                let name = describe.name.text().to_string();
                let known = self.cnc.variables.channel(self.call);
                let known = known.and_then(|channel| channel.described.get(&name)).cloned();
                if let Some((known, ..)) = known {
                    let same = given.var_type == known.var_type
                        && given.access == known.access
                        && given.size == known.size
                        && given.dimensions.iter().eq(known.dimensions.iter().copied());
                    let dimensions = given.dimensions.iter().collect::<Vec<_>>();
                    let found = || in_words(given.var_type, given.access, given.size, &dimensions);
                    let mut record = self.records.on(Topic::CncVar, self.observation);
                    let expected = || {
                        let Description { var_type, access, size, ref dimensions, .. } = known;
                        format!("as by index: {}", in_words(var_type, access, size, dimensions))
                    };
                    record.check(VAR_28, same, expected, found);
                }
            }
            _ => {}
        }
    }

    /// The number of variables of a kind, unless a program may change it.
    fn bound(&mut self, kind: &str) -> Option<u32> {
        let counts = &self.cnc.variables.channel(self.call)?.counts;
        // The number for the empty kind is not a bound either, because it belongs to several kinds.
        let is_of_program = kind.is_empty() || OF_PROGRAM.contains(&kind);
        counts.get(kind).copied().filter(|_| !is_of_program)
    }

    fn number(&mut self, kind: String, number: u32) {
        let Some(channel) = self.cnc.variables.channel(self.call) else { return };
        let changed = channel.counts.get(&kind).is_some_and(|known| *known != number);
        if changed {
            // The configuration may have changed, so everything that is stored about the channel
            // may be obsolete.
            *channel = ChannelVariables::default();
        }
        if channel.counts.len() < 64 {
            channel.counts.insert(kind, number);
        }
        let counts = &channel.counts;
        let of = |kind: &str| counts.get(kind).copied();
        if let (Some(all), Some(g), Some(e), Some(a)) = (of(""), of("V.G"), of("V.E"), of("V.A")) {
            let sum = g.saturating_add(e).saturating_add(a);
            let expected = || format!("{} of all kinds", plural(sum, "variable"));
            let mut record = self.records.on(Topic::CncVar, self.observation);
            record.check(VAR_1, all == sum, expected, all);
        }
    }

    fn description(&mut self, variable: Description, kind: String, index: u32) {
        let mut record = self.records.on(Topic::CncVar, self.observation);
        record.about(&variable.name.text);
        check_description(&mut record, &variable, &kind);
        let Some(channel) = self.cnc.variables.channel(self.call) else { return };
        let name = variable.name.text.to_string();
        let handle = variable.handle.0;
        if let Some((known, of, at)) = channel.described.get(&name) {
            let unique = *of == kind && *at == index;
            let found = || format!("{name} at index {index}, and at {at}");
            record.check(VAR_3, unique, "a different variable at each index", found);
            let words = |one: &Description| {
                let facts = in_words(one.var_type, one.access, one.size, &one.dimensions);
                format!("handle {:#x}, {facts}", one.handle.0)
            };
            let same = !unique || *known == variable;
            let expected = || format!("as before: {}", words(known));
            record.check(assumed(VAR_4), same, expected, || words(&variable));
        }
        let other = channel.handles.get(&handle).filter(|other| **other != name);
        let found = || {
            format!("the handle {handle:#x}, which {} has too", other.map_or("", String::as_str))
        };
        record.check(assumed(VAR_10), other.is_none(), "a handle that no other name has", found);
        channel.handle(handle, &name, self.budget);
        let length = name.len().saturating_add(variable.dimensions.len()).saturating_mul(4);
        if channel.described.contains_key(&name) || self.budget.take(length) {
            channel.described.insert(name, (variable, kind, index));
        }
    }

    fn handle(&mut self, name: CncStr<'_>, handle: u32) {
        let text = name.to_string();
        let mut record = self.records.on(Topic::CncVar, self.observation);
        // Both editions exclude V.CYC from requests for handles. Only one edition also excludes
        // V.P, V.L and V.S, so these kinds are not judged.
        let barred = text.starts_with("V.CYC");
        let expected = "an error number, because V.CYC has no handles";
        record.check(VAR_18, !barred, expected, || format!("{handle:#x}"));
        let Some(channel) = self.cnc.variables.channel(self.call) else { return };
        let before = channel.names.get(&text).copied();
        let rule = assumed(VAR_10);
        if let Some(before) = before {
            let expected = || format!("{before:#x}, as before for {text}");
            record.check(rule, before == handle, expected, || format!("{handle:#x}"));
        }
        let other = channel.handles.get(&handle).filter(|other| **other != text).cloned();
        let found = || format!("the handle of {}", other.as_deref().unwrap_or_default());
        record.check(rule, other.is_none(), || format!("a handle that only {text} has"), found);
        channel.handle(handle, &text, self.budget);
    }
}

/// Checks the extended description of a V.E variable.
pub(crate) fn check_extended(record: &mut impl Checks, reply: &ExtendedReply, at: &str) {
    let found = || format!("no data for {at}");
    record.check(VAR_15, reply.0.is_some(), "an extended description", found);
    let Some(extended) = reply.0 else { return };
    let known = [Synchronisation::NO_SYNC, Synchronisation::SYNCHRONIZED];
    let passed = known.contains(&extended.synchronisation);
    let found = || format!("{} for {at}", extended.synchronisation.0);
    record.check(VAR_15, passed, "a synchronisation of 1 or 2", found);
    let known = [Validity::CHANNEL, Validity::GLOBAL];
    let found = || format!("{} for {at}", extended.validity.0);
    record.check(VAR_15, known.contains(&extended.validity), "a validity of 1 or 2", found);
}

/// A description, as shown in a report.
fn in_words(ty: VariableType, access: VariableAccess, size: u32, dimensions: &[u32]) -> String {
    format!("{ty}, {access}, {}, dimensions {dimensions:?}", plural(size, "byte"))
}

/// The number of elements of an array; 1 for another variable.
pub(crate) fn element_count(dimensions: &[u32]) -> u32 {
    dimensions.iter().fold(1, |all, &n| all.saturating_mul(n))
}

/// Checks a description by itself.
pub(crate) fn check_description(record: &mut impl Checks, variable: &Description, kind: &str) {
    let name = variable.name.text.to_string();
    let of_kind = name.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'));
    record.check(VAR_3, of_kind, || format!("a name of {kind}"), || format!("{name:?}"));
    let askable = name.chars().count() < TEXT_MAX;
    record.check(VAR_9, askable, "a name of at most 255 characters", || format!("{name:?}"));
    let readable = !name.chars().any(char::is_control);
    record.check(assumed(GEN_3), readable, "a name of CP1252 characters", || format!("{name:?}"));
    let known = variable.var_type.name().is_some();
    let expected = "a type from 1 to 9";
    record.check(VAR_5, known, expected, || format!("{} of {name}", variable.var_type.0));
    let access = variable.access;
    let known = matches!(access, VariableAccess::READ_ONLY | VariableAccess::READ_WRITE);
    record.check(VAR_6, known, "access 1 or 2", || format!("{} of {name}", access.0));
    let empty = variable.dimensions.contains(&0);
    let found = || format!("{:?} of {name}", variable.dimensions);
    record.check(VAR_4, !empty, "at least one element in each dimension", found);
    record.check(VAR_7, !empty, "dimensions for an array only", found);
    let Description { var_type, access, .. } = variable;
    // Type and access are invalid in this order, but valid when exchanged.
    let exchanged = !(1..=2).contains(&access.0)
        && VariableType(access.0).name().is_some()
        && (1..=2).contains(&var_type.0);
    let found = || format!("{} and {} of {name}", var_type.0, access.0);
    record.check(VAR_4, !exchanged, "the type, followed by the access", found);
    let Some(size) = variable.var_type.element_size() else { return };
    if variable.dimensions.is_empty() {
        let one = variable.size < size.saturating_mul(2);
        let found = || format!("{} of {name}", plural(variable.size, "byte"));
        // If the size is larger, the description may lack the dimensions, so VAR-4 is judged too.
        record.check([VAR_7, VAR_4], one, "the size of one element without a dimension", found);
    }
    let whole = size.saturating_mul(element_count(&variable.dimensions));
    let expected =
        || format!("{} for {:?} {}", plural(whole, "byte"), variable.dimensions, variable.var_type);
    let found = || format!("{} of {name}", plural(variable.size, "byte"));
    record.check(VAR_8, variable.size == whole, expected, found);
    // A size in the wrong byte order usually exceeds this limit.
    let plausible = variable.size <= 0x00FF_FFFF;
    record.check(GEN_1, plausible, "a little-endian size", || format!("{:#x}", variable.size));
}
