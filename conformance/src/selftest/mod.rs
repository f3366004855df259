//! Tests the suite: a codec, CNC or client with a seeded defect must fail a requirement that the
//! defect breaks, and a valid variant must not fail.
//!
//! A defect is caught if a requirement that it breaks fails. For a requirement below the level
//! *must*, and for a codec with a seeded defect, a warning or a difference suffices. If neither
//! happens, the defect needs a written reason, otherwise the self-test fails. A field defect of a
//! CNC that changes no byte is not counted. The detection table lists the defects that a run
//! against a device misses; such a miss needs no reason.

mod clients;
mod cncs;
mod codecs;
pub mod detection;
mod parallel;
mod reasons;
mod show;
#[cfg(test)]
mod tests;
mod trial;
mod undetectable;

use serde::Serialize;

use crate::exit::Exit;
use crate::faults::{self, DefectKind};
use crate::judge::{CaseOutcome, Verdict};
use detection::{CheckedTable, PairFigures, Scope};

pub use parallel::SelfTestProgress;
use parallel::parallel;
pub use show::print;
use trial::{Candidate, detecting, judge, whole};
pub use trial::{SelfTestGroup, Trial, TrialResult};
pub use undetectable::UNSEEN;

#[derive(Clone, Debug, Serialize)]
pub struct SelfTest {
    /// The trials that were run: those of codecs, of miniatures, of CNCs and of clients, each in
    /// the order of its list.
    pub tried: Vec<Trial>,
    /// The groups and ID prefixes of the written reasons to which no surviving defect belongs.
    pub stale: Vec<String>,
    /// The detection table, and the differences of the defects that were measured again.
    pub detection: CheckedTable,
    /// The result of the pairs of defects; `PairFigures::default()` if only some of the trials were
    /// run.
    pub pairs: PairFigures,
}

impl SelfTest {
    /// The number of trials of a group with the desired result, and the number of all trials of the
    /// group. Neither number includes trials in which the defect changed nothing.
    pub fn rate(&self, group: SelfTestGroup) -> (usize, usize) {
        let differs = |one: &&Trial| one.group == group && one.result != TrialResult::Same;
        let mine = || self.tried.iter().filter(differs);
        let right = |one: &&Trial| {
            matches!(one.result, TrialResult::Caught | TrialResult::Noticed | TrialResult::Quiet)
        };
        (mine().filter(right).count(), mine().count())
    }

    /// The exit code: [`Exit::Nothing`] without a trial; [`Exit::Failure`] after a failed trial, a
    /// stale reason, a difference from the detection table, or a pair in `PairFigures::hidden`;
    /// otherwise [`Exit::Success`].
    pub fn exit(&self) -> Exit {
        let differs = !self.detection.differences.is_empty();
        let hides = !self.pairs.hidden.is_empty();
        if self.tried.is_empty() {
            Exit::Nothing
        } else if self.tried.iter().any(Trial::is_failure)
            || !self.stale.is_empty()
            || differs
            || hides
        {
            Exit::Failure
        } else {
            Exit::Success
        }
    }
}

/// Runs the trials that `only` selects, or all if it is empty. A word selects trials by the start
/// of their ID, the name of their group, or a requirement, an area or a section. `scope` selects
/// the defects that are measured again for the detection table; words in `only` select them
/// instead. Calls `report_progress` after each trial, comparison with the table, measurement and
/// pair.
pub fn run(
    only: &[String],
    scope: Scope,
    report_progress: impl Fn(SelfTestProgress) + Sync,
) -> SelfTest {
    let wanted = |id: &str, group: SelfTestGroup, targets: &[&str]| {
        only.is_empty()
            || only.iter().any(|word| {
                id.starts_with(word.as_str())
                    || group.name() == word
                    || targets.iter().any(|target| crate::judge::names(word, target))
            })
    };
    let mut candidates = codecs::candidates();
    candidates.extend(cncs::candidates());
    candidates.extend(clients::candidates());
    candidates.retain(|one| wanted(&one.id, one.group, &one.targets));
    // Uses more threads than processors, because the trials of clients and miniatures wait for
    // another thread or process.
    let tried = parallel(
        ("defects tried once", &candidates),
        3,
        attempt,
        Trial::is_failure,
        &report_progress,
    );
    let stale = if only.is_empty() { reasons::stale(&tried) } else { Vec::new() };
    let defects = faults::all().iter().filter(|defect| defect.is_for_cnc());
    let defects = defects.filter(|defect| {
        let group = if defect.kind == DefectKind::Different {
            SelfTestGroup::Different
        } else {
            SelfTestGroup::Cnc
        };
        wanted(&defect.id, group, &defect.requirements)
    });
    let scope = if only.is_empty() { scope } else { Scope::All };
    let detection = CheckedTable::new(defects.collect(), scope, only.is_empty(), &report_progress);
    let pairs = if only.is_empty() {
        detection::pairs(&detection.table, &report_progress)
    } else {
        PairFigures::default()
    };
    SelfTest { tried, stale, detection, pairs }
}

fn attempt(candidate: &Candidate) -> Trial {
    let Candidate { id, group, what, targets, run } = candidate;
    let (failed, result) = match run() {
        Ok(Some(outcomes)) if *group == SelfTestGroup::Codec => by_level(targets, &outcomes),
        Ok(Some(outcomes)) => judge(targets, &outcomes),
        Ok(None) => (Vec::new(), TrialResult::Same),
        Err(error) => (vec![error.to_string()], TrialResult::Broken),
    };
    let survives = matches!(result, TrialResult::Survived | TrialResult::Elsewhere);
    Trial {
        id: id.clone(),
        group: *group,
        what: what.clone(),
        targets: targets.iter().map(|&id| id.to_owned()).collect(),
        failed,
        result,
        reason: reasons::of(*group, id).filter(|_| survives).map(str::to_owned),
    }
}

/// The failed requirements and the result for a codec. If a requirement that the defect breaks has
/// a warning or a difference in a case, and no requirement that it breaks fails, the result is
/// `Noticed`.
fn by_level(targets: &[&str], outcomes: &[CaseOutcome]) -> (Vec<String>, TrialResult) {
    let (failed, result) = judge(targets, outcomes);
    let broken: Vec<&str> = targets.iter().map(|id| whole(id)).collect();
    let noticed = outcomes.iter().flat_map(|outcome| &outcome.verdicts).any(|one| {
        matches!(detecting(one), Verdict::Warning | Verdict::Differs)
            && broken.contains(&one.requirement)
    });
    match result {
        TrialResult::Caught | TrialResult::Survived | TrialResult::Elsewhere
            if noticed && !failed.iter().any(|one| broken.contains(&one.as_str())) =>
        {
            (failed, TrialResult::Noticed)
        }
        result => (failed, result),
    }
}
