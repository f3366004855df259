//! Plays golden sequences of data streaming and of the Service Interface: acts as the client, the
//! service and the NC program, and compares each step with the simulated CNC.

mod service;
mod streaming;

use ads_cnc_vectors::{Pieces, Sequence, SequenceExpect, SequenceInput};

use crate::target::{CheckResult, Failed, TestCnc};

/// The class of an error and the ID of the step that caused it; `None` without an error.
type Fault<'c> = Option<(&'static str, &'c str)>;

/// Plays a sequence up to the first error, or to its end, and compares the error with the expected
/// one.
pub(crate) fn play(target: &TestCnc, sequence: &Sequence) -> CheckResult {
    let found = match &sequence.given {
        SequenceInput::Streaming(given) => streaming::play(target, given)?,
        SequenceInput::Service(given) => service::play(target, given)?,
        _ => return Err(Failed("a text has no steps".to_owned())),
    };
    let stated = match &sequence.expect {
        SequenceExpect::Accept(_) => None,
        SequenceExpect::Reject(reject) => {
            Some((reject.class.as_str(), reject.step.as_deref().unwrap_or_default()))
        }
    };
    crate::target::same("the fault", found, stated)
}

fn differs<T>(expected: impl ToString, found: impl ToString) -> CheckResult<T> {
    Err(Failed(format!("expected {}, found {}", expected.to_string(), found.to_string())))
}

/// The error of a sequence whose step lacks a required part.
fn lacks(what: &str) -> Failed {
    Failed(format!("a step lacks its {what}"))
}

fn bytes(pieces: Option<&Pieces>, what: &str) -> CheckResult<Vec<u8>> {
    Ok(pieces.ok_or_else(|| lacks(what))?.bytes())
}
