//! The clauses of the manuals as checks of a request, its reply and what earlier ones have shown.
//!
//! `ads-cnc check` applies them to captured traffic, `ads-cnc run` to every exchange it makes with a
//! target, `ads-cnc run --client` and `--listen` to every request of a client. A [`RuleBook`] records
//! the checks by [`Topic`].

mod elements;
mod knowledge;
mod objects;
mod parameters;
mod replies;
mod requests;
mod service;
mod streaming;
mod topic;
mod values;
mod variables;

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc::ads::{AmsHeader, AmsNetId, Command};
use ads_cnc::operation::{Call, Request};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

pub(crate) use self::elements::{
    check_group, check_length, check_offset, check_type, element_type,
};
pub(crate) use self::knowledge::TargetVariable;
use self::knowledge::{ExchangeJudge, Knowledge, MemoryBudget};
pub(crate) use self::objects::check_descriptor;
pub(crate) use self::requests::function_at;
pub(crate) use self::topic::{Topic, TopicRecords, reply_cases};
pub(crate) use self::variables::{check_description, check_extended};
use crate::exchange::{Exchange, Violation};
use crate::judge::Evidence;
use crate::wire_service;

/// Maximum number of CNCs that are distinguished.
const CNCS_MAX: usize = 64;

/// The frames that a check is about.
pub(crate) trait Observation {
    fn evidence(&self) -> Evidence;

    /// When the request was sent, from any common start; `None` if unknown.
    fn time(&self) -> Option<Duration> {
        None
    }
}

impl Observation for Exchange {
    fn evidence(&self) -> Evidence {
        Evidence::from(self)
    }
}

/// The checks of all exchanges, and what they have shown of each CNC.
#[derive(Debug)]
pub(crate) struct RuleBook {
    pub(crate) records: TopicRecords,
    cncs: BTreeMap<AmsNetId, Knowledge>,
    /// Whether requests are missing that may have changed the state of a CNC.
    is_lost: bool,
    budget: MemoryBudget,
}

impl RuleBook {
    /// `is_lost`: a CNC may have received requests before the first observed one.
    pub(crate) fn new(is_lost: bool) -> Self {
        let budget = MemoryBudget { left: MemoryBudget::ALL, missed: 0 };
        Self { records: TopicRecords::new(), cncs: BTreeMap::new(), is_lost, budget }
    }

    /// Number of entries that were not stored, so that later exchanges were not compared with them.
    pub(crate) const fn missed(&self) -> u64 {
        self.budget.missed
    }

    /// Missing requests may have changed any state: forgets what is known of all CNCs.
    pub(crate) fn forget_cncs(&mut self) {
        self.cncs.clear();
        self.is_lost = true;
    }

    /// Judges the headers of a request. `is_repeated`: whether another request with this invoke ID
    /// waits for its reply, if that is known.
    pub(crate) fn request_headers(
        &mut self,
        observation: &dyn Observation,
        header: &AmsHeader,
        is_repeated: Option<bool>,
    ) {
        requests::headers(&mut self.records, observation, header, is_repeated);
    }

    /// Judges a request; returns its address if no manual documents it.
    pub(crate) fn request(
        &mut self,
        observation: &dyn Observation,
        call: &Call<'_>,
    ) -> Option<String> {
        requests::judge(&mut self.records, observation, call)
    }

    /// Judges a reply by itself and with earlier ones of the same CNC.
    pub(crate) fn reply(
        &mut self,
        observation: &dyn Observation,
        cnc: AmsNetId,
        call: &Call<'_>,
        exchange: &Exchange,
        violations: &[Violation],
    ) {
        replies::headers(&mut self.records, observation, violations);
        let Some(answer) = replies::service(&mut self.records, observation, exchange) else {
            return;
        };
        if !answer.ams_error.is_ok() {
            // The CNC may be gone, and another one may take its NetId.
            self.cncs.remove(&cnc);
            return;
        }
        if !self.cncs.contains_key(&cnc) && self.cncs.len() >= CNCS_MAX {
            return;
        }
        let knowledge = self.cncs.entry(cnc).or_insert_with(|| Knowledge::new(self.is_lost));
        let mut judge =
            ExchangeJudge { records: &mut self.records, cnc: knowledge, budget: &mut self.budget };
        replies::judge(&mut judge, observation, call, answer);
    }

    /// The described variable that a request reads or writes.
    pub(crate) fn described(&self, cnc: AmsNetId, request: &Request<'_>) -> Option<TargetVariable> {
        self.cncs.get(&cnc)?.variables.described(request)
    }
}

/// The requirement of a command's service.
pub(crate) fn service_clause(command: Command) -> ClauseId {
    wire_service::service_of(command).map_or(ADS_5, wire_service::clause)
}
