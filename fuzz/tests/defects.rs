//! Tests that the corpora detect the seeded defects, except those listed below, on stable Rust and
//! without a fuzzer.

// Without these features a target is missing or checks fewer laws.
#![cfg(all(feature = "arbitrary", feature = "binrw", feature = "tools"))]

use std::collections::BTreeSet;
use std::panic::{catch_unwind, set_hook, take_hook};

use ads_cnc_fuzz::{Defect, Folder, TARGETS, corpus};

/// Defects that the corpus of some target does not detect; `fuzz/nightly --prove` finds inputs for them.
const NOT_IN_EVERY_CORPUS: [&str; 6] = [
    "a vector has an extra byte if its last byte is 0",
    "an element at the offset of a function is rejected with a different error",
    "no frame is found while exactly three bytes follow it",
    "a byte 0xB5 is encoded as 0xB4 if there are more than 16 bytes",
    "the last byte loses its top bit when it is encoded",
    "the readings differ if the last byte is odd",
];

/// With any other seeded defect of a target, an input of its corpus breaks a law. The test
/// `corpora_keep_the_laws` verifies that no input breaks a law without a defect.
#[test]
#[cfg_attr(miri, ignore = "too many inputs for an interpreter")]
fn corpora_detect_the_seeded_defects() {
    let hook = take_hook();
    // A detected defect is a panic.
    set_hook(Box::new(|_| ()));
    let mut missed = BTreeSet::new();
    for target in TARGETS {
        let corpus = Folder::new(&corpus(target.name));
        let inputs: Vec<_> = corpus.files().map(|(_, bytes)| bytes).collect();
        for (number, title) in (1..).zip(target.defects) {
            let run = |bytes: &Vec<u8>| catch_unwind(|| target.run(bytes, Defect::new(number)));
            if inputs.iter().all(|bytes| run(bytes).is_ok()) {
                missed.insert((*title, target.name));
            }
        }
    }
    set_hook(hook);
    let titles: BTreeSet<_> = missed.iter().map(|(title, _)| *title).collect();
    assert_eq!(titles, BTreeSet::from(NOT_IN_EVERY_CORPUS), "{missed:#?}");
}
