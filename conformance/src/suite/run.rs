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
    let (gate, inside) = (session.client.gate(), session.cnc.is_some());
    if let Some((verdict, why)) = case.needs.unmet(gate, &session.profile, inside) {
        return Outcome::untried(case, verdict, why);
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
