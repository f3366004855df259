//! The exit codes, and how the verdicts of a run determine its exit code.

use std::process::ExitCode;

use super::Verdict;

/// The exit code of a run; it is never a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: every judged requirement passed; warnings and differences are permitted.
    Success,
    /// 1: a verdict is fail or vacuous.
    Failure,
    /// 2: the command line is wrong.
    Usage,
    /// 3: nothing was judged, a verdict is inconclusive, or the run was interrupted.
    Nothing,
    /// 4: the gate rejected a request, or the file of `--allow-write` does not fit the target
    /// (`report/build.rs`).
    Refused,
    /// 5: a waiver is stale (`judge/waivers.rs`).
    Stale,
    /// 6: a value was changed and could not be restored.
    LeftChanged,
    /// 70: an error of the suite, such as a case that panics.
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
