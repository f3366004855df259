//! Dynamic parameters, compared across exchanges.

use ads_cnc::operation::{Call, Reply, Request};
use ads_cnc_vectors::ids::*;

use super::knowledge::{ExchangeJudge, MemoryBudget, ObservedParameters};
use super::observation::Observation;
use super::topic::Topic;
use crate::judge::Checks as _;

impl ObservedParameters {
    /// Stores a count. Names are not stored because indices move (DYN-4).
    fn learn(&mut self, budget: &mut MemoryBudget, (group, kind): (u32, String), count: u32) {
        let length = kind.len();
        let key = (group, kind);
        if self.counts.contains_key(&key) || budget.take(length) {
            self.counts.insert(key, count);
        }
    }
}

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
                    self.cnc.parameters.learn(
                        self.budget,
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
        let Some(&count) = self.cnc.parameters.counts.get(&(group, kind.to_string())) else {
            return;
        };
        if index > count {
            let expected = || format!("one of 1 to {count}");
            let found = || format!("index {index}");
            self.judge_nonexistent(observation, request, DYN_5, expected, found);
        }
        let passed = index <= count || reply.is_none();
        let expected = || format!("an error number for index {index} of {count}");
        self.records.on(Topic::CncDyn, observation).check(DYN_5, passed, expected, "a success");
        let name = match reply {
            Some(Reply::DynamicName(name)) => name.name.text(),
            _ => return,
        };
        let prefix = kind.to_string();
        let of_kind = name.to_string().starts_with(&prefix);
        let mut record = self.records.on(Topic::CncDyn, observation);
        record.check(DYN_2, of_kind, || format!("a name of {prefix}"), || format!("{name:?}"));
    }
}
