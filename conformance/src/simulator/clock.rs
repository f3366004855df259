//! The clock of a simulated CNC.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Measures the time since the start of the CNC: the time that has passed on the clock of the
/// system plus the time that `pass` has added. A stopped clock measures only the latter, since it
/// was stopped.
#[derive(Debug)]
pub(super) struct Clock {
    /// The time of the system at the start of the CNC; `None` if this clock is stopped.
    since: Option<Instant>,
    /// Nanoseconds added by `pass`.
    passed: AtomicU64,
}

impl Clock {
    /// A running clock.
    pub(super) fn running() -> Self {
        Self { since: Some(Instant::now()), passed: AtomicU64::new(0) }
    }

    /// A clock stopped at 0.
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
        // The closure always returns a value.
        let _ = self.passed.fetch_update(Ordering::SeqCst, Ordering::SeqCst, passed);
    }
}
