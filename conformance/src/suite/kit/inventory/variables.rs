//! The descriptions of a channel's variables, which are stored after they were read.

use ads_cnc::address::Channel;
use ads_cnc::limits::{TEXT_MAX, VARIABLE_MAX};
use ads_cnc::operation::{CountVariables, DescribeByIndex, Request};
use ads_cnc::{Decode, Description, Kind, TextRef, VariableCount};
use ads_cnc_vectors::ClauseId;

use crate::judge::{Step, Stop, applicable};
use crate::objects::KINDS;
use crate::suite::kit::{DescribedList, ItemKind, Probe};

/// Maximum number of variables of a kind in a channel that a case reads without sampling.
pub(crate) const VARIABLES_MAX: u32 = 10_000;

/// Maximum number of bytes of the stored descriptions of a target, because a target can report long
/// descriptions in many channels.
const DESCRIPTIONS_MAX: usize = 16 << 20;

/// The name of a described variable, for a request.
pub(crate) fn name_of(variable: &Description) -> TextRef<'_> {
    variable.name.text.as_cnc_str().into()
}

/// The variable; `None` if its name has no space for a NUL, so that no request can contain the
/// name.
fn requestable(variable: Description) -> Option<Description> {
    Some(variable).filter(|variable| variable.name.text.as_bytes().len() < TEXT_MAX)
}

impl Probe<'_> {
    /// The kinds of variables that can be listed according to the profile, each with its name.
    pub(crate) fn kinds(&self) -> Vec<(&'static str, Kind<'static>)> {
        let profile = &self.target.profile;
        KINDS.into_iter().filter(|(_, kind)| profile.has_kind(*kind)).collect()
    }

    /// The descriptions of the variables of a channel that the cases read, except those whose name
    /// is too long for a request. A stored description is not requested again. Ends the case as not
    /// applicable if there are none, and as inconclusive if one of the replies cannot be used.
    pub(crate) fn variables(&mut self, channel: Channel) -> Step<Vec<Description>> {
        let mut all = Vec::new();
        for (name, kind) in self.kinds() {
            let count = self.count_described(channel, name, kind)?;
            let indices = self.sample(ItemKind::Variable, 0..count);
            all.extend(self.described(channel, (name, kind), indices)?);
        }
        self.end_comparison();
        applicable(!all.is_empty(), "the target has no variable")?;
        Ok(all)
    }

    /// All descriptions of a channel's variables of the claimed kinds, except those whose name is
    /// too long for a request. For cases that must know which names or handles do not exist. `None`
    /// if the channel has more than [`VARIABLES_MAX`] variables of a claimed kind.
    pub(crate) fn all_variables(&mut self, channel: Channel) -> Step<Option<Vec<Description>>> {
        let mut all = Vec::new();
        for (name, kind) in self.kinds() {
            let count = self.count_described(channel, name, kind)?;
            if count > VARIABLES_MAX {
                return Ok(None);
            }
            all.extend(self.described(channel, (name, kind), 0..count)?);
        }
        self.end_comparison();
        Ok(Some(all))
    }

    /// Those of the [`variables`](Self::variables) whose whole value fits into a reply.
    pub(crate) fn readable(&mut self, channel: Channel) -> Step<Vec<Description>> {
        let mut all = self.variables(channel)?;
        let fits = |size: u32| usize::try_from(size).is_ok_and(|size| size <= VARIABLE_MAX);
        all.retain(|variable| fits(variable.size));
        Ok(all)
    }

    /// The number of variables of a kind in a channel. A stored number is not requested again.
    fn count_described(
        &mut self,
        channel: Channel,
        name: &'static str,
        kind: Kind<'_>,
    ) -> Step<u32> {
        let key = (u32::from(channel.number()), name);
        if let Some(known) = self.target.variables.get(&key) {
            return Ok(known.count);
        }
        let count: VariableCount = self.read_unjudged(CountVariables::new(channel, kind))?;
        let list = DescribedList { count: count.0, ..DescribedList::default() };
        self.target.variables.insert(key, list);
        Ok(count.0)
    }

    /// The descriptions with these indices, except those whose name is too long for a request.
    fn described(
        &mut self,
        channel: Channel,
        (name, kind): (&'static str, Kind<'_>),
        indices: impl IntoIterator<Item = u32>,
    ) -> Step<Vec<Description>> {
        let key = (u32::from(channel.number()), name);
        let mut all = Vec::new();
        for index in indices {
            let known = self.target.variables.get(&key).and_then(|list| list.read.get(&index));
            if let Some(known) = known {
                all.extend(known.clone());
                continue;
            }
            let variable: Description =
                self.read_unjudged(DescribeByIndex::new(channel, index, kind))?;
            let variable = requestable(variable);
            all.extend(variable.clone());
            if !self.store(key, index, variable) {
                // Without the stored descriptions, each case would request them again.
                return Err(Stop::Inconclusive(format!(
                    "{name} channel {channel}, index {index}: the descriptions of all channels that \
                     were read need more than {} MiB, which is the limit",
                    DESCRIPTIONS_MAX >> 20
                )));
            }
        }
        Ok(all)
    }

    /// Stores a description; `None` for a variable whose name is too long for a request. Stores
    /// nothing and returns false if the descriptions of all channels would exceed
    /// [`DESCRIPTIONS_MAX`].
    fn store(
        &mut self,
        key: (u32, &'static str),
        index: u32,
        variable: Option<Description>,
    ) -> bool {
        let lists = self.target.variables.values();
        let stored = lists.fold(0_usize, |sum, list| sum.saturating_add(list.bytes));
        let more = variable.as_ref().map_or(0, |variable| {
            let name = variable.name.text.as_bytes().len();
            name.saturating_add(size_of_val(variable.dimensions.as_slice()))
        });
        let more = more.saturating_add(size_of::<Option<Description>>());
        if stored.saturating_add(more) > DESCRIPTIONS_MAX {
            return false;
        }
        let list = self.target.variables.entry(key).or_default();
        list.bytes = list.bytes.saturating_add(more);
        list.read.insert(index, variable);
        true
    }

    /// Returns a description that the case judges. A stored description is returned without a
    /// request. A reply that is not a description violates `rule` and ends the case.
    pub(crate) fn judged_description(
        &mut self,
        rule: ClauseId,
        channel: Channel,
        (name, kind): (&'static str, Kind<'_>),
        index: u32,
    ) -> Step<Description> {
        let key = (u32::from(channel.number()), name);
        let known = self.target.variables.get(&key).and_then(|list| list.read.get(&index));
        if let Some(Some(known)) = known {
            return Ok(known.clone());
        }
        let is_new = known.is_none() && self.target.variables.contains_key(&key);
        let variable: Description = self.read(rule, DescribeByIndex::new(channel, index, kind))?;
        if is_new {
            self.store(key, index, requestable(variable.clone()));
        }
        Ok(variable)
    }

    /// Reads and decodes a reply that other cases judge. If the reply is not a success or cannot be
    /// decoded, this case is inconclusive.
    fn read_unjudged<'a, T>(&mut self, request: impl Into<Request<'a>>) -> Step<T>
    where
        T: for<'b> Decode<'b>,
    {
        let exchange = self.send(request)?;
        let what = T::STREAM.layout().name;
        let lacks = |why: String| Stop::Inconclusive(format!("no {what} could be read: {why}"));
        T::decode(exchange.success().ok_or_else(|| lacks(exchange.result()))?)
            .map_err(|error| lacks(error.to_string()))
    }
}
