//! Every public function by its path, with arguments that the compiler does not know. reached.py
//! holds the paths against the list of the public API.

mod address;
mod machines;
mod operation;
mod shown;
mod streams;
mod value;

use core::hint::black_box;

use ads_cnc::CncStr;

/// Room for any variable.
const ROOM: usize = 2200;

/// What the compiler does not know to be this.
fn any<T>(value: T) -> T {
    black_box(value)
}

/// What the compiler has to work out.
fn seen<T>(value: T) {
    black_box(&value);
}

/// Text of the bytes, if they are some; else what the compiler does not know to be this.
fn text<'a>(bytes: &'a [u8], other: &'a str) -> &'a str {
    core::str::from_utf8(bytes).ok().filter(|text| !text.starts_with('\0')).unwrap_or(any(other))
}

fn cnc(bytes: &[u8]) -> CncStr<'_> {
    CncStr::from_bytes(bytes).unwrap_or(CncStr::EMPTY)
}

/// Runs all of it; what comes of it does not matter.
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
