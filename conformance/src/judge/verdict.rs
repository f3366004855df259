//! Verdicts, and the exit code of a run.

use std::fmt;
use std::process::ExitCode;

use ads_cnc_vectors::Level;
use serde::{Deserialize, Serialize};

use crate::text::named;

/// The judgement of one requirement in one case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The requirement is met.
    Pass,
    /// A requirement of level must is not met.
    Fail,
    /// A requirement of level should is not met.
    Warning,
    /// An assumed part of a requirement is not met.
    Differs,
    /// The request or input was rejected as required, but the valid one was rejected too.
    Vacuous,
    /// The replies do not decide the requirement.
    Inconclusive,
    /// The profile does not claim what the requirement is about.
    NotApplicable,
    /// No request or reply concerned the requirement.
    NotObserved,
    /// The case was not selected, or not permitted.
    NotRun,
    /// The run was interrupted before the case.
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

    /// Whether the verdict is a judgement of the target.
    pub const fn is_judged(self) -> bool {
        matches!(self, Self::Pass | Self::Fail | Self::Warning | Self::Differs | Self::Vacuous)
    }

    /// Whether a run with this verdict fails.
    pub const fn fails_run(self) -> bool {
        self.is_failure() || matches!(self, Self::Inconclusive | Self::Interrupted)
    }

    /// Whether it is a failure of what is judged, or of the suite.
    pub const fn is_failure(self) -> bool {
        matches!(self, Self::Fail | Self::Vacuous | Self::HarnessError)
    }

    /// Whether a waiver can accept this verdict.
    pub const fn is_waivable(self) -> bool {
        let known = matches!(self, Self::Fail | Self::Vacuous | Self::Inconclusive);
        known || matches!(self, Self::Warning | Self::Differs)
    }

    /// The severity; the verdict of a group is its most severe one.
    pub const fn gravity(self) -> u8 {
        match self {
            Self::HarnessError => 10,
            Self::Fail => 9,
            Self::Vacuous => 8,
            Self::Warning => 7,
            Self::Inconclusive => 6,
            Self::Interrupted => 5,
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

/// The exit code of a run; it is never a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Every judged requirement passed; warnings and differences are permitted.
    Success,
    /// A verdict is fail or vacuous.
    Failure,
    /// The command line is wrong.
    Usage,
    /// Nothing was judged, a verdict is inconclusive, or the run was interrupted.
    Nothing,
    /// The gate rejected a request.
    Refused,
    /// A waiver is stale.
    Stale,
    /// A value was changed and could not be restored.
    LeftChanged,
    Internal,
}

impl Exit {
    pub const fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Failure => 1,
            Self::Usage => 2,
            Self::Nothing => 3,
            Self::Refused => 4,
            Self::Stale => 5,
            Self::LeftChanged => 6,
            Self::Internal => 70,
        }
    }

    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|exit| exit.code() == code)
    }

    /// All exit codes, in the order of precedence.
    pub const ALL: [Self; 8] = [
        Self::Internal,
        Self::LeftChanged,
        Self::Usage,
        Self::Refused,
        Self::Failure,
        Self::Stale,
        Self::Nothing,
        Self::Success,
    ];

    /// The exit code for these verdicts.
    pub fn of(verdicts: impl IntoIterator<Item = Verdict>) -> Self {
        let mut tally = VerdictTally::default();
        verdicts.into_iter().for_each(|verdict| tally.add(verdict, false));
        tally.exit()
    }
}

/// The facts of a run that determine its exit code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VerdictTally {
    judged: bool,
    failed: bool,
    open: bool,
    broken: bool,
    /// Whether the gate rejected a request.
    pub refused: bool,
    /// Whether a waiver is stale.
    pub stale: bool,
    /// Whether a value was changed and could not be restored.
    pub left_changed: bool,
}

impl VerdictTally {
    /// Counts a verdict. A waived verdict only counts as judged.
    pub const fn add(&mut self, verdict: Verdict, waived: bool) {
        if verdict.is_judged() || waived {
            self.judged = true;
        }
        if waived {
            return;
        }
        match verdict {
            Verdict::Fail | Verdict::Vacuous => self.failed = true,
            Verdict::Inconclusive | Verdict::Interrupted => self.open = true,
            Verdict::HarnessError => self.broken = true,
            _ => {}
        }
    }

    /// The exit code with the highest precedence.
    pub const fn exit(self) -> Exit {
        let Self { judged, failed, open, broken, refused, stale, left_changed } = self;
        match (broken, left_changed, refused, failed, stale) {
            (true, ..) => Exit::Internal,
            (_, true, ..) => Exit::LeftChanged,
            (_, _, true, ..) => Exit::Refused,
            (_, _, _, true, _) => Exit::Failure,
            (.., true) => Exit::Stale,
            _ if open || !judged => Exit::Nothing,
            _ => Exit::Success,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The precedence of the exit codes; a run without judgements is not a success.
    #[test]
    fn exit_codes_have_a_precedence() {
        use Verdict::*;
        let cases: [(&[Verdict], u8); 11] = [
            (&[], 3),
            (&[NotRun, NotApplicable, NotObserved], 3),
            (&[Pass, NotRun], 0),
            (&[Pass, Warning, Differs], 0),
            (&[Pass, Inconclusive], 3),
            (&[Pass, Interrupted], 3),
            (&[Fail, Interrupted], 1),
            (&[Pass, Fail, Inconclusive], 1),
            (&[Pass, Vacuous], 1),
            (&[Fail, HarnessError], 70),
            (&[HarnessError], 70),
        ];
        for (verdicts, code) in cases {
            assert_eq!(Exit::of(verdicts.iter().copied()).code(), code, "{verdicts:?}");
        }
    }

    /// A waived failure is a success; a stale waiver is not, but a failure takes precedence over it.
    #[test]
    fn stale_waivers_rank_after_failures() {
        use Verdict::*;
        let exit = |verdicts: &[(Verdict, bool)], stale, refused| {
            let mut tally = VerdictTally { stale, refused, ..VerdictTally::default() };
            verdicts.iter().for_each(|&(verdict, waived)| tally.add(verdict, waived));
            tally.exit().code()
        };
        assert_eq!(exit(&[(Pass, false), (Fail, true), (Inconclusive, true)], false, false), 0);
        assert_eq!(exit(&[(Fail, true)], false, false), 0);
        assert_eq!(exit(&[(Fail, true), (Fail, false)], true, false), 1);
        assert_eq!(exit(&[(Fail, true), (Inconclusive, false)], true, false), 5);
        assert_eq!(exit(&[(Fail, false)], true, true), 4);
        assert_eq!(exit(&[(HarnessError, false)], true, true), 70);
        let left = |verdict| {
            let mut tally =
                VerdictTally { left_changed: true, refused: true, ..VerdictTally::default() };
            tally.add(verdict, false);
            tally.exit().code()
        };
        assert_eq!((left(Fail), left(Pass), left(HarnessError)), (6, 6, 70));
        for exit in Exit::ALL {
            assert_eq!(Exit::from_code(exit.code()), Some(exit));
        }
    }
}
