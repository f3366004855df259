//! Tests the suite: a codec, CNC or client with a seeded defect must fail by a requirement that it
//! breaks, and a valid variant must not fail.
//!
//! A defect is caught if a requirement that it breaks fails or, if it breaks at most a should, has
//! a warning. A defect that survives needs a written reason, otherwise the self-test fails.

mod clients;
mod codecs;
pub mod detection;
mod reasons;
mod show;
mod targets;
#[cfg(test)]
mod tests;

use std::sync::Mutex;
use std::thread;

use serde::Serialize;

use crate::faults::{self, SeedKind};
use crate::judge::{CaseOutcome, Exit, Verdict};
use crate::session::Trouble;
use crate::text::named;
use detection::{CheckedTable, Scope};

pub use show::print;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SelfTestGroup {
    /// Codecs with a defect, by the vectors.
    Codec,
    /// CNCs with a defect, by the cases over the wire.
    Cnc,
    /// Clients with a defect, by the scenarios.
    Client,
    /// Testees that misbehave in general.
    Miniature,
    /// Valid variants.
    Different,
}

named! { SelfTestGroup:
    Codec "codec", Cnc "cnc", Client "client", Miniature "miniature", Different "different",
}

/// A trial and its result.
#[derive(Clone, Debug, Serialize)]
pub struct Tried {
    /// The ID of the defect, miniature or variant.
    pub id: String,
    /// Its group.
    pub group: SelfTestGroup,
    pub what: String,
    /// The requirements it breaks; empty for a valid variant.
    pub targets: Vec<String>,
    pub failed: Vec<String>,
    pub result: Outcomes,
    /// The reason why it may survive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// The result of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcomes {
    /// A requirement that it breaks has failed.
    Caught,
    /// Codec only: a vector of a requirement that it breaks has a warning or a difference, because
    /// the manuals do not state everything that the vector expects.
    Noticed,
    /// Other requirements have failed, and none that it breaks.
    Elsewhere,
    /// No requirement has failed.
    Survived,
    /// A valid variant, and no requirement has failed.
    Quiet,
    /// A valid variant, but a requirement has failed.
    FalseAlarm,
    /// The defect changed no byte in any exchange, so it is not detectable.
    Same,
    /// It could not be run.
    Broken,
}

#[derive(Clone, Debug, Serialize)]
pub struct SelfTest {
    /// All trials, in the order of groups and IDs.
    pub tried: Vec<Tried>,
    /// Reasons that no survivor needs.
    pub stale: Vec<String>,
    /// The table of detection, and the rows that were measured again.
    pub detection: CheckedTable,
}

impl SelfTest {
    /// Number of trials of a group with the desired result, and of all; without those in which the
    /// defect changed nothing.
    pub fn rate(&self, group: SelfTestGroup) -> (usize, usize) {
        let differs = |one: &&Tried| one.group == group && one.result != Outcomes::Same;
        let mine = || self.tried.iter().filter(differs);
        let right = |one: &&Tried| {
            matches!(one.result, Outcomes::Caught | Outcomes::Noticed | Outcomes::Quiet)
        };
        (mine().filter(right).count(), mine().count())
    }

    /// The exit code: a survivor without a reason, a false alarm and a stale reason are failures.
    pub fn exit(&self) -> Exit {
        let wrong = |one: &Tried| match one.result {
            Outcomes::Caught | Outcomes::Noticed | Outcomes::Quiet | Outcomes::Same => false,
            Outcomes::Survived | Outcomes::Elsewhere => one.reason.is_none(),
            Outcomes::FalseAlarm | Outcomes::Broken => true,
        };
        let differs = !self.detection.differences.is_empty();
        if self.tried.is_empty() {
            Exit::Nothing
        } else if self.tried.iter().any(wrong) || !self.stale.is_empty() || differs {
            Exit::Failure
        } else {
            Exit::Success
        }
    }
}

/// A trial before it is run.
struct Candidate {
    id: String,
    group: SelfTestGroup,
    what: String,
    targets: Vec<&'static str>,
    /// Runs the cases; `None` if the defect changed nothing.
    run: Box<dyn Fn() -> Result<Option<Vec<CaseOutcome>>, Trouble> + Send + Sync>,
}

/// Runs all trials whose ID, group or requirement begins with one of these words; all if there are
/// none. `scope` is the part of the table of detection to measure again. `tell` is called after
/// each with the number done and the number of all.
pub fn run(only: &[String], scope: Scope, tell: impl Fn(usize, usize) + Sync) -> SelfTest {
    let wanted = |id: &str, group: SelfTestGroup, targets: &[&str]| {
        only.is_empty()
            || only.iter().any(|word| {
                id.starts_with(word.as_str())
                    || group.name() == word
                    || targets.iter().any(|target| crate::judge::names(word, target))
            })
    };
    let mut candidates = codecs::candidates();
    candidates.extend(targets::candidates());
    candidates.extend(clients::candidates());
    candidates.retain(|one| wanted(&one.id, one.group, &one.targets));
    // Most of the time they wait for a connection.
    let tried = parallel(&candidates, 3, attempt, &tell);
    let stale = if only.is_empty() { reasons::stale(&tried) } else { Vec::new() };
    let seeds = faults::all().iter().filter(|seed| seed.is_for_cnc());
    let seeds = seeds.filter(|seed| {
        let group = if seed.kind == SeedKind::Different {
            SelfTestGroup::Different
        } else {
            SelfTestGroup::Cnc
        };
        wanted(&seed.id, group, &seed.requirements)
    });
    let scope = if only.is_empty() { scope } else { Scope::All };
    let detection = CheckedTable::new(seeds.collect(), scope, only.is_empty(), &tell);
    SelfTest { tried, stale, detection }
}

/// Processes each item, in this many threads per processor; the results have the order of the
/// items.
fn parallel<T: Sync, R: Send>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T) -> R + Sync,
    tell: &(impl Fn(usize, usize) + Sync),
) -> Vec<R> {
    let left = Mutex::new((items.iter().enumerate(), Vec::with_capacity(items.len())));
    let workers = thread::available_parallelism().map_or(1, usize::from) * threads;
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let next = lock(&left).0.next();
                    let Some((place, item)) = next else { return };
                    let result = work(item);
                    let mut left = lock(&left);
                    left.1.push((place, result));
                    tell(left.1.len(), items.len());
                }
            });
        }
    });
    let (_, mut results) = left.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

fn attempt(candidate: &Candidate) -> Tried {
    let Candidate { id, group, what, targets, run } = candidate;
    let (failed, result) = match run() {
        Ok(Some(outcomes)) if *group == SelfTestGroup::Codec => by_level(targets, &outcomes),
        Ok(Some(outcomes)) => judge(targets, &outcomes),
        Ok(None) => (Vec::new(), Outcomes::Same),
        Err(trouble) => (vec![trouble.to_string()], Outcomes::Broken),
    };
    let survives = matches!(result, Outcomes::Survived | Outcomes::Elsewhere);
    Tried {
        id: id.clone(),
        group: *group,
        what: what.clone(),
        targets: targets.iter().map(|&id| id.to_owned()).collect(),
        failed,
        result,
        reason: reasons::of(*group, id).filter(|_| survives).map(str::to_owned),
    }
}

/// The result of a codec: warnings and differences count at the level of their requirements.
fn by_level(targets: &[&str], outcomes: &[CaseOutcome]) -> (Vec<String>, Outcomes) {
    let (failed, result) = judge(targets, outcomes);
    let broken: Vec<&str> = targets.iter().map(|id| whole(id)).collect();
    let noticed = outcomes.iter().flat_map(|outcome| &outcome.verdicts).any(|one| {
        matches!(one.verdict, Verdict::Warning | Verdict::Differs)
            && broken.contains(&one.requirement)
    });
    match result {
        Outcomes::Caught | Outcomes::Survived | Outcomes::Elsewhere
            if noticed && !failed.iter().any(|one| broken.contains(&one.as_str())) =>
        {
            (failed, Outcomes::Noticed)
        }
        result => (failed, result),
    }
}

/// The requirement that this is, or is a part of.
fn whole(id: &str) -> &str {
    id.split_once('.').map_or(id, |(of, _)| of)
}

/// Which requirements have failed, and the result.
fn judge(targets: &[&str], outcomes: &[CaseOutcome]) -> (Vec<String>, Outcomes) {
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
    // A should gives a warning, and an assumed part a difference: at their levels these are caught.
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
