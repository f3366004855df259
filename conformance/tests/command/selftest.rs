//! `ads-cnc selftest` with one trial of each kind; the workflow `nightly.yml` runs all trials.

use std::process::{Command, Output};

use serde_json::Value;

fn selftest(only: &[&str]) -> Output {
    let mut call = Command::new(env!("CARGO_BIN_EXE_ads-cnc"));
    call.args(["selftest", "--json", "-"]);
    call.args(only.iter().flat_map(|word| ["--only", word]));
    call.output().unwrap()
}

#[test]
fn one_trial_of_each_kind_has_its_result() {
    let each = [
        ("variable-description.size.flip", "codec", "caught"),
        ("cnc.var.handle-not-understood", "cnc", "caught"),
        ("client.no-error", "client", "caught"),
        ("miniature.accepts-unknown", "miniature", "caught"),
        ("different.pieces-of-40", "different", "quiet"),
        ("ams-tcp-header.reserved.zero", "cnc", "same"),
    ];
    let output = selftest(&each.map(|(id, _, _)| id));
    let shown: Value = serde_json::from_slice(&output.stdout).unwrap();
    let tried = shown["tried"].as_array().unwrap();
    for (id, group, result) in each {
        let mut mine = tried.iter().filter(|one| one["id"] == id && one["group"] == group);
        let one = mine.next().unwrap_or_else(|| panic!("{id} was not tried: {shown:#}"));
        assert_eq!(one["result"], result, "{one:#}");
        assert!(mine.next().is_none(), "{id} was tried twice");
    }
    assert_eq!(output.status.code(), Some(0), "{shown:#}");
}

#[test]
fn an_empty_selection_is_not_a_success() {
    let output = selftest(&["no-such-thing"]);
    assert_eq!(output.status.code(), Some(3));
}
