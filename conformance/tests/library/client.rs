//! Clients under test: this project's own client passes all scenarios, and each of its seeded
//! defects is judged as a violation of the requirement that the defect breaks.

use std::net::SocketAddr;
use std::thread;

use ads_cnc_conformance::client_suite::{
    ClientDefect, ClientFault, JudgedClient, ReferenceClient, Scenario, TestServer, VOCABULARY,
    defects, find_defect, judge, scenarios, trial, variants,
};
use ads_cnc_conformance::judge::{CLIENT, Verdict};
use ads_cnc_vectors::{Level, clause, requirement};

fn stage() -> TestServer {
    TestServer::new(SocketAddr::from(([127, 0, 0, 1], 0))).unwrap()
}

#[test]
fn the_own_client_passes_everything() {
    let judged = judge_without_findings(None);
    assert!(judged.requests > 200, "{}", judged.requests);
}

/// With each valid variant of the client, every requirement passes.
#[test]
fn valid_variants_pass() {
    thread::scope(|scope| {
        for variant in variants() {
            scope.spawn(|| judge_without_findings(Some(variant.fault)));
        }
    });
}

fn judge_without_findings(fault: Option<ClientFault>) -> JudgedClient {
    let judged = judge(&mut ReferenceClient { fault }, &stage(), &scenarios(), None);
    let mut raised = Vec::new();
    for outcome in &judged.outcomes {
        for one in outcome.verdicts.iter().filter(|one| one.verdict != Verdict::Pass) {
            let said = one.judgements.first().map(|one| (&one.expected, &one.found));
            let (id, requirement) = (&outcome.case.id, one.requirement);
            raised.push(format!("{id} {requirement} {}: {said:?} {:?}", one.verdict, outcome.note));
        }
    }
    assert!(raised.is_empty(), "{fault:?}\n{}", raised.join("\n"));
    judged
}

#[test]
fn every_defect_fails_its_requirement() {
    // Uses threads to save time.
    let missed: Vec<&str> = thread::scope(|scope| {
        let part = |part| {
            move || defects().iter().skip(part).step_by(PARTS).filter(missed).map(id).collect()
        };
        let parts: Vec<_> = (0..PARTS).map(|one| scope.spawn::<_, Vec<&str>>(part(one))).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    });
    assert!(missed.is_empty(), "{} of {}: {missed:?}", missed.len(), defects().len());
}

const PARTS: usize = 8;

fn missed(defect: &&ClientDefect) -> bool {
    let outcomes = trial(defect, &stage());
    let mut verdicts = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
    let level = clause(defect.requirement).map_or(Level::Must, |clause| clause.level());
    let expected = Verdict::missed(level);
    let told = |verdict| verdict == Verdict::Fail || verdict == expected;
    !verdicts.any(|one| one.requirement == whole(defect) && told(one.verdict))
}

/// The ID of the requirement that the defect breaks, without the part of the requirement.
fn whole(defect: &ClientDefect) -> &'static str {
    clause(defect.requirement).map_or(defect.requirement, |clause| &clause.requirement.id)
}

fn id(defect: &ClientDefect) -> &'static str {
    defect.id
}

/// Every defect breaks a requirement that a scenario judges, and `find_defect` finds it by its ID.
#[test]
fn every_defect_breaks_a_judged_requirement() {
    for defect in defects() {
        assert_eq!(find_defect(defect.id), Some(defect));
        let judges = |one: &Scenario| one.case().requirements.contains(&whole(defect));
        assert!(defect.requirement == CLIENT || scenarios().iter().any(judges), "{}", defect.id);
    }
}

/// Each scenario has a unique ID, and the requirements that it names exist.
#[test]
fn scenarios_are_distinct() {
    let all = scenarios();
    let mut ids: Vec<&str> = all.iter().map(|one| one.id.as_str()).collect();
    ids.sort_unstable();
    let before = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), before);
    for one in &all {
        for id in one.case().requirements {
            assert!(id == CLIENT || requirement(id).is_some(), "{} {id}", one.id);
        }
    }
}

/// The description of the client protocol for authors of adapters contains every action.
#[test]
fn the_vocabulary_is_documented() {
    let text = include_str!("../../adapters/CLIENTS.md");
    for word in VOCABULARY {
        let row = format!("| `{}` | {} | {} |", word.name, word.arguments.join(" "), word.gives);
        assert!(text.contains(&row), "{row}");
    }
    let rows = text.lines().filter(|line| line.starts_with("| `") && line.contains("CHANNEL"));
    assert_eq!(rows.count(), VOCABULARY.len());
}
