//! Temporary files and folders of tests.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};

/// The beginning of a file for --allow-write for a CNC on this machine.
pub(crate) const HEAD: &str = "target = \"127.0.0.1.1.1\"\nexpires = 2999-01-01T00:00:00Z\n";

/// A temporary file that is removed when this value is dropped.
pub(crate) struct TestFile(pub(crate) PathBuf);

impl TestFile {
    /// Creates a file whose name ends with `suffix`.
    pub(crate) fn new(suffix: &str, content: &[u8]) -> Self {
        let path = unused(suffix);
        std::fs::write(&path, content).unwrap();
        Self(path)
    }

    /// Creates a file for --allow-write for a CNC on this machine with the AMS NetId 127.0.0.1.1.1.
    pub(crate) fn allowing(table: &str) -> Self {
        Self::new(".toml", format!("{HEAD}{table}").as_bytes())
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

/// A temporary folder that is removed when this value is dropped.
pub(crate) struct TestFolder(PathBuf);

impl TestFolder {
    pub(crate) fn new() -> Self {
        let path = unused("");
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// The path of a file in the folder.
    pub(crate) fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }
}

impl Drop for TestFolder {
    fn drop(&mut self) {
        let _gone = std::fs::remove_dir_all(&self.0);
    }
}

/// A file in memory, which its clones share.
#[derive(Clone, Default)]
pub(crate) struct MemoryFile(pub(crate) Arc<Mutex<Vec<u8>>>);

impl Write for MemoryFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A temporary path that ends with `suffix`, and that no other test of this process uses.
fn unused(suffix: &str) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let (process, count) = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    std::env::temp_dir().join(format!("ads-cnc-test-{process}-{count}{suffix}"))
}
