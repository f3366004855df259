//! The quick tests as one binary, so that each mutant needs one link instead of one for each file. Tests that
//! generate many cases are excluded; the second pass runs them on the survivors.

#![allow(clippy::duplicate_mod, reason = "each file includes the common code as its own module")]

#[path = "../tests/addresses.rs"]
mod addresses;
#[path = "../tests/arbitrary.rs"]
mod arbitrary;
#[path = "../tests/binrw.rs"]
mod binrw;
#[path = "../tests/codes.rs"]
mod codes;
#[path = "../tests/containers.rs"]
mod containers;
#[path = "../tests/content.rs"]
mod content;
#[path = "../tests/copies.rs"]
mod copies;
#[path = "../tests/cp1252.rs"]
mod cp1252;
#[path = "../tests/cuts.rs"]
mod cuts;
#[path = "../tests/dispatch.rs"]
mod dispatch;
#[path = "../tests/equality.rs"]
mod equality;
#[path = "../tests/errata.rs"]
mod errata;
#[path = "../tests/frames.rs"]
mod frames;
#[path = "../tests/join.rs"]
mod join;
#[path = "../tests/json.rs"]
mod json;
#[path = "../tests/limits.rs"]
mod limits;
#[path = "../tests/net_ids.rs"]
mod net_ids;
#[path = "../tests/operations.rs"]
mod operations;
#[path = "../tests/outcomes.rs"]
mod outcomes;
#[path = "../tests/parts.rs"]
mod parts;
#[path = "../tests/paths.rs"]
mod paths;
#[path = "../tests/samples.rs"]
mod samples;
#[path = "../tests/sequences.rs"]
mod sequences;
#[path = "../tests/service.rs"]
mod service;
#[path = "../tests/shown.rs"]
mod shown;
#[path = "../tests/shown_errors.rs"]
mod shown_errors;
#[path = "../tests/streaming.rs"]
mod streaming;
#[path = "../tests/streaming_checker.rs"]
mod streaming_checker;
#[path = "../tests/streaming_findings.rs"]
mod streaming_findings;
#[path = "../tests/table.rs"]
mod table;
#[path = "../tests/tables.rs"]
mod tables;
#[path = "../tests/typed.rs"]
mod typed;
#[path = "../tests/typed_writes.rs"]
mod typed_writes;
#[path = "../tests/values.rs"]
mod values;
#[path = "../tests/vectors.rs"]
mod vectors;

/// The first failure is enough: nothing is drawn again to shrink it, no other test is waited for.
#[test]
fn a_failure_ends_the_run() {
    let shown = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        shown(info);
        std::process::exit(101);
    }));
}
