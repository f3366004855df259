//! Tests of `kept`: the seeds of failed random cases are stored in files, and later runs repeat
//! these cases. The files are optional.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use proptest::test_runner::{TestCaseError, TestRunner};

use super::kept;

/// The number of seeds in kept_cases.txt.
const KEPT: usize = 2;
const NEW: u32 = 3;

/// Runs random numbers as cases; `well` decides whether a case passes. Returns the numbers in
/// order, and true if all of them passed.
fn run(config: ProptestConfig, well: impl Fn(u64) -> bool) -> (Vec<u64>, bool) {
    let seen = std::cell::RefCell::new(Vec::new());
    let result = TestRunner::new(config).run(&any::<u64>(), |number| {
        seen.borrow_mut().push(number);
        if well(number) { Ok(()) } else { Err(TestCaseError::fail("wanted")) }
    });
    (seen.into_inner(), result.is_ok())
}

fn kept_in(folder: &Path) -> ProptestConfig {
    let persistence = Box::new(kept::beside(folder, "tests/some.rs"));
    let failure_persistence = Some(persistence as _);
    ProptestConfig { cases: NEW, failure_persistence, ..ProptestConfig::default() }
}

/// The path of a folder that no other test or process uses.
fn folder(name: &str) -> PathBuf {
    let folder =
        Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

#[test]
#[cfg_attr(miri, ignore = "reads files")]
fn kept_cases_are_run_before_new_ones() {
    let config = || {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/proptest-regressions");
        let failure_persistence = Some(Box::new(kept::beside(here, file!())) as _);
        ProptestConfig { failure_persistence, ..kept::cases(NEW, file!()) }
    };
    let (once, again) = (run(config(), |_| true), run(config(), |_| true));
    assert_eq!((once.0.len(), once.1), (KEPT + NEW as usize, true));
    assert_eq!(once.0[..KEPT], again.0[..KEPT]);
    assert_ne!(once.0[KEPT..], again.0[KEPT..]);
}

/// A failed case is stored, and is the first case of the next run.
#[test]
#[cfg_attr(miri, ignore = "writes files")]
fn failed_cases_are_stored() {
    let folder = folder("failures");
    let (seen, well) = run(kept_in(&folder), |_| false);
    assert!(!well && !seen.is_empty());
    let text = fs::read_to_string(folder.join("some.txt")).unwrap();
    assert_eq!(text.lines().filter(|line| line.starts_with("cc ")).count(), 1, "{text}");
    let (again, well) = run(kept_in(&folder), |_| true);
    assert_eq!((again.len(), again[0], well), (1 + NEW as usize, seen[0], true));
    fs::remove_dir_all(folder).unwrap();
}

/// If no seeds are stored, or the path of the folder is that of a file, the tests run and failures
/// are reported.
#[test]
#[cfg_attr(miri, ignore = "writes files")]
fn tests_run_without_access_to_files() {
    let base = folder("no-folder");
    fs::create_dir_all(&base).unwrap();
    let file = base.join("file");
    fs::write(&file, "").unwrap();
    for folder in [file, base.join("nothing")] {
        assert_eq!(run(kept_in(&folder), |_| true).0.len(), NEW as usize);
    }
    assert!(!run(kept_in(&base.join("file")), |_| false).1);
    fs::remove_dir_all(base).unwrap();
}
