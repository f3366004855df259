//! The parts of errors, for comparison in tests.

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

/// A fault that a test expects.
pub(crate) fn fault(
    kind: ErrorKind,
    field: &'static str,
    offset: usize,
    (expected, found): (usize, usize),
) -> Fault {
    Fault { kind, field, offset, expected, found }
}

/// The fault of a result that must be an error.
#[track_caller]
pub(crate) fn fault_of<T>(result: Result<T, Error>) -> Fault {
    Fault::of(result.err().expect("an error"))
}
