//! Random cases that failed are stored and run before new cases: see
//! proptest-regressions/README.md.

use std::path::Path;

use proptest::test_runner::{Config, FileFailurePersistence};

/// The configuration for a number of new cases; `source` is the `file!()` of the test.
pub(crate) fn cases(cases: u32, source: &str) -> Config {
    let default = Config::default();
    // PROPTEST_DISABLE_FAILURE_PERSISTENCE disables the files; by default, Miri has no access to
    // files.
    if default.failure_persistence.is_none() || cfg!(miri) {
        return Config { cases, failure_persistence: None, ..default };
    }
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/proptest-regressions");
    Config { cases, failure_persistence: Some(Box::new(beside(folder, source))), ..default }
}

/// The file in `folder` that is named like the source file of the test, with the extension `txt`.
pub(crate) fn beside(folder: impl AsRef<Path>, source: &str) -> FileFailurePersistence {
    let name = Path::new(source).with_extension("txt");
    let file = folder.as_ref().join(name.file_name().expect("the file of a test"));
    // proptest needs a path with a static lifetime, so leak the path of each test.
    FileFailurePersistence::Direct(file.to_str().expect("a path in UTF-8").to_string().leak())
}
