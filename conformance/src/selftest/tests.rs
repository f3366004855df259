//! Tests which results count as caught, how they are printed, and that the committed detection
//! table is complete.

use super::detection::{DetectionResult, DetectionTable, Mode};
use super::*;
use crate::judge::RequirementVerdict;
use crate::suite;

/// One outcome with these verdicts on these requirements.
fn outcomes(verdicts: &[(&'static str, Verdict)]) -> Vec<CaseOutcome> {
    let case = suite::cases().swap_remove(0);
    let verdicts = verdicts.iter().map(|&(requirement, verdict)| RequirementVerdict {
        requirement,
        verdict,
        judgements: Vec::new(),
    });
    vec![CaseOutcome {
        case,
        verdicts: verdicts.collect(),
        checks: 1,
        note: None,
        rejected: false,
        time: None,
    }]
}

fn judged(targets: &[&str], verdicts: &[(&'static str, Verdict)]) -> TrialResult {
    judge(targets, &outcomes(verdicts)).1
}

#[test]
fn a_defect_is_caught_if_its_own_requirement_fails() {
    use Verdict::{Differs, Fail, NotObserved, Pass, Vacuous, Warning};

    assert_eq!(judged(&["VAR-4"], &[("VAR-4", Fail), ("VAR-8", Pass)]), TrialResult::Caught);
    assert_eq!(judged(&["VAR-4", "VAR-8"], &[("VAR-8", Fail)]), TrialResult::Caught);
    assert_eq!(judged(&["VAR-4"], &[("VAR-4", Vacuous)]), TrialResult::Caught);
    assert_eq!(judged(&["VAR-4"], &[("VAR-8", Fail)]), TrialResult::Elsewhere);
    assert_eq!(judged(&["VAR-4"], &[("VAR-4", Pass)]), TrialResult::Survived);
    assert_eq!(judged(&["VAR-4"], &[("VAR-4", NotObserved)]), TrialResult::Survived);
    // A warning counts as caught for a requirement of level *should*, but not of level *must*.
    assert_eq!(judged(&["VAR-4"], &[("VAR-4", Warning)]), TrialResult::Survived);
    assert_eq!(judged(&["VAR-4"], &[("VAR-4", Differs)]), TrialResult::Survived);
    assert_eq!(judged(&["ADS-8"], &[("ADS-8", Warning)]), TrialResult::Caught);
}

#[test]
fn a_valid_variant_may_differ_but_not_fail() {
    use Verdict::{Differs, Fail, HarnessError, Pass, Warning};

    assert_eq!(judged(&[], &[("VAR-4", Pass), ("VAR-8", Differs)]), TrialResult::Quiet);
    assert_eq!(judged(&[], &[("VAR-4", Warning)]), TrialResult::Quiet);
    assert_eq!(judged(&[], &[("VAR-4", Fail)]), TrialResult::FalseAlarm);
    // A harness error takes precedence over the verdicts on requirements.
    assert_eq!(judged(&[], &[("VAR-4", HarnessError)]), TrialResult::Broken);
    let both = [("VAR-4", Fail), ("VAR-8", HarnessError)];
    assert_eq!(judged(&["VAR-4"], &both), TrialResult::Broken);
}

fn tried(result: TrialResult, reason: Option<&str>) -> Trial {
    Trial {
        id: "an-id".to_owned(),
        group: SelfTestGroup::Cnc,
        what: "something".to_owned(),
        targets: vec!["VAR-4".to_owned()],
        failed: Vec::new(),
        result,
        reason: reason.map(str::to_owned),
    }
}

fn test(tried: Vec<Trial>) -> SelfTest {
    let table = DetectionTable::published().unwrap();
    let detection = CheckedTable { table, measured: 0, differences: Vec::new() };
    SelfTest { tried, stale: Vec::new(), detection, pairs: PairFigures::default() }
}

#[test]
fn a_surviving_defect_needs_a_reason() {
    use TrialResult::{Broken, Caught, Elsewhere, FalseAlarm, Noticed, Quiet, Same, Survived};

    assert_eq!(test(Vec::new()).exit(), Exit::Nothing);
    for fine in [Caught, Noticed, Quiet, Same] {
        assert_eq!(test(vec![tried(fine, None)]).exit(), Exit::Success, "{fine:?}");
    }
    for open in [Survived, Elsewhere] {
        assert_eq!(test(vec![tried(open, None)]).exit(), Exit::Failure, "{open:?}");
        assert_eq!(test(vec![tried(open, Some("why"))]).exit(), Exit::Success, "{open:?}");
    }
    // A reason does not excuse a false alarm or a broken trial.
    for wrong in [FalseAlarm, Broken] {
        assert_eq!(test(vec![tried(wrong, Some("why"))]).exit(), Exit::Failure, "{wrong:?}");
    }
    let caught = || test(vec![tried(Caught, None)]);
    let stale = SelfTest { stale: vec!["cnc old".to_owned()], ..caught() };
    assert_eq!(stale.exit(), Exit::Failure);
    let mut differs = caught();
    differs.detection.differences.push("cnc.com.id-twice, all: missed now".to_owned());
    assert_eq!(differs.exit(), Exit::Failure);
}

#[test]
fn a_defect_without_effect_does_not_count() {
    let all = [TrialResult::Caught, TrialResult::Same, TrialResult::Survived, TrialResult::Same];
    let test = test(all.map(|result| tried(result, None)).into());
    assert_eq!(test.rate(SelfTestGroup::Cnc), (1, 2));
    let mut shown = Vec::new();
    print(&test, false, &mut shown).unwrap();
    let shown = String::from_utf8(shown).unwrap();
    let line = "simulated         2       1                  1\n";
    assert!(shown.contains(line), "{shown}");
    assert!(shown.contains("SURVIVED     cnc        an-id  [VAR-4]"), "{shown}");
}

#[test]
fn every_reason_belongs_to_a_trial() {
    let mut candidates = codecs::candidates();
    candidates.extend(cncs::candidates());
    candidates.extend(clients::candidates());
    for (group, start) in reasons::names() {
        let any = candidates.iter().any(|one| one.group == group && one.id.starts_with(start));
        assert!(any, "{} {start}", group.name());
    }
    let ids: std::collections::BTreeSet<_> =
        candidates.iter().map(|one| (one.group, one.id.clone())).collect();
    assert_eq!(ids.len(), candidates.len(), "an ID occurs twice");
}

#[test]
fn every_reason_belongs_to_a_missed_defect() {
    for start in reasons::missed() {
        assert!(faults::all().iter().any(|defect| defect.id.starts_with(start)), "{start}");
    }
}

/// The table and the document in `doc` agree with the code, and every defect has a row.
#[test]
fn the_table_is_complete() {
    let table = DetectionTable::published().unwrap();
    let renew = "run `ads-cnc selftest --renew conformance/doc`";
    let defects = faults::all().iter().filter(|defect| defect.is_for_cnc());
    let ids: Vec<&str> = defects.map(|defect| defect.id.as_str()).collect();
    let rows: Vec<&str> = table.rows.iter().map(|row| row.id.as_str()).collect();
    let lack = |of: &[&str], all: &[&str]| {
        all.iter().filter(|id| !of.contains(id)).map(|id| (*id).to_owned()).collect::<Vec<_>>()
    };
    let (new, gone) = (lack(&rows, &ids), lack(&ids, &rows));
    assert!(new.is_empty(), "detection.tsv has no row of the defects {new:?}: {renew}");
    assert!(gone.is_empty(), "detection.tsv has rows without a defect, {gone:?}: {renew}");
    assert_eq!(rows, ids, "the order of the rows is that of the defects: {renew}");
    assert!(
        table.inputs == detection::inputs(),
        "since detection.tsv was written, a case, the level of a requirement or the default model \
         changed: {renew}",
    );
    assert!(
        table.to_text() == include_str!("../../doc/detection.tsv"),
        "detection.tsv was edited: {renew}",
    );
    assert!(
        table.to_markdown() == include_str!("../../doc/detection.md"),
        "detection.md differs from detection.tsv: {renew}",
    );
    for mode in Mode::ALL {
        let all = table.rows.iter().map(|row| (&row.id, &row.modes[&mode].result));
        let alarms: Vec<_> = all.filter(|(_, result)| **result == DetectionResult::Alarm).collect();
        assert!(alarms.is_empty(), "{}: {alarms:?}", mode.name());
    }
}
