//! Corpora without a fuzzer.

use std::path::{Path, PathBuf};

use crate::{Defect, Outcome, Target};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Where the inputs of a target are.
pub fn corpus(target: &str) -> PathBuf {
    folder("corpus").join(target)
}

/// Where the inputs are that were findings once, by name. Most targets have none.
pub fn regressions(target: &str) -> PathBuf {
    folder("regressions").join(target)
}

/// Where the dictionaries are, a family each.
pub fn dictionaries() -> PathBuf {
    folder("dictionaries")
}

/// The files of a folder by name; none if there is no such folder.
pub struct Folder(Vec<PathBuf>);

impl Folder {
    /// Lists it.
    ///
    /// # Panics
    /// If it is there and cannot be read.
    pub fn new(path: &Path) -> Self {
        if !path.exists() {
            return Self(Vec::new());
        }
        let entries =
            std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let entries = entries.map(|entry| entry.expect("readable"));
        // Links are files until they are read.
        let files = entries.filter(|entry| !entry.file_type().expect("readable").is_dir());
        let mut paths: Vec<_> = files.map(|entry| entry.path()).collect();
        // By bytes: part by part it takes Miri longer than all else.
        paths.sort_by(|one, two| one.as_os_str().cmp(two.as_os_str()));
        Self(paths)
    }

    /// So many of the files, from one end of the folder to the other.
    #[must_use]
    pub fn at_most(self, most: usize) -> Self {
        let step = self.0.len().div_ceil(most.max(1)).max(1);
        Self(self.0.into_iter().step_by(step).collect())
    }

    /// Each file's path and bytes.
    ///
    /// # Panics
    /// If one cannot be read.
    pub fn files(&self) -> impl ExactSizeIterator<Item = (&Path, Vec<u8>)> {
        self.0.iter().map(|path| {
            let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path:?}: {error}"));
            (&**path, bytes)
        })
    }
}

/// Runs a target on every file of its corpus, regressions included.
pub fn replay(target: &Target, mut each: impl FnMut(&Path, Outcome)) {
    for folder in [corpus(target.name), regressions(target.name)] {
        for (path, bytes) in Folder::new(&folder).files() {
            // The test harness shows this only if the body panics.
            println!("{}", path.display());
            each(path, target.run(&bytes, Defect::NONE));
        }
    }
}
