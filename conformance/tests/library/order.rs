//! With the simulated CNC, the order of the cases does not affect the verdicts; some orders are
//! tried.

use std::collections::BTreeMap;
use std::sync::Arc;

use ads_cnc_conformance::judge::{Selection, Verdict};
use ads_cnc_conformance::session::Session;
use ads_cnc_conformance::simulator::{Cnc, Model};
use ads_cnc_conformance::suite::{self, TargetState};

type Verdicts = BTreeMap<String, Vec<(&'static str, Verdict)>>;

/// The IDs of all cases in the order of a seed, and the verdicts of each case.
fn run(seed: u32) -> (Vec<String>, Verdicts) {
    let cnc = Cnc::with_default_model().unwrap().with_stopped_clock();
    let (client, _) = Session::in_process_to_try(Arc::new(cnc)).unwrap().into_parts();
    let mut target = TargetState::new(client, Model::default_model().unwrap().profile());
    let plan = Selection::default().plan(suite::cases(), seed).unwrap();
    let outcomes = suite::run(plan.cases, Some(&mut target), None, seed);
    let ids = outcomes.iter().map(|outcome| outcome.case.id.clone()).collect();
    let verdicts = outcomes.into_iter().map(|outcome| {
        let verdicts = outcome.verdicts.iter().map(|one| (one.requirement, one.verdict));
        (outcome.case.id, verdicts.collect())
    });
    (ids, verdicts.collect())
}

#[test]
fn any_order_gives_the_same_verdicts() {
    let (first, verdicts) = run(1);
    for seed in [2, 3, u32::MAX] {
        let (ids, others) = run(seed);
        assert_ne!(first, ids);
        assert_eq!(verdicts, others, "seed {seed}");
    }
}
