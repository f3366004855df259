//! Running cases.

use super::case::{Body, Case, Needs, Stop, Subject};
use super::outcome::Outcome;
use super::probe::Probe;
use super::session::Session;
use super::{printed, replay};
use crate::defect::Seed;
use crate::testee::{self, Terms};
use crate::verdict::Verdict;

/// Runs the cases: those of the codec against the codec, all others against a session.
///
/// `defect` changes bytes on their way into and out of the codec, to show that its cases can fail.
pub fn run(
    cases: Vec<Case>,
    mut session: Option<&mut Session>,
    defect: Option<&Seed>,
    seed: u32,
) -> Vec<Outcome> {
    let (codec, target): (Vec<Case>, Vec<Case>) =
        cases.into_iter().partition(|case| case.needs == Needs::Codec);
    let mut outcomes = match codec.is_empty() {
        true => Vec::new(),
        false => {
            let mut own = testee::Own { defect: defect.cloned() };
            testee::judge(
                &mut own,
                codec,
                Terms { seed, subject: Subject::Codec, edition: None, strict: true },
            )
            .outcomes
        }
    };
    outcomes.extend(target.into_iter().map(|case| one(case, session.as_deref_mut())));
    outcomes
}

fn one(case: Case, session: Option<&mut Session>) -> Outcome {
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
        Needs::Writes if !session.client.gate().may_let_writes_pass() => {
            let note = "writes: only what a file for --allow-write names";
            return Outcome::untried(case, Verdict::NotRun, note);
        }
        Needs::MalformedWrites if session.client.gate().embedded().is_none() => {
            let note = "writes what no client should: to the embedded CNC only";
            return Outcome::untried(case, Verdict::NotRun, note);
        }
        Needs::Embedded if session.cnc.is_none() => {
            let note =
                "takes something that is done to a CNC from within: to the embedded one only";
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
        Body::Sequence(sequence) => replay::run(&mut probe, sequence),
        Body::Vector(_) | Body::Manners | Body::Client | Body::Traffic => {
            Err(Stop::Harness("this case needs no target".to_owned()))
        }
    };
    let (judgements, checks) = probe.into_findings();
    Outcome::tried(case, judgements, checks, step.err())
}
