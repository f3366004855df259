//! The Service Interface: the examples of the manuals, the order of writes, the limits, and failures.

mod channel;
mod examples;
mod failures;
mod values;

use ads_cnc::{Error, ErrorKind};

/// The parts of an error that tests compare: the kind, the field, the offset, and the expected and the
/// found number.
pub(crate) fn parts(error: Error) -> (ErrorKind, &'static str, u32, u32, u32) {
    (error.kind(), error.field().name(), error.offset(), error.expected(), error.found())
}
