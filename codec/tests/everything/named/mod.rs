//! Calls every public function by its path, with arguments that the compiler does not know. reached.py
//! compares the paths with the list of the public API.

mod address;
mod machines;
mod operation;
mod shown;
mod streams;
mod value;

use core::hint::black_box;

use ads_cnc::CncStr;

/// The length of a buffer that is large enough for any stream of variables.
const ROOM: usize = 2200;

/// Returns the value, which the compiler then cannot predict.
fn any<T>(value: T) -> T {
    black_box(value)
}

/// Uses a value, so that the compiler must compute it.
fn seen<T>(value: T) {
    black_box(&value);
}

/// The text of the bytes, if they are valid; otherwise a text that the compiler cannot predict.
fn text<'a>(bytes: &'a [u8], other: &'a str) -> &'a str {
    core::str::from_utf8(bytes).ok().filter(|text| !text.starts_with('\0')).unwrap_or(any(other))
}

fn cnc(bytes: &[u8]) -> CncStr<'_> {
    CncStr::from_bytes(bytes).unwrap_or(CncStr::EMPTY)
}

/// Runs everything and ignores the results.
pub(crate) fn runs(bytes: &[u8]) {
    seen(streams::runs(bytes));
    seen(streams::tables(bytes));
    seen(address::runs());
    seen(shown::runs(bytes));
    seen(operation::makers(bytes));
    seen(operation::rules(bytes));
    seen(value::runs(bytes));
    seen(machines::service(bytes));
    seen(machines::streaming(bytes));
}
