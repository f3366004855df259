//! What a judgement can be, and what a run of them means for the caller.

use std::fmt;
use std::process::ExitCode;

use ads_cnc_vectors::Level;
use serde::{Deserialize, Serialize};

use crate::text::named;

/// The judgement of one requirement in one case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Done as required.
    Pass,
    /// A must was not met.
    Fail,
    /// A should was not met.
    Warning,
    /// Something assumed was done otherwise.
    Differs,
    /// Refused as required, but its accepted sibling was refused too.
    Vacuous,
    /// What came back does not tell.
    Inconclusive,
    /// The target does not claim it.
    NotApplicable,
    /// Nothing that happened touches it.
    NotObserved,
    /// Not asked for.
    NotRun,
    /// The run was interrupted before it was done.
    Interrupted,
    /// The suite itself failed.
    HarnessError,
}

named! { Verdict:
    Pass "pass", Fail "fail", Warning "warning", Differs "differs", Vacuous "vacuous",
    Inconclusive "inconclusive", NotApplicable "not-applicable", NotObserved "not-observed",
    NotRun "not-run", Interrupted "interrupted", HarnessError "harness-error",
}

impl Verdict {
    /// The verdict on something of this level that was not done.
    pub const fn missed(level: Level) -> Self {
        match level {
            Level::Must => Self::Fail,
            Level::Should => Self::Warning,
            Level::Info => Self::Differs,
        }
    }

    /// Whether something was judged at all.
    pub const fn is_judged(self) -> bool {
        matches!(self, Self::Pass | Self::Fail | Self::Warning | Self::Differs | Self::Vacuous)
    }

    /// Whether a run with it is no success.
    pub const fn is_trouble(self) -> bool {
        let open = matches!(self, Self::Inconclusive | Self::Interrupted);
        open || matches!(self, Self::Fail | Self::Vacuous | Self::HarnessError)
    }

    /// Whether somebody may put up with it.
    pub const fn is_waivable(self) -> bool {
        let known = matches!(self, Self::Fail | Self::Vacuous | Self::Inconclusive);
        known || matches!(self, Self::Warning | Self::Differs)
    }

    /// How much of a reader's attention it needs; the verdict of a group is its gravest.
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

/// How the process ends. Never a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Everything judged is in order; warnings and differences leave it so.
    Success,
    /// A fail, or a vacuous verdict.
    Failure,
    /// The command line is wrong.
    Usage,
    /// Nothing was judged, or something stayed inconclusive, or the run was interrupted.
    Nothing,
    /// Refused for safety.
    Refused,
    /// A waiver no longer holds.
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

    /// All of them, in the order in which they win over one another.
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

    /// The first that holds for these verdicts.
    pub fn of(verdicts: impl IntoIterator<Item = Verdict>) -> Self {
        let mut tally = VerdictTally::default();
        verdicts.into_iter().for_each(|verdict| tally.add(verdict, false));
        tally.exit()
    }
}

/// What a run had, as far as it decides how the process ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VerdictTally {
    judged: bool,
    failed: bool,
    open: bool,
    broken: bool,
    /// Something was refused for safety.
    pub refused: bool,
    /// A waiver no longer holds.
    pub stale: bool,
    /// A value was changed and could not be restored.
    pub left_changed: bool,
}

impl VerdictTally {
    /// Counts a verdict. One that is put up with is judged, and that is all.
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

    /// The first that holds.
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

    /// The order of exit codes: the gravest cause decides, and nothing judged is no success.
    #[test]
    fn the_first_cause_decides() {
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

    /// What is put up with does not decide; that it is known no longer does, but a failure first.
    #[test]
    fn waivers_decide_in_their_turn() {
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
