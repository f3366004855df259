//! Attributes failed checks to their cause: the check of the violated clause fails, and a check
//! that fails only as a consequence becomes inconclusive.
//!
//! For example, a wrong size in a description makes every comparison with that size fail. The first
//! failing function of a chain (`chain.rs`) shows which clause is violated. Therefore, if a check
//! of an earlier function fails for a variable or object, a failed check of a later function for it
//! usually does not make its own clause fail.

use std::collections::HashSet;

use ads_cnc::operation::{AdsService, Function};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::chain::{before, can_explain, defines, follows, is_of_functions, origin};
use super::root::{FailedCheck, Root, checks, is_broken, is_deviation, is_of_device, roots};
use super::{Body, CaseOutcome, Needs, RequirementVerdict, Verdict, most_severe};

/// Clauses whose checks detect one specific error, such as reversed bytes. A violation of another
/// clause is not considered the cause of this error: [`cause`] returns `None` for a failed check of
/// these clauses.
const SPECIFIC: [ClauseId; 7] = [GEN_1, GEN_2, GEN_3, ADR_6, ADS_2, ADS_5, ADS_7];

/// Clauses that apply to many functions: an error of one function can also make a check of these
/// clauses fail.
const GENERAL: [ClauseId; 5] = [ADS_1, ADS_3, GEN_5, GEN_6, OBJ_1];

fn is_one_of(clause: &str, list: &[ClauseId]) -> bool {
    list.iter().any(|one| one.as_str() == clause)
}

/// The possible causes of the failed checks of a run.
struct Causes<'a> {
    roots: Vec<Root<'a>>,
    /// The clause of the service that the functions of all roots use, if the service is the cause.
    service: Option<&'static str>,
    /// Whether the functions of all roots belong to one chain.
    is_one_chain: bool,
    /// The clause of a request stream that fails for several functions, and these functions.
    request: Option<(&'static str, Vec<Function>)>,
}

impl<'a> Causes<'a> {
    fn of(failed_checks: &[FailedCheck<'a>]) -> Self {
        let roots = roots(failed_checks);
        let (service, request) = (service_of(&roots, failed_checks), request_of(&roots));
        let chains: HashSet<Function> = roots.iter().map(|root| origin(root.function)).collect();
        Self { roots, service, is_one_chain: chains.len() == 1, request }
    }
}

/// Number of chains that must fail before their service is considered the cause: functions of three
/// chains use each service.
const CHAINS_OF_SERVICE: usize = 3;

/// The clause of the service, if the functions of the roots belong to at least `CHAINS_OF_SERVICE`
/// chains, all these functions use this service, and a check of the clause fails too. `None` for
/// the service Write.
fn service_of(roots: &[Root<'_>], failed_checks: &[FailedCheck<'_>]) -> Option<&'static str> {
    let origins: HashSet<Function> = roots.iter().map(|root| origin(root.function)).collect();
    let service = roots.first()?.function.spec().service;
    let clause = match service {
        AdsService::Read => ADS_1.as_str(),
        AdsService::ReadWrite => ADS_3.as_str(),
        _ => return None,
    };
    let is_alone = roots.iter().all(|root| root.function.spec().service == service);
    let fails = failed_checks.iter().any(|one| one.clause() == clause);
    (origins.len() >= CHAINS_OF_SERVICE && is_alone && fails).then_some(clause)
}

/// The clause of a request stream that several functions share, if it fails for more than one of
/// them, and the functions for which it fails.
fn request_of(roots: &[Root<'_>]) -> Option<(&'static str, Vec<Function>)> {
    let request = |root: &Root<'_>| root.function.spec().request;
    let by_clause = |root: &&Root<'_>| {
        request(root).is_some_and(|stream| stream.layout().clause == root.check.clause())
    };
    roots.iter().filter(by_clause).find_map(|root| {
        let alike = roots.iter().filter(by_clause).filter(|one| request(one) == request(root));
        let mut functions: Vec<Function> = alike.map(|other| other.function).collect();
        functions.sort_unstable();
        functions.dedup();
        (functions.len() > 1).then_some((root.check.clause(), functions))
    })
}

/// The clause whose failure explains the failure of `check`; `None` if no such clause is found.
fn cause(
    check: FailedCheck<'_>,
    Causes { roots, service, is_one_chain, request }: &Causes<'_>,
) -> Option<&'static str> {
    let (clause, function) = (check.clause(), check.function());
    if check.case.needs == Needs::Frames && !matches!(check.case.body, Body::Traffic) {
        return None;
    }
    if clause == SVC_1.as_str() {
        // If a check of the same function fails several times, and its stored failure is about a
        // variable outside the Service Interface, the function is the cause.
        let is_of_all =
            |root: &&Root<'_>| root.is_not_of_services() && function == Some(root.function);
        return roots.iter().find(is_of_all).map(|root| root.check.clause());
    }
    if is_one_of(clause, &SPECIFIC) {
        return None;
    }
    if let Some(service) = *service {
        return (clause != service).then_some(service);
    }
    let roots = || roots.iter().filter(|root| root.check.is_about_all_of(check));
    let Some(function) = function else {
        let is_before_home = |root: &&Root<'_>| {
            let mut homes = Function::ALL.iter().filter(|one| defines(clause, **one));
            homes.any(|home| follows(*home, root.function))
        };
        return roots().find(is_before_home).map(|root| root.check.clause());
    };
    if let Some((shared, functions)) = request
        && functions.contains(&function)
        && defines(clause, function)
    {
        return (clause != *shared).then_some(*shared);
    }
    if roots().any(|root| root.check.is_same_as(check)) {
        return None;
    }
    let earlier = before(function);
    let is_earlier = |root: &&Root<'_>| {
        if root.function != function && !root.explains_later(check) {
            return false;
        }
        if is_of_functions(clause) {
            if defines(clause, function) {
                return earlier.contains(&root.function);
            }
            let mut homes = earlier.iter().filter(|one| defines(clause, **one)).peekable();
            if homes.peek().is_some() {
                return homes.any(|home| follows(*home, root.function));
            }
        }
        earlier.contains(&root.function) || root.function == function && is_one_of(clause, &GENERAL)
    };
    let is_compared = |root: &&Root<'_>| {
        let uses = root.function == function || check.compared().contains(&root.function);
        let is_any = check.judgement.verdict == Verdict::Vacuous
            || *is_one_chain && is_one_of(clause, &[ADS_1, ADS_3]);
        root.explains_comparison(check) || uses && is_any
    };
    let found = roots().find(is_earlier).or_else(|| roots().find(is_compared));
    found.map(|root| root.check.clause()).filter(|found| *found != clause)
}

/// Finds the violated clause if `check` judges several clauses at once: another of these clauses
/// that can explain the failure (`can_explain`) and of which `alone` contains a suitable check. The
/// subject of that check must permit this (`is_about_all_of`), and its function must be that of
/// `check`, one with which `check` compares, or an earlier one. `None` if `alone` contains a check
/// of the clause of `check`, or if that clause is in [`GENERAL`]. The checks in `alone` have the
/// verdict `Fail` and no cause, and judge no other clause with this verdict.
fn single_out(check: FailedCheck<'_>, alone: &[FailedCheck<'_>]) -> Option<&'static str> {
    let clause = check.clause();
    if alone.iter().any(|one| one.clause() == clause) || is_one_of(clause, &GENERAL) {
        return None;
    }
    let is_of_same_function = |other: Option<Function>| {
        other == check.function()
            || other.is_some_and(|other| {
                check.compared().contains(&other)
                    || check.function().is_some_and(|function| follows(function, other))
            })
    };
    let explains = |other: &&'static str| {
        can_explain(other, clause)
            && alone.iter().any(|one| {
                one.clause() == *other
                    && is_of_same_function(one.function())
                    && one.is_about_all_of(check)
            })
    };
    check.judgement.together.iter().copied().find(explains)
}

/// Follows the causes from `cause` to a clause with a failed check that has no cause. `None`
/// without such a clause: then the check has failed by itself.
fn settle(
    cause: &'static str,
    clauses: &[&'static str],
    causes: &[Option<&'static str>],
) -> Option<&'static str> {
    let mut visited = vec![cause];
    let mut pending = vec![cause];
    while let Some(clause) = pending.pop() {
        for (_, cause) in clauses.iter().zip(causes).filter(|(one, _)| **one == clause) {
            match cause {
                None => return Some(clause),
                Some(next) if !visited.contains(next) => {
                    visited.push(next);
                    pending.push(next);
                }
                Some(_) => {}
            }
        }
    }
    None
}

/// Makes a failed check inconclusive if it only follows from another failure: for example, of an
/// earlier function, a service, a shared request, a simpler comparison, or another clause that the
/// same check judges. A warning or a difference that follows from a failure keeps its verdict.
/// Checks of a codec, a testee or a client are not changed.
pub(crate) fn attribute(outcomes: &mut [CaseOutcome]) {
    let failed_checks: Vec<FailedCheck<'_>> = checks(outcomes, is_broken).collect();
    let causes = Causes::of(&failed_checks);
    let mut found: Vec<Option<&'static str>> =
        failed_checks.iter().map(|check| cause(*check, &causes)).collect();
    let is_alone = |check: &FailedCheck<'_>| {
        check.judgement.verdict == Verdict::Fail && check.judgement.together.is_empty()
    };
    let unexplained = failed_checks.iter().zip(&found).filter(|(_, cause)| cause.is_none());
    let alone: Vec<FailedCheck<'_>> =
        unexplained.map(|(check, _)| *check).filter(|check| is_alone(check)).collect();
    for (check, cause) in failed_checks.iter().zip(&mut found) {
        *cause = cause.or_else(|| single_out(*check, &alone));
    }
    let clauses: Vec<&'static str> = failed_checks.iter().map(|check| check.clause()).collect();
    let settled = |cause: Option<&'static str>| settle(cause?, &clauses, &found);
    let deviations = checks(outcomes, is_deviation).map(|check| settled(cause(check, &causes)));
    let deviations: Vec<Option<&'static str>> = deviations.collect();
    let failed_checks: Vec<Option<&'static str>> =
        found.iter().map(|cause| settled(*cause)).collect();
    let (mut failed_checks, mut deviations) = (failed_checks.into_iter(), deviations.into_iter());
    for outcome in outcomes.iter_mut().filter(|outcome| is_of_device(&outcome.case)) {
        for verdict in &mut outcome.verdicts {
            follow(verdict, |one| {
                if is_broken(one) {
                    failed_checks.next()?
                } else if is_deviation(one) {
                    deviations.next()?
                } else {
                    None
                }
            });
        }
    }
}

/// Stores the cause in each check that has a cause, and changes the verdict of the check to
/// [`Verdict::as_following`].
fn follow(
    verdict: &mut RequirementVerdict,
    mut cause: impl FnMut(Verdict) -> Option<&'static str>,
) {
    for judgement in &mut verdict.judgements {
        if let Some(clause) = cause(judgement.verdict) {
            judgement.verdict = judgement.verdict.as_following();
            judgement.follows = Some(clause);
        }
    }
    if is_broken(verdict.verdict)
        && let Some(most_severe) = most_severe(verdict.judgements.iter().map(|one| one.verdict))
    {
        verdict.verdict = most_severe;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::Evidence;
    use crate::judge::{Case, CaseSubject, Judgement};

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
        CaseOutcome { case, verdicts, checks: 1, note: None, rejected: false, time: None }
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

    /// A warning or a difference can follow from a failure, but no other check follows from a
    /// warning or a difference.
    #[test]
    fn a_warning_follows_from_a_failure_and_causes_none() {
        let sized = ("size", VAR_8, Function::DescribeByIndex, "V.E.a");
        let read = ("read", VAR_14, Function::ReadByHandle, "V.E.a");
        for deviation in [Verdict::Warning, Verdict::Differs] {
            for (place, causes) in [(1, [None, Some("VAR-8")]), (0, [None, None])] {
                let mut outcomes = [outcome(sized), outcome(read)];
                let verdict = &mut outcomes[place].verdicts[0];
                (verdict.verdict, verdict.judgements[0].verdict) = (deviation, deviation);
                assert_eq!(attribute_one(&mut outcomes), causes);
                assert_eq!(outcomes[place].verdicts[0].verdict, deviation);
            }
        }
    }

    /// A check without a function, for a clause that defines no function, does not follow from the
    /// failure of one function.
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
        // Functions of only two chains fail, so each function may be wrong by itself.
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
        // If the clause of the request fails for one function only, it does not explain the failure
        // of the other function with this request.
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

    /// A request that was accepted although it must be rejected explains no failure of a later
    /// function.
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
