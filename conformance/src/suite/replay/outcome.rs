//! How a step of a sequence ends.

use crate::judge::Stop;

/// The class of a fault, and its step.
pub type Fault<'c> = Option<(&'static str, &'c str)>;

/// Why a step fails.
#[derive(Debug)]
pub enum StepError {
    /// The expected and the actual result.
    Differs(String, String),
    Stop(Stop),
}

impl From<Stop> for StepError {
    fn from(stop: Stop) -> Self {
        Self::Stop(stop)
    }
}

/// An error of the simulated CNC in a direct call is an error of the suite.
impl<E: std::error::Error> From<E> for StepError {
    fn from(error: E) -> Self {
        Self::Stop(error.into())
    }
}

pub type StepResult<T> = Result<T, StepError>;

/// The error of a step with another result.
pub fn differs<T>(expected: impl ToString, found: impl ToString) -> StepResult<T> {
    Err(StepError::Differs(expected.to_string(), found.to_string()))
}

/// The error of a sequence without a required part.
pub(super) fn lacks(what: &str) -> StepError {
    StepError::Stop(Stop::Harness(format!("a step lacks its {what}")))
}
