//! Tests that the checks of the simulated CNC and the golden sequences detect the defects that no
//! case of the suite detects.

use std::collections::BTreeSet;
use std::thread;

use ads_cnc_conformance::faults::{self, DefectKind, SeededDefect};
use ads_cnc_conformance::matrix::SIMULATOR_CHECKS;
use ads_cnc_conformance::selftest::UNSEEN;

use crate::checks::SimulatorCheck;
use crate::player::play;
use crate::sequences::with_steps;
use crate::target::TestCnc;
use crate::{changes, contents, device, services, streams, variables};

/// All checks.
fn checks() -> impl Iterator<Item = &'static SimulatorCheck> {
    let all = [
        changes::CHECKS,
        contents::CHECKS,
        device::CHECKS,
        services::CHECKS,
        streams::CHECKS,
        variables::CHECKS,
    ];
    all.into_iter().flatten()
}

/// The checks and sequences of these requirements that fail for a CNC with this defect or variant; if
/// `requirements` is empty, of all requirements.
fn failing(defect: &SeededDefect, requirements: &[&str]) -> Vec<String> {
    let wanted = |id: &str| requirements.is_empty() || requirements.contains(&id);
    let fails = |failed: crate::target::CheckResult, name: &str| {
        failed.err().map(|why| format!("{name}: {why:?}"))
    };
    let checks = checks().filter(|one| one.clauses().iter().any(|id| wanted(id.as_str())));
    let checks = checks.filter_map(|one| fails((one.run)(&TestCnc::new(Some(defect))), one.name));
    let sequences = with_steps().filter(|one| one.cited().iter().any(|one| wanted(&one.id)));
    let sequences =
        sequences.filter_map(|one| fails(play(&TestCnc::new(Some(defect)), one), &one.id));
    checks.chain(sequences).collect()
}

/// The matrix of requirements lists all checks.
#[test]
fn the_matrix_lists_every_check() {
    let names: BTreeSet<&str> = checks().map(|one| one.name).collect();
    let listed: BTreeSet<&str> = SIMULATOR_CHECKS.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, listed);
}

/// With each defect in `UNSEEN`, a check or sequence of a requirement that the defect breaks fails.
#[test]
fn defects_that_no_case_detects_are_detected() {
    let is_missed = |id: &&&str| {
        let defect = faults::by_id(id).expect("a defect");
        failing(defect, &defect.requirements).is_empty()
    };
    let missed: Vec<&&str> = UNSEEN.iter().filter(is_missed).collect();
    assert!(missed.is_empty(), "not found: {missed:?}");
}

/// Valid variants with which sequences, or checks other than `OF_THIS_CNC`, fail: they have another
/// model, or another permitted behaviour than the checks expect.
const OTHERWISE: [&str; 15] = [
    "different.axes-move",
    "different.axis-handles",
    "different.blank-real",
    "different.come-and-go",
    "different.device-silent-of-itself",
    "different.error-numbers",
    "different.error-one",
    "different.extended-external-only",
    "different.model",
    "different.model-bare",
    "different.model-channel-3",
    "different.model-many",
    "different.model-numbers",
    "different.path-preparation-without-axes",
    "different.request-over-early",
];

/// A check that compares the replies to many queries with those of the simulated CNC without a
/// defect. A valid variant may reply differently.
const OF_THIS_CNC: &str = "each_query_has_its_own_answer";

#[test]
fn valid_variants_pass() {
    let variants = faults::all().iter().filter(|defect| defect.kind == DefectKind::Different);
    let variants: Vec<&SeededDefect> = variants.collect();
    let is_failing = |defect: &&&SeededDefect| {
        let failing = failing(defect, &[]);
        failing.iter().any(|one| !one.contains(OF_THIS_CNC))
    };
    let failing_of = |part: &[&'static SeededDefect]| -> Vec<&str> {
        part.iter().filter(is_failing).map(|defect| defect.id.as_str()).collect()
    };
    let failing: BTreeSet<&str> = thread::scope(|scope| {
        let parts = variants.chunks(variants.len().div_ceil(4));
        let parts: Vec<_> = parts.map(|part| scope.spawn(move || failing_of(part))).collect();
        parts.into_iter().flat_map(|part| part.join().unwrap()).collect()
    });
    assert_eq!(failing, BTreeSet::from(OTHERWISE));
}
