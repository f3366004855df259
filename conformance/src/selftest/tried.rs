//! One that can be tried, and what came of one that was.

use serde::Serialize;

use crate::judge::{CaseOutcome, Verdict};
use crate::session::Trouble;
use crate::text::named;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SelfTestGroup {
    /// Codecs with a defect, by the vectors.
    Codec,
    /// CNCs with a defect, by the cases over the wire.
    Cnc,
    /// Clients with a defect, by the scenarios.
    Client,
    /// Testees that misbehave as a whole.
    Miniature,
    /// Who does things otherwise, and nothing wrong.
    Different,
}

named! { SelfTestGroup:
    Codec "codec", Cnc "cnc", Client "client", Miniature "miniature", Different "different",
}

/// One that is tried.
#[derive(Clone, Debug, Serialize)]
pub struct Tried {
    /// The defect, the miniature or the difference.
    pub id: String,
    /// As what it was tried.
    pub group: SelfTestGroup,
    pub what: String,
    /// What it breaks; nothing if it does nothing wrong.
    pub targets: Vec<String>,
    pub failed: Vec<String>,
    pub result: Outcomes,
    /// Of one that survives: why it may.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// What came of one that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcomes {
    /// A requirement that it breaks has failed.
    Caught,
    /// Of a codec: a vector of a requirement that it breaks is not met. No manual says all that the
    /// vector expects, so that is a warning or a difference and fails nobody.
    Noticed,
    /// Others have failed, and none that it breaks.
    Elsewhere,
    /// Nothing has failed.
    Survived,
    /// Nothing is wrong, and nothing has failed.
    Quiet,
    /// Nothing is wrong, and something has failed.
    FalseAlarm,
    /// What it changes was what it is changed to wherever it came by: nobody could tell.
    Same,
    /// It could not be tried.
    Broken,
}

/// One that can be tried.
pub(super) struct Candidate {
    pub(super) id: String,
    pub(super) group: SelfTestGroup,
    pub(super) what: String,
    pub(super) targets: Vec<&'static str>,
    /// Nothing if it does as it would without its defect.
    pub(super) run: Box<dyn Fn() -> Result<Option<Vec<CaseOutcome>>, Trouble> + Send + Sync>,
}

/// The requirement that this is, or is a part of.
pub(super) fn whole(id: &str) -> &str {
    id.split_once('.').map_or(id, |(of, _)| of)
}

/// What has failed, and whether that is right.
pub(super) fn judge(targets: &[&str], outcomes: &[CaseOutcome]) -> (Vec<String>, Outcomes) {
    let with = |verdicts: &[Verdict]| -> Vec<&'static str> {
        let judged = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        let mut found: Vec<&'static str> = judged
            .filter(|one| verdicts.contains(&one.verdict))
            .map(|one| one.requirement)
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    };
    let failed = with(&[Verdict::Fail, Verdict::Vacuous]);
    // A should is warned of, and what is assumed differs: by their levels these are caught too.
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
        _ if !broken.is_empty() => Outcomes::Broken,
        (true, _) if failed.is_empty() => Outcomes::Quiet,
        (true, _) => Outcomes::FalseAlarm,
        (false, true) => Outcomes::Caught,
        (false, false) if failed.is_empty() => Outcomes::Survived,
        (false, false) => Outcomes::Elsewhere,
    };
    let shown = if broken.is_empty() { failed } else { broken };
    (shown.into_iter().map(str::to_owned).collect(), result)
}
