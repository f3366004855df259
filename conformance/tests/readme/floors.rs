//! A module of `conformance/src` imports only itself and modules below it in the table of `lib.rs`,
//! and no files import each other in a circle. Tests may import any module.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use super::bench::root;

/// Maximum number of imports in a chain of modules, so that a reader who follows imports from any module
/// reaches the end after at most this number of imports.
const IMPORTS_MAX: usize = 8;

/// An import: the line `at` of the module `from` names the module `to`, which may be the same
/// module.
struct Arrow {
    from: String,
    to: String,
    at: String,
}

/// Reads the files in a folder, except lib.rs and main.rs: the text of each file without lines of
/// comments, tests and declarations of modules, by its path below `src`.
fn read_files(folder: &Path, prefix: &str, found: &mut BTreeMap<String, String>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        let path = format!("{prefix}{name}");
        match (entry.file_type().unwrap().is_dir(), name.as_str()) {
            (_, "tests" | "tests.rs" | "lib.rs" | "main.rs") => {}
            (true, _) => read_files(&entry.path(), &format!("{path}/"), found),
            (false, _) if name.ends_with(".rs") => {
                let text = fs::read_to_string(entry.path()).unwrap();
                let lines = text.lines().take_while(|line| *line != "mod tests {");
                let is_left_out = |line: &str| {
                    line.trim_start().starts_with("//") || line.rsplit(' ').nth(1) == Some("mod")
                };
                let lines = lines.map(|line| if is_left_out(line) { "" } else { line });
                found.insert(path, lines.collect::<Vec<_>>().join("\n"));
            }
            _ => {}
        }
    }
}

fn arrows(path: &str, text: &str, found: &mut Vec<Arrow>) {
    let from = path.split('/').next().unwrap().trim_end_matches(".rs");
    let depth = path.trim_end_matches("/mod.rs").split('/').count();
    for (number, line) in (1..).zip(text.lines()) {
        let at = format!("conformance/src/{path}:{number}");
        assert!(!line.contains(&"super::".repeat(depth)), "{at}: write `crate::`, not `super::`");
        for import in line.split("crate::").skip(1) {
            let to = import.split(|one: char| one != '_' && !one.is_alphanumeric()).next().unwrap();
            assert!(!to.is_empty(), "{at}: one `use` for each module");
            found.push(Arrow { from: from.to_owned(), to: to.to_owned(), at: at.clone() });
        }
    }
}

/// The modules from top to bottom of the table in `lib.rs`.
fn floors(lib: &str) -> Vec<&str> {
    let rows = lib.lines().filter_map(|line| line.strip_prefix("//! | [")?.split(" | ").next());
    rows.flat_map(|row| row.split('`').skip(1).step_by(2)).collect()
}

#[test]
fn modules_import_only_modules_below_them() {
    let src = root().join("conformance/src");
    let lib = fs::read_to_string(src.join("lib.rs")).unwrap();
    let floors = floors(&lib);
    let mut declared: Vec<&str> =
        lib.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    declared.sort_unstable();
    let mut listed = floors.clone();
    listed.sort_unstable();
    assert_eq!(listed, declared, "the table in conformance/src/lib.rs lists every module once");
    let (mut files, mut all) = (BTreeMap::new(), Vec::new());
    read_files(&src, "", &mut files);
    files.iter().for_each(|(path, text)| arrows(path, text, &mut all));
    // A name that is not a module has the position `None`, which counts as above all modules.
    let floor = |module: &str| floors.iter().position(|floor| *floor == module);
    let mut chains = BTreeMap::new();
    for module in floors.iter().rev() {
        let imported = all.iter().filter(|arrow| arrow.from == *module && arrow.to != *module);
        let below = imported.filter_map(|arrow| chains.get(arrow.to.as_str()));
        let longest =
            below.max_by_key(|chain: &&Vec<&str>| chain.len()).cloned().unwrap_or_default();
        chains.insert(*module, [vec![*module], longest].concat());
    }
    let chain = chains.values().max_by_key(|chain| chain.len()).unwrap();
    let imports = chain.len() - 1;
    assert!(imports <= IMPORTS_MAX, "a chain of {imports} imports: {}", chain.join(" -> "));
    all.retain(|arrow| floor(&arrow.to) < floor(&arrow.from));
    let upward = all.iter().map(|Arrow { from, to, at }| format!("{at}: {from} -> {to}"));
    let upward: Vec<String> = upward.collect();
    assert!(upward.is_empty(), "imports of a module above:\n{}", upward.join("\n"));
}

/// The imports of a file.
struct Module {
    /// The path that each imported name stands for.
    names: BTreeMap<String, String>,
    /// The paths in code and imports, except the paths that the file only re-exports.
    paths: BTreeSet<String>,
}

impl Module {
    fn new(text: &str) -> Self {
        let (mut code, mut imports) = (String::new(), Vec::new());
        // The path in `pub(in path)` is not an import.
        let text = text.replace("pub(in crate", "pub(in");
        for statement in text.split_inclusive(';') {
            let (before, tree) = statement.rsplit_once("use ").unwrap_or((statement, ""));
            let visibility = before.rsplit('\n').next().unwrap().trim();
            if tree.is_empty() || !visibility.is_empty() && !visibility.starts_with("pub") {
                code += statement;
            } else {
                code += before;
                let paths = expand(tree.trim_end_matches(';')).into_iter();
                imports.extend(paths.map(|path| (path, !visibility.is_empty())));
            }
        }
        let words = code.split(|one: char| !one.is_alphanumeric() && !"_:.".contains(one));
        let words: BTreeSet<&str> = words.map(|word| word.trim_matches(':')).collect();
        let used: BTreeSet<&str> =
            words.iter().filter_map(|word| word.split([':', '.']).next()).collect();
        let paths = words.iter().map(|word| word.trim_start_matches('.'));
        let paths = paths.filter(|path| path.contains("::")).map(str::to_owned);
        let (mut names, mut paths) = (BTreeMap::new(), paths.collect::<BTreeSet<_>>());
        for (path, is_public) in &imports {
            let (path, alias) = path.split_once(" as ").unwrap_or((path, ""));
            let path = path.trim_end_matches("::self");
            let name = if alias.is_empty() { path.rsplit(':').next().unwrap() } else { alias };
            if !is_public || used.contains(name) {
                paths.insert(path.to_owned());
            }
            names.insert(name.to_owned(), path.to_owned());
        }
        Self { names, paths }
    }
}

/// Expands a `use` tree with braces to its paths.
fn expand(tree: &str) -> Vec<String> {
    let Some((prefix, rest)) = tree.split_once('{') else { return vec![tree.trim().to_owned()] };
    let mut depth = 0;
    let parts = rest.trim_end().strip_suffix('}').unwrap().split(|one| {
        depth += i32::from(one == '{') - i32::from(one == '}');
        depth == 0 && one == ','
    });
    let paths = parts.filter(|part| !part.trim().is_empty()).flat_map(expand);
    paths.map(|path| format!("{}{path}", prefix.trim())).collect()
}

/// The module that defines the item to which a path in `module` refers, following re-exports;
/// `None` if the path begins with a name that this module or another crate defines.
fn definition(modules: &BTreeMap<String, Module>, module: &str, path: &str) -> Option<String> {
    let (first, rest) = path.split_once("::").unwrap_or((path, ""));
    let child = format!("{module}::{first}");
    let is_module = modules.contains_key(&child);
    let import = modules.get(module).and_then(|module| module.names.get(first));
    let inner = match (first, import) {
        ("crate", _) => "crate",
        ("self", _) => module,
        ("super", _) => module.rsplit_once("::")?.0,
        // A function may have the name of a module.
        (_, Some(import)) if rest.is_empty() && import != path => {
            return definition(modules, module, import);
        }
        _ if is_module => &child,
        (_, Some(import)) if import != first => {
            return definition(modules, module, &format!("{import}::{rest}"));
        }
        _ => return None,
    };
    definition(modules, inner, rest).or_else(|| Some(inner.to_owned()))
}

/// The imports of each circle of modules that import each other.
fn circles(files: &BTreeMap<String, String>) -> Vec<String> {
    let modules = files.iter().map(|(path, text)| {
        let path = path.trim_end_matches(".rs").trim_end_matches("/mod").replace('/', "::");
        (format!("crate::{path}"), Module::new(text))
    });
    let modules: BTreeMap<String, Module> = modules.collect();
    let arrows = modules.iter().map(|(from, module)| {
        let to = module.paths.iter().filter_map(|path| definition(&modules, from, path));
        (from, to.filter(|to| to != from && modules.contains_key(to)).collect())
    });
    let arrows: BTreeMap<&String, BTreeSet<String>> = arrows.collect();
    let reached = arrows.keys().map(|&from| {
        let (mut found, mut left) = (BTreeSet::new(), vec![from]);
        while let Some(next) = left.pop() {
            left.extend(arrows[next].iter().filter(|to| found.insert(*to)));
        }
        (from, found)
    });
    let reached: BTreeMap<&String, BTreeSet<&String>> = reached.collect();
    let mut circles: BTreeMap<&String, Vec<String>> = BTreeMap::new();
    for (from, to) in arrows.iter().flat_map(|(from, all)| all.iter().map(move |to| (*from, to))) {
        if reached[to].contains(from) {
            let first = reached[from].iter().find(|other| reached[*other].contains(from)).unwrap();
            circles.entry(*first).or_default().push(format!("{from} -> {to}"));
        }
    }
    circles.into_values().map(|arrows| arrows.join("\n")).collect()
}

#[test]
fn no_files_import_each_other() {
    let mut files = BTreeMap::new();
    read_files(&root().join("conformance/src"), "", &mut files);
    let circles = circles(&files);
    assert!(circles.is_empty(), "circles of files:\n{}", circles.join("\n\n"));
}

#[test]
fn circles_are_found() {
    let files = [
        ("a/mod.rs", "pub(crate) use b::{deep::{Name as Other, one}, two};\n"),
        ("a/b/mod.rs", "pub fn two() {}\n"),
        ("a/b/deep.rs", "use crate::{a::row, low};\nfn one() { row::text() }\n"),
        ("a/row.rs", "use super::Other;\n"),
        ("low.rs", "pub(in crate::a) fn two() { let a = super::a::two(); }\n"),
    ];
    let files = files.map(|(path, text)| (path.to_owned(), text.to_owned())).into();
    let expected = "crate::a::b::deep -> crate::a::row\ncrate::a::row -> crate::a::b::deep";
    assert_eq!(circles(&files), [expected]);
}
