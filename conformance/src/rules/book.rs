//! The records of all checks, and the knowledge of the CNCs.

use std::collections::BTreeMap;

use ads_cnc::ads::AmsNetId;
use ads_cnc::operation::{Call, Request};

use super::knowledge::{ExchangeJudge, Knowledge, MemoryBudget, TargetVariable};
use super::observation::Observation;
use super::replies;
use super::topic::TopicRecords;
use crate::exchange::{Exchange, Violation};

/// Maximum number of CNCs whose state is stored. Of the replies of further CNCs, only the headers
/// and the fields of the service are judged.
const CNCS_MAX: usize = 64;

/// The checks of all exchanges, and the state of at most [`CNCS_MAX`] CNCs as far as the exchanges
/// have shown it.
#[derive(Debug)]
pub(crate) struct RuleBook {
    pub(crate) records: TopicRecords,
    cncs: BTreeMap<AmsNetId, Knowledge>,
    /// Whether requests that changed the state of a CNC may be missing.
    is_lost: bool,
    budget: MemoryBudget,
}

impl RuleBook {
    /// Creates the book of a capture or a client. `is_lost`: whether a CNC may have received
    /// requests before the first observed request.
    pub(crate) fn new(is_lost: bool) -> Self {
        Self::with_memory(is_lost, MemoryBudget::ALL)
    }

    /// Creates the book of a run. This book has less memory, because the cases of a run also store
    /// what they know about the target.
    pub(crate) fn of_run() -> Self {
        Self::with_memory(true, MemoryBudget::OF_RUN)
    }

    fn with_memory(is_lost: bool, left: usize) -> Self {
        let programs = MemoryBudget::PROGRAMS;
        let budget = MemoryBudget { left, missed: 0, programs, unchecked: 0 };
        Self { records: TopicRecords::new(), cncs: BTreeMap::new(), is_lost, budget }
    }

    /// Number of entries that were not stored for lack of memory, so that later exchanges were not
    /// compared with them.
    pub(crate) const fn missed(&self) -> u64 {
        self.budget.missed
    }

    /// Number of packets of NC programs that were not checked for loops and jumps back, because too
    /// many channels have programs.
    pub(crate) const fn unchecked(&self) -> u64 {
        self.budget.unchecked
    }

    /// Forgets the state of all CNCs, because requests that were not observed may have changed it.
    pub(crate) fn forget_cncs(&mut self) {
        self.cncs.clear();
        self.budget.programs = MemoryBudget::PROGRAMS;
        self.is_lost = true;
    }

    /// Number of channels whose NC programs are checked.
    fn programs(&self) -> usize {
        let streams = self.cncs.values().flat_map(|cnc| cnc.streams.values());
        streams.filter(|stream| stream.checker.is_some()).count()
    }

    /// Judges a reply, alone and together with earlier replies of the same CNC.
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
            // After an AMS error, another CNC may have this NetId, so the stored state is removed.
            self.cncs.remove(&cnc);
            self.budget.programs = MemoryBudget::PROGRAMS.saturating_sub(self.programs());
            return;
        }
        if !self.cncs.contains_key(&cnc) && self.cncs.len() >= CNCS_MAX {
            return;
        }
        let knowledge = self.cncs.entry(cnc).or_insert_with(|| Knowledge::new(self.is_lost));
        let mut judge = ExchangeJudge {
            observation,
            call,
            records: &mut self.records,
            cnc: knowledge,
            budget: &mut self.budget,
        };
        replies::judge(&mut judge, answer);
    }

    /// The variable that a request reads or writes, if its description is known.
    pub(crate) fn described(&self, cnc: AmsNetId, request: &Request<'_>) -> Option<TargetVariable> {
        self.cncs.get(&cnc)?.variables.described(request)
    }
}
