//! Relative links in the documents lead to existing files and anchors, and the claims of ASSURANCE
//! and SECURITY name existing commands.

use std::fs;

use super::documents::texts;
use super::root;

#[test]
fn links_have_targets() {
    let (mut seen, texts) = (0, texts());
    for (path, text) in &texts {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            // rustdoc itself checks links to items.
            let is_item = link.starts_with("crate::");
            if is_item || link.contains("://") || link.contains(char::is_whitespace) {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let target =
                if file.is_empty() { root().join(path) } else { root().join(folder).join(file) };
            assert!(target.exists(), "{path}: {link}");
            if !anchor.is_empty() {
                let text = fs::read_to_string(&target).unwrap();
                let headings = text.lines().filter(|line| line.starts_with('#'));
                assert!(headings.map(slug).any(|slug| slug == anchor), "{path}: {link}");
            }
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen} links");
}

/// The anchor of a heading, as GitHub creates it for the first heading with this text.
fn slug(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading.chars().filter(|one| one.is_alphanumeric() || " -_".contains(*one));
    kept.map(|one| if one == ' ' { '-' } else { one }).collect()
}

/// Each row of the tables of ASSURANCE and SECURITY names commands that exist, in the script or
/// workflow that their mark states, or states why it names none.
#[test]
fn claims_have_commands() {
    let read = |path: &&str| fs::read_to_string(root().join(path)).unwrap();
    let is_comment = |line: &&str| line.trim_start().starts_with('#');
    let runners = [".ci/run", ".github/workflows/ci.yml", ".github/workflows/nightly.yml"];
    let [gate, ci, nightly] = runners.map(|runner| {
        let text = read(&runner);
        text.lines().filter(|line| !is_comment(line)).collect::<Vec<_>>().join("\n")
    });
    for (path, least) in [("codec/ASSURANCE.md", 25), (".github/SECURITY.md", 15)] {
        let text = read(&path);
        let rows = text.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
        let cells = rows.map(|row| row.rsplit_once(" | ").unwrap().1);
        let cells: Vec<&str> =
            cells.filter(|cell| !cell.starts_with("command that fails")).collect();
        assert!(cells.len() >= least, "{path}: {} claims", cells.len());
        for cell in cells {
            let parts: Vec<&str> = cell.split('`').skip(1).collect();
            let has_reason = cell.starts_with("not verified by a command: ");
            assert_eq!(has_reason, parts.is_empty(), "{path}: {cell}");
            for command in parts.chunks_exact(2) {
                let runner = match command[1] {
                    text if text.contains("*CI*") => &ci,
                    text if text.contains("*nightly*") => &nightly,
                    _ => &gate,
                };
                assert_exists(command[0], runner);
            }
        }
    }
}

/// A command `cargo test -p …` names existing tests, or modules of tests. For any other command,
/// `run` contains its script or, for cargo, the whole command.
fn assert_exists(command: &str, run: &str) {
    let words: Vec<&str> = command.split(' ').filter(|word| *word != "--").collect();
    let (tests, filters) = match &words[..] {
        ["cargo", "test", "-p", package, kind, rest @ ..] => {
            let folder = package.trim_start_matches("ads-cnc").trim_start_matches('-');
            let folder = if folder.is_empty() { "codec" } else { folder };
            match (*kind, rest) {
                ("--lib", rest) => (format!("{folder}/src"), rest),
                (_, ["codec", rest @ ..]) => (format!("{folder}/tests"), rest),
                (_, rest) => (format!("{folder}/tests/{}", rest[0]), &rest[1..]),
            }
        }
        ["cargo", ..] => return assert!(run.contains(command), "{command}"),
        words => return assert!(run.contains(words[0]), "{command}"),
    };
    assert!(!filters.is_empty(), "{command}");
    for filter in filters {
        let (module, test) = filter.rsplit_once("::").unwrap_or(("", filter));
        let path = format!("{tests}/{}", module.replace("::", "/"));
        let path = path.trim_end_matches('/');
        let files = [".rs", "/mod.rs", "/main.rs"].map(|end| root().join(format!("{path}{end}")));
        let text: String = files.iter().filter_map(|file| fs::read_to_string(file).ok()).collect();
        let wanted = if test.is_empty() { "#[test]" } else { &format!("fn {test}(") };
        assert!(text.contains(wanted), "{command}: {filter}");
    }
}
