//! How the suite is run against a device, and what it detects.

use std::collections::BTreeSet;

use crate::gate::{Allowed, Gate};
use crate::text::named;

/// How the suite is run against a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mode {
    /// Queries only, and no profile.
    ReadOnly,
    /// Queries only, with a profile that tells everything about the device.
    Profiled,
    /// Without a profile; a file for `--allow-write` names every writable value.
    Writes,
    /// Such a file, the full profile, and malformed requests.
    All,
}

named! { Mode: ReadOnly "read-only", Profiled "profiled", Writes "writes", All "all", }

impl Mode {
    pub(super) const fn has_profile(self) -> bool {
        matches!(self, Self::Profiled | Self::All)
    }

    pub(super) fn gate(self, allowed: &Allowed) -> Gate {
        let gate = Gate::queries();
        match self {
            Self::ReadOnly | Self::Profiled => gate,
            Self::Writes => gate.with_allowed(Some(allowed.clone())),
            Self::All => {
                let allowed = Allowed { malformed: true, ..allowed.clone() };
                gate.with_allowed(Some(allowed)).and_malformed()
            }
        }
    }
}

/// What came of one defect in one mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detection {
    /// How it came out.
    pub result: Found,
    pub requirements: BTreeSet<String>,
    pub cases: BTreeSet<String>,
}

/// How a defect came out in one mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// A requirement that its row declares broken fails.
    Caught,
    /// Only other requirements fail.
    Elsewhere,
    /// Nothing fails. This request would have shown it.
    Missed(String),
    /// Nothing fails, and no request that the mode may send tells it from a right CNC: from the one
    /// without a defect, or from that of this witness.
    Undetectable(String),
    /// Of a correct variant: nothing fails, as it should be.
    Quiet,
    /// Of a correct variant: something fails.
    Alarm,
}
