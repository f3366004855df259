//! Calls the public functions that exist without features by their paths, with arguments that the
//! compiler does not know. The script `proofs/reached.py` compares the paths in this folder and in
//! its parent with the list of the public API.

mod address;
mod machines;
mod operation;
mod shown;
mod streams;
mod value;

use core::hint::black_box;

use ads_cnc::CncStr;

/// The length in bytes of a buffer that is large enough for any stream of variables.
const ROOM: usize = 2200;

/// Returns the value in a way that hides it from the compiler.
fn any<T>(value: T) -> T {
    black_box(value)
}

/// Uses a value, so that the compiler must compute it.
fn seen<T>(value: T) {
    black_box(&value);
}

/// The bytes as text if they are valid UTF-8 and do not begin with a NUL; otherwise `other`, hidden
/// from the compiler.
fn text<'a>(bytes: &'a [u8], other: &'a str) -> &'a str {
    core::str::from_utf8(bytes).ok().filter(|text| !text.starts_with('\0')).unwrap_or(any(other))
}

fn cnc(bytes: &[u8]) -> CncStr<'_> {
    CncStr::from_bytes(bytes).unwrap_or(CncStr::EMPTY)
}

/// Calls the functions of all modules of this folder and ignores their results.
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
