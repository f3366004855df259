//! Replay of corpora without a fuzzer.

use std::path::{Path, PathBuf};

use crate::{Defect, Outcome, Target};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The folder with the corpus of a target.
pub fn corpus(target: &str) -> PathBuf {
    folder("corpus").join(target)
}

/// The folder with the former findings of a target. Most targets have none.
pub fn regressions(target: &str) -> PathBuf {
    folder("regressions").join(target)
}

/// The folder with the dictionaries, one for each family.
pub fn dictionaries() -> PathBuf {
    folder("dictionaries")
}

/// The files of a folder, sorted by name. Empty if the folder does not exist.
pub struct Folder(Vec<PathBuf>);

impl Folder {
    /// Lists the files of a folder.
    ///
    /// # Panics
    /// If the folder exists but cannot be read.
    pub fn new(path: &Path) -> Self {
        if !path.exists() {
            return Self(Vec::new());
        }
        let entries =
            std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let entries = entries.map(|entry| entry.expect("readable"));
        // A symbolic link counts as a file.
        let files = entries.filter(|entry| !entry.file_type().expect("readable").is_dir());
        let mut paths: Vec<_> = files.map(|entry| entry.path()).collect();
        // Compared as bytes: comparing paths by their components takes too long under Miri.
        paths.sort_by(|one, two| one.as_os_str().cmp(two.as_os_str()));
        Self(paths)
    }

    /// At most this number of files, evenly distributed over the folder.
    #[must_use]
    pub fn at_most(self, most: usize) -> Self {
        let step = self.0.len().div_ceil(most.max(1)).max(1);
        Self(self.0.into_iter().step_by(step).collect())
    }

    /// The path and the bytes of each file.
    ///
    /// # Panics
    /// If a file cannot be read.
    pub fn files(&self) -> impl ExactSizeIterator<Item = (&Path, Vec<u8>)> {
        self.0.iter().map(|path| {
            let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
            (&**path, bytes)
        })
    }
}

/// Runs a target on every file of its corpus and regressions, and calls `each` with the path and the
/// outcome.
pub fn replay(target: &Target, mut each: impl FnMut(&Path, Outcome)) {
    for folder in [corpus(target.name), regressions(target.name)] {
        for (path, bytes) in Folder::new(&folder).files() {
            // The test harness shows this only if the body panics.
            println!("{}", path.display());
            each(path, target.run(&bytes, Defect::NONE));
        }
    }
}
