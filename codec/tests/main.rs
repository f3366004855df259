//! The tests of the codec, except those of allocations, in one program: most of them use the same
//! samples and laws (`common`), and linking a program takes longer than running most of the tests.

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

/// Every `.rs` file of this folder is a module of this program. Cargo does not search this folder
/// for tests, because Cargo.toml sets `autotests = false`.
#[test]
fn every_file_is_a_module() {
    let modules = include_str!("main.rs");
    let files = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests")).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    for name in names.filter(|name| name != "main.rs") {
        let Some(name) = name.strip_suffix(".rs") else { continue };
        assert!(modules.contains(&format!("\nmod {name};")), "{name}.rs is not in main.rs");
    }
}

/// `src/lib.rs` denies the lints of clippy against code that can panic.
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
