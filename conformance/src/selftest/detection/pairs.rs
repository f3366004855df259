//! Tests, with pairs of defects, that the failure of one clause does not hide the violation of
//! another.

use serde::Serialize;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;

use super::detection_result::{DetectionResult, Mode};
use super::device::Device;
use super::table::DetectionTable;
use crate::edition::Edition;
use crate::faults::{self, FieldDefect, SeededDefect};
use crate::judge::{follows, order};
use crate::selftest::parallel::{ProgressCallback, parallel};
use crate::selftest::trial::{TrialResult, judge};
use crate::session::ToolError;

/// Number of pairs that are tried.
pub const PAIRS: usize = 200;

/// The random seed that selects the pairs. The seed is constant, because `MASKED` is complete only
/// for the pairs that this seed selects.
const SEED: u32 = 24;

/// Pairs of ID prefixes: a defect whose ID starts with the first prefix can hide a defect whose ID
/// starts with the second. For example, a read of elements by handle detects a wrong dimension in a
/// description (VAR-4), and the value of a dynamic parameter is compared with the value of the
/// variable of the same name.
const MASKED: [(&str, &str); 3] = [
    ("variable-handle-read", "variable-description.dimensions"),
    ("variable-handle-read", "dynamic-value.value"),
    ("variable-description", "dynamic-value.value"),
];

/// The results of pairs of defects in different fields. Each defect alone is caught in the mode
/// `ReadOnly`.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PairFigures {
    /// Number of pairs of which both defects are detected.
    pub both: usize,
    /// Number of pairs of which only one defect is detected, and it can make the other undetectable,
    /// plus the number of pairs of two defects of frames of which neither is detected.
    pub masked: usize,
    /// All other pairs: those in which a defect is not detected without such a reason, and those
    /// that could not be tried.
    pub hidden: Vec<String>,
}

/// Tries [`PAIRS`] pairs of defects that are caught according to the table.
pub(crate) fn pairs(table: &DetectionTable, report_progress: ProgressCallback<'_>) -> PairFigures {
    let mut figures = PairFigures::default();
    let tried = parallel(
        ("pairs of defects", &chosen(table)),
        1,
        |pair| (pair.clone(), try_pair(pair)),
        |(_, detected)| detected.is_err(),
        report_progress,
    );
    for ((one, other), detected) in tried {
        let name = || format!("{} and {}", one.id, other.id);
        match detected {
            Err(error) => figures.hidden.push(format!("{}: {error}", name())),
            Ok((true, true)) => figures.both += 1,
            // Two defects of frames may hide each other.
            Ok((false, false)) if [&one, &other].iter().all(|it| is_of_frames(it)) => {
                figures.masked += 1;
            }
            Ok((false, false)) => figures.hidden.push(format!("{}: neither is detected", name())),
            Ok((is_first, _)) => {
                let (masking, masked) = if is_first { (&one, &other) } else { (&other, &one) };
                if can_mask(masking, masked) {
                    figures.masked += 1;
                } else {
                    figures.hidden.push(format!("{}: {} is not detected", name(), masked.id));
                }
            }
        }
    }
    figures
}

/// The pairs of field defects to try, each of which is caught alone.
fn chosen(table: &DetectionTable) -> Vec<(FieldDefect, FieldDefect)> {
    let is_caught = |defect: &SeededDefect| {
        let found = table.row(defect).and_then(|row| row.modes.get(&Mode::ReadOnly));
        found.is_some_and(|found| found.result == DetectionResult::Caught)
    };
    let caught = faults::all().iter().filter(|defect| is_caught(defect));
    let mut all: Vec<&FieldDefect> = caught.filter_map(SeededDefect::field).collect();
    all.sort_by_key(|defect| order(SEED, &defect.id));
    let distances = 1..all.len();
    let pairs = distances.flat_map(|distance| {
        let others = all.iter().cycle().skip(distance);
        all.iter().zip(others).map(|(one, other)| (*one, *other))
    });
    let pairs = pairs.filter(|(one, other)| (one.stream, one.field) != (other.stream, other.field));
    pairs.take(PAIRS).map(|(one, other)| (one.clone(), other.clone())).collect()
}

/// For each of the two defects, whether the defect is caught.
fn try_pair((one, other): &(FieldDefect, FieldDefect)) -> Result<(bool, bool), ToolError> {
    let device = Device::of_edition(Edition::English)?;
    let outcomes = device.outcomes_with(vec![one.clone(), other.clone()], Mode::ReadOnly)?;
    let detected = |field: &FieldDefect| {
        let defect = SeededDefect::from(field.clone());
        judge(&defect.requirements, &outcomes).1 == TrialResult::Caught
    };
    Ok((detected(one), detected(other)))
}

/// Whether the field of the defect belongs to a frame or an ADS service, and not to the stream of a
/// function.
fn is_of_frames(defect: &FieldDefect) -> bool {
    functions(defect.stream).is_empty()
}

/// Whether the defect `masking` can make the defect `masked` undetectable. It can if `masking` is
/// in a stream of the same function or of one on which that function depends, if one of the two is
/// a defect of a frame, or if [`MASKED`] lists the pair. A wrong frame can make every other defect
/// undetectable, and the suite names the clause of an ADS service as the cause only if no function
/// of another service fails.
fn can_mask(masking: &FieldDefect, masked: &FieldDefect) -> bool {
    let listed = MASKED
        .iter()
        .any(|(one, other)| masking.id.starts_with(one) && masked.id.starts_with(other));
    let (first, then) = (functions(masking.stream), functions(masked.stream));
    let depends =
        first.iter().any(|one| then.iter().any(|other| one == other || follows(*other, *one)));
    listed || is_of_frames(masking) || is_of_frames(masked) || depends
}

/// The functions whose request or reply is the stream, or contains the stream as a record; empty
/// for a stream of frames.
fn functions(stream: Stream) -> Vec<Function> {
    let stream = match stream {
        Stream::ObjectDescriptor => Stream::ObjectDescriptors,
        stream => stream,
    };
    let has = |function: &&Function| {
        let spec = function.spec();
        [spec.request, spec.reply].contains(&Some(stream))
    };
    Function::ALL.iter().filter(has).copied().collect()
}
