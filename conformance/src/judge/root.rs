//! The checks that can be the cause of other failures.

use std::collections::HashSet;

use ads_cnc::operation::Function;

use super::chain::{before, defines, is_of_functions};
use super::{Case, CaseOutcome, CaseSubject, Judgement, Verdict};

pub(super) const fn is_broken(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Fail | Verdict::Vacuous)
}

/// Whether a check with this verdict deviates from a clause without failing the run. Such a check
/// is not the cause of another failure.
pub(super) const fn is_deviation(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Warning | Verdict::Differs)
}

/// Whether a case judges the replies of a target or of a CNC in captured traffic.
pub(super) fn is_of_device(case: &Case) -> bool {
    matches!(case.subject, CaseSubject::Target | CaseSubject::CapturedCnc)
}

/// The checks in the cases for which [`is_of_device`] returns true, if `wanted` returns true for
/// the verdict of the check.
pub(super) fn checks(
    outcomes: &[CaseOutcome],
    wanted: fn(Verdict) -> bool,
) -> impl Iterator<Item = FailedCheck<'_>> {
    outcomes.iter().filter(|outcome| is_of_device(&outcome.case)).flat_map(move |outcome| {
        let judged = outcome.verdicts.iter().flat_map(|one| &one.judgements);
        let wanted = judged.filter(move |one| wanted(one.verdict));
        wanted.map(|judgement| FailedCheck { case: &outcome.case, judgement })
    })
}

/// A check that did not pass.
#[derive(Clone, Copy)]
pub(super) struct FailedCheck<'a> {
    pub(super) case: &'a Case,
    pub(super) judgement: &'a Judgement,
}

impl<'a> FailedCheck<'a> {
    pub(super) const fn clause(self) -> &'static str {
        self.judgement.requirement
    }

    pub(super) fn function(self) -> Option<Function> {
        self.judgement.evidence.as_ref().and_then(|evidence| evidence.function)
    }

    /// The variable or object of the failure whose evidence is stored.
    fn first_subject(self) -> Option<&'a str> {
        self.judgement.evidence.as_ref().and_then(|evidence| evidence.subject.as_deref())
    }

    /// The variable or object that all failures of the check are about. `None` if the check is not
    /// about a particular one, or if further failures were counted but not stored: these may be
    /// about others.
    fn subject(self) -> Option<&'a str> {
        self.first_subject().filter(|_| self.judgement.more == 0)
    }

    /// The functions whose replies the check may compare.
    pub(super) fn compared(self) -> &'a [Function] {
        self.judgement.evidence.as_ref().map_or(&[], |evidence| &evidence.compared)
    }

    /// Whether, by its subject, this check can explain all failures of `other`: both checks have
    /// the same subject, or one of the checks is not about a particular subject. A check about a
    /// particular subject does not explain a check with failures that were not stored.
    pub(super) fn is_about_all_of(self, other: Self) -> bool {
        match (self.subject(), other.first_subject()) {
            (Some(_), _) if other.judgement.more > 0 => false,
            (Some(one), Some(other)) => one == other,
            _ => true,
        }
    }

    /// Whether the two checks can have the same subject.
    fn may_share_subject(self, other: Self) -> bool {
        let (one, other) = (self.subject(), other.subject());
        one.is_none() || other.is_none() || one == other
    }

    /// Whether `self` and `other` are the results of one check, recorded for different clauses.
    pub(super) fn is_same_as(self, other: Self) -> bool {
        let (one, two) = (self.judgement, other.judgement);
        self.case.id == other.case.id && one.expected == two.expected && one.found == two.found
    }
}

/// A failed check of a function, for a clause that defines this function. Such a check is a
/// possible cause of the failures of later functions.
#[derive(Clone, Copy)]
pub(super) struct Root<'a> {
    pub(super) function: Function,
    pub(super) check: FailedCheck<'a>,
}

impl<'a> Root<'a> {
    fn of(check: FailedCheck<'a>) -> Option<Self> {
        let (clause, function) = (check.clause(), check.function()?);
        let is_root = is_of_functions(clause) && defines(clause, function);
        is_root.then_some(Self { function, check })
    }

    /// Whether the stored failure of the check is about a variable outside the Service Interface,
    /// and the check has further failures, which are not stored.
    pub(super) fn is_not_of_services(&self) -> bool {
        let is_other = |name: &str| !name.contains(".SERVICE.");
        self.check.judgement.more > 0 && self.check.first_subject().is_some_and(is_other)
    }

    /// Whether this root can explain the failed `check` of a later function. It cannot if the
    /// target accepted a request that it must reject, or if the root compares several replies, and
    /// more of them than `check`.
    pub(super) fn explains_later(&self, check: FailedCheck<'_>) -> bool {
        let evidence = self.check.judgement.evidence.as_ref();
        !evidence.is_some_and(|evidence| evidence.is_rejection)
            && self.check.compared().len() <= check.compared().len().max(1)
    }

    /// Whether this root explains the failure of `check`, which compares the replies of several
    /// functions: the root shows with fewer of these replies that one of these functions is wrong.
    pub(super) fn explains_comparison(&self, check: FailedCheck<'_>) -> bool {
        let (own_functions, compared) = (self.check.compared(), check.compared());
        let mut functions = before(self.function);
        functions.insert(self.function);
        own_functions.len() < compared.len()
            && compared.contains(&self.function)
            && own_functions.iter().all(|function| compared.contains(function))
            && is_of_functions(check.clause())
            && !functions.into_iter().any(|home| defines(check.clause(), home))
    }
}

/// The roots that no other root explains.
pub(super) fn roots<'a>(broken: &[FailedCheck<'a>]) -> Vec<Root<'a>> {
    let mut all: Vec<Root<'_>> = broken.iter().filter_map(|check| Root::of(*check)).collect();
    // A root that compares fewer replies comes first, because only such a root explains a
    // comparison.
    all.sort_by_key(|root| root.check.compared().len());
    let mut simplest: Vec<Root<'_>> = Vec::new();
    for root in all {
        let explains = |other: &Root<'_>| {
            other.explains_comparison(root.check) && other.check.may_share_subject(root.check)
        };
        if !simplest.iter().any(explains) {
            simplest.push(root);
        }
    }
    let is_first = |root: &&Root<'_>| {
        let before: HashSet<Function> = before(root.function);
        !simplest.iter().any(|other| {
            before.contains(&other.function)
                && other.explains_later(root.check)
                && other.check.may_share_subject(root.check)
        })
    };
    simplest.iter().filter(is_first).copied().collect()
}
