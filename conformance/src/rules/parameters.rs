//! Dynamic parameters, compared across exchanges.

use ads_cnc::operation::{Call, Reply, Request};
use ads_cnc_vectors::ids::*;

use super::knowledge::{ExchangeJudge, ObservedCount};
use super::observation::Observation;
use super::topic::Topic;
use crate::judge::{Checks as _, assumed};

impl ExchangeJudge<'_> {
    pub(super) fn parameters(
        &mut self,
        observation: &dyn Observation,
        request: &Request<'_>,
        reply: Option<&Reply<'_>>,
        call: &Call<'_>,
    ) {
        let group = call.index_group.get();
        let (kind, index) = match request {
            Request::CountDynamic(count) => {
                if let Some(Reply::DynamicCount(number)) = reply {
                    self.number_of_parameters(
                        observation,
                        (group, count.kind.to_string()),
                        number.0,
                    );
                }
                return;
            }
            Request::DynamicNameByIndex(name) => (name.kind, name.index),
            Request::DynamicValueByIndex(value) => (value.kind, value.index),
            _ => return,
        };
        let known = self.cnc.parameters.counts.get_mut(&(group, kind.to_string()));
        let Some(ObservedCount { number: count, answered_beyond }) = known else { return };
        let count = *count;
        if index > count && reply.is_some() {
            // A program may have created a parameter; the next count will show that.
            *answered_beyond = Some(index);
            return;
        }
        if index > count {
            let expected = || match count {
                0 => "no request for an index, because the list is empty".to_owned(),
                _ => format!("an index from 1 to {count}"),
            };
            let found = || format!("index {index}");
            self.judge_nonexistent(observation, request, DYN_5, expected, found);
        }
        self.records.on(Topic::CncDyn, observation).pass(DYN_5);
        let name = match reply {
            Some(Reply::DynamicName(name)) => name.name.text(),
            _ => return,
        };
        let prefix = kind.to_string();
        let of_kind = name.to_string().starts_with(&prefix);
        let mut record = self.records.on(Topic::CncDyn, observation);
        record.check(DYN_2, of_kind, || format!("a name of {prefix}"), || format!("{name:?}"));
    }

    /// Stores a number. Names are not stored, because a parameter's index may change.
    ///
    /// DYN-4
    fn number_of_parameters(
        &mut self,
        observation: &dyn Observation,
        key: (u32, String),
        number: u32,
    ) {
        let length = key.1.len();
        // A subprogram may have created a V.L variable and deleted it at its end.
        let rule = if key.1 == "V.L" { assumed(DYN_5) } else { DYN_5.into() };
        let counts = &mut self.cnc.parameters.counts;
        if !counts.contains_key(&key) && !self.budget.take(length) {
            return;
        }
        let before = counts.insert(key, ObservedCount { number, answered_beyond: None });
        let same = before.filter(|before| before.number == number);
        if let Some(index) = same.and_then(|before| before.answered_beyond) {
            let expected =
                || format!("an error number for index {index} between two counts of {number}");
            self.records.on(Topic::CncDyn, observation).check(rule, false, expected, "a success");
        }
    }
}
