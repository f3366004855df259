//! The documents show the real output of the tools: this test and readme/gate.rs execute the calls
//! in blocks ```console, except those in [`ELSEWHERE`], and compare the output with the document.

#[path = "readme/bench.rs"]
mod bench;
mod common;
// `conformance/doc/dependencies.md` lists the crates of a build for Linux.
#[cfg(target_os = "linux")]
#[path = "readme/dependencies.rs"]
mod dependencies;
#[path = "readme/documents.rs"]
mod documents;
#[path = "readme/floors.rs"]
mod floors;
#[path = "readme/links.rs"]
mod links;
#[path = "readme/sections.rs"]
mod sections;
#[path = "readme/shown.rs"]
mod shown;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use bench::root;
use documents::{IN_THE_GATE, documents, is_in_the_gate, make};

/// Calls that neither this test nor readme/gate.rs executes: the start of the call, the file that
/// executes or replaces it, and a text that this file must contain.
const ELSEWHERE: [(&str, &str, &str); 4] = [
    ("cargo test --workspace", ".ci/run", "cargo test --workspace --locked"),
    ("cargo install ", ".ci/run", "cargo install --path conformance --locked"),
    ("fuzz/nightly ", ".ci/run", "fuzz/nightly --seconds 0"),
    // `cat` is not executed: its output in the document is written to the file, before any call.
    ("cat ", "conformance/tests/readme/bench.rs", "strip_prefix(\"cat \")"),
];

fn is_elsewhere(call: &str) -> bool {
    ELSEWHERE.iter().any(|(start, ..)| call.starts_with(start))
}

#[test]
fn calls_print_the_output_in_the_documents() {
    let made = make(|call| !is_elsewhere(call) && !is_in_the_gate(call));
    assert!(made >= 15, "{made} calls");
}

/// CONTRIBUTING names each script of this repository that the gate, `.ci/run`, or the workflow of a
/// change names, except those of the adapters.
#[test]
fn every_script_of_the_gate_is_documented() {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    let gate = read(".ci/run") + &read(".github/workflows/ci.yml");
    let told = read(".github/CONTRIBUTING.md");
    let words = gate.lines().filter(|line| !line.trim_start().starts_with('#'));
    let words =
        words.flat_map(|line| line.split(|at: char| at.is_whitespace() || "\"$()".contains(at)));
    let is_script = |word: &&str| {
        let folder = word.split('/').next().unwrap_or_default();
        [".ci", "codec", "conformance", "fuzz", "spec-vectors"].contains(&folder)
            && Path::new(word).extension().is_none_or(|extension| extension == "py")
            && root().join(word).is_file()
    };
    let scripts: BTreeSet<&str> = words.filter(is_script).collect();
    assert!(scripts.len() >= 15, "{scripts:?}");
    // Other documents show the calls of the adapters.
    for script in scripts.iter().filter(|script| !script.contains("/adapters/")) {
        assert!(told.contains(script), "{script}");
    }
}

/// Each call in `ELSEWHERE` is shown in a document, and the file that executes or replaces the call
/// contains the stated text; documents also show the calls that readme/gate.rs executes.
#[test]
fn other_calls_are_executed_elsewhere() {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    let documents = documents();
    let names: Vec<&str> = documents.iter().map(|(path, _)| path.as_str()).collect();
    for expected in ["README.md", "conformance/TOOLS.md"] {
        assert!(names.contains(&expected), "{names:?}");
    }
    let has = |start: &str| {
        let mut all = documents.iter().flat_map(|(_, shown)| shown);
        all.any(|one| one.call.starts_with(start.trim_end()))
    };
    for start in IN_THE_GATE {
        assert!(has(start), "no call begins with {start}");
    }
    assert!(read(".ci/run").contains("--test readme_gate"));
    for (start, path, text) in ELSEWHERE {
        assert!(has(start), "no call begins with {start}");
        assert!(read(path).contains(text), "{path}: {text}");
    }
}

/// TOOLS.md names every command, and every option in TOOLS.md and in the README exists, except in
/// lines with other programs.
#[test]
fn documented_commands_and_options_exist() {
    let help = |words: &[&str]| {
        let help = Command::new(env!("CARGO_BIN_EXE_ads-cnc")).args(words).output().unwrap();
        String::from_utf8(help.stdout).unwrap()
    };
    let overview = help(&["--help"]);
    let (tools, _) = overview.split_once("\nOptions:").unwrap();
    let tools = tools.lines().filter_map(|line| line.strip_prefix("  "));
    let tools: Vec<&str> = tools.map(|line| line.split_whitespace().next().unwrap()).collect();
    assert!(tools.len() > 10, "{tools:?}");
    let options: String = tools.iter().map(|tool| help(&[tool, "--help"])).collect();
    let is_option = |word: &str| options.split(|c: char| !is_word(c)).any(|option| option == word);

    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    let document = read("conformance/TOOLS.md");
    for tool in tools {
        assert!(tool == "help" || document.contains(&format!("ads-cnc {tool}")), "{tool}");
    }
    for text in [read("README.md"), document] {
        for line in text
            .lines()
            .filter(|line| !["cargo ", "fuzz/", "docker "].iter().any(|it| line.contains(it)))
        {
            let words = line.split(|character: char| !is_word(character));
            // Skips the lines of dashes in tables.
            let options = words.filter(|word| word.strip_prefix("--").is_some_and(is_name));
            for word in options {
                assert!(is_option(word), "{word} in {line}");
            }
        }
    }
}

fn is_name(word: &str) -> bool {
    word.starts_with(|character: char| character.is_ascii_lowercase())
}

fn is_word(character: char) -> bool {
    character.is_ascii_lowercase() || character == '-'
}
