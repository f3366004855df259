//! The calls of documents that need Python 3, or minutes. `cargo test --workspace` leaves this out;
//! `.ci/run` runs it. `ADS_CNC_TOOL` names the tool as it was built for release, which takes minutes
//! less.

mod bench;
#[path = "../common/mod.rs"]
mod common;
mod documents;
mod shown;

use documents::{is_in_the_gate, make};

#[test]
fn calls_show_what_the_documents_have() {
    let made = make(is_in_the_gate);
    assert!(made >= 8, "{made} calls");
}
