//! The error of a file of the user.

use std::io;
use std::path::Path;

use super::utf8;

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

    /// Parses the bytes of a file. An error contains the name of the file.
    ///
    /// # Errors
    /// The error of reading the file, bytes that are not UTF-8, and the errors of `parse`.
    pub(crate) fn parse<T>(
        file: &Path,
        bytes: io::Result<Vec<u8>>,
        parse: impl FnOnce(&str) -> Result<T, Self>,
    ) -> Result<T, Self> {
        let text = bytes.map_err(|error| error.to_string()).and_then(utf8);
        let parsed = text.map_err(Self::new).and_then(|text| parse(&text));
        parsed.map_err(|error| Self { file: Some(file.display().to_string()), ..error })
    }
}
