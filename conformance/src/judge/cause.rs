//! Attributes failures to their cause: the clause that is broken fails, and what only follows from it is
//! inconclusive.
//!
//! A wrong size in a description makes every comparison with that size fail. Only the first function of
//! the chain shows which clause is broken, so a failed check of a later function does not count against
//! its own clause while an earlier one of the same variable or object fails.

use std::collections::HashSet;

use ads_cnc::operation::{Function, Service};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::chain::{before, can_explain, defines, follows, is_of_functions, origin};
use super::{
    Body, Case, CaseOutcome, CaseSubject, Judgement, Needs, RequirementVerdict, Verdict, gravest,
};

/// Clauses whose checks look for one error only, such as reversed bytes. No error of another clause looks
/// like it, so they always fail.
const SPECIFIC: [ClauseId; 8] = [GEN_1, GEN_2, GEN_3, ADR_6, ADS_2, ADS_5, ADS_7, SVC_1];

/// Clauses of every function: an error of the function itself looks like an error of these.
const GENERAL: [ClauseId; 5] = [ADS_1, ADS_3, GEN_5, GEN_6, OBJ_1];

fn is_one_of(clause: &str, list: &[ClauseId]) -> bool {
    list.iter().any(|one| one.as_str() == clause)
}

const fn is_broken(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Fail | Verdict::Vacuous)
}

/// A failed check of a function by a clause that defines it, with no failed one before it.
struct Root {
    function: Function,
    clause: &'static str,
    /// The variable or object; `None` for several, or for none in particular.
    subject: Option<String>,
    /// Whether it is about several variables, one of them not of the Service Interface.
    is_of_others: bool,
    /// Whether the check expects a rejection: an accepted request spoils no later function.
    is_rejection: bool,
    /// The functions whose replies the check compares.
    compared: Vec<Function>,
    check: (String, String, String),
}

impl Root {
    /// Whether it can explain a check of a later function: not if a request was accepted that must be
    /// rejected, nor if it compares more replies than that check.
    fn explains_later(&self, compared: &[Function]) -> bool {
        !self.is_rejection && self.compared.len() <= compared.len().max(1)
    }

    /// Whether a check that compares replies of `functions` fails because the function of this one is
    /// broken, which this one shows by fewer replies.
    fn spoils(&self, clause: &str, functions: &[Function]) -> bool {
        let mut homes = before(self.function);
        homes.insert(self.function);
        self.compared.len() < functions.len()
            && functions.contains(&self.function)
            && self.compared.iter().all(|function| functions.contains(function))
            && is_of_functions(clause)
            && !homes.into_iter().any(|home| defines(clause, home))
    }
}

/// What explains the failures of a run.
struct Causes {
    roots: Vec<Root>,
    /// The clause of the service that all of them use.
    service: Option<&'static str>,
    /// Whether all failures are of one chain.
    is_one_chain: bool,
    /// The clause of the request that several of them use, and these.
    request: Option<(&'static str, Vec<Function>)>,
}

impl Causes {
    fn of(outcomes: &[CaseOutcome]) -> Self {
        let roots = roots(outcomes);
        let (service, request) = (service_of(&roots, outcomes), request_of(&roots));
        let chains: HashSet<Function> = roots.iter().map(|root| origin(root.function)).collect();
        Self { roots, service, is_one_chain: chains.len() == 1, request }
    }
}

fn site(judgement: &Judgement) -> (Option<Function>, Option<&str>) {
    let evidence = judgement.evidence.as_ref();
    let subject = evidence.and_then(|evidence| evidence.subject.as_deref());
    (evidence.and_then(|evidence| evidence.function), subject)
}

fn compared(judgement: &Judgement) -> &[Function] {
    judgement.evidence.as_ref().map_or(&[], |evidence| &evidence.compared)
}

/// Whether the two can be about the same: one of them may be about all.
fn related(one: Option<&str>, other: Option<&str>) -> bool {
    one.is_none() || other.is_none() || one == other
}

fn check(case: &str, judgement: &Judgement) -> (String, String, String) {
    (case.to_owned(), judgement.expected.clone(), judgement.found.clone())
}

fn roots(outcomes: &[CaseOutcome]) -> Vec<Root> {
    let mut all = Vec::new();
    for (case, judgement) in broken(outcomes) {
        let (Some(function), subject) = site(judgement) else { continue };
        let clause = judgement.requirement;
        if is_of_functions(clause) && defines(clause, function) {
            // The failures that are not stored are about others.
            let is_of_others =
                judgement.more > 0 && subject.is_some_and(|name| !name.contains(".SERVICE."));
            let is_rejection =
                judgement.evidence.as_ref().is_some_and(|evidence| evidence.is_rejection);
            let subject = subject.filter(|_| judgement.more == 0).map(str::to_owned);
            let check = check(&case.id, judgement);
            let compared = compared(judgement).to_vec();
            all.push(Root {
                function,
                clause,
                subject,
                is_of_others,
                is_rejection,
                compared,
                check,
            });
        }
    }
    // The one that compares the fewest replies first: it can only be spoiled by one before it.
    all.sort_by_key(|root| root.compared.len());
    let mut simplest: Vec<Root> = Vec::new();
    for root in all {
        let is_about = |other: &Root| related(root.subject.as_deref(), other.subject.as_deref());
        if !simplest
            .iter()
            .any(|other| other.spoils(root.clause, &root.compared) && is_about(other))
        {
            simplest.push(root);
        }
    }
    let has_earlier = |root: &Root| {
        let before = before(root.function);
        simplest.iter().any(|other| {
            let (one, other_subject) = (root.subject.as_deref(), other.subject.as_deref());
            other.explains_later(&root.compared)
                && before.contains(&other.function)
                && related(one, other_subject)
        })
    };
    let first: Vec<bool> = simplest.iter().map(|root| !has_earlier(root)).collect();
    let mut first = first.into_iter();
    simplest.retain(|_| first.next().unwrap_or_default());
    simplest
}

/// Whether a case judges replies of a device.
fn is_of_device(case: &Case) -> bool {
    matches!(case.subject, CaseSubject::Target | CaseSubject::CapturedCnc)
}

/// The broken checks of a device.
fn broken(outcomes: &[CaseOutcome]) -> impl Iterator<Item = (&Case, &Judgement)> {
    outcomes.iter().filter(|outcome| is_of_device(&outcome.case)).flat_map(|outcome| {
        let judged = outcome.verdicts.iter().flat_map(|one| &one.judgements);
        let broken = judged.filter(|one| is_broken(one.verdict));
        broken.map(|judgement| (&outcome.case, judgement))
    })
}

/// Number of chains that must fail for their service to be the cause: each service has functions of three.
const CHAINS_OF_SERVICE: usize = 3;

/// The clause of the service, if functions of all chains fail, all of them of this service, and its clause
/// fails too.
fn service_of(roots: &[Root], outcomes: &[CaseOutcome]) -> Option<&'static str> {
    let origins: HashSet<Function> = roots.iter().map(|root| origin(root.function)).collect();
    let service = roots.first()?.function.spec().service;
    let clause = match service {
        Service::Read => ADS_1.as_str(),
        Service::ReadWrite => ADS_3.as_str(),
        _ => return None,
    };
    let is_alone = roots.iter().all(|root| root.function.spec().service == service);
    let fails = broken(outcomes).any(|(_, one)| one.requirement == clause);
    (origins.len() >= CHAINS_OF_SERVICE && is_alone && fails).then_some(clause)
}

/// The clause of a request that several functions have, if it fails for several of them, and these.
fn request_of(roots: &[Root]) -> Option<(&'static str, Vec<Function>)> {
    let request = |root: &Root| root.function.spec().request;
    let by_clause =
        |root: &&Root| request(root).is_some_and(|stream| stream.layout().clause == root.clause);
    roots.iter().filter(by_clause).find_map(|root| {
        let alike = roots.iter().filter(by_clause).filter(|one| request(one) == request(root));
        let mut functions: Vec<Function> = alike.map(|other| other.function).collect();
        functions.sort_unstable();
        functions.dedup();
        (functions.len() > 1).then_some((root.clause, functions))
    })
}

/// The clause whose failure explains this one.
fn cause(
    case: &Case,
    judgement: &Judgement,
    Causes { roots, service, is_one_chain, request }: &Causes,
) -> Option<&'static str> {
    let clause = judgement.requirement;
    let is_of_frames = case.needs == Needs::Frames && !matches!(case.body, Body::Traffic);
    if is_of_frames {
        return None;
    }
    if is_one_of(clause, &SPECIFIC) {
        let is_of_others = |root: &&Root| {
            clause == SVC_1.as_str()
                && root.is_of_others
                && site(judgement).0 == Some(root.function)
        };
        return roots.iter().find(is_of_others).map(|root| root.clause);
    }
    let (function, subject) = site(judgement);
    if let Some(service) = *service {
        return (clause != service).then_some(service);
    }
    let explains = |root: &&Root| match &root.subject {
        // Failures that are not stored may be about others.
        Some(_) if judgement.more > 0 => false,
        one => related(one.as_deref(), subject),
    };
    let roots = || roots.iter().filter(explains);
    let Some(function) = function else {
        let is_before_home = |root: &&Root| {
            let mut homes = Function::ALL.iter().filter(|one| defines(clause, **one));
            homes.any(|home| before(*home).contains(&root.function))
        };
        return roots().find(is_before_home).map(|root| root.clause);
    };
    if let Some((shared, functions)) = request
        && functions.contains(&function)
        && defines(clause, function)
    {
        return (clause != *shared).then_some(*shared);
    }
    let earlier = before(function);
    let is_earlier = |root: &&Root| {
        if root.function != function && !root.explains_later(compared(judgement)) {
            return false;
        }
        if is_of_functions(clause) {
            if defines(clause, function) {
                return earlier.contains(&root.function);
            }
            let mut homes = earlier.iter().filter(|one| defines(clause, **one)).peekable();
            if homes.peek().is_some() {
                return homes.any(|home| before(*home).contains(&root.function));
            }
        }
        earlier.contains(&root.function) || root.function == function && is_one_of(clause, &GENERAL)
    };
    let same = check(&case.id, judgement);
    if roots().any(|root| root.check == same) {
        return None;
    }
    let spoils = |root: &&Root| {
        let compared = compared(judgement);
        let uses = root.function == function || compared.contains(&root.function);
        let is_any = judgement.verdict == Verdict::Vacuous
            || *is_one_chain && is_one_of(clause, &[ADS_1, ADS_3]);
        root.spoils(clause, compared) || uses && is_any
    };
    let found = roots().find(is_earlier).or_else(|| roots().find(spoils));
    found.map(|root| root.clause).filter(|found| *found != clause)
}

/// Makes a failed check inconclusive if it only follows from another failure: that of an earlier function, of
/// a service, of a shared request, or of another clause that the same check can fail for.
pub(crate) fn attribute(outcomes: &mut [CaseOutcome]) {
    let causes = Causes::of(outcomes);
    let broken: Vec<(&Case, &Judgement)> = broken(outcomes).collect();
    let mut found: Vec<Option<&'static str>> =
        broken.iter().map(|(case, judgement)| cause(case, judgement, &causes)).collect();
    let unexplained = broken.iter().zip(&found).filter(|(_, cause)| cause.is_none());
    let alone: Vec<&Judgement> =
        unexplained.map(|((_, one), _)| *one).filter(|one| shows_one_clause(one)).collect();
    for ((_, judgement), cause) in broken.iter().zip(&mut found) {
        *cause = cause.or_else(|| single_out(judgement, &alone));
    }
    let clauses: Vec<&'static str> = broken.iter().map(|(_, one)| one.requirement).collect();
    let mut settled = found.iter().map(|cause| cause.and_then(|one| settle(one, &clauses, &found)));
    let settled: Vec<Option<&'static str>> = settled.by_ref().collect();
    let mut settled = settled.into_iter();
    for outcome in outcomes.iter_mut().filter(|outcome| is_of_device(&outcome.case)) {
        for verdict in &mut outcome.verdicts {
            follow(verdict, || settled.next().flatten());
        }
    }
}

/// The clause that fails at the end of a chain of causes; `None` if none does, so that the check fails
/// itself.
fn settle(
    cause: &'static str,
    clauses: &[&'static str],
    causes: &[Option<&'static str>],
) -> Option<&'static str> {
    let mut seen = vec![cause];
    let mut open = vec![cause];
    while let Some(clause) = open.pop() {
        for (_, cause) in clauses.iter().zip(causes).filter(|(one, _)| **one == clause) {
            match cause {
                None => return Some(clause),
                Some(next) if !seen.contains(next) => {
                    seen.push(next);
                    open.push(next);
                }
                Some(_) => {}
            }
        }
    }
    None
}

/// Whether a check that failed shows that its clause is broken, and no other.
const fn shows_one_clause(judgement: &Judgement) -> bool {
    matches!(judgement.verdict, Verdict::Fail) && judgement.together.is_empty()
}

/// Of the clauses that a check can fail for, the one that another check of the same functions and subject
/// shows broken, if no check shows this clause broken.
fn single_out(judgement: &Judgement, alone: &[&Judgement]) -> Option<&'static str> {
    let clause = judgement.requirement;
    if alone.iter().any(|one| one.requirement == clause) || is_one_of(clause, &GENERAL) {
        return None;
    }
    let (function, subject) = site(judgement);
    let is_about_it = |one: &Judgement| {
        let (other, other_subject) = site(one);
        let is_same_function = other == function
            || other.is_some_and(|other| {
                compared(judgement).contains(&other)
                    || function.is_some_and(|function| follows(function, other))
            });
        // Failures that are not stored may be about others.
        let is_same_subject = one.more > 0
            || judgement.more == 0 && related(subject, other_subject)
            || other_subject.is_none();
        is_same_function && is_same_subject
    };
    let explains = |other: &&'static str| {
        can_explain(other, clause)
            && alone.iter().any(|one| one.requirement == *other && is_about_it(one))
    };
    judgement.together.iter().copied().find(explains)
}

/// Makes the broken checks inconclusive that have a cause.
fn follow(verdict: &mut RequirementVerdict, mut cause: impl FnMut() -> Option<&'static str>) {
    for judgement in verdict.judgements.iter_mut().filter(|one| is_broken(one.verdict)) {
        if let Some(clause) = cause() {
            judgement.verdict = Verdict::Inconclusive;
            judgement.follows = Some(clause);
        }
    }
    if is_broken(verdict.verdict)
        && let Some(gravest) = gravest(verdict.judgements.iter().map(|one| one.verdict))
    {
        verdict.verdict = gravest;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{CaseSubject, Evidence};

    /// A failed check: case, clause, function, subject.
    type Failed = (&'static str, ClauseId, Function, &'static str);

    fn attribute_one(outcomes: &mut [CaseOutcome]) -> Vec<Option<&'static str>> {
        attribute(outcomes);
        let verdicts = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        verdicts.map(|one| one.judgements[0].follows).collect()
    }

    fn outcome((case, clause, function, subject): Failed) -> CaseOutcome {
        let requirement = clause.as_str();
        let (function, subject) = (Some(function), Some(subject.to_owned()));
        let judgement = Judgement {
            requirement,
            level: None,
            verdict: Verdict::Fail,
            expected: case.to_owned(),
            found: String::new(),
            evidence: Some(Evidence { function, subject, ..Evidence::default() }),
            more: 0,
            together: Vec::new(),
            follows: None,
        };
        let case = Case {
            id: case.to_owned(),
            title: String::new(),
            subject: CaseSubject::Target,
            requirements: vec![requirement],
            needs: Needs::Queries,
            body: Body::Probe,
        };
        let (verdict, judgements) = (Verdict::Fail, vec![judgement]);
        let verdicts = vec![RequirementVerdict { requirement, verdict, judgements }];
        CaseOutcome { case, verdicts, checks: 1, note: None, refused: false, time: None }
    }

    /// Each verdict, and the clause that it follows from.
    fn attributed(failed: &[Failed]) -> Vec<(Verdict, Option<&'static str>)> {
        let mut outcomes: Vec<CaseOutcome> = failed.iter().copied().map(outcome).collect();
        attribute(&mut outcomes);
        let verdicts = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        verdicts.map(|one| (one.verdict, one.judgements[0].follows)).collect()
    }

    const FAILS: (Verdict, Option<&str>) = (Verdict::Fail, None);

    fn follows_from(clause: ClauseId) -> (Verdict, Option<&'static str>) {
        (Verdict::Inconclusive, Some(clause.as_str()))
    }

    #[test]
    fn no_function_is_before_itself() {
        for function in Function::ALL {
            assert!(!before(*function).contains(function), "{function:?}");
        }
    }

    #[test]
    fn a_value_follows_from_the_description_of_the_same_variable() {
        let sized = ("size", VAR_8, Function::DescribeByIndex, "V.E.a");
        let read = ("read", VAR_14, Function::ReadByHandle, "V.E.a");
        let other = ("read", VAR_14, Function::ReadByHandle, "V.E.b");
        assert_eq!(attributed(&[read, other]), [FAILS, FAILS]);
        assert_eq!(attributed(&[read, sized, other]), [follows_from(VAR_8), FAILS, FAILS]);
    }

    /// Failures that are not stored may be about other variables.
    #[test]
    fn unstored_failures_follow_from_unstored_ones_only() {
        let sized = ("size", VAR_8, Function::DescribeByIndex, "V.E.a");
        let read = ("read", VAR_14, Function::ReadByHandle, "V.E.a");
        for (described, read_more, follows) in
            [(0, 5, None), (5, 5, Some("VAR-8")), (5, 0, Some("VAR-8"))]
        {
            let mut outcomes = [outcome(sized), outcome(read)];
            outcomes[0].verdicts[0].judgements[0].more = described;
            outcomes[1].verdicts[0].judgements[0].more = read_more;
            assert_eq!(attribute_one(&mut outcomes), [None, follows], "{described} {read_more}");
        }
    }

    #[test]
    fn a_failure_of_the_target_explains_none_of_the_codec() {
        let sized = ("size", VAR_8, Function::DescribeByIndex, "V.E.a");
        let read = ("read", VAR_14, Function::ReadByHandle, "V.E.a");
        let mut outcomes = [outcome(sized), outcome(read), outcome(read)];
        outcomes[2].case.subject = CaseSubject::Codec;
        assert_eq!(attribute_one(&mut outcomes), [None, Some("VAR-8"), None]);
    }

    /// A clause of no function does not follow if its check is about no function.
    #[test]
    fn a_clause_without_a_function_does_not_follow() {
        let count = ("count", COM_1, Function::CountObjects, "");
        let mut outcomes = [outcome(count), outcome(("state", ADS_9, Function::CountObjects, ""))];
        outcomes[1].verdicts[0].judgements[0].evidence = None;
        assert_eq!(attribute_one(&mut outcomes), [None, None]);
    }

    #[test]
    fn a_general_clause_follows_from_one_of_the_function() {
        let count = ("count", COM_1, Function::CountObjects, "");
        let general = ("general", ADS_1, Function::CountObjects, "");
        let reversed = ("order", GEN_1, Function::CountObjects, "");
        assert_eq!(attributed(&[general, count, reversed]), [follows_from(COM_1), FAILS, FAILS]);
        assert_eq!(attributed(&[general, reversed]), [FAILS, FAILS]);
    }

    #[test]
    fn what_all_functions_of_a_service_fail_is_the_service() {
        let all = [
            ("com", COM_1, Function::CountObjects, ""),
            ("dyn", DYN_1, Function::CountDynamic, ""),
            ("sda", SDA_4, Function::CountElements, ""),
            ("ads", ADS_1, Function::CountDynamic, ""),
        ];
        let follows = follows_from(ADS_1);
        assert_eq!(attributed(&all), [follows, follows, follows, FAILS]);
        assert_eq!(attributed(&all[..3]), [FAILS, FAILS, FAILS]);
        // Two functions may be wrong by themselves.
        let two = [all[0], all[1], ("ads", ADS_1, Function::ReadObject, "")];
        assert_eq!(attributed(&two), [FAILS, FAILS, follows_from(COM_1)]);
    }

    #[test]
    fn what_several_functions_read_wrong_is_their_request() {
        let all = [
            ("one", VAR_4, Function::DescribeByIndex, ""),
            ("one", VAR_3, Function::DescribeByIndex, ""),
            ("other", VAR_15, Function::DescribeExtended, ""),
            ("other", VAR_3, Function::DescribeExtended, ""),
        ];
        let follows = follows_from(VAR_3);
        assert_eq!(attributed(&all), [follows, FAILS, follows, FAILS]);
        // The request of one function alone explains nothing of another.
        assert_eq!(attributed(&all[..3])[2], FAILS);
    }

    #[test]
    fn a_comparison_follows_from_the_simpler_check() {
        use Function::{ReadByHandle, ReadByName};
        let alone = outcome(("alone", VAR_14, ReadByName, "V.E.a"));
        let mut both = outcome(("both", VAR_11, ReadByHandle, "V.E.a"));
        let evidence = both.verdicts[0].judgements[0].evidence.as_mut().unwrap();
        evidence.compared = vec![ReadByHandle, ReadByName];
        assert_eq!(attribute_one(&mut [alone, both.clone()]), [None, Some("VAR-14")]);
        let other = outcome(("alone", VAR_14, ReadByName, "V.E.b"));
        assert_eq!(attribute_one(&mut [other, both.clone()]), [None, None]);
        assert_eq!(attribute_one(&mut [both]), [None]);
    }

    #[test]
    fn of_two_clauses_of_a_check_the_one_fails_that_another_check_shows() {
        let mut both = outcome(("both", SDA_12, Function::CountDynamic, ""));
        both.verdicts[0].judgements[0].together = vec![DYN_1.as_str()];
        let alone = |function| outcome(("alone", DYN_1, function, ""));
        let one = &mut [alone(Function::CountDynamic), both.clone()];
        assert_eq!(attribute_one(one), [None, Some("DYN-1")]);
        let one = &mut [alone(Function::CountObjects), both.clone()];
        assert_eq!(attribute_one(one), [None, None]);
        assert_eq!(attribute_one(&mut [both]), [None]);
    }

    /// An accepted request explains no failure of a later function.
    #[test]
    fn a_missing_rejection_explains_no_later_function() {
        let mut accepted = outcome(("far", VAR_2, Function::CountVariables, "V.E.a"));
        let described = outcome(("size", VAR_8, Function::DescribeByIndex, "V.E.a"));
        let wrong = [accepted.clone(), described.clone()];
        assert_eq!(attribute_one(&mut wrong.clone()), [None, Some("VAR-2")]);
        accepted.verdicts[0].judgements[0].evidence.as_mut().unwrap().is_rejection = true;
        assert_eq!(attribute_one(&mut [accepted, described]), [None, None]);
    }

    #[test]
    fn each_named_cause_fails() {
        use Function::*;
        let all = [
            ("a", VAR_1, CountVariables, ""),
            ("b", VAR_3, DescribeByIndex, ""),
            ("c", VAR_4, DescribeByIndex, "V.E.a"),
            ("d", VAR_3, DescribeExtended, ""),
            ("e", VAR_15, DescribeExtended, "V.E.a"),
            ("f", VAR_9, HandleByName, "V.E.b"),
            ("g", VAR_14, ReadByName, "V.E.a"),
            ("h", VAR_11, ReadByHandle, "V.E.a"),
            ("i", ADS_3, ReadByName, ""),
            ("j", SVC_1, ReadByName, "V.G.SERVICE.UUID"),
            ("k", COM_1, CountObjects, ""),
            ("l", ADS_1, CountObjects, ""),
        ];
        for chosen in 1_u32..1 << all.len() {
            let some = (0..all.len()).filter(|one| chosen & (1 << one) != 0);
            let mut outcomes: Vec<CaseOutcome> = some.map(|one| outcome(all[one])).collect();
            attribute(&mut outcomes);
            let verdicts = || outcomes.iter().flat_map(|one| &one.verdicts);
            let fails = |clause| {
                verdicts().any(|one| one.requirement == clause && one.verdict == Verdict::Fail)
            };
            for cause in verdicts().filter_map(|one| one.judgements[0].follows) {
                assert!(fails(cause), "{chosen:#b}: {cause}");
            }
            assert!(verdicts().any(|one| one.verdict == Verdict::Fail), "{chosen:#b}");
        }
    }
}
