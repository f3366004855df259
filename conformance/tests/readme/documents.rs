//! Finds the documents and the calls that they show.

use std::fs;
use std::path::Path;

use super::bench::{Bench, root};
use super::shown::{Shown, calls};

/// The starts of the calls that only gate.rs executes, because they need a build by cargo, Python
/// 3, or minutes.
pub(crate) const IN_THE_GATE: [&str; 4] =
    ["cargo run ", "ads-cnc selftest", "ads-cnc run --testee ", "ads-cnc run --client "];

/// The path and the text of each Markdown file, except in folders of generated files.
pub(crate) fn texts() -> Vec<(String, String)> {
    let mut found = Vec::new();
    add(&root(), "", &mut found);
    found.sort();
    found
}

fn add(folder: &Path, prefix: &str, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        let is_left_out = ["target", ".git", "corpus", "node_modules"].contains(&name.as_str());
        let path = format!("{prefix}{name}");
        if entry.file_type().unwrap().is_dir() && !is_left_out {
            add(&entry.path(), &format!("{path}/"), found);
        } else if name.ends_with(".md") {
            found.push((path, fs::read_to_string(entry.path()).unwrap()));
        }
    }
}

/// The documents that show calls: the path of each, and its calls.
pub(crate) fn documents() -> Vec<(String, Vec<Shown>)> {
    let shown = texts().into_iter().map(|(path, text)| (path, calls(&text)));
    shown.filter(|(_, shown)| !shown.is_empty()).collect()
}

pub(crate) fn is_in_the_gate(call: &str) -> bool {
    IN_THE_GATE.iter().any(|start| call.starts_with(start) || call == start.trim_end())
}

/// Executes the calls for which `is_meant` returns true, and returns their number. The calls of a document
/// are executed in order, because a call may need the files of a previous call.
pub(crate) fn make(is_meant: impl Fn(&str) -> bool) -> usize {
    let mut made = 0;
    for (path, shown) in documents() {
        let bench = Bench::new(&path.replace('/', "-"), &shown);
        for one in shown.iter().filter(|one| is_meant(&one.call)) {
            bench.make(one);
            made += 1;
        }
    }
    made
}
