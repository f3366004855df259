//! The integration tests of the crate `ads-cnc`, except `tests/allocation`, in one program, because
//! many of them use the same samples and laws (`common`) and every further program has to be
//! linked.

use std::fs;
use std::path::Path;

mod common;
mod damage;
mod kept;

mod addresses;
mod arbitrary;
mod binrw;
mod codes;
mod containers;
mod content;
mod copies;
mod cp1252;
mod cuts;
mod dispatch;
mod equality;
mod errata;
mod frames;
mod functions;
mod join;
mod json;
mod kept_cases;
mod limits;
mod net_ids;
mod operations;
mod outcomes;
mod own_content;
mod parts;
mod paths;
mod properties;
mod samples;
mod sequences;
mod service;
mod shown;
mod shown_errors;
mod streaming;
mod streaming_checker;
mod streaming_findings;
mod table;
mod tables;
mod typed;
mod typed_writes;
mod values;
mod vectors;

/// Every other `.rs` file directly in this folder is a module of this program. Cargo does not
/// search this folder for tests, because Cargo.toml sets `autotests = false`.
#[test]
fn every_file_is_a_module() {
    let modules = include_str!("main.rs");
    let files = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    for name in names.filter(|name| name != "main.rs") {
        let Some(name) = name.strip_suffix(".rs") else { continue };
        assert!(modules.contains(&format!("\nmod {name};")), "{name}.rs is not in main.rs");
    }
}

/// The library names lints of Clippy in its block `deny`, which has eight, and in two exceptions.
#[test]
fn lints_have_two_exceptions() {
    fn exceptions(folder: &Path) -> usize {
        let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        paths.map(|path| if path.is_dir() { exceptions(&path) } else { in_file(&path) }).sum()
    }
    fn in_file(path: &Path) -> usize {
        let text = fs::read_to_string(path).unwrap();
        text.matches("clippy::").count() - text.matches("clippy::upper_case_acronyms").count()
    }
    assert_eq!(exceptions(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"))), 8 + 2);
}

/// The block `deny` of `src/lib.rs` that does not apply to unit tests contains exactly these lints
/// of Clippy.
#[test]
fn lints_reject_panics_in_the_library() {
    let (_, lints) = include_str!("../src/lib.rs").split_once("    not(test),\n    deny(").unwrap();
    let (lints, _) = lints.split_once("\n    )\n)]").unwrap();
    let lints: String = lints.split_whitespace().map(|lint| lint.replace("clippy::", "")).collect();
    assert_eq!(
        lints,
        "arithmetic_side_effects,as_conversions,expect_used,indexing_slicing,panic,string_slice,\
         unreachable,unwrap_used"
    );
}
