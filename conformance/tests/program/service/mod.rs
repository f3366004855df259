//! The Service Interface: the examples of the manuals, the order of what is written, the limits,
//! and what happens when something goes wrong.

mod channel;
mod examples;
mod failures;
mod values;

use ads_cnc::{Error, ErrorKind};

/// An error in the parts that tests compare.
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

/// A fault as a person writes it down; of the numbers, the one expected comes first.
pub(crate) fn fault(
    kind: ErrorKind,
    field: &'static str,
    offset: usize,
    (expected, found): (usize, usize),
) -> Fault {
    Fault { kind, field, offset, expected, found }
}
