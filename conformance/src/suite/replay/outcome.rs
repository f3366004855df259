//! How a step of a sequence ends.

use crate::judge::Stop;

/// What is at fault: its class, and the step.
pub type Fault<'c> = Option<(&'static str, &'c str)>;

/// How a step ends that does not go as stated, or cannot be done.
#[derive(Debug)]
pub enum Otherwise {
    /// What was expected, and what was there.
    Differs(String, String),
    Stop(Stop),
}

impl From<Stop> for Otherwise {
    fn from(stop: Stop) -> Self {
        Self::Stop(stop)
    }
}

/// What the simulated CNC rejects from within is a mistake of the suite.
impl<E: std::error::Error> From<E> for Otherwise {
    fn from(error: E) -> Self {
        Self::Stop(error.into())
    }
}

pub type Done<T> = Result<T, Otherwise>;

/// A step that does not go as stated.
pub fn differs<T>(expected: impl ToString, found: impl ToString) -> Done<T> {
    Err(Otherwise::Differs(expected.to_string(), found.to_string()))
}

/// That a sequence lacks what its kind has.
pub(super) fn lacks(what: &str) -> Otherwise {
    Otherwise::Stop(Stop::Harness(format!("a step lacks its {what}")))
}
