//! Checks, their rules and their verdicts.

use std::error::Error;

use ads_cnc_vectors::{ClauseId, Level, clause};

use super::{CLIENT, Verdict};
use crate::evidence::{Describe, Evidence};
use crate::text::shorten;

/// The result of a step of a case.
pub type Step<T = ()> = Result<T, Stop>;

/// Why a case ends early.
#[derive(Clone, Debug)]
pub enum Stop {
    /// A check failed, and the case cannot continue after this failure.
    Judged,
    /// The target does not have what the case needs.
    NotApplicable(String),
    /// The replies do not decide the case.
    Inconclusive(String),
    NotPermitted(String),
    /// The run is interrupted.
    Interrupted,
    /// An error of the suite itself.
    Harness(String),
}

impl Stop {
    /// The target does not have what the case needs.
    pub(crate) fn not_applicable(why: impl Into<String>) -> Self {
        Self::NotApplicable(why.into())
    }

    /// The replies do not decide the case.
    pub(crate) fn inconclusive(why: impl Into<String>) -> Self {
        Self::Inconclusive(why.into())
    }
}

/// An error that a case returns with `?` is an error of the suite, such as a request that cannot be
/// encoded. Therefore a case must not use `?` for a reply that cannot be decoded.
impl<E: Error> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Harness(error.to_string())
    }
}

/// Ends a case as not applicable for the reason `why`, unless `any` is true.
pub(crate) fn applicable(any: bool, why: &str) -> Step {
    if any { Ok(()) } else { Err(Stop::not_applicable(why)) }
}

/// Ends a case if a value is missing.
pub(crate) trait OrStop<T> {
    /// Returns the value, or ends the case as not applicable.
    fn or_not_applicable(self, why: &str) -> Step<T>;

    /// Returns the value, or ends the case as inconclusive.
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

/// Continues a case without a value.
pub(crate) trait IfPresent<T> {
    /// Returns the value, or `None` if the step ended as not applicable.
    fn if_applicable(self) -> Step<Option<T>>;

    /// Returns the value, or `None` if the step ended as not applicable or as inconclusive.
    fn if_known(self) -> Step<Option<T>>;
}

impl<T> IfPresent<T> for Step<T> {
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

/// A requirement and the level at which it is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rule {
    pub id: &'static str,
    /// The level; `None` if it is not known, such as for an ID that `Rule::of` does not find in the
    /// catalogue.
    pub level: Option<Level>,
}

impl From<ClauseId> for Rule {
    fn from(id: ClauseId) -> Self {
        Self::of(id.as_str())
    }
}

/// A part of a requirement that is assumed, even if the rest of it is stated in a manual.
pub fn assumed(rule: impl Into<Rule>) -> Rule {
    rule.into().at(Level::Info)
}

/// A part of a requirement that is documented in the online help only.
pub fn online(rule: impl Into<Rule>) -> Rule {
    rule.into().at(Level::Should)
}

/// The requirements of a check.
pub trait Rules {
    /// Iterates over the rules.
    fn rules(self) -> impl Iterator<Item = Rule>;
}

impl Rules for Rule {
    fn rules(self) -> impl Iterator<Item = Rule> {
        [self].into_iter()
    }
}

impl Rules for ClauseId {
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

#[derive(Clone, Debug)]
pub struct Judgement {
    pub requirement: &'static str,
    /// The level at which the requirement was judged; for a part of the requirement, it can differ
    /// from the level in the catalogue.
    pub level: Option<Level>,
    pub verdict: Verdict,
    /// The expected result; empty for a pass.
    pub expected: String,
    /// The actual result; empty for a pass.
    pub found: String,
    /// The bytes on which the check is based, such as the request and the reply; `None` for a pass,
    /// and for a check without such bytes.
    pub evidence: Option<Evidence>,
    /// The number of further checks of the requirement with the same verdict and the same
    /// `together`, which are not stored.
    pub more: usize,
    /// The other clauses that the same failed check judges with the same verdict: the failure does
    /// not show which of these clauses is violated.
    pub together: Vec<&'static str>,
    /// The clause whose failure caused this check to fail, if any.
    pub follows: Option<&'static str>,
}

/// Maximum number of checks that a record stores for a requirement and a verdict other than
/// [`Verdict::Pass`]; further checks are counted. A check with a new value of `together` is stored
/// in addition.
const STORED_MAX: usize = 3;

/// Maximum number of characters of the expected and of the actual result.
pub(crate) const TEXT_MAX: usize = 1024;

#[derive(Clone, Debug, Default)]
pub(crate) struct Record {
    pub(crate) judgements: Vec<Judgement>,
    /// Number of all checks.
    pub(crate) checks: usize,
}

/// Records the checks of a case or of captured traffic.
pub(crate) trait Checks {
    /// Records a check for each rule and returns `passed`. `expected` and `found` are formatted
    /// only if the check failed.
    fn check(
        &mut self,
        rules: impl Rules,
        passed: bool,
        expected: impl Describe,
        found: impl Describe,
    ) -> bool;
}

impl Rule {
    /// The rule of the protocol between the suite and a client, which is not in the catalogue.
    pub(crate) const CLIENT: Self = Self { id: CLIENT, level: Some(Level::Must) };

    /// The rule for an ID that is given as text, such as by the codec's tables. The ID of a part of
    /// a requirement gives a rule with the ID of the requirement and the level of the part.
    pub(crate) fn of(id: &'static str) -> Self {
        let clause = clause(id);
        let id = clause.map_or(id, |clause| clause.requirement.id.as_str());
        Self { id, level: clause.map(|clause| clause.level()) }
    }

    /// The same rule at another level.
    pub(crate) const fn at(self, level: Level) -> Self {
        Self { id: self.id, level: Some(level) }
    }

    /// The verdict of a check that passed or failed.
    pub(crate) const fn verdict(self, passed: bool) -> Verdict {
        match (passed, self.level) {
            (true, _) => Verdict::Pass,
            (false, Some(level)) => Verdict::missed(level),
            (false, None) => Verdict::HarnessError,
        }
    }
}

impl Record {
    /// Adds a check of several rules.
    pub(crate) fn add_all(
        &mut self,
        rules: impl Rules,
        passed: bool,
        expected: impl Describe,
        found: impl Describe,
        evidence: impl Fn() -> Option<Evidence>,
    ) {
        let words = (!passed).then(|| (expected.describe(), found.describe()));
        let rules: Vec<Rule> = rules.rules().collect();
        self.add_rules(&rules, passed, &words.unwrap_or_default(), &evidence);
    }

    /// Adds a check. For a requirement, only the first passed check is stored; [`STORED_MAX`]
    /// limits the stored checks with another verdict.
    pub(crate) fn add(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        expected: impl Describe,
        found: impl Describe,
        evidence: impl Fn() -> Option<Evidence>,
    ) {
        let passed = verdict == Verdict::Pass;
        let words = (!passed).then(|| (expected.describe(), found.describe()));
        self.add_one(rule, verdict, Vec::new(), &words.unwrap_or_default(), &evidence);
    }

    // The two functions above are compiled once for each combination of argument types, so most of
    // the code that does not depend on these types is in the functions below.

    fn add_rules(
        &mut self,
        rules: &[Rule],
        passed: bool,
        words: &(String, String),
        evidence: &dyn Fn() -> Option<Evidence>,
    ) {
        for &rule in rules {
            let verdict = rule.verdict(passed);
            let others = rules
                .iter()
                .filter(|other| !passed && other.id != rule.id && other.verdict(passed) == verdict);
            let together = others.map(|other| other.id).collect();
            self.add_one(rule, verdict, together, words, evidence);
        }
    }

    fn add_one(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        together: Vec<&'static str>,
        (expected, found): &(String, String),
        evidence: &dyn Fn() -> Option<Evidence>,
    ) {
        self.checks += 1;
        let passed = verdict == Verdict::Pass;
        let same = self
            .judgements
            .iter_mut()
            .filter(|judgement| judgement.requirement == rule.id && judgement.verdict == verdict);
        let mut same: Vec<_> = same.collect();
        let is_new = !passed && same.iter().all(|one| one.together != together);
        if !is_new && same.len() >= if passed { 1 } else { STORED_MAX } {
            let alike = same.iter().rposition(|one| one.together == together);
            if let Some(stored) = alike.and_then(|index| same.get_mut(index)) {
                stored.more += 1;
            }
            return;
        }
        self.judgements.push(Judgement {
            requirement: rule.id,
            level: rule.level,
            verdict,
            expected: shorten(expected, TEXT_MAX),
            found: shorten(found, TEXT_MAX),
            evidence: if passed { None } else { evidence() },
            more: 0,
            together,
            follows: None,
        });
    }

    /// Records a check that did not pass only because the clause `cause` failed. `verdict` is the
    /// verdict of the check by itself.
    pub(crate) fn add_following(
        &mut self,
        rule: Rule,
        verdict: Verdict,
        cause: &'static str,
        expected: impl Describe,
        found: impl Describe,
    ) {
        let place = self.judgements.len();
        self.add(rule, verdict.as_following(), expected, found, || None);
        if let Some(new) = self.judgements.get_mut(place) {
            new.follows = Some(cause);
        }
    }

    /// The part of the record for a requirement.
    pub(crate) fn of(&self, requirement: &str) -> Self {
        let mine = self.judgements.iter().filter(|one| one.requirement == requirement);
        let judgements: Vec<Judgement> = mine.cloned().collect();
        let checks = judgements.iter().map(|one| one.more + 1).sum();
        Self { checks, judgements }
    }

    /// Appends the checks of another record.
    pub(crate) fn append(&mut self, mut other: Self) {
        self.judgements.append(&mut other.judgements);
        self.checks += other.checks;
    }
}
