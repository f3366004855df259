//! What came of a request.

use std::collections::VecDeque;
use std::time::Duration;

use ads_cnc::CncString;

/// What came of a request of a [`Script`](super::Script).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceAnswer {
    /// Which it was of all that were made, from 1.
    pub number: u64,
    /// Its place in the script, from 0.
    pub request: usize,
    /// When the program went on.
    pub at: Duration,
    /// How it ended.
    pub outcome: ServiceOutcome,
}

/// How a request ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServiceOutcome {
    Response {
        state: u32,
        text: CncString,
    },
    /// There was none within the longest wait.
    TimedOut,
}

/// The latest answers, and how many there were.
#[derive(Clone, Debug, Default)]
pub(super) struct Answers {
    pub(super) kept: VecDeque<ServiceAnswer>,
    pub(super) count: u64,
    pub(super) timed_out: u64,
}

impl Answers {
    /// How many are kept.
    pub(super) const KEPT: usize = 64;

    pub(super) fn push(&mut self, request: usize, at: Duration, outcome: ServiceOutcome) {
        self.count = self.count.saturating_add(1);
        if outcome == ServiceOutcome::TimedOut {
            self.timed_out = self.timed_out.saturating_add(1);
        }
        if self.kept.len() >= Self::KEPT {
            self.kept.pop_front();
        }
        self.kept.push_back(ServiceAnswer { number: self.count, request, at, outcome });
    }
}
