//! CNCs with more objects and variables than a person would write into a model.

use std::net::SocketAddr;
use std::sync::Arc;

use ads_cnc_conformance::client::{Client, Target};
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::judge::{CaseOutcome, Selection, Verdict};
use ads_cnc_conformance::profile::Profile;
use ads_cnc_conformance::simulator::{Cnc, DEFAULT_MODEL, Model, NET_ID, Settings};
use ads_cnc_conformance::suite::{self, TargetState};

/// The default model with more variables in its first channel.
fn with_variables(count: usize) -> Cnc {
    let first = "variables = [\n";
    let (head, tail) = {
        let channel = DEFAULT_MODEL.find("[[channel]]").unwrap();
        let at = channel + DEFAULT_MODEL[channel..].find(first).unwrap() + first.len();
        DEFAULT_MODEL.split_at(at)
    };
    let more: String = (0..count)
        .map(|one| format!("  {{ name = \"V.E.more_{one}\", type = \"SGN32\", value = {one} }},\n"))
        .collect();
    let model = format!("{head}{more}{tail}");
    let model = Model::with_settings(&model, "the model", Settings::default()).unwrap();
    Cnc::new(model).with_stopped_clock()
}

fn connected(cnc: Cnc) -> TargetState {
    let target = Target::local(SocketAddr::from(([127, 0, 0, 1], 0)), NET_ID);
    let client = Client::in_process(target, Gate::queries(), Arc::new(cnc)).unwrap();
    TargetState::new(client, Profile::DEVICE)
}

fn outcomes(target: &mut TargetState, only: &[&str]) -> Vec<CaseOutcome> {
    let only = only.iter().map(|&word| word.to_owned()).collect();
    let plan = Selection { only, ..Selection::default() }.plan(suite::cases(), 1).unwrap();
    suite::run(plan.cases, Some(target), None, 1)
}

/// The index after the last is that after all variables, not after those that are read.
#[test]
fn more_variables_than_are_read() {
    let mut target = connected(with_variables(10_100));
    for outcome in outcomes(&mut target, &["var-extended-beyond-last"]) {
        assert_eq!(outcome.verdict(), Verdict::Pass, "{outcome:?}");
    }
}
