//! The frames that a check is about.

use std::time::Duration;

use crate::evidence::Evidence;
use crate::exchange::Exchange;

/// The frames that a check is about.
pub(crate) trait Observation {
    fn evidence(&self) -> Evidence;

    /// The time at which the request was sent, since a start that all observations of a `RuleBook`
    /// share; `None` if unknown.
    fn time(&self) -> Option<Duration> {
        None
    }
}

impl Observation for Exchange {
    fn evidence(&self) -> Evidence {
        Evidence::from(self)
    }
}
