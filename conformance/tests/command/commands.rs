//! Tests that the README of this package names exactly the commands of `ads-cnc`.

use std::collections::BTreeSet;
use std::process::Command;

#[test]
fn the_readme_has_exactly_the_commands() {
    let help = Command::new(env!("CARGO_BIN_EXE_ads-cnc")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let (commands, _) = help.split_once("\nOptions:").unwrap();
    let indented = commands.lines().filter_map(|line| line.strip_prefix("  "));
    let commands: BTreeSet<&str> =
        indented.filter_map(|line| line.split_whitespace().next()).collect();
    let readme = include_str!("../../README.md");
    let row = |line: &'static str| line.strip_prefix("| `ads-cnc ")?.split('`').next();
    let named: BTreeSet<&str> = readme.lines().filter_map(row).collect();
    assert!(named.len() > 10, "{named:?}");
    assert_eq!(commands.into_iter().filter(|name| *name != "help").collect::<BTreeSet<_>>(), named);
}
