//! The calls of documents that need a build by cargo, Python 3, or minutes. `.ci/run` runs this
//! test; `cargo test --workspace` omits it. The environment variable `ADS_CNC_TOOL` may name a
//! release build of the tool, which saves minutes.

mod bench;
#[path = "../common/mod.rs"]
mod common;
mod documents;
mod shown;

use documents::{is_in_the_gate, make};

#[test]
fn calls_print_the_output_in_the_documents() {
    let made = make(is_in_the_gate);
    assert!(made >= 7, "{made} calls");
}
