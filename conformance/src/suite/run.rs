//! Runs cases.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use std::collections::HashMap;
use std::sync::LazyLock;

use super::kit::{Probe, TargetState};

use super::row::CaseFunction;
use super::{printed, rows};
use crate::deadline::Deadline;
use crate::faults::SeededDefect;
use crate::judge::{
    Body, Case, CaseOutcome, CaseSubject, ENOUGH, Needs, Stop, Verdict, attribute, caught,
};
use crate::process::{interrupt, progress};
use crate::testee::{self, JudgementOptions};

/// The function of each case that has one, by the ID of the case.
static TRIES: LazyLock<HashMap<&str, CaseFunction>> =
    LazyLock::new(|| rows().map(|row| (row.id, row.run)).collect());

/// Runs the cases: those of the codec on this project's codec, all others on the target. Without a
/// target, the other cases get the verdict *not run*.
///
/// A `defect` of a codec changes the bytes that the codec receives, or its answers, to show that
/// the cases of the codec can fail.
pub fn run(
    cases: Vec<Case>,
    mut target: Option<&mut TargetState>,
    defect: Option<&SeededDefect>,
    seed: u32,
) -> Vec<CaseOutcome> {
    let (of_codec, of_target): (Vec<Case>, Vec<Case>) =
        cases.into_iter().partition(|case| case.needs == Needs::Codec);
    let mut outcomes = Vec::new();
    if !of_codec.is_empty() {
        let mut own = testee::CodecTestee { defect: defect.cloned() };
        let terms =
            JudgementOptions { seed, subject: CaseSubject::Codec, edition: None, strict: true };
        outcomes = testee::judge(&mut own, of_codec, terms).outcomes;
    }
    if !of_target.is_empty() {
        progress::begin(of_target.len());
    }
    outcomes.extend(of_target.into_iter().map(|case| {
        let run = TRIES.get(case.id.as_str()).copied();
        let outcome = CaseOutcome::timed(|| one(case, run, target.as_deref_mut()));
        progress::step(outcome.verdict().fails_run());
        if let Some(target) = target.as_deref_mut() {
            target.end_in(&outcome.case.id);
            let failed = usize::from(outcome.verdict().is_failure());
            target.failures_left = target.failures_left.map(|left| left.saturating_sub(failed));
        }
        outcome
    }));
    if let Some(target) = target.as_deref_mut() {
        let broken = broken_frames(&outcomes, target);
        outcomes.extend(broken);
    }
    attribute(&mut outcomes);
    if let Some(target) = target {
        // A panic is ignored here, because the report lists the values that remain changed.
        let _panic = caught(|| Probe::new(target).restore_rest());
    }
    outcomes
}

/// The case that judges the frames that the client has received so far.
const EVERY_FRAME: &str = "ads-every-frame";

/// The outcome of the case [`EVERY_FRAME`] if the client has found violations in received frames
/// and the case is not among `outcomes`; otherwise `None`. A selected case is among the outcomes,
/// even if it was interrupted.
fn broken_frames(outcomes: &[CaseOutcome], target: &mut TargetState) -> Option<CaseOutcome> {
    let is_selected = outcomes.iter().any(|outcome| outcome.case.id == EVERY_FRAME);
    if is_selected || target.broken.checks == 0 {
        return None;
    }
    let row = rows().find(|row| row.id == EVERY_FRAME)?;
    Some(one(super::case_of(row), Some(row.run), Some(target)))
}

fn one(mut case: Case, run: Option<CaseFunction>, target: Option<&mut TargetState>) -> CaseOutcome {
    let Some(target) = target else {
        return CaseOutcome::untried(case, Verdict::NotRun, "no target");
    };
    if interrupt::is_requested() {
        return CaseOutcome::interrupted(case);
    }
    // Cases about frames judge the frames exchanged so far, even if the target no longer answers.
    if let Some(why) = target.disconnect_reason.as_ref().filter(|_| case.needs != Needs::Frames) {
        return CaseOutcome::untried(
            case,
            Verdict::Inconclusive,
            format!("the target no longer answers: {why}"),
        );
    }
    if target.failures_left == Some(0) && case.needs != Needs::Frames {
        return CaseOutcome::untried(case, Verdict::NotRun, ENOUGH);
    }
    let late = target.deadline.filter(|_| case.needs != Needs::Frames);
    if let Some(deadline) = late.filter(Deadline::is_over) {
        return CaseOutcome::untried(case, Verdict::Inconclusive, deadline.to_string());
    }
    if let Some((verdict, why)) = case.needs.unmet(target.client.gate(), &target.profile) {
        return CaseOutcome::untried(case, verdict, why);
    }
    let writes = matches!(case.needs, Needs::Writes | Needs::MalformedWrites);
    if writes && target.changes.any_given_up() {
        let note = "no more writes are sent after a value could not be restored";
        return CaseOutcome::untried(case, Verdict::NotRun, note);
    }
    // The deadline ends the requests of a case, but values are restored even after the deadline.
    let mut probe = Probe::new(target).with_deadline(late);
    let begun = caught(|| match (case.body, run) {
        (Body::Probe, Some(run)) => run(&mut probe),
        (Body::Probe, None) => Err(Stop::Harness(format!("{} has no function", case.id))),
        (Body::Printed(vector), _) => printed::ask(&mut probe, vector),
        (Body::Traffic, _) => {
            let record = probe.target.rules.records.take_of_replies(&case.id);
            let is_judged = |id: &&str| record.judgements.iter().any(|one| one.requirement == *id);
            if record.checks > 0 {
                case.requirements.retain(is_judged);
            }
            probe.take_over(record);
            Ok(())
        }
        (Body::Vector(_) | Body::Sequence(_) | Body::Protocol | Body::Client, _) => {
            Err(Stop::Harness("this case needs no target".to_owned()))
        }
    });
    let step = match begun {
        Ok(Ok(())) if probe.interrupted => Err(Stop::Interrupted),
        Ok(step) => step,
        Err(panicked) => Err(Stop::Harness(panicked)),
    };
    let restored_all = caught(|| probe.restore_all()).unwrap_or_else(|panicked| {
        probe.target.changes.give_up();
        Err(Stop::Harness(panicked))
    });
    let step = step.and(restored_all);
    let step = probe.end(step);
    CaseOutcome::tried(case, probe.record, step.err())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use ads_cnc::CncString;
    use ads_cnc::address::Channel;
    use ads_cnc_vectors::ids::ADS_5;

    use super::*;
    use crate::client::{Client, Target};
    use crate::faults::{self, Faulty};
    use crate::gate::{Allowed, Gate};
    use crate::judge::{Rule, Step};
    use crate::net;
    use crate::objects::ValueAddress;
    use crate::profile::Profile;
    use crate::simulator::{Cnc, NET_ID, Server};
    use crate::suite::kit::WriteCheck;

    const NAME: &str = "V.E.vartest";

    fn place() -> ValueAddress {
        let name = NAME.parse::<CncString>().unwrap();
        ValueAddress::Name { channel: Channel::new(1).unwrap(), name }
    }

    fn panics(probe: &mut Probe<'_>) -> Step {
        let write_check = WriteCheck { what: NAME, rules: &[], is_text: false, name: None };
        probe.try_write(&write_check, &place(), |probe, before, new| {
            assert_eq!(probe.value_at(&place()).unwrap().as_deref(), Some(new));
            assert_ne!(before, new);
            panic!("in a case")
        })
    }

    /// A CNC, optionally with a defect, on which the variable `name` may be written.
    fn target(defect: Option<&str>, name: &str) -> (Server, TargetState) {
        let listener = net::listen(([127, 0, 0, 1], 0).into()).unwrap();
        let defect = defect.map(|id| faults::by_id(id).unwrap());
        let cnc = Faulty::new(Cnc::with_default_model().unwrap(), defect);
        let server = Server::start(listener, Arc::new(cnc)).unwrap();
        let file = format!(
            "target = \"{NET_ID}\"\nexpires = 2999-01-01T00:00:00Z\n\
             [[variable]]\nchannel = 1\nname = \"{name}\"\n"
        );
        let gate = Gate::queries().with_allowed(Some(Allowed::from_toml(&file).unwrap()));
        let client = Client::connect(Target::local(server.addr(), NET_ID), gate).unwrap();
        (server, TargetState::new(client, Profile::DEVICE))
    }

    /// A value of 2048 bytes does not fit into a write by name, so the verdict is *not observed*.
    /// The verdict is *not applicable* if the target has no variable that may be written.
    #[test]
    fn a_case_without_a_subject_is_not_applicable() {
        let padded = Some("cnc.var.value-2048");
        for (defect, name, verdict) in [
            (None, NAME, Verdict::Pass),
            (padded, NAME, Verdict::NotObserved),
            (None, "V.E.none", Verdict::NotApplicable),
        ] {
            let (_server, mut target) = target(defect, name);
            let case = crate::suite::cases().into_iter().find(|one| one.id == "write-by-name");
            let outcomes = run(vec![case.unwrap()], Some(&mut target), None, 1);
            assert_eq!(outcomes[0].verdict(), verdict, "{defect:?} {name}: {outcomes:?}");
        }
    }

    /// A violation in a frame adds the outcome of the case that judges frames, unless the case
    /// already has an outcome, such as that of an interrupted run.
    #[test]
    fn the_case_of_frames_has_one_outcome() {
        let (_server, mut target) = target(None, NAME);
        let rule = Rule::from(ADS_5);
        target.broken.add(rule, Verdict::Fail, "a header", "another", || None);
        let case = crate::suite::cases().into_iter().find(|one| one.id == EVERY_FRAME).unwrap();
        let interrupted = [CaseOutcome::interrupted(case)];
        assert!(broken_frames(&interrupted, &mut target).is_none());
        assert_eq!(broken_frames(&[], &mut target).unwrap().verdict(), Verdict::Fail);
    }

    /// `TargetState::ended` names the case in which the target stops answering.
    #[test]
    fn the_case_in_which_the_target_is_gone_is_noted() {
        let (server, mut target) = target(None, NAME);
        let cases: Vec<Case> =
            crate::suite::cases().into_iter().filter(|one| one.needs == Needs::Queries).collect();
        run(cases[..1].to_vec(), Some(&mut target), None, 1);
        assert_eq!(target.ended(), None);
        drop(server);
        run(cases[1..].to_vec(), Some(&mut target), None, 1);
        let ended = target.ended().unwrap();
        assert!(ended.starts_with("the target stopped answering in "), "{ended}");
    }

    /// The values that a panicking case has changed are restored, and the next case runs.
    #[test]
    fn values_are_restored_after_a_panic() {
        let (_server, mut target) = target(None, NAME);
        let before = Probe::new(&mut target).value_at(&place()).unwrap();
        let case = || Case {
            id: "write-and-panic".to_owned(),
            title: String::new(),
            subject: CaseSubject::Target,
            requirements: vec!["VAR-13"],
            needs: Needs::Writes,
            body: Body::Probe,
        };
        let reads: CaseFunction = |probe| probe.value_at(&place()).map(drop);
        let [panicked, next] = [panics, reads].map(|run| one(case(), Some(run), Some(&mut target)));
        assert_eq!(
            [panicked.verdict(), next.verdict()],
            [Verdict::HarnessError, Verdict::NotObserved]
        );
        assert_eq!(panicked.note.as_deref(), Some("the case panicked: in a case"));
        assert_eq!(Probe::new(&mut target).value_at(&place()).unwrap(), before);
        assert!(target.changes().left().is_empty());
    }
}
