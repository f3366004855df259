//! Tests with pairs of defects that the failure of one clause does not hide another broken clause.

use serde::Serialize;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;

use super::device::Device;
use super::found::{DetectionResult, Mode};
use super::table::DetectionTable;
use crate::edition::Edition;
use crate::faults::{self, FieldDefect, Seed};
use crate::judge::{follows, order};
use crate::selftest::parallel::{Tell, parallel};
use crate::selftest::tried::{TrialResult, judge};
use crate::session::ToolError;

/// Number of tried pairs.
pub const PAIRS: usize = 200;

/// The seed that selects the pairs; it is constant, so that the following list is complete.
const SEED: u32 = 24;

/// Pairs in which a defect of the first field hides one of the second. Only a read of elements by handle
/// shows a wrong dimension (VAR-4); the description alone shows a breach of VAR-8. The value
/// of a parameter is compared with the value of the variable with its name.
const MASKED: [(&str, &str); 3] = [
    ("variable-handle-read", "variable-description.dimensions"),
    ("variable-handle-read", "dynamic-value.value"),
    ("variable-description", "dynamic-value.value"),
];

/// Pairs of defects in different fields, each detected alone without a profile.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PairFigures {
    /// Both are detected.
    pub both: usize,
    /// The request or the expectation for one depends on the reply of the other, and only the clause of
    /// the other fails.
    pub masked: usize,
    /// One hides the other, although they do not depend on each other.
    pub hidden: Vec<String>,
}

/// Tries the pairs.
pub(crate) fn pairs(table: &DetectionTable, tell: Tell<'_>) -> PairFigures {
    let mut figures = PairFigures::default();
    let tried = parallel(
        ("pairs of defects", &chosen(table)),
        1,
        |pair| (pair.clone(), try_pair(pair)),
        |(_, detected)| detected.is_err(),
        tell,
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

/// Pairs of defects that are caught alone.
fn chosen(table: &DetectionTable) -> Vec<(FieldDefect, FieldDefect)> {
    let is_caught = |seed: &Seed| {
        let found = table.row(seed).and_then(|row| row.modes.get(&Mode::ReadOnly));
        found.is_some_and(|found| found.result == DetectionResult::Caught)
    };
    let seeds = faults::all().iter().filter(|seed| is_caught(seed));
    let mut all: Vec<&FieldDefect> = seeds.filter_map(Seed::field).collect();
    all.sort_by_key(|defect| order(SEED, &defect.id));
    let distances = 1..all.len();
    let pairs = distances.flat_map(|distance| {
        let others = all.iter().cycle().skip(distance);
        all.iter().zip(others).map(|(one, other)| (*one, *other))
    });
    let pairs = pairs.filter(|(one, other)| (one.stream, one.field) != (other.stream, other.field));
    pairs.take(PAIRS).map(|(one, other)| (one.clone(), other.clone())).collect()
}

/// Whether each defect of a pair is detected by a clause that it breaks.
fn try_pair((one, other): &(FieldDefect, FieldDefect)) -> Result<(bool, bool), ToolError> {
    let device = Device::of_edition(Edition::English)?;
    let outcomes = device.outcomes_with(vec![one.clone(), other.clone()], Mode::ReadOnly)?;
    let detected = |defect: &FieldDefect| {
        let seed = Seed::from(defect.clone());
        judge(&seed.requirements, &outcomes).1 == TrialResult::Caught
    };
    Ok((detected(one), detected(other)))
}

/// Whether the field belongs to a frame or an ADS service, and not to a function.
fn is_of_frames(defect: &FieldDefect) -> bool {
    functions(defect.stream).is_empty()
}

/// Whether a wrong field can make another one undetectable, because it belongs to an earlier function
/// or to the same function. A wrong frame may make everything undetectable; the clause of a service
/// is the cause only if no function of another service fails.
fn can_mask(masking: &FieldDefect, masked: &FieldDefect) -> bool {
    let listed = MASKED
        .iter()
        .any(|(one, other)| masking.id.starts_with(one) && masked.id.starts_with(other));
    let (first, then) = (functions(masking.stream), functions(masked.stream));
    let depends =
        first.iter().any(|one| then.iter().any(|other| one == other || follows(*other, *one)));
    listed || is_of_frames(masking) || is_of_frames(masked) || depends
}

/// The functions whose request or reply is the stream or contains it as a record; none for a stream
/// of frames.
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
