//! A candidate for a trial, and the result of a trial.

use serde::Serialize;

use crate::judge::{CaseOutcome, RequirementVerdict, Verdict};
use crate::session::ToolError;
use crate::text::named;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SelfTestGroup {
    /// Codecs with a defect, judged by the vectors and sequences.
    Codec,
    /// CNCs with a defect, judged by the cases for a target.
    Cnc,
    /// Clients with a defect, judged by the scenarios.
    Client,
    /// Miniatures: small testees with one kind of wrong behaviour.
    Miniature,
    /// Valid variants of a CNC or a client, and correct miniatures.
    Different,
}

named! { SelfTestGroup:
    Codec "codec", Cnc "cnc", Client "client", Miniature "miniature", Different "different",
}

/// A trial and its result.
#[derive(Clone, Debug, Serialize)]
pub struct Trial {
    /// The ID of the defect, miniature or variant.
    pub id: String,
    /// The group of the candidate.
    pub group: SelfTestGroup,
    pub what: String,
    /// The requirements that the defect breaks; empty for a valid variant.
    pub targets: Vec<String>,
    /// The requirements that failed; after a harness error, the requirements with a harness error;
    /// if the trial could not be run, the error.
    pub failed: Vec<String>,
    pub result: TrialResult,
    /// The written reason why the defect may survive; only for a defect that was not caught.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Trial {
    /// Whether the trial is a failure: a defect that was neither caught nor noticed and has no
    /// reason, a false alarm, or a broken trial.
    pub(super) fn is_failure(&self) -> bool {
        match self.result {
            TrialResult::Caught | TrialResult::Noticed | TrialResult::Quiet | TrialResult::Same => {
                false
            }
            TrialResult::Survived | TrialResult::Elsewhere => self.reason.is_none(),
            TrialResult::FalseAlarm | TrialResult::Broken => true,
        }
    }
}

/// The result of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TrialResult {
    /// A requirement that the defect breaks has failed or, below the level *must* and not for a
    /// codec, has a warning or a difference.
    Caught,
    /// For codecs only: no requirement that the defect breaks has failed, but such a requirement
    /// has a warning or a difference in a case. One possible reason: the manuals do not state
    /// everything that a vector expects.
    Noticed,
    /// Only requirements that the defect does not break have failed.
    Elsewhere,
    /// No requirement has failed.
    Survived,
    /// A valid variant, and no requirement has failed.
    Quiet,
    /// A valid variant, but a requirement has failed.
    FalseAlarm,
    /// The defect changed no byte in any exchange of the trial, so it is not detectable.
    Same,
    /// The trial could not be run, or had a harness error.
    Broken,
}

/// A trial before it is run.
pub(super) struct Candidate {
    pub(super) id: String,
    pub(super) group: SelfTestGroup,
    pub(super) what: String,
    pub(super) targets: Vec<&'static str>,
    /// Runs the cases; the outcomes are `None` if a field defect changed no byte.
    pub(super) run: Box<dyn Fn() -> Result<Option<Vec<CaseOutcome>>, ToolError> + Send + Sync>,
}

/// The ID of the whole requirement: `VAR-4` for `VAR-4` and for its part `VAR-4.x`.
pub(super) fn whole(id: &str) -> &str {
    id.split_once('.').map_or(id, |(of, _)| of)
}

/// The verdict on a requirement, or a warning if a check has a warning and none fails: the warning
/// detects a defect even if other checks are inconclusive.
pub(super) fn detecting(judged: &RequirementVerdict) -> Verdict {
    let mut checks = judged.judgements.iter();
    match judged.verdict {
        Verdict::Inconclusive if checks.any(|one| one.verdict == Verdict::Warning) => {
            Verdict::Warning
        }
        verdict => verdict,
    }
}

/// The failed requirements and the result of the trial. After a harness error, the requirements
/// with a harness error are returned instead of the failed requirements.
pub(super) fn judge(targets: &[&str], outcomes: &[CaseOutcome]) -> (Vec<String>, TrialResult) {
    let with = |verdicts: &[Verdict]| -> Vec<&'static str> {
        let judged = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        let mut found: Vec<&'static str> = judged
            .filter(|one| verdicts.contains(&detecting(one)))
            .map(|one| one.requirement)
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    let failed = with(&[Verdict::Fail, Verdict::Vacuous]);
    // A violated requirement of level *should* causes a warning, a violated assumption a
    // difference.
    let noticed = with(&[Verdict::Warning, Verdict::Differs]);
    let hit = |id: &&str| match ads_cnc_vectors::clause(id) {
        Some(clause) => {
            let of = clause.requirement.id.as_str();
            failed.contains(&of)
                || clause.level() != ads_cnc_vectors::Level::Must && noticed.contains(&of)
        }
        None => failed.contains(id) || noticed.contains(id),
    };
    let broken = with(&[Verdict::HarnessError]);
    let result = match (targets.is_empty(), targets.iter().any(hit)) {
        _ if !broken.is_empty() => TrialResult::Broken,
        (true, _) if failed.is_empty() => TrialResult::Quiet,
        (true, _) => TrialResult::FalseAlarm,
        (false, true) => TrialResult::Caught,
        (false, false) if failed.is_empty() => TrialResult::Survived,
        (false, false) => TrialResult::Elsewhere,
    };
    let shown = if broken.is_empty() { failed } else { broken };
    (shown.into_iter().map(str::to_owned).collect(), result)
}
