//! Names of variables.

use crate::common::names::{NameMutation, check_name};
use crate::{Defect, Outcome};

/// Input: a name in CP1252, up to its first NUL.
///
/// Parsed from CP1252 and from UTF-8, the name has the same parts or the same fault. The parts are those
/// that simple splitting of the string finds, and joining them gives the name again. The characters
/// of a name before the offset of its fault are a valid name, or a valid beginning of one.
pub(crate) fn path(data: &[u8], defect: Defect) -> Outcome {
    let text = data.split(|&byte| byte == 0).next().unwrap_or(data);
    match check_name(text, mutation(defect)) {
        Ok(pieces) => Outcome::accepted(format!("{pieces:?}")),
        Err(fault) => Outcome::rejected(format!("{fault:?}")),
    }
}

pub(crate) const DEFECTS: &[&str] = &[
    "an index above 255 loses its upper bits",
    "the kind V.CYC is read as V.C",
    "the fourth part is lost",
    "the offset of an error after the tenth character is off by one",
    "a name of more than thirty characters is written without the last character",
];

fn mutation(defect: Defect) -> NameMutation {
    let mut mutation = NameMutation::NONE;
    if defect.is(1) {
        mutation.pieces = |pieces| {
            let indices = pieces.parts.iter_mut().flat_map(|(_, indices)| indices);
            indices.for_each(|index| *index &= 0xFF);
        };
    }
    if defect.is(2) {
        mutation.pieces = |pieces| pieces.kind = pieces.kind.replace("CYC", "C");
    }
    if defect.is(3) {
        mutation.pieces = |pieces| pieces.parts.truncate(3);
    }
    if defect.is(4) {
        mutation.fault = |mut fault| {
            fault.offset -= usize::from(fault.offset > 10);
            fault
        };
    }
    if defect.is(5) {
        mutation.written = |mut name| {
            if name.chars().count() > 30 {
                name.pop();
            }
            name
        };
    }
    mutation
}
