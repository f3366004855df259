//! Modules import only modules below them.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules, from the top floor down.
const FLOORS: &[&str] = &[
    "cli",
    "selftest",
    "matrix",
    "capture",
    "clients",
    "suite",
    "testee",
    "named",
    "objects",
    "session",
    "report",
    "client",
    "faults",
    "simulator",
    "net",
    "exchange",
    "gate",
    "process",
    "explain",
    "codec",
    "show",
    "judge",
    "values",
    "profile",
    "edition",
    "services",
    "deadline",
    "text",
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        // Tests may use any module.
        if path.file_stem().is_some_and(|name| name == "tests") {
            continue;
        }
        match path.is_dir() {
            true => sources(&path, found),
            false => found.push(path),
        }
    }
}

fn floor(module: &str) -> usize {
    let found = FLOORS.iter().position(|floor| *floor == module);
    found.unwrap_or_else(|| panic!("the module {module} is on no floor: add it to FLOORS"))
}

/// The modules that a line names after `crate::`.
fn imported(line: &str) -> impl Iterator<Item = &str> {
    let code = line.split("//").next().unwrap_or_default();
    code.split("crate::").skip(1).map(|rest| {
        rest.split(|other: char| !other.is_ascii_lowercase() && other != '_').next().unwrap()
    })
}

#[test]
fn no_module_imports_one_above_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut files, mut upward, mut arrows) = (Vec::new(), Vec::new(), 0);
    sources(&root, &mut files);
    for file in files {
        let path = file.strip_prefix(&root).unwrap();
        let top = path.iter().next().unwrap().to_str().unwrap();
        let module = top.strip_suffix(".rs").unwrap_or(top);
        if ["lib", "main", "floors"].contains(&module) {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        for (line, content) in (1..).zip(text.lines()) {
            for import in imported(content).filter(|import| !import.is_empty()) {
                arrows += 1;
                if import != module && floor(import) <= floor(module) {
                    upward.push(format!("{}:{line}: {module} -> {import}", path.display()));
                }
            }
        }
    }
    assert!(arrows > 500, "only {arrows} imports were found");
    assert!(upward.is_empty(), "imports of a module above:\n{}", upward.join("\n"));
}
