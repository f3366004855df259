//! The time of a CNC.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Time since a CNC was switched on: the machine's clock, unless it is stopped, and what was let
/// pass.
#[derive(Debug)]
pub(super) struct Clock {
    /// None if it is stopped.
    since: Option<Instant>,
    /// Nanoseconds that were let pass.
    passed: AtomicU64,
}

impl Clock {
    /// Runs from now on.
    pub(super) fn running() -> Self {
        Self { since: Some(Instant::now()), passed: AtomicU64::new(0) }
    }

    /// Stopped at 0.
    pub(super) const fn stopped() -> Self {
        Self { since: None, passed: AtomicU64::new(0) }
    }

    pub(super) fn now(&self) -> Duration {
        let passed = Duration::from_nanos(self.passed.load(Ordering::SeqCst));
        self.since.map(|since| since.elapsed()).unwrap_or_default().saturating_add(passed)
    }

    pub(super) fn pass(&self, time: Duration) {
        let time = u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
        let passed = |passed: u64| Some(passed.saturating_add(time));
        // It always has a new value.
        let _ = self.passed.fetch_update(Ordering::SeqCst, Ordering::SeqCst, passed);
    }
}
