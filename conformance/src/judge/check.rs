//! Checks: the rule of each, and what came of it.

use std::fmt::Display;

use ads_cnc_vectors::{Level, clause};

use super::{Evidence, Verdict};
use crate::text::shorten;

/// How a step of a case goes on.
pub type Step<T = ()> = Result<T, Stop>;

/// Why a case ends before its end.
#[derive(Clone, Debug)]
pub enum Stop {
    /// A judgement has been made that leaves nothing to go on with.
    Judged,
    /// The target has nothing to try this on.
    NotApplicable(String),
    /// What came back does not tell.
    Inconclusive(String),
    Refused(String),
    /// The run is to end.
    Interrupted,
    /// The suite itself is wrong.
    Harness(String),
}

/// A requirement at a level: that of the catalogue, or of an assumed part.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    pub id: &'static str,
    /// The level it is judged at.
    pub level: Option<Level>,
}

impl From<&'static str> for Rule {
    fn from(id: &'static str) -> Self {
        let clause = clause(id);
        let id = clause.map_or(id, |clause| clause.requirement.id.as_str());
        Self { id, level: clause.map(|clause| clause.level()) }
    }
}

/// A part of a requirement that is assumed, whatever its rest is.
pub const fn assumed(id: &'static str) -> Rule {
    Rule { id, level: Some(Level::Info) }
}

/// A part of a requirement that is known from help pages only, whatever its rest is.
pub const fn online(id: &'static str) -> Rule {
    Rule { id, level: Some(Level::Should) }
}

#[derive(Clone, Debug)]
pub struct Judgement {
    pub requirement: &'static str,
    /// The level it was judged at; that of an assumed part may be lower.
    pub level: Option<Level>,
    pub verdict: Verdict,
    /// What was expected; empty for a pass.
    pub expected: String,
    /// What was there; empty for a pass.
    pub found: String,
    /// The request and the answer in question.
    pub evidence: Option<Evidence>,
    /// Checks with the same verdict that are not kept.
    pub more: usize,
}

/// The most failed checks a case keeps of one requirement; of the others it keeps the number.
const KEPT: usize = 3;

/// The most characters that are kept of what was expected, and of what was found.
pub(crate) const TEXT_MAX: usize = 1024;

#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    pub(crate) judgements: Vec<Judgement>,
    /// How many there were.
    pub(crate) checks: usize,
}

/// Who judges checks: a case that asks for itself, or one that looks on.
pub(crate) trait Checks {
    fn check(
        &mut self,
        rule: impl Into<Rule>,
        kept: bool,
        expected: impl Display,
        found: impl Display,
    ) -> bool;
}

impl Rule {
    /// What comes of it if it is kept or not.
    pub(crate) const fn verdict(self, kept: bool) -> Verdict {
        match (kept, self.level) {
            (true, _) => Verdict::Pass,
            (false, Some(level)) => Verdict::missed(level),
            (false, None) => Verdict::HarnessError,
        }
    }
}

impl Record {
    /// Adds a check; of those that passed, and of many alike, the first are kept.
    pub(crate) fn add(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        expected: impl Display,
        found: impl Display,
        evidence: impl FnOnce() -> Option<Evidence>,
    ) {
        self.checks = self.checks.saturating_add(1);
        let passed = verdict == Verdict::Pass;
        let same = self
            .judgements
            .iter_mut()
            .filter(|judgement| judgement.requirement == rule.id && judgement.verdict == verdict);
        let mut same: Vec<_> = same.collect();
        if same.len() >= if passed { 1 } else { KEPT } {
            if let Some(last) = same.last_mut() {
                last.more = last.more.saturating_add(1);
            }
            return;
        }
        let evidence = if passed { None } else { evidence() };
        let (requirement, level) = (rule.id, rule.level);
        let (expected, found) =
            (shorten(&expected.to_string(), TEXT_MAX), shorten(&found.to_string(), TEXT_MAX));
        let judgement =
            Judgement { requirement, level, verdict, expected, found, evidence, more: 0 };
        self.judgements.push(judgement);
    }

    /// What it has of a requirement.
    pub(crate) fn of(&self, requirement: &str) -> Self {
        let mine = self.judgements.iter().filter(|one| one.requirement == requirement);
        let judgements: Vec<Judgement> = mine.cloned().collect();
        let checks = judgements.iter().map(|one| one.more.saturating_add(1));
        Self { checks: checks.fold(0, usize::saturating_add), judgements }
    }

    /// Adds what another record has, which is of other requirements.
    pub(crate) fn append(&mut self, mut other: Self) {
        self.judgements.append(&mut other.judgements);
        self.checks = self.checks.saturating_add(other.checks);
    }
}
