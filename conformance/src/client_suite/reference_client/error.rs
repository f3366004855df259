//! The errors of an action of this project's client.

use ads_cnc::ads::AdsError;

/// Why an action has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ActionError {
    /// An ADS error of the CNC.
    Rejected(AdsError),
    /// Another error, which the client itself found, for example in a reply.
    Error(String),
    /// The client must behave as if it crashed.
    Dies,
    /// The client must behave as if it hung.
    Hangs,
}

impl<T: std::fmt::Display> From<T> for ActionError {
    fn from(why: T) -> Self {
        Self::Error(why.to_string())
    }
}
