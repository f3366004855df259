//! Running cases.

use super::case::{Body, Case, Judgement, Needs, Rule, Stop};
use super::outcome::Outcome;
use super::probe::{Probe, Session};
use super::{printed, vectors};
use crate::defect::Defect;
use crate::verdict::Verdict;

/// Runs the cases against a session; those without a target against the codec.
///
/// `defect` changes bytes on their way into the codec, to show that its cases can fail.
pub fn run(
    cases: Vec<Case>,
    mut session: Option<&mut Session>,
    defect: Option<&Defect>,
) -> Vec<Outcome> {
    cases.into_iter().map(|case| one(case, session.as_deref_mut(), defect)).collect()
}

fn one(case: Case, session: Option<&mut Session>, defect: Option<&Defect>) -> Outcome {
    if let Body::Vector(vector) = case.body {
        let judgement = vectors::judge(vector, defect);
        let judgements = case.requirements.iter().map(|&id| {
            let Rule { id, level } = Rule::from(id);
            Judgement { requirement: id, level, ..judgement.clone() }
        });
        let judgements = judgements.collect();
        return Outcome::tried(case, judgements, 1, None);
    }
    let Some(session) = session else {
        return Outcome::untried(case, Verdict::NotRun, "no target");
    };
    // Frames are judged by what there was of them, whatever became of the target.
    if let Some(why) = session.gone.as_ref().filter(|_| case.needs != Needs::Frames) {
        return Outcome::untried(case, Verdict::Inconclusive, format!("no target left: {why}"));
    }
    match case.needs {
        Needs::Malformed if !session.client.gate().lets_malformed_pass() => {
            let note = "sends what no client should: not sent to a device";
            return Outcome::untried(case, Verdict::NotRun, note);
        }
        Needs::PrintedExamples if !session.profile.printed_examples => {
            let note = "the target does not claim to answer the printed examples";
            return Outcome::untried(case, Verdict::NotApplicable, note);
        }
        _ => {}
    }
    let mut probe = Probe::new(session);
    let step = match case.body {
        Body::Probe(body) => body(&mut probe),
        Body::Printed(vector) => printed::ask(&mut probe, vector),
        Body::Vector(_) => Err(Stop::Harness("a vector needs no target".to_owned())),
    };
    let (judgements, checks) = probe.into_findings();
    Outcome::tried(case, judgements, checks, step.err())
}
