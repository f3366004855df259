//! Tests of the codec, in one program: most use the same samples and laws, and a link takes longer than most
//! of them run.

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

/// Cargo does not look for test files here, so that all are in one program.
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
