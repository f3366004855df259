//! The queries with which a run without a profile discovers what a CNC has, and the cases that judge
//! what was found.

use ads_cnc_conformance::faults::{self, DefectKind, Faulty, SeededDefect};
use ads_cnc_conformance::judge::Verdict;
use ads_cnc_conformance::simulator::Cnc;
use ads_cnc_conformance::suite::{Discovery, Sample, TargetState};

use super::large::{connected, outcomes};

/// The default model, discovered like a device.
fn discovered(defect: Option<&SeededDefect>) -> (TargetState, Discovery) {
    let cnc = Cnc::with_default_model().unwrap().with_stopped_clock();
    connected(Faulty::new(cnc, defect), Sample::BySeed(1))
}

#[test]
fn the_default_model_is_found_without_a_profile() {
    let (target, Discovery { found, .. }) = discovered(None);
    assert_eq!(found.ports, [551, 552, 553]);
    let channels: Vec<_> = found.channels.iter().map(|one| (one.number, one.axes)).collect();
    assert_eq!(channels, [(1, 3), (2, 3), (6, 3)]);
    assert_eq!((found.platform_axes, found.spindles), (5, 2));
    assert_eq!(target.profile.channels[..], [1, 2, 6]);
    assert_eq!(target.profile.absent_channel, Some(3));
    let items = |name: &str| found.lists.iter().find(|list| list.name == name).unwrap().items;
    assert_eq!((items("COM platform"), items("COM channel 6")), (2, 12));
    assert_eq!((items("V.E channel 2"), items("decoder channel 1")), (2, 6));
    assert!(found.requests < 400, "{}", found.requests);
    assert_eq!(found.sampled(), None);
}

/// A port that discovery did not find is claimed nevertheless, so its case fails.
#[test]
fn a_missing_port_fails() {
    let (mut target, _) = discovered(faults::by_id("cnc.gen.geo-missing"));
    assert_eq!(target.profile.ports[..], [551, 552, 553]);
    let outcomes = outcomes(&mut target, &[]);
    let ports = outcomes.iter().find(|one| one.case.id == "gen-ports-answer").unwrap();
    assert_eq!(ports.verdict(), Verdict::Fail);
}

/// No case fails for every 16th valid variant of a CNC, without a profile. The command
/// `selftest --only different` tries all variants.
#[test]
fn a_sample_of_valid_variants_passes() {
    let variants = faults::all().iter().filter(|defect| defect.kind == DefectKind::Different);
    let mut alarms = Vec::new();
    let mut count = 0;
    for defect in variants.step_by(16) {
        count += 1;
        let (mut target, Discovery { found, .. }) = discovered(Some(defect));
        println!("{}: {}", defect.id, found.summary());
        let failed = outcomes(&mut target, &[]).into_iter().filter(|one| one.verdict().fails_run());
        alarms
            .extend(failed.map(|one| format!("{}: {} {:?}", defect.id, one.case.id, one.verdicts)));
    }
    assert!(count > 3 && alarms.is_empty(), "{count}: {alarms:#?}");
}
