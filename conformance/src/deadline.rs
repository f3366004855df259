//! The deadline of a command.

use std::fmt;
use std::time::{Duration, Instant};

use crate::text::shown_time;

/// The instant after which a command sends no more requests, except for example to restore values.
#[derive(Clone, Copy, Debug)]
pub struct Deadline {
    at: Option<Instant>,
    after: Duration,
}

impl Deadline {
    /// Creates a deadline that is `time` from now. If the clock cannot represent that instant, the
    /// deadline never passes.
    pub fn after(time: Duration) -> Self {
        Self { at: Instant::now().checked_add(time), after: time }
    }

    /// Returns `time`, or the time until the deadline if that is shorter.
    #[must_use]
    pub fn limit(&self, time: Duration) -> Duration {
        let left = self.at.map(|at| at.saturating_duration_since(Instant::now()));
        left.map_or(time, |left| left.min(time))
    }

    /// Whether the deadline has passed.
    pub fn is_over(&self) -> bool {
        self.at.is_some_and(|at| Instant::now() >= at)
    }
}

/// Formats the error for a command whose deadline has passed.
impl fmt::Display for Deadline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let limit = shown_time(self.after.as_secs());
        write!(f, "the deadline of {limit} has passed (--deadline)")
    }
}
