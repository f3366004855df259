//! A module of `conformance/src` imports only modules below it, in the order of the table in
//! `lib.rs`. What is `#[cfg(test)]` may import any.

use std::fs;
use std::path::Path;

use super::bench::root;

/// An import of a module by a line of another module.
struct Arrow {
    from: String,
    to: String,
    at: String,
}

/// The arrows of all files in a folder, each by its path below `src`.
fn arrows(folder: &Path, prefix: &str, found: &mut Vec<Arrow>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        let path = format!("{prefix}{name}");
        match (entry.file_type().unwrap().is_dir(), name.as_str()) {
            (_, "tests" | "tests.rs" | "lib.rs" | "main.rs") => {}
            (true, _) => arrows(&entry.path(), &format!("{path}/"), found),
            (false, _) if name.ends_with(".rs") => {
                of_text(&path, &fs::read_to_string(entry.path()).unwrap(), found);
            }
            _ => {}
        }
    }
}

fn of_text(path: &str, text: &str, found: &mut Vec<Arrow>) {
    let from = path.split('/').next().unwrap().trim_end_matches(".rs");
    let depth = path.trim_end_matches("/mod.rs").split('/').count();
    let lines = (1..).zip(text.lines()).take_while(|(_, line)| *line != "mod tests {");
    for (number, line) in lines.filter(|(_, line)| !line.trim_start().starts_with("//")) {
        let at = format!("conformance/src/{path}:{number}");
        assert!(!line.contains(&"super::".repeat(depth)), "{at}: write `crate::`, not `super::`");
        for import in line.split("crate::").skip(1) {
            let to = import.split(|one: char| one != '_' && !one.is_alphanumeric()).next().unwrap();
            assert!(!to.is_empty(), "{at}: one `use` for each module");
            found.push(Arrow { from: from.to_owned(), to: to.to_owned(), at: at.clone() });
        }
    }
}

/// The modules from the top down, as the table of `lib.rs` has them.
fn floors(lib: &str) -> Vec<&str> {
    let rows = lib.lines().filter_map(|line| line.strip_prefix("//! | [")?.split(" | ").next());
    rows.flat_map(|row| row.split('`').skip(1).step_by(2)).collect()
}

#[test]
fn modules_import_what_is_below_them() {
    let src = root().join("conformance/src");
    let lib = fs::read_to_string(src.join("lib.rs")).unwrap();
    let floors = floors(&lib);
    let mut declared: Vec<&str> =
        lib.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    declared.sort_unstable();
    let mut listed = floors.clone();
    listed.sort_unstable();
    assert_eq!(listed, declared, "the table in conformance/src/lib.rs lists every module once");
    let mut all = Vec::new();
    arrows(&src, "", &mut all);
    // A name that no module has is above all modules.
    let floor = |module: &str| floors.iter().position(|floor| *floor == module);
    all.retain(|arrow| floor(&arrow.to) < floor(&arrow.from));
    let upward = all.iter().map(|Arrow { from, to, at }| format!("{at}: {from} -> {to}"));
    let upward: Vec<String> = upward.collect();
    assert!(upward.is_empty(), "imports of a module above:\n{}", upward.join("\n"));
}
