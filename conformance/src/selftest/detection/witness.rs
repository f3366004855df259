//! Shows that a defect is undetectable in a mode: a right CNC, the witness, gives the same answers
//! to every request that the mode may send.
//!
//! The witness is the CNC without the defect, a valid variant of it, or one with another model. In
//! a mode with a profile, that profile is also true of the witness.

use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError};

use super::device::{Device, Variants, answers};
use super::found::{DetectionResult, Mode};
use super::requests::RecordedAnswers;
use crate::faults::{self, FieldChange, FieldDefect, Seed, SeedKind};
use crate::session::ToolError;

/// Fields with arbitrary values: a one-to-one change of them gives a right CNC too. Stream, field,
/// changes, and why.
const FREE: &[(&str, &str, &[FieldChange], &str)] = &[
    ("device-info-reply", "major", ONE_TO_ONE, "a CNC may have any version"),
    ("device-info-reply", "minor", ONE_TO_ONE, "a CNC may have any version"),
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
    ("object-descriptor", "write_access", &[FieldChange::SwapBytes], "every number but 0 is TRUE"),
    ("ams-header", "error", &[FieldChange::SwapBytes], "no error number is documented"),
    ("read-reply", "result", &[FieldChange::SwapBytes], "no error number is documented"),
    ("write-reply", "result", &[FieldChange::SwapBytes], "no error number is documented"),
    ("read-write-reply", "result", &[FieldChange::SwapBytes], "no error number is documented"),
    ("device-info-reply", "result", &[FieldChange::SwapBytes], "no error number is documented"),
    ("device-state-reply", "result", &[FieldChange::SwapBytes], "no error number is documented"),
];

const ONE_TO_ONE: &[FieldChange] =
    &[FieldChange::FlipLow, FieldChange::Invert, FieldChange::SwapBytes];

/// Why a CNC with this change of a field is a right one.
pub(super) fn is_right(seed: &Seed) -> Option<&'static str> {
    let FieldDefect { stream, field, change, .. } = seed.field()?;
    let free = FREE.iter().find(|(in_stream, name, changes, _)| {
        stream.layout().name == *in_stream && field.name() == *name && changes.contains(change)
    });
    free.map(|(.., why)| *why)
}

/// The witness, or the first request that distinguishes the defect from the CNC without it.
pub(super) fn of(
    seed: &Seed,
    devices: &[&'static Device],
    mode: Mode,
) -> Result<DetectionResult, ToolError> {
    if let Some(why) = is_right(seed) {
        return Ok(DetectionResult::Undetectable(format!("a right CNC: {why}")));
    }
    let mut shown = None;
    let mut witnesses: Vec<&str> = Vec::new();
    for device in devices {
        let right = device.correct_answers(mode)?;
        let RecordedAnswers { answers: mine, difference } =
            answers(device, Some(seed), mode, Some(right))?;
        let Some(request) = difference else { continue };
        shown = shown.or(Some(request));
        // Only a variant with the same first difference can have the same answers.
        let alike = variants(device, mode)?.get(&first_difference(&mine)).cloned();
        let mut witness = None;
        for variant in alike.unwrap_or_default() {
            let theirs = answers(device, Some(variant), mode, None)?.answers;
            if answers(device, Some(seed), mode, Some(&theirs))?.difference.is_none() {
                witness = Some(variant.id.as_str());
            }
        }
        match witness {
            Some(witness) => witnesses.push(witness),
            None => return Ok(DetectionResult::Missed(shown.unwrap_or_default())),
        }
    }
    match witnesses.first() {
        None => Ok(DetectionResult::Undetectable("no answer differs".to_owned())),
        Some(variant) => Ok(DetectionResult::Undetectable(format!("as {variant}"))),
    }
}

fn first_difference(answers: &[u64]) -> (usize, Option<u64>) {
    (answers.len(), answers.last().copied())
}

fn variants(device: &'static Device, mode: Mode) -> Result<Variants, ToolError> {
    let mut known = device.variants.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(variants) = known.get(&mode) {
        return Ok(Arc::clone(variants));
    }
    let mut variants: BTreeMap<_, Vec<&Seed>> = BTreeMap::new();
    let different = faults::all().iter().filter(|seed| seed.kind == SeedKind::Different);
    for seed in different.filter(|seed| seed.own_model().is_none()) {
        if seed.edition.is_none_or(|edition| Some(edition) == device.settings.edition) {
            let answers =
                answers(device, Some(seed), mode, Some(device.correct_answers(mode)?))?.answers;
            variants.entry(first_difference(&answers)).or_default().push(seed);
        }
    }
    Ok(Arc::clone(known.entry(mode).or_insert(Arc::new(variants))))
}
