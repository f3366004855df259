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

use super::{
    Body, Case, CaseOutcome, CaseSubject, Judgement, Needs, RequirementVerdict, Verdict, gravest,
};

/// The functions whose answers the requests of `function`, or the expectations of its answer, are taken
/// from.
const fn sources(function: Function) -> &'static [Function] {
    use Function::*;
    match function {
        ReadDescriptors => &[CountObjects],
        ReadObject | WriteObject | WriteProgramStream => &[ReadDescriptors],
        DescribeByIndex | DescribeExtended => &[CountVariables],
        HandleByName | DescribeByName | ReadByName | WriteByName => &[DescribeByIndex],
        AxisHandleByName | AxisReadByName | AxisWriteByName => &[DescribeByIndex],
        ReadByHandle | WriteByHandle => &[DescribeByIndex, HandleByName],
        DynamicNameByIndex => &[CountDynamic],
        DynamicValueByName => &[DynamicNameByIndex],
        DynamicValueByIndex => &[CountDynamic, DynamicNameByIndex],
        CountElements => &[FindInstance],
        ReadElementName | ReadElementType | ReadElementLength => &[CountElements],
        ReadElementUnit | ReadElementWriteFlag => &[CountElements],
        ReadElement | WriteElement => &[CountElements, ReadElementLength, ReadElementType],
        _ => &[],
    }
}

/// All functions before `function` in a chain.
fn before(function: Function) -> HashSet<Function> {
    let mut all = HashSet::new();
    let mut open = vec![function];
    while let Some(next) = open.pop() {
        open.extend(sources(next).iter().filter(|source| all.insert(**source)));
    }
    all
}

/// Whether the requests or expectations of `function` depend on the answers of `earlier`.
pub(crate) fn follows(function: Function, earlier: Function) -> bool {
    before(function).contains(&earlier)
}

/// The function that a chain begins with.
fn origin(function: Function) -> Function {
    let mut first = function;
    while let [source, ..] = sources(first) {
        first = *source;
    }
    first
}

/// Clauses whose checks look for one error only, such as reversed bytes. No error of another clause looks
/// like it, so they always fail.
const SPECIFIC: [ClauseId; 7] = [GEN_1, GEN_2, GEN_3, ADR_6, ADS_2, ADS_5, SVC_1];

/// Clauses of every function: an error of the function itself looks like an error of these.
const GENERAL: [ClauseId; 5] = [ADS_1, ADS_3, GEN_5, GEN_6, OBJ_1];

fn is_one_of(clause: &str, list: &[ClauseId]) -> bool {
    list.iter().any(|one| one.as_str() == clause)
}

/// Whether the clause defines the function, or a field of its request or reply.
fn defines(clause: &str, function: Function) -> bool {
    let spec = function.spec();
    let streams = [spec.request, spec.reply].into_iter().flatten();
    spec.clause == clause
        || streams.into_iter().any(|stream| {
            let mut fields = stream.fields().filter_map(|field| field.spec());
            stream.layout().clause == clause || fields.any(|field| field.clause == clause)
        })
}

/// Whether only functions have the clause, so that a failure of it shows a function broken.
fn is_of_functions(clause: &str) -> bool {
    let area = clause.split_once('-').map_or(clause, |(area, _)| area);
    !matches!(area, "GEN" | "ADR" | "ADS" | "OBJ")
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
    check: (String, String, String),
}

/// What explains the failures of a run.
struct Causes {
    roots: Vec<Root>,
    /// The clause of the service that all of them use.
    service: Option<&'static str>,
    /// The clause of the request that several of them use, and these.
    request: Option<(&'static str, Vec<Function>)>,
}

fn site(judgement: &Judgement) -> (Option<Function>, Option<&str>) {
    let evidence = judgement.evidence.as_ref();
    let subject = evidence.and_then(|evidence| evidence.subject.as_deref());
    (evidence.and_then(|evidence| evidence.function), subject)
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
    for (case, judgement) in judgements(outcomes).filter(|(_, one)| is_broken(one.verdict)) {
        let (Some(function), subject) = site(judgement) else { continue };
        let clause = judgement.requirement;
        if is_of_functions(clause) && defines(clause, function) {
            // The failures that are not stored are about others.
            let subject = subject.filter(|_| judgement.more == 0).map(str::to_owned);
            let check = check(case, judgement);
            all.push(Root { function, clause, subject, check });
        }
    }
    let has_earlier = |root: &Root| {
        let before = before(root.function);
        all.iter().any(|other| {
            let (one, other_subject) = (root.subject.as_deref(), other.subject.as_deref());
            before.contains(&other.function) && related(one, other_subject)
        })
    };
    let first: Vec<bool> = all.iter().map(|root| !has_earlier(root)).collect();
    let mut first = first.into_iter();
    all.retain(|_| first.next().unwrap_or_default());
    all
}

/// Whether a case judges replies of a device.
fn is_of_device(case: &Case) -> bool {
    matches!(case.subject, CaseSubject::Target | CaseSubject::CapturedCnc)
}

fn judgements(outcomes: &[CaseOutcome]) -> impl Iterator<Item = (&str, &Judgement)> {
    outcomes.iter().filter(|outcome| is_of_device(&outcome.case)).flat_map(|outcome| {
        let judged = outcome.verdicts.iter().flat_map(|one| &one.judgements);
        judged.map(|judgement| (outcome.case.id.as_str(), judgement))
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
    let fails =
        judgements(outcomes).any(|(_, one)| one.requirement == clause && is_broken(one.verdict));
    (origins.len() >= CHAINS_OF_SERVICE && is_alone && fails).then_some(clause)
}

/// The clause of a request that several functions have, if it and all of several of them fail.
fn request_of(roots: &[Root]) -> Option<(&'static str, Vec<Function>)> {
    let request = |root: &Root| root.function.spec().request;
    let by_clause =
        |root: &&Root| request(root).is_some_and(|stream| stream.layout().clause == root.clause);
    roots.iter().filter(by_clause).find_map(|root| {
        let alike = roots.iter().filter(|other| request(other) == request(root));
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
    Causes { roots, service, request }: &Causes,
) -> Option<&'static str> {
    let clause = judgement.requirement;
    let is_of_frames = case.needs == Needs::Frames && !matches!(case.body, Body::Traffic);
    if !is_of_device(case) || is_of_frames || is_one_of(clause, &SPECIFIC) {
        return None;
    }
    if let Some(service) = *service {
        return (clause != service).then_some(service);
    }
    let (function, subject) = site(judgement);
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
    roots().find(is_earlier).map(|root| root.clause)
}

/// Makes failed checks inconclusive that follow from the failure of an earlier function.
pub(crate) fn attribute(outcomes: &mut [CaseOutcome]) {
    let roots = roots(outcomes);
    if roots.is_empty() {
        return;
    }
    let (service, request) = (service_of(&roots, outcomes), request_of(&roots));
    let causes = Causes { roots, service, request };
    for outcome in outcomes {
        for verdict in &mut outcome.verdicts {
            follow(&outcome.case, verdict, &causes);
        }
    }
}

fn follow(case: &Case, verdict: &mut RequirementVerdict, causes: &Causes) {
    for judgement in &mut verdict.judgements {
        if !is_broken(judgement.verdict) {
            continue;
        }
        if let Some(clause) = cause(case, judgement, causes)
            && clause != judgement.requirement
        {
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
        ];
        assert_eq!(attributed(&all), [follows_from(VAR_3), FAILS, follows_from(VAR_3)]);
    }
}
