//! Tests that dependencies.md states the reason for every crate on which the tools depend.

use std::collections::BTreeSet;
use std::process::Command;
use std::{env, fs};

use super::root;

#[test]
fn every_crate_has_a_reason() {
    let tree = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()))
        .args(["tree", "-p", "ads-cnc-conformance", "-e", "normal,build", "--prefix", "none"])
        .args(["--locked", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let tree = String::from_utf8(tree.stdout).unwrap();
    let named = |line: &str| line.split(' ').take(2).map(str::to_owned).collect::<Vec<_>>();
    let versions: BTreeSet<Vec<String>> =
        tree.lines().map(named).filter(|words| !words[0].starts_with("ads-cnc")).collect();
    let crates: BTreeSet<&str> = versions.iter().map(|words| words[0].as_str()).collect();

    let document = fs::read_to_string(root().join("conformance/doc/dependencies.md")).unwrap();
    let (used, _) = document.split_once("## Considered and not used").unwrap();
    let quoted = used.split('`').skip(1).step_by(2);
    // Options and this project's own crates are quoted, too, but are not dependencies.
    let quoted = quoted.filter(|word| !word.starts_with('-') && !word.starts_with("ads-cnc"));
    assert_eq!(quoted.collect::<BTreeSet<_>>(), crates);
    let counted = format!("built from {} crates", versions.len());
    assert!(document.contains(&counted), "{counted}");
}
