//! The seeded defects, on stable Rust and without a fuzzer.

// Without these features a target is missing or checks fewer laws.
#![cfg(all(feature = "arbitrary", feature = "binrw", feature = "tools"))]

use std::collections::BTreeSet;
use std::panic::{catch_unwind, set_hook, take_hook};

use ads_cnc_fuzz::{Defect, Folder, TARGETS, corpus};

/// Defects that no input of the corpus of some target shows: `fuzz/nightly --prove` finds those inputs.
const NOT_IN_EVERY_CORPUS: [&str; 6] = [
    "a vector has a byte too much if the last is 0",
    "an element that is another function is refused for something else",
    "no frame comes out as long as there are just three bytes behind it",
    "of more than 16 bytes one of 0xB5 becomes 0xB4 when it is encoded",
    "the last byte loses its top bit when it is encoded",
    "the readings differ if the last byte is odd",
];

/// Each other defect of a target makes an input of its corpus break a law. Without a defect none does:
/// `corpora_keep_the_laws`.
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
