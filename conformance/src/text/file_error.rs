//! The error of a file of the user.

use std::io::{self, Read};
use std::path::Path;

use super::utf8;

/// Maximum number of bytes of a file of the user that is parsed as a whole. A device or a pipe may
/// never end, and a parsed text needs a multiple of its length in memory.
pub(crate) const FILE_MAX: u64 = 16 * 1024 * 1024;

/// Reads a file of the user, or stdin, to its end.
///
/// # Errors
/// The error of reading, and more than `most` bytes.
pub(crate) fn read_limited(from: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut from = from.take(most.saturating_add(1));
    from.read_to_end(&mut bytes)?;
    if from.limit() == 0 {
        return Err(io::Error::other(format!("expected at most {most} bytes, found more")));
    }
    Ok(bytes)
}

/// An error while reading or parsing a file: the name of the file, unless only a text was parsed,
/// and the reason.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{why}", file.as_deref().map(|file| format!("{file}: ")).unwrap_or_default())]
pub struct FileError {
    file: Option<String>,
    why: String,
}

impl FileError {
    /// An error in a text.
    pub(crate) const fn new(why: String) -> Self {
        Self { file: None, why }
    }

    /// Reads and parses a file. An error contains the name of the file.
    ///
    /// # Errors
    /// The error of opening or reading the file, more than [`FILE_MAX`] bytes, bytes that are not
    /// UTF-8, and the errors of `parse`.
    pub(crate) fn parse<T>(
        file: &Path,
        opened: io::Result<impl Read>,
        parse: impl FnOnce(&str) -> Result<T, Self>,
    ) -> Result<T, Self> {
        let bytes = opened.and_then(|opened| read_limited(opened, FILE_MAX));
        let text = bytes.map_err(|error| error.to_string()).and_then(utf8);
        let parsed = text.map_err(Self::new).and_then(|text| parse(&text));
        parsed.map_err(|error| Self { file: Some(file.display().to_string()), ..error })
    }
}
