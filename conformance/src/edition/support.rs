//! Whether an edition of the manual or a version of the CNC has a feature.

use std::fmt;

/// Whether an edition of the manual or a version of the CNC has a feature, and the requirement that
/// concerns the feature.
///
/// ```
/// use ads_cnc::Kind;
/// use ads_cnc::operation::Function;
/// use ads_cnc_conformance::edition::Edition;
///
/// let support = Edition::German.permits(Function::WriteByHandle, Kind::V_S, None);
/// assert_eq!((support.available, support.assumed), (false, false));
/// assert_eq!(support.to_string(), "no (VAR-18)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Support {
    /// Whether the feature is available.
    pub available: bool,
    /// The requirement that determines whether the feature is available.
    pub requirement: &'static str,
    /// Whether `available` is assumed: the requirement does not document it, and a CNC may differ.
    pub assumed: bool,
}

impl Support {
    pub(super) const fn documented(available: bool, requirement: &'static str) -> Self {
        Self { available, requirement, assumed: false }
    }

    pub(super) const fn assumed(available: bool, requirement: &'static str) -> Self {
        Self { available, requirement, assumed: true }
    }
}

impl fmt::Display for Support {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { available, requirement, assumed } = *self;
        let available = if available { "yes" } else { "no" };
        write!(f, "{available} ({requirement}{})", if assumed { ", assumed" } else { "" })
    }
}
