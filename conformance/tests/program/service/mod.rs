//! The Service Interface: the examples of the manuals, the order of writes, the limits, and failures.

mod channel;
mod examples;
mod failures;
mod values;

use ads_cnc::{Error, ErrorKind};

/// The parts of an error that tests compare.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) kind: ErrorKind,
    pub(crate) field: &'static str,
    pub(crate) offset: usize,
    pub(crate) expected: usize,
    pub(crate) found: usize,
}

impl Fault {
    pub(crate) fn of(error: Error) -> Self {
        Self {
            kind: error.kind(),
            field: error.field().name(),
            offset: error.offset() as usize,
            expected: error.expected() as usize,
            found: error.found() as usize,
        }
    }
}

/// Creates an expected error; of the two numbers, the first is the expected and the second the found
/// number.
pub(crate) fn fault(
    kind: ErrorKind,
    field: &'static str,
    offset: usize,
    (expected, found): (usize, usize),
) -> Fault {
    Fault { kind, field, offset, expected, found }
}
