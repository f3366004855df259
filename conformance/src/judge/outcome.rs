//! The outcome of a case.

use std::panic::{self, AssertUnwindSafe};
use std::time::{Duration, Instant};

use super::{Case, Judgement, Record, Stop, Verdict};

#[derive(Clone, Debug)]
pub struct CaseOutcome {
    pub case: Case,
    pub verdicts: Vec<RequirementVerdict>,
    pub checks: usize,
    /// Why the case was not run, or not completed.
    pub note: Option<String>,
    /// Whether the case ended with [`Stop::NotPermitted`], because the gate rejected a request.
    pub rejected: bool,
    /// The duration of the case, if it was measured.
    pub time: Option<Duration>,
}

/// The verdict on a requirement in a case.
#[derive(Clone, Debug)]
pub struct RequirementVerdict {
    pub requirement: &'static str,
    /// The most severe verdict of the checks. Without checks, the reason why the case ended
    /// determines the verdict. It also does if all checks passed and the case ended as
    /// inconclusive, interrupted or with a harness error.
    pub verdict: Verdict,
    /// The stored checks that did not pass.
    pub judgements: Vec<Judgement>,
}

/// The note of a case that was interrupted after it had begun.
const INTERRUPTED: &str = "interrupted before its end";

impl CaseOutcome {
    /// Runs a case and measures its duration.
    pub(crate) fn timed(run: impl FnOnce() -> Self) -> Self {
        let begin = Instant::now();
        let outcome = run();
        Self { time: Some(begin.elapsed()), ..outcome }
    }

    /// A case that had not begun when the run was interrupted.
    pub(crate) fn interrupted(case: Case) -> Self {
        Self::untried(case, Verdict::Interrupted, "interrupted before it was begun")
    }

    /// A case that was not run.
    pub(crate) fn untried(case: Case, verdict: Verdict, note: impl Into<String>) -> Self {
        let verdicts = case.requirements.iter().map(|&requirement| RequirementVerdict {
            requirement,
            verdict,
            judgements: Vec::new(),
        });
        let verdicts = verdicts.collect();
        Self { case, verdicts, checks: 0, note: Some(note.into()), rejected: false, time: None }
    }

    pub(crate) fn tried(case: Case, record: Record, stop: Option<Stop>) -> Self {
        let Record { judgements, checks } = record;
        let (unjudged, note) = match &stop {
            None | Some(Stop::Judged) => (Verdict::NotObserved, None),
            Some(Stop::NotApplicable(why)) => (Verdict::NotApplicable, Some(why.clone())),
            Some(Stop::Inconclusive(why)) => (Verdict::Inconclusive, Some(why.clone())),
            Some(Stop::NotPermitted(why)) => (Verdict::NotRun, Some(why.clone())),
            Some(Stop::Interrupted) => (Verdict::Interrupted, Some(INTERRUPTED.to_owned())),
            Some(Stop::Harness(why)) => (Verdict::HarnessError, Some(why.clone())),
        };
        let undeclared = judgements
            .iter()
            .find(|judgement| !case.requirements.contains(&judgement.requirement))
            .map(|judgement| judgement.requirement);
        let mut verdicts: Vec<_> = case
            .requirements
            .iter()
            .map(|&requirement| of_requirement(requirement, &judgements, unjudged))
            .collect();
        if let Some(requirement) = undeclared {
            let verdict = Verdict::HarnessError;
            verdicts.push(RequirementVerdict { requirement, verdict, judgements: Vec::new() });
        }
        let rejected = matches!(stop, Some(Stop::NotPermitted(_)));
        Self { case, verdicts, checks, note, rejected, time: None }
    }

    /// The most severe verdict on the requirements of the case; `NotObserved` without requirements.
    pub fn verdict(&self) -> Verdict {
        most_severe(self.verdicts.iter().map(|judged| judged.verdict))
            .unwrap_or(Verdict::NotObserved)
    }
}

fn of_requirement(
    requirement: &'static str,
    judgements: &[Judgement],
    unjudged: Verdict,
) -> RequirementVerdict {
    let mine = || judgements.iter().filter(|judgement| judgement.requirement == requirement);
    // A case that ended as inconclusive, interrupted or with a harness error does not pass, even if
    // its first checks passed.
    let judged = mine().map(|judgement| judgement.verdict);
    let verdict = most_severe(judged.chain([unjudged])).unwrap_or(unjudged);
    let failed = mine().filter(|judgement| judgement.verdict != Verdict::Pass);
    RequirementVerdict { requirement, verdict, judgements: failed.cloned().collect() }
}

/// The most severe of several verdicts.
pub fn most_severe(verdicts: impl IntoIterator<Item = Verdict>) -> Option<Verdict> {
    verdicts.into_iter().max_by_key(|verdict| verdict.severity())
}

/// Calls a function. If the function panics, returns the message of the panic as the error, so that
/// the panic ends only the current case.
pub(crate) fn caught<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    panic::catch_unwind(AssertUnwindSafe(run)).map_err(|payload| {
        let text = payload.downcast_ref::<&str>().copied();
        let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
        format!("the case panicked: {}", text.unwrap_or("without a message"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A case that ended early does not pass, even if its first checks only deviated.
    #[test]
    fn the_end_of_a_case_is_not_hidden() {
        use Verdict::*;
        let verdict = |verdict, end| {
            let judgement = Judgement {
                requirement: "VAR-8",
                level: None,
                verdict,
                expected: String::new(),
                found: String::new(),
                evidence: None,
                more: 0,
                together: Vec::new(),
                follows: None,
            };
            of_requirement("VAR-8", &[judgement], end).verdict
        };
        for end in [Inconclusive, Interrupted, HarnessError] {
            for judged in [Pass, Differs, Warning] {
                assert_eq!(verdict(judged, end), end);
            }
        }
        assert_eq!(verdict(Fail, Interrupted), Fail);
        assert_eq!(verdict(Fail, HarnessError), HarnessError);
        assert_eq!(verdict(Pass, NotObserved), Pass);
    }
}
