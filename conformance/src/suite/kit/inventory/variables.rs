//! All descriptions of a channel, read once.

use ads_cnc::address::Channel;
use ads_cnc::limits::{TEXT_MAX, VARIABLE_MAX};
use ads_cnc::operation::{CountVariables, DescribeByIndex, Request};
use ads_cnc::{Decode, Description, Kind, TextRef, VariableCount};

use crate::judge::{Step, Stop, applicable};
use crate::objects::KINDS;
use crate::suite::kit::Probe;

/// Maximum number of variables of a kind that are read.
pub(crate) const VARIABLES_MAX: u32 = 10_000;

/// The name in a description, as in a request.
pub(crate) fn name_of(variable: &Description) -> TextRef<'_> {
    variable.name.text.as_cnc_str().into()
}

impl Probe<'_> {
    /// The kinds that the target lists.
    pub(crate) fn kinds(&self) -> Vec<(&'static str, Kind<'static>)> {
        let profile = &self.target.profile;
        KINDS.into_iter().filter(|(_, kind)| profile.has_kind(*kind)).collect()
    }

    /// All descriptions of a channel. Cases that judge descriptions read them again; here an
    /// unreadable one is skipped.
    pub(crate) fn variables(&mut self, channel: Channel) -> Step<Vec<Description>> {
        let mut all = Vec::new();
        for (name, kind) in self.kinds() {
            let key = (u32::from(channel.number()), name);
            if !self.target.variables.contains_key(&key) {
                let described = self.describe(channel, kind)?;
                self.target.variables.insert(key, described);
            }
            all.extend(self.target.variables.get(&key).into_iter().flatten().cloned());
        }
        applicable(!all.is_empty(), "the target has no variable")?;
        Ok(all)
    }

    /// Variables whose whole value fits into a reply.
    pub(crate) fn readable(&mut self, channel: Channel) -> Step<Vec<Description>> {
        let mut all = self.variables(channel)?;
        let fits = |size: u32| usize::try_from(size).is_ok_and(|size| size <= VARIABLE_MAX);
        all.retain(|variable| fits(variable.size));
        Ok(all)
    }

    fn describe(&mut self, channel: Channel, kind: Kind<'_>) -> Step<Vec<Description>> {
        let count: VariableCount = self.read_unjudged(CountVariables::new(channel, kind))?;
        let indices = 0..count.0.min(VARIABLES_MAX);
        let mut all = Vec::new();
        for index in indices {
            let variable: Description =
                self.read_unjudged(DescribeByIndex::new(channel, index, kind))?;
            // A name without room for its NUL cannot be requested.
            if variable.name.text.as_bytes().len() < TEXT_MAX {
                all.push(variable);
            }
        }
        Ok(all)
    }

    /// Reads a stream that other cases judge.
    fn read_unjudged<'a, T>(&mut self, request: impl Into<Request<'a>>) -> Step<T>
    where
        T: for<'b> Decode<'b>,
    {
        let exchange = self.send(request)?;
        let what = T::STREAM.layout().name;
        let lacks = |why: String| Stop::Inconclusive(format!("no {what} to go by: {why}"));
        T::decode(exchange.success().ok_or_else(|| lacks(exchange.result()))?)
            .map_err(|error| lacks(error.to_string()))
    }
}
