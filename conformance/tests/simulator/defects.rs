//! Defects that the checks and the golden sequences find.

use ads_cnc_conformance::faults::{self, Seed};

use crate::checks::SimulatorCheck;
use crate::player::play;
use crate::sequences::with_steps;
use crate::target::Target;
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

/// The checks and sequences that a CNC with this seed fails, of those with one of these requirements;
/// of all without any.
fn failing(seed: &Seed, requirements: &[&str]) -> Vec<String> {
    let wanted = |id: &str| requirements.is_empty() || requirements.contains(&id);
    let fails = |failed: crate::target::Check, name: &str| {
        failed.err().map(|why| format!("{name}: {why:?}"))
    };
    let checks = checks().filter(|one| one.clauses.iter().any(|id| wanted(id.as_str())));
    let checks = checks.filter_map(|one| fails((one.run)(&Target::new(Some(seed))), one.name));
    let sequences = with_steps().filter(|one| one.cited().iter().any(|one| wanted(&one.id)));
    let sequences = sequences.filter_map(|one| fails(play(&Target::new(Some(seed)), one), &one.id));
    checks.chain(sequences).collect()
}

#[test]
#[ignore]
fn explore() {
    for seed in faults::all().iter().filter(|seed| seed.is_for_cnc()) {
        let failing = failing(seed, &seed.requirements);
        println!("{}\t{}\t{}", seed.id, failing.len(), failing.first().map_or("", |one| one));
    }
}
