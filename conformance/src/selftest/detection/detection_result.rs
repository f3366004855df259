//! The modes in which the suite is run against a device, and the result of a defect in a mode.

use std::collections::BTreeSet;

use crate::gate::{Allowed, Gate};
use crate::text::named;

/// A mode in which a user can run the suite against a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Mode {
    /// Queries only, without a profile.
    ReadOnly,
    /// Queries only, with a complete profile of the device.
    Profiled,
    /// Without a profile; the file of `--allow-write` names the writable values except the axis
    /// numbers.
    Writes,
    /// The `--allow-write` file of `Writes`, the profile of `Profiled`, and malformed requests.
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

/// The result of a defect in a mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detection {
    pub result: DetectionResult,
    /// The IDs of the requirements that fail. If the defect is caught, also of the requirements
    /// that it breaks and that have a warning or a difference.
    pub requirements: BTreeSet<String>,
    /// The IDs of the cases in which these requirements fail or have a warning or a difference.
    pub cases: BTreeSet<String>,
}

/// The result of a defect in a mode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DetectionResult {
    /// A requirement that the defect breaks fails or, below the level *must*, has a warning or a
    /// difference.
    Caught,
    /// Only other requirements fail.
    Elsewhere,
    /// No requirement fails, although the reply to this request shows the defect.
    Missed(String),
    /// No requirement fails. Either the CNC is correct for the reason in this text, or no request
    /// of the mode distinguishes it from a correct CNC: the CNC without the defect, or the witness
    /// that this text names.
    Undetectable(String),
    /// A valid variant, and no requirement fails.
    Quiet,
    /// A requirement fails, although the CNC is a valid variant or the effects of the defect are
    /// undocumented (`witness::is_right`).
    Alarm,
}
