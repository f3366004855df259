//! Replays the corpora on stable Rust, without a fuzzer.

use std::collections::HashSet;
use std::path::Path;

use ads_cnc_fuzz::{
    Defect, Folder, TARGETS, corpus, dictionaries, dictionary, regressions, replay, seeds,
};

/// Whether to write the generated files instead of comparing them.
fn write() -> bool {
    std::env::var_os("ADS_CNC_WRITE_SEEDS").is_some()
}

/// Every input of every corpus keeps the laws of its target, and at least one input of each target passes
/// the first checks.
#[test]
fn corpora_keep_the_laws() {
    for target in TARGETS {
        let (mut inputs, mut accepted) = (0, 0);
        replay(target, |_, outcome| {
            inputs += 1;
            accepted += usize::from(outcome.accepted);
        });
        assert!(inputs >= seeds::seeds(target).len(), "{}: {inputs} inputs", target.name);
        assert!(accepted > 0, "{}: none of {inputs} inputs is accepted", target.name);
    }
}

/// An input has the same outcome in every run.
#[test]
fn outcomes_are_repeatable() {
    for target in TARGETS {
        for (path, bytes) in Folder::new(&corpus(target.name)).files() {
            let run = || target.run(&bytes, Defect::NONE);
            assert_eq!(run(), run(), "{}", path.display());
        }
    }
}

/// The corpora contain every seed (from vectors, samples and inputs made by hand) under its name,
/// and the dictionaries are those that `dictionary` generates.
#[test]
fn corpora_and_dictionaries_are_up_to_date() {
    let mut stale = Vec::new();
    let mut compare = |path: &Path, bytes: &[u8]| {
        if write() {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, bytes).unwrap();
        } else if std::fs::read(path).ok().as_deref() != Some(bytes) {
            stale.push(path.to_owned());
        }
    };
    for target in TARGETS {
        let seeds = seeds::seeds(target);
        let names: HashSet<_> = seeds.iter().map(|(name, _)| name).collect();
        assert_eq!(names.len(), seeds.len(), "{}: two seeds have the same name", target.name);
        for (name, bytes) in &seeds {
            compare(&corpus(target.name).join(name), bytes);
        }
    }
    for (family, dictionary) in dictionary::dictionaries() {
        assert!(!dictionary.is_empty(), "{family}");
        compare(&dictionaries().join(format!("{family}.dict")), dictionary.as_bytes());
    }
    assert!(stale.is_empty(), "run with ADS_CNC_WRITE_SEEDS=1 to rewrite {stale:#?}");
}

/// Every folder of inputs belongs to a target, and every family has a dictionary.
#[test]
fn folders_match_the_targets() {
    let names = |folder: &Path| -> Vec<String> {
        let entries = std::fs::read_dir(folder).into_iter().flatten();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    };
    let is_target = |name: &String| TARGETS.iter().any(|target| target.name == *name);
    for folder in [corpus(""), regressions("")] {
        for name in names(&folder) {
            assert!(is_target(&name) || name == "README.md", "{}", folder.join(name).display());
        }
    }
    for target in TARGETS {
        let dictionary = dictionaries().join(format!("{}.dict", target.family()));
        assert!(dictionary.is_file(), "{}", dictionary.display());
    }
}

/// The corpora have at most 2 MiB in all, which is small enough for the repository.
#[test]
fn corpora_are_small() {
    let files = |target: &str| {
        let folder = Folder::new(&corpus(target));
        folder.files().map(|(_, bytes)| bytes.len()).sum::<usize>()
    };
    let sum: usize = TARGETS.iter().map(|target| files(target.name)).sum();
    assert!(sum <= 2 << 20, "{sum} bytes");
}

/// Every target has a binary that calls it, and a `[[bin]]` for `cargo fuzz`.
#[test]
fn binaries_match_the_targets() {
    let manifest = include_str!("../Cargo.toml");
    assert_eq!(manifest.matches("[[bin]]").count(), TARGETS.len());
    for target in TARGETS {
        let path = format!("fuzz_targets/{}.rs", target.name);
        assert!(manifest.contains(&format!("name = \"{}\"\npath = \"{path}\"", target.name)));
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        let source = std::fs::read_to_string(&source).expect("the binary's source");
        let line = format!("ads_cnc_fuzz::targets::{}.fuzz(data)", target.name.to_uppercase());
        assert!(source.contains(&line), "{}", target.name);
    }
}

/// Every target that the matrix of the suite names exists.
#[test]
fn the_matrix_names_existing_targets() {
    let rows = ads_cnc_conformance::matrix::matrix();
    let named: HashSet<_> = rows.iter().flat_map(|row| &row.fuzz_targets).copied().collect();
    assert!(named.len() > 10);
    for name in named {
        assert!(TARGETS.iter().any(|target| target.name == name), "{name}");
    }
}

/// The table of the README has exactly the targets, with their laws.
#[test]
fn the_readme_lists_the_targets() {
    let readme = include_str!("../README.md");
    // The other tables of the README have fewer columns.
    let rows = readme.lines().filter(|line| line.matches(" | ").count() == 2);
    let rows = rows.filter_map(|line| {
        let (name, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
        Some((name, rest.split(" | ").next()?))
    });
    let wanted: Vec<_> = TARGETS.iter().map(|target| (target.name, target.proves)).collect();
    assert_eq!(rows.collect::<Vec<_>>(), wanted);
}
