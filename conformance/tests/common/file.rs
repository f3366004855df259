//! Temporary files of tests.

use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

/// A temporary file that is removed when this value is dropped.
pub(crate) struct TestFile(pub(crate) PathBuf);

impl TestFile {
    /// Creates a file whose name ends with `suffix`.
    pub(crate) fn new(suffix: &str, content: &[u8]) -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(format!("ads-cnc-test-{process}-{count}{suffix}"));
        std::fs::write(&path, content).unwrap();
        Self(path)
    }

    /// Creates a file for --allow-write for a CNC on this machine.
    pub(crate) fn allowing(table: &str) -> Self {
        let head = "target = \"127.0.0.1.1.1\"\nexpires = 2999-01-01T00:00:00Z\n";
        Self::new(".toml", format!("{head}{table}").as_bytes())
    }

    pub(crate) fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for TestFile {
    fn drop(&mut self) {
        let _gone = std::fs::remove_file(&self.0);
    }
}
