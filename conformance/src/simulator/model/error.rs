//! Errors in a data model, with their positions.

use std::cell::Cell;
use std::ops::Range;

use crate::text::{UTF16, is_utf16};

/// An error in a data model, with its position and the reason.
///
/// ```
/// use ads_cnc_conformance::simulator::Model;
///
/// let error = Model::from_toml("[[channel]]\nnumber = 0\n", "mine.toml").unwrap_err();
/// assert_eq!(error.to_string(), "mine.toml:2: expected a channel number from 1 to 255, found 0");
/// assert_eq!(error.line(), Some(2));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {reason}", line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct ModelError {
    file: String,
    line: Option<usize>,
    reason: String,
}

impl ModelError {
    /// The line, from 1; `None` if the file cannot be read.
    pub const fn line(&self) -> Option<usize> {
        self.line
    }

    pub fn reason(&self) -> &str {
        &self.reason
    }

    pub(super) fn of_file(file: &str, reason: impl ToString) -> Self {
        Self { file: file.to_owned(), line: None, reason: reason.to_string() }
    }
}

/// The file that is being parsed; creates errors with positions.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    /// Number of bytes of memory that the values of the items read so far need.
    pub(super) memory: &'a Cell<usize>,
}

impl Source<'_> {
    pub(super) fn error(self, span: &Range<usize>, reason: impl ToString) -> ModelError {
        let line = Some(line(self.text.as_bytes(), span.start));
        ModelError { file: self.file.to_owned(), line, reason: reason.to_string() }
    }

    /// The error for a file that is not UTF-8 at this offset.
    pub(super) fn not_text(bytes: &[u8], at: usize, file: &str) -> ModelError {
        let byte = bytes.get(at).copied().unwrap_or_default();
        let reason = match is_utf16(bytes) {
            true => UTF16.to_owned(),
            false => format!("the file must be UTF-8; byte {byte:#04X} is not"),
        };
        ModelError { file: file.to_owned(), line: Some(line(bytes, at)), reason }
    }
}

/// The line of an offset, from 1.
fn line(bytes: &[u8], at: usize) -> usize {
    let before = bytes.get(..at).unwrap_or(bytes);
    before.iter().filter(|&&byte| byte == b'\n').count().saturating_add(1)
}
