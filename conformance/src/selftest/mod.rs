//! The suite tried on itself: whoever has a seeded defect has to fail by a requirement that it
//! breaks, and whoever merely does things otherwise by none.
//!
//! A defect counts as caught when a requirement that it targets is among those that fail, or, if it
//! targets no more than a should, among those that are warned of. What survives has a written
//! reason, or the self-test fails.

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

#[derive(Clone, Debug, Serialize)]
pub struct SelfTest {
    /// Each that was tried, in the order of groups and IDs.
    pub tried: Vec<Tried>,
    /// Reasons for survivors that are none.
    pub stale: Vec<String>,
    /// What is detected of CNCs from outside, and what of it was measured again.
    pub detection: CheckedTable,
}

impl SelfTest {
    /// How many of a group did what they should, and how many there are; without those that are the
    /// same as without their defect.
    pub fn rate(&self, group: SelfTestGroup) -> (usize, usize) {
        let differs = |one: &&Tried| one.group == group && one.result != Outcomes::Same;
        let mine = || self.tried.iter().filter(differs);
        let right = |one: &&Tried| {
            matches!(one.result, Outcomes::Caught | Outcomes::Noticed | Outcomes::Quiet)
        };
        (mine().filter(right).count(), mine().count())
    }

    /// How the process ends: a survivor without a reason, a false alarm and a reason for none fail.
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

/// One that can be tried.
struct Candidate {
    id: String,
    group: SelfTestGroup,
    what: String,
    targets: Vec<&'static str>,
    /// Nothing if it does as it would without its defect.
    run: Box<dyn Fn() -> Result<Option<Vec<CaseOutcome>>, Trouble> + Send + Sync>,
}

/// Tries all whose ID, group or target begins with one of these words; all if there is none. Of the
/// table of detection as much as `scope` wants is measured again. `tell` is told after each how many
/// are done, of how many.
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
    // Most of their time they wait for each other's ends of a connection.
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

/// Does the work on each item, in as many threads for each processor; the results in the order of
/// the items.
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

/// What came of a codec: what its vectors warn of, or differ in, is caught at their level.
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

/// What has failed, and whether that is right.
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
