//! Checks: the rule of each, and what came of it.

use std::error::Error;
use std::fmt::{self, Display};

use ads_cnc_vectors::{Hex, Level, clause};

use super::{CLIENT, Evidence, Verdict};
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

impl Stop {
    /// The target has nothing to try this on.
    pub(crate) fn not_applicable(why: impl Into<String>) -> Self {
        Self::NotApplicable(why.into())
    }

    /// What came back does not tell.
    pub(crate) fn inconclusive(why: impl Into<String>) -> Self {
        Self::Inconclusive(why.into())
    }
}

/// An error that a case returns with `?` is the suite's own, such as a request that has no form on the
/// wire. A reply that cannot be decoded is a failed check, or None, but never such an error.
impl<E: Error> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Harness(error.to_string())
    }
}

/// Ends a case as not applicable unless it judged anything.
pub(crate) fn applicable(any: bool, why: &str) -> Step {
    if any { Ok(()) } else { Err(Stop::not_applicable(why)) }
}

/// Ends a case that lacks a value.
pub(crate) trait OrStop<T> {
    /// The value, or the case is not applicable.
    fn or_not_applicable(self, why: &str) -> Step<T>;

    /// The value, or the case is inconclusive.
    fn or_inconclusive(self, why: &str) -> Step<T>;
}

impl<T> OrStop<T> for Option<T> {
    fn or_not_applicable(self, why: &str) -> Step<T> {
        self.ok_or_else(|| Stop::not_applicable(why))
    }

    fn or_inconclusive(self, why: &str) -> Step<T> {
        self.ok_or_else(|| Stop::inconclusive(why))
    }
}

/// Goes on with a case that lacks a value.
pub(crate) trait IfThere<T> {
    /// The value, or None where the target does not have it.
    fn if_applicable(self) -> Step<Option<T>>;

    /// The value, or None where the target does not have it or it could not be read: other cases judge
    /// that.
    fn if_known(self) -> Step<Option<T>>;
}

impl<T> IfThere<T> for Step<T> {
    fn if_applicable(self) -> Step<Option<T>> {
        match self {
            Err(Stop::NotApplicable(_)) => Ok(None),
            step => step.map(Some),
        }
    }

    fn if_known(self) -> Step<Option<T>> {
        match self {
            Err(Stop::Inconclusive(_)) => Ok(None),
            step => step.if_applicable(),
        }
    }
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
        if id == CLIENT {
            // Not of the catalogue.
            return Self { id, level: Some(Level::Must) };
        }
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

/// The requirements of one check.
pub trait Rules {
    /// Each of them.
    fn rules(self) -> impl Iterator<Item = Rule>;
}

impl Rules for Rule {
    fn rules(self) -> impl Iterator<Item = Rule> {
        [self].into_iter()
    }
}

impl Rules for &'static str {
    fn rules(self) -> impl Iterator<Item = Rule> {
        [self.into()].into_iter()
    }
}

impl<R: Into<Rule>, const N: usize> Rules for [R; N] {
    fn rules(self) -> impl Iterator<Item = Rule> {
        self.into_iter().map(Into::into)
    }
}

impl<R: Into<Rule> + Copy> Rules for &[R] {
    fn rules(self) -> impl Iterator<Item = Rule> {
        self.iter().map(|&rule| rule.into())
    }
}

impl<R: Into<Rule> + Copy, const N: usize> Rules for &[R; N] {
    fn rules(self) -> impl Iterator<Item = Rule> {
        self.as_slice().rules()
    }
}

impl<R: Into<Rule> + Copy> Rules for &Vec<R> {
    fn rules(self) -> impl Iterator<Item = Rule> {
        self.as_slice().rules()
    }
}

/// What a check expected, or found. Only a check that fails formats it: for a pass no closure is called
/// and no `format_args!` is formatted.
pub trait Describe {
    /// As a report shows it.
    fn describe(self) -> String;
}

impl<F: FnOnce() -> D, D: Display> Describe for F {
    fn describe(self) -> String {
        self().to_string()
    }
}

macro_rules! describe {
    ($($displayed:ty),+ $(,)?) => {$(
        impl Describe for $displayed {
            fn describe(self) -> String {
                self.to_string()
            }
        }
    )+};
}

describe! { &str, String, &String, fmt::Arguments<'_>, Hex, u32, usize, ads_cnc::Error }

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

/// Records checks: of a case that sends requests, or of captured traffic.
pub(crate) trait Checks {
    /// Judges a check for each of the rules; returns `kept`. The words are formatted if it fails.
    fn check(
        &mut self,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
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
    /// Adds one check of several rules.
    pub(crate) fn add_all(
        &mut self,
        rules: impl Rules,
        kept: bool,
        expected: impl Describe,
        found: impl Describe,
        evidence: impl Fn() -> Option<Evidence>,
    ) {
        let words = (!kept).then(|| (expected.describe(), found.describe()));
        let (expected, found) = words.unwrap_or_default();
        for rule in rules.rules() {
            self.add(rule, rule.verdict(kept), expected.as_str(), found.as_str(), &evidence);
        }
    }

    /// Adds a check; of those that passed, and of many alike, the first are kept.
    pub(crate) fn add(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        expected: impl Describe,
        found: impl Describe,
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
        let (requirement, level) = (rule.id, rule.level);
        let (expected, found, evidence) = if passed {
            (String::new(), String::new(), None)
        } else {
            let short = |text: String| shorten(&text, TEXT_MAX);
            (short(expected.describe()), short(found.describe()), evidence())
        };
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
