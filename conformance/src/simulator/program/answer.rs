//! The answers to requests of a script.

use std::collections::VecDeque;
use std::time::Duration;

use ads_cnc::CncString;

/// The answer to a request of a [`Script`](super::Script).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceAnswer {
    /// Number of the request among all that were sent, from 1.
    pub number: u64,
    /// Index of the request in the script.
    pub request: usize,
    /// When the program continued.
    pub at: Duration,
    pub outcome: ServiceOutcome,
}

/// How a request ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServiceOutcome {
    Response {
        state: u32,
        text: CncString,
    },
    /// No answer within the maximum wait.
    TimedOut,
}

/// The latest answers, and the number of all.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    pub(super) kept: VecDeque<ServiceAnswer>,
    pub(super) count: u64,
    pub(super) timed_out: u64,
}

impl Answers {
    /// Number of stored answers.
    pub(super) const STORED_MAX: usize = 64;

    pub(super) fn push(&mut self, request: usize, at: Duration, outcome: ServiceOutcome) {
        self.count = self.count.saturating_add(1);
        if outcome == ServiceOutcome::TimedOut {
            self.timed_out = self.timed_out.saturating_add(1);
        }
        if self.kept.len() >= Self::STORED_MAX {
            self.kept.pop_front();
        }
        self.kept.push_back(ServiceAnswer { number: self.count, request, at, outcome });
    }
}
