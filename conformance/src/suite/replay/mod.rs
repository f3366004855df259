//! The golden sequences of data streaming and of the Service Interface. Each kind has a player,
//! which acts as the client or the service, and an actor for the CNC. The suite's actor is a CNC
//! over the wire, whose own part is done directly in the simulated CNC; tests have actors without a
//! wire.

mod outcome;
mod service;
mod streaming;
mod wire;

pub use outcome::{Fault, StepError, StepResult, differs};
pub use service::{
    RequestingProgram, ServiceActor, fault_class, play as play_service, script, square_root,
};
pub use streaming::{StreamActor, play as play_stream, take};

use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{ClauseId, Given, Sequence, SequenceExpect, sequences};

use crate::judge::{Body, Case, CaseSubject, Checks as _, Needs, Rule, Step, Stop};
use crate::suite::kit::Probe;

/// Requirements of a client or a service, which is the suite itself here.
const NOT_THE_TARGETS: [ClauseId; 5] = [STM_17, SVC_2, SVC_5, SVC_7, SVC_13];

fn is_of_target(id: &str) -> bool {
    NOT_THE_TARGETS.iter().all(|other| other.as_str() != id)
}

/// One case for each sequence with a requirement of the CNC.
pub(super) fn cases() -> Vec<Case> {
    let all = sequences().iter();
    let steps = all.filter(|one| matches!(one.given, Given::Streaming(_) | Given::Service(_)));
    let cases = steps.map(|sequence| {
        let ids = sequence.cited().into_iter().map(|one| one.id.as_str());
        Case {
            id: format!("seq-{}", sequence.id),
            title: sequence.title.clone(),
            subject: CaseSubject::Target,
            requirements: ids.filter(|id| is_of_target(id)).collect(),
            needs: Needs::Simulator,
            body: Body::Sequence(sequence),
        }
    });
    cases.filter(|case| !case.requirements.is_empty()).collect()
}

/// Plays a sequence.
pub(super) fn run(probe: &mut Probe<'_>, sequence: &'static Sequence) -> Step {
    let done = match &sequence.given {
        Given::Streaming(given) => wire::stream(probe, given, &sequence.cited()),
        Given::Service(given) => wire::service(probe, given),
        _ => return Err(Stop::Harness("a text has no steps".to_owned())),
    };
    let stated = match &sequence.expect {
        SequenceExpect::Accept(_) => None,
        SequenceExpect::Reject(reject) => {
            Some((reject.class.as_str(), reject.step.as_deref().unwrap_or_default()))
        }
    };
    let (passed, expected, found) = match done {
        Ok(fault) => (fault == stated, display(stated), display(fault)),
        Err(StepError::Differs(expected, found)) => (false, expected, found),
        Err(StepError::Stop(stop)) => return Err(stop),
    };
    // For the simulated CNC assumed requirements are judged too.
    let cited = sequence.cited().into_iter().map(|one| one.id.as_str());
    let cited: Vec<Rule> = cited.filter(|id| is_of_target(id)).map(Rule::of).collect();
    probe.check(&cited, passed, expected, found);
    Ok(())
}

fn display(fault: Option<(&str, &str)>) -> String {
    match fault {
        None => "every step as stated".to_owned(),
        Some((class, step)) => format!("{class} in the step {step}"),
    }
}
