//! The detection of every seeded defect of a CNC over the wire, in each mode in which a user can
//! run the suite against a device.
//!
//! The suite tests a simulated CNC in this process through the gate, as `ads-cnc run --target` tests a
//! device: with the same cases, defaults and limits, and without access to the state of the simulator.
//! The clock of the simulated CNC advances only while the client waits for a missing reply, so that a
//! run is short and repeatable. A device has other values than the manuals' examples, so no profile
//! here claims that the CNC replies as in these examples.

mod check;
mod configured;
mod detection_result;
mod device;
mod pairs;
mod requests;
mod table;
mod witness;

use std::collections::{BTreeMap, BTreeSet};

use crate::faults::SeededDefect;
use crate::judge::Verdict;
use crate::session::ToolError;

use super::trial::{TrialResult, judge};
pub use check::{CheckedTable, SAMPLE, Scope};
pub use detection_result::{Detection, DetectionResult, Mode};
use device::{answers, devices};
pub(super) use pairs::pairs;
pub use pairs::{PAIRS, PairFigures};
use requests::Compare;
pub use table::{DetectionRow, DetectionTable, Figures, inputs};

/// Measures a defect, or a valid variant, in every mode.
///
/// # Errors
/// An error of the suite, or of the simulated CNC.
pub fn measure(seed: &SeededDefect) -> Result<DetectionRow, ToolError> {
    let detect = |mode| detect(seed, mode).map(|detection| (mode, detection));
    let modes = Mode::ALL.into_iter().map(detect).collect::<Result<BTreeMap<_, _>, _>>()?;
    Ok(DetectionRow { id: seed.id.clone(), hash: hash(seed)?, modes })
}

/// A hash of the defect's row, and of the replies of the CNC with the defect, up to the first reply that
/// differs from the reply without the defect.
///
/// # Errors
/// An error of the simulated CNC.
pub fn hash(seed: &SeededDefect) -> Result<String, ToolError> {
    let devices = devices(seed)?;
    let SeededDefect { id, requirements, what, edition, .. } = seed;
    let mut text = format!("{id} {requirements:?} {what} {edition:?}");
    for device in devices.iter().take(1) {
        let correct_digests = device.correct_answers(Mode::All, Compare::Bytes)?;
        let cnc = device.cnc(Some(seed))?;
        let answers =
            answers(device, cnc, Mode::All, Some(correct_digests), Compare::Bytes)?.answers;
        text = format!("{text} {answers:?}");
    }
    Ok(table::hash(&text))
}

/// The result of a defect in a mode. The suite is run against the device of each edition until the
/// defect is caught.
fn detect(seed: &SeededDefect, mode: Mode) -> Result<Detection, ToolError> {
    let devices = devices(seed)?;
    let mut outcomes = Vec::new();
    for device in &devices {
        outcomes.extend(device.outcomes(Some(seed), mode)?);
        if judge(&seed.requirements, &outcomes).1 == TrialResult::Caught {
            break;
        }
    }
    let (failed, result) = judge(&seed.requirements, &outcomes);
    let result = match result {
        TrialResult::Caught | TrialResult::Elsewhere if witness::is_right(seed).is_some() => {
            DetectionResult::Alarm
        }
        TrialResult::Caught => DetectionResult::Caught,
        TrialResult::Quiet => DetectionResult::Quiet,
        TrialResult::FalseAlarm => DetectionResult::Alarm,
        TrialResult::Broken => return Err(ToolError::Internal(failed.join(" "))),
        _ if !failed.is_empty() => DetectionResult::Elsewhere,
        _ => witness::of(seed, &devices, mode)?,
    };
    // A warning or a difference counts as a failure only if it caught the defect (requirements below
    // the level *must*).
    let counts = |id: &str, verdict: Verdict| match verdict {
        Verdict::Fail | Verdict::Vacuous => true,
        Verdict::Warning | Verdict::Differs => {
            result == DetectionResult::Caught && seed.requirements.contains(&id)
        }
        _ => false,
    };
    let (mut requirements, mut cases) = (BTreeSet::new(), BTreeSet::new());
    for outcome in &outcomes {
        for one in outcome.verdicts.iter().filter(|one| counts(one.requirement, one.verdict)) {
            requirements.insert(one.requirement.to_owned());
            cases.insert(outcome.case.id.clone());
        }
    }
    Ok(Detection { result, requirements, cases })
}
