//! How the verdicts of a run determine its exit code.

use super::Verdict;
use crate::exit::Exit;

/// The facts of a run that determine its exit code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VerdictTally {
    judged: bool,
    failed: bool,
    is_undecided: bool,
    has_harness_error: bool,
    /// Whether a case is incomplete, because the gate rejected a request.
    pub rejected: bool,
    /// Whether a waiver is stale: expired, without a case, or for another verdict.
    pub stale: bool,
    /// Whether a value was changed and could not be restored.
    pub left_changed: bool,
}

impl VerdictTally {
    /// Counts verdicts that are not waived.
    pub fn of(verdicts: impl IntoIterator<Item = Verdict>) -> Self {
        let mut tally = Self::default();
        verdicts.into_iter().for_each(|verdict| tally.add(verdict, false));
        tally
    }

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
            Verdict::Inconclusive | Verdict::Interrupted => self.is_undecided = true,
            Verdict::HarnessError => self.has_harness_error = true,
            _ => {}
        }
    }

    /// The exit code with the highest precedence.
    pub const fn exit(self) -> Exit {
        let Self { judged, failed, is_undecided, has_harness_error, rejected, stale, left_changed } =
            self;
        match (has_harness_error, left_changed, rejected, failed, stale) {
            (true, ..) => Exit::Internal,
            (_, true, ..) => Exit::UnrestoredValue,
            (_, _, true, ..) => Exit::NotPermitted,
            (_, _, _, true, _) => Exit::Failure,
            (.., true) => Exit::Stale,
            _ if is_undecided || !judged => Exit::Nothing,
            _ => Exit::Success,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exit codes have a precedence, and a run without judgements is not a success.
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
            assert_eq!(
                VerdictTally::of(verdicts.iter().copied()).exit().code(),
                code,
                "{verdicts:?}"
            );
        }
    }

    /// A waived failure is a success. A stale waiver is not a success, but a failure takes
    /// precedence over a stale waiver.
    #[test]
    fn stale_waivers_rank_after_failures() {
        use Verdict::*;
        let exit = |verdicts: &[(Verdict, bool)], stale, rejected| {
            let mut tally = VerdictTally { stale, rejected, ..VerdictTally::default() };
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
                VerdictTally { left_changed: true, rejected: true, ..VerdictTally::default() };
            tally.add(verdict, false);
            tally.exit().code()
        };
        assert_eq!((left(Fail), left(Pass), left(HarnessError)), (6, 6, 70));
        for exit in Exit::ALL {
            assert_eq!(Exit::from_code(exit.code()), Some(exit));
        }
    }
}
