//! Finds out whether a defect is undetectable in a mode: a correct CNC, the witness, sends the same
//! replies as the CNC with the defect to every generated request that the gate of the mode allows.
//! Differences that `requests::meaning` removes do not count.
//!
//! The witness is the CNC without the defect, or a CNC with [another
//! configuration](super::configured). In a mode with a profile, the witness must also match the
//! profile. A CNC with a defect that `is_right` finds is itself correct.

use super::configured;
use super::detection_result::{DetectionResult, Mode};
use super::device::{Device, answers};
use super::requests::Compare;
use crate::faults::{FieldChange, FieldDefect, SeededDefect};
use crate::session::ToolError;

/// Fields whose values are arbitrary, as stream, field, changes and reason: a CNC whose values are
/// changed in one of these ways is correct, too.
const FREE: &[(&str, &str, &[FieldChange], &str)] = &[
    ("device-info-reply", "major", ONE_TO_ONE, "a CNC may have any version"),
    ("device-info-reply", "minor", ANY, "a CNC may have any version"),
    ("device-info-reply", "build", ONE_TO_ONE, "a CNC may have any version"),
    (
        "device-info-reply",
        "name",
        &[FieldChange::FlipLow, FieldChange::Invert],
        "a CNC may have any name",
    ),
    ("device-state-reply", "ads_state", ONE_TO_ONE, "a CNC may be in any state"),
    ("device-state-reply", "device_state", ONE_TO_ONE, "a CNC may be in any state"),
    ("object-descriptor", "id", ONE_TO_ONE, "the number is unique, and nothing more is documented"),
    ("object-descriptor", "not_assigned", ONE_TO_ONE, "nothing is assigned to these bytes"),
];

const ONE_TO_ONE: &[FieldChange] =
    &[FieldChange::FlipLow, FieldChange::Invert, FieldChange::SwapBytes];

const ANY: &[FieldChange] =
    &[FieldChange::FlipLow, FieldChange::Invert, FieldChange::SwapBytes, FieldChange::Zero];

/// Prefixes of the IDs of defects whose effects are all undocumented or assumed, each with the
/// reason.
const UNDOCUMENTED: &[(&str, &str)] = &[
    ("cnc.var.axis-handle-own", "how handles of the axis interface are used is assumed (VAR-10)"),
    ("cnc.var.handle-changes", "a name may have several handles (VAR-10)"),
    ("cnc.svc.request-state-resets-not", "that a write over ADS resets is assumed (SVC-3)"),
    ("cnc.svc.resets-once", "that a write over ADS resets is assumed (SVC-3)"),
    ("cnc.sda.blank-axis-number", "any element may be the axis number, zeros are assumed (SDA-11)"),
    (
        "cnc.com.content-big-endian",
        "an object may have any value, and what is written is read back",
    ),
    (
        "axis-handle-by-name.first-channel",
        "how handles of the axis interface are used is assumed (VAR-10)",
    ),
    (
        "cnc.adr.platform-axis-from-0",
        "where the lists of platform axes are is assumed (COM-7), and a list says where its objects are",
    ),
    ("cnc.sda.feedhold-2", "that TRUE is 1 is assumed (GEN-5)"),
];

/// The reason why a CNC with this defect is correct; `None` if the CNC is not correct.
pub(super) fn is_right(defect: &SeededDefect) -> Option<&'static str> {
    let undocumented = UNDOCUMENTED.iter().find(|(start, _)| defect.id.starts_with(start));
    if let Some((_, why)) = undocumented {
        return Some(why);
    }
    let FieldDefect { stream, field, change, .. } = defect.field()?;
    let free = FREE.iter().find(|(in_stream, name, changes, _)| {
        stream.layout().name == *in_stream && field.name() == *name && changes.contains(change)
    });
    free.map(|(.., why)| *why)
}

/// The witness if the defect is undetectable; otherwise the first request whose reply differs from
/// that of the CNC without the defect in more than configurable values.
pub(super) fn of(
    defect: &SeededDefect,
    devices: &[&'static Device],
    mode: Mode,
) -> Result<DetectionResult, ToolError> {
    if let Some(why) = is_right(defect) {
        return Ok(DetectionResult::Undetectable(format!("a correct CNC: {why}")));
    }
    let mut witness = None;
    for device in devices {
        if difference(defect, device, mode, Compare::Bytes)?.is_none() {
            continue;
        }
        if let Some(what) = configured_witness(defect, device, mode)? {
            witness = Some(what);
        } else if let Some(request) = difference(defect, device, mode, Compare::Configured)? {
            return Ok(DetectionResult::Missed(request));
        } else {
            witness = Some(CONFIGURED.to_owned());
        }
    }
    let why = witness.unwrap_or_else(|| "no answer differs".to_owned());
    Ok(DetectionResult::Undetectable(why))
}

/// Describes the witness whose existence a comparison with [`Compare::Configured`] proves.
const CONFIGURED: &str =
    "elements may have any texts, objects any content, and V.E any extended description";

/// The first request whose reply distinguishes the CNC with the defect from the CNC without the
/// defect.
fn difference(
    defect: &SeededDefect,
    device: &Device,
    mode: Mode,
    compare: Compare,
) -> Result<Option<String>, ToolError> {
    let correct_digests = device.correct_answers(mode, compare)?;
    Ok(answers(device, device.cnc(Some(defect))?, mode, Some(correct_digests), compare)?.difference)
}

/// The description of a witness with another configuration, whose replies equal those of the CNC
/// with the defect.
fn configured_witness(
    defect: &SeededDefect,
    device: &Device,
    mode: Mode,
) -> Result<Option<String>, ToolError> {
    for witness in configured::of(&defect.id) {
        let Some(cnc) = witness.cnc(device, mode)? else { continue };
        let theirs = answers(device, cnc, mode, None, Compare::Bytes)?.answers;
        let mine = answers(device, device.cnc(Some(defect))?, mode, Some(&theirs), Compare::Bytes)?;
        if mine.difference.is_none() {
            return Ok(Some(witness.what.to_owned()));
        }
    }
    Ok(None)
}
