//! The errors of an action of this project's client.

use ads_cnc::ads::AdsError;

/// Why an action has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ActionError {
    /// An ADS error of the CNC.
    Rejected(AdsError),
    /// Another error, in the client or in a reply.
    Error(String),
    /// The client crashes.
    Dies,
    /// The client hangs.
    Hangs,
}

impl<T: std::fmt::Display> From<T> for ActionError {
    fn from(why: T) -> Self {
        Self::Error(why.to_string())
    }
}
