//! How an action of this project's client fails.

use ads_cnc::ads::AdsError;

/// The reason why an action has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Fail {
    /// The CNC refuses.
    Refused(AdsError),
    /// Something is wrong, here or in the CNC.
    Error(String),
    /// It dies here.
    Dies,
    /// It waits for ever.
    Hangs,
}

impl<T: std::fmt::Display> From<T> for Fail {
    fn from(why: T) -> Self {
        Self::Error(why.to_string())
    }
}
