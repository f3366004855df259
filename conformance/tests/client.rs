//! Clients under test: this project's own passes everything, and each of its defects is seen by the
//! requirement it is about.

use std::net::SocketAddr;
use std::thread;

use ads_cnc_conformance::clients::{
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
    let judged = raises_nothing(None);
    assert!(judged.requests > 200, "{}", judged.requests);
}

/// What is done otherwise, and is as right.
#[test]
fn habits_raise_nothing() {
    thread::scope(|scope| {
        for variant in variants() {
            scope.spawn(|| raises_nothing(Some(variant.fault)));
        }
    });
}

fn raises_nothing(fault: Option<ClientFault>) -> JudgedClient {
    let judged = judge(&mut ReferenceClient { fault }, &stage(), &scenarios());
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
fn every_defect_is_seen_by_its_requirement() {
    // Most of the time is waiting.
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

/// The requirement that it breaks, or breaks a part of.
fn whole(defect: &ClientDefect) -> &'static str {
    clause(defect.requirement).map_or(defect.requirement, |clause| &clause.requirement.id)
}

fn id(defect: &ClientDefect) -> &'static str {
    defect.id
}

/// Every defect is about a requirement that a scenario judges, and is found by its ID.
#[test]
fn defects_are_about_something() {
    for defect in defects() {
        assert_eq!(find_defect(defect.id), Some(defect));
        let judges = |one: &Scenario| one.case().requirements.contains(&whole(defect));
        assert!(defect.requirement == CLIENT || scenarios().iter().any(judges), "{}", defect.id);
    }
}

/// A scenario is called one thing, tells a client something, and is about what it claims.
#[test]
fn scenarios_are_told_apart() {
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

/// The description for those who write glue has every word as it is.
#[test]
fn the_vocabulary_is_written_down() {
    let text = include_str!("../adapters/CLIENTS.md");
    for word in VOCABULARY {
        let row = format!("| `{}` | {} | {} |", word.name, word.arguments.join(" "), word.gives);
        assert!(text.contains(&row), "{row}");
    }
    let rows = text.lines().filter(|line| line.starts_with("| `") && line.contains("CHANNEL"));
    assert_eq!(rows.count(), VOCABULARY.len());
}
