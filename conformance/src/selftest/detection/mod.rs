//! Measures, in each [`Mode`], whether the suite detects each seeded defect of a CNC.
//!
//! The suite tests a simulated CNC in this process through the gate, as
//! `ads-cnc run --target --all` tests a device: with the same cases, but without a deadline, and
//! without access to the state of the simulator. During a run, the clock of the simulated CNC
//! advances only while the client waits for a missing reply or between two requests, so that a run
//! is short and repeatable. A device has other values than the manuals' examples, so no profile
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

use super::trial::{TrialResult, detecting, judge};
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
pub fn measure(defect: &SeededDefect) -> Result<DetectionRow, ToolError> {
    let detect = |mode| detect(defect, mode).map(|detection| (mode, detection));
    let modes = Mode::ALL.into_iter().map(detect).collect::<Result<BTreeMap<_, _>, _>>()?;
    Ok(DetectionRow { id: defect.id.clone(), hash: hash(defect)?, modes })
}

/// A hash of the defect's ID, requirements and edition, and of the replies of the first of its
/// devices with the defect in the mode `All`. The first reply that differs from that without the
/// defect is the last.
///
/// # Errors
/// An error of the simulated CNC.
pub fn hash(defect: &SeededDefect) -> Result<String, ToolError> {
    let devices = devices(defect)?;
    let mut text = row_text(defect);
    for device in devices.iter().take(1) {
        let correct_digests = device.correct_answers(Mode::All, Compare::Bytes)?;
        let cnc = device.cnc(Some(defect))?;
        let answers =
            answers(device, cnc, Mode::All, Some(correct_digests), Compare::Bytes)?.answers;
        text = format!("{text} {answers:?}");
    }
    Ok(table::hash(&text))
}

fn row_text(defect: &SeededDefect) -> String {
    let SeededDefect { id, requirements, edition, .. } = defect;
    format!("{id} {requirements:?} {edition:?}")
}

/// The result of a defect in a mode. The suite runs against each of the [`devices`] of the defect,
/// until the defect is caught.
fn detect(defect: &SeededDefect, mode: Mode) -> Result<Detection, ToolError> {
    let devices = devices(defect)?;
    let mut outcomes = Vec::new();
    for device in &devices {
        outcomes.extend(device.outcomes(Some(defect), mode)?);
        if judge(&defect.requirements, &outcomes).1 == TrialResult::Caught {
            break;
        }
    }
    let (failed, result) = judge(&defect.requirements, &outcomes);
    let result = match result {
        TrialResult::Caught | TrialResult::Elsewhere if witness::is_right(defect).is_some() => {
            DetectionResult::Alarm
        }
        TrialResult::Caught => DetectionResult::Caught,
        TrialResult::Quiet => DetectionResult::Quiet,
        TrialResult::FalseAlarm => DetectionResult::Alarm,
        TrialResult::Broken => return Err(ToolError::Internal(failed.join(" "))),
        _ if !failed.is_empty() => DetectionResult::Elsewhere,
        _ => witness::of(defect, &devices, mode)?,
    };
    // A warning or a difference is a failure only for a requirement that the defect breaks, and
    // only if the defect is caught.
    let counts = |id: &str, verdict: Verdict| match verdict {
        Verdict::Fail | Verdict::Vacuous => true,
        Verdict::Warning | Verdict::Differs => {
            result == DetectionResult::Caught && defect.requirements.contains(&id)
        }
        _ => false,
    };
    let (mut requirements, mut cases) = (BTreeSet::new(), BTreeSet::new());
    for outcome in &outcomes {
        let verdicts = outcome.verdicts.iter();
        for one in verdicts.filter(|one| counts(one.requirement, detecting(one))) {
            requirements.insert(one.requirement.to_owned());
            cases.insert(outcome.case.id.clone());
        }
    }
    Ok(Detection { result, requirements, cases })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faults;

    #[test]
    fn a_description_does_not_change_the_hash() {
        let defect = faults::by_id("cnc.com.type-dword").unwrap();
        let mut other = defect.clone();
        other.what = "another description".to_owned();
        assert_eq!(row_text(&other), row_text(defect));
    }
}
