//! The verdicts.

use std::fmt;

use ads_cnc_vectors::Level;
use serde::{Deserialize, Serialize};

use crate::text::named;

/// The judgement of one requirement in one case, or the most severe judgement of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The requirement is met.
    Pass,
    /// A requirement, or a part of a requirement, of level must is not met.
    Fail,
    /// A requirement, or a part of a requirement, of level should is not met.
    Warning,
    /// A requirement, or a part of a requirement, of level info (assumed) is not met.
    Differs,
    /// The request or input was rejected as required, but the valid one was rejected too.
    Vacuous,
    /// The replies do not decide the requirement, or the failure only follows from another failure.
    Inconclusive,
    /// The product under test does not claim, or does not have, the subject of the requirement.
    NotApplicable,
    /// No check concerned the requirement.
    NotObserved,
    /// The case was not run or ended early, for example because the gate does not permit its
    /// requests.
    NotRun,
    /// The run was interrupted before or during the case.
    Interrupted,
    /// An error of the suite itself.
    HarnessError,
}

named! { Verdict:
    Pass "pass", Fail "fail", Warning "warning", Differs "differs", Vacuous "vacuous",
    Inconclusive "inconclusive", NotApplicable "not-applicable", NotObserved "not-observed",
    NotRun "not-run", Interrupted "interrupted", HarnessError "harness-error",
}

impl Verdict {
    /// The verdict if a requirement of this level is not met.
    pub const fn missed(level: Level) -> Self {
        match level {
            Level::Must => Self::Fail,
            Level::Should => Self::Warning,
            Level::Info => Self::Differs,
        }
    }

    /// The verdict that a check with this verdict gets if it only follows from another failure.
    pub const fn as_following(self) -> Self {
        match self {
            Self::Warning | Self::Differs => self,
            _ => Self::Inconclusive,
        }
    }

    /// Whether the verdict is a judgement of the product under test.
    pub const fn is_judged(self) -> bool {
        matches!(self, Self::Pass | Self::Fail | Self::Warning | Self::Differs | Self::Vacuous)
    }

    /// Whether a run with this verdict does not pass, unless the verdict is waived.
    pub const fn fails_run(self) -> bool {
        self.is_failure() || matches!(self, Self::Inconclusive | Self::Interrupted)
    }

    /// Whether the verdict is a failure of the product under test or of the suite.
    pub const fn is_failure(self) -> bool {
        matches!(self, Self::Fail | Self::Vacuous | Self::HarnessError)
    }

    /// Whether a waiver can accept this verdict.
    pub const fn is_waivable(self) -> bool {
        let known = matches!(self, Self::Fail | Self::Vacuous | Self::Inconclusive);
        known || matches!(self, Self::Warning | Self::Differs)
    }

    /// The severity: the verdict of a group is the verdict with the greatest severity in the group.
    /// The verdicts that fail the run are the most severe, so that no other verdict hides them.
    pub const fn severity(self) -> u8 {
        match self {
            Self::HarnessError => 10,
            Self::Fail => 9,
            Self::Vacuous => 8,
            Self::Inconclusive => 7,
            Self::Interrupted => 6,
            Self::Warning => 5,
            Self::Differs => 4,
            Self::Pass => 3,
            Self::NotObserved => 2,
            Self::NotApplicable => 1,
            Self::NotRun => 0,
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
