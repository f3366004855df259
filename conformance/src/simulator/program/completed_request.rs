//! The outcomes of the requests of a script.

use std::collections::VecDeque;
use std::time::Duration;

use ads_cnc::CncString;

/// The outcome of a request of a [`Script`](super::Script).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CompletedRequest {
    /// Number of the request among all completed requests, from 1.
    pub number: u64,
    /// Index of the request in the script.
    pub request: usize,
    /// The time of the step that read the response, or after which the program stopped waiting.
    pub at: Duration,
    pub outcome: ServiceOutcome,
}

/// The outcome of a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServiceOutcome {
    Response {
        state: u32,
        text: CncString,
    },
    /// No response arrived within the maximum wait.
    TimedOut,
}

/// The latest outcomes, the number of all outcomes, and the number of requests that timed out.
#[derive(Clone, Debug, Default)]
pub(super) struct CompletedRequests {
    pub(super) stored: VecDeque<CompletedRequest>,
    pub(super) count: u64,
    pub(super) timed_out: u64,
}

impl CompletedRequests {
    /// Maximum number of stored outcomes.
    pub(super) const STORED_MAX: usize = 64;

    pub(super) fn push(&mut self, request: usize, at: Duration, outcome: ServiceOutcome) {
        self.count = self.count.saturating_add(1);
        if outcome == ServiceOutcome::TimedOut {
            self.timed_out = self.timed_out.saturating_add(1);
        }
        if self.stored.len() >= Self::STORED_MAX {
            self.stored.pop_front();
        }
        self.stored.push_back(CompletedRequest { number: self.count, request, at, outcome });
    }
}
