//! The executed lines of a program.

use crate::number::{digest, digest_more};

/// The executed lines of a program: the number and digest of all lines, and the text of the latest
/// lines.
///
/// ```
/// use std::time::Duration;
///
/// use ads_cnc_conformance::number::digest;
/// use ads_cnc_conformance::simulator::program::{Pace, StreamingProgram, ProgramConfig};
///
/// let config = ProgramConfig { pace: Pace::Fast, kept: 20, ..ProgramConfig::default() };
/// let mut program = StreamingProgram::new(config);
/// let text = b"N10 X1\r\nN20 X2\r\nN30 X3\r\nN40 X4\r\nN50 X5\r\nN60 X6\r\n";
/// program.write(text, Duration::ZERO);
/// let executed = program.executed();
/// assert_eq!((executed.line_count(), executed.byte_count()), (6, 48));
/// assert_eq!(executed.digest(), digest(text));
/// assert!(executed.lines().eq([&b"N40 X4"[..], b"N50 X5", b"N60 X6"]));
/// assert_eq!(executed.first_recent(), 4);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Executed {
    lines: u64,
    bytes: u64,
    digest: u64,
    /// The latest complete lines.
    kept: Vec<u8>,
    kept_lines: u64,
    /// Number of bytes. When a new line would make the stored lines exceed twice this number, the
    /// oldest lines are removed. At least this number of bytes remains, including the new line.
    room: usize,
}

impl Executed {
    pub(super) fn new(room: usize) -> Self {
        Self { lines: 0, bytes: 0, digest: digest(b""), kept: Vec::new(), kept_lines: 0, room }
    }

    /// Number of lines.
    pub fn line_count(&self) -> u64 {
        self.lines
    }

    /// Number of bytes, including line ends.
    pub fn byte_count(&self) -> u64 {
        self.bytes
    }

    /// The [`digest`] of all bytes, including line ends.
    pub fn digest(&self) -> u64 {
        self.digest
    }

    /// The latest lines, which are stored, each with its line end.
    pub fn recent(&self) -> &[u8] {
        &self.kept
    }

    /// Number of the first stored line, from 1; if no line is stored, the number of the next line.
    pub fn first_recent(&self) -> u64 {
        self.lines.saturating_sub(self.kept_lines).saturating_add(1)
    }

    /// The latest lines, which are stored, each without its CR LF.
    pub fn lines(&self) -> impl Iterator<Item = &[u8]> {
        lines(&self.kept).map(|line| line.strip_suffix(b"\r\n").unwrap_or(line))
    }

    pub(super) fn push(&mut self, line: &[u8]) {
        self.lines = self.lines.saturating_add(1);
        self.bytes = self.bytes.saturating_add(u64::try_from(line.len()).unwrap_or(u64::MAX));
        self.digest = digest_more(self.digest, line);
        if self.kept.len().saturating_add(line.len()) > self.room.saturating_mul(2) {
            self.forget(line.len());
        }
        self.kept.extend_from_slice(line);
        self.kept_lines = self.kept_lines.saturating_add(1);
    }

    /// Removes the oldest lines. At least `room` bytes remain, including the `new` bytes of the
    /// next line.
    fn forget(&mut self, new: usize) {
        let mut surplus = 0_usize;
        for line in lines(&self.kept) {
            let end = surplus.saturating_add(line.len());
            if self.kept.len().saturating_sub(end).saturating_add(new) < self.room {
                break;
            }
            surplus = end;
            self.kept_lines = self.kept_lines.saturating_sub(1);
        }
        self.kept.drain(..surplus);
    }
}

/// Splits bytes from the streaming interface after each LF into lines with their line ends.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split_inclusive(|&byte| byte == b'\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_least_the_room_is_used() {
        let mut executed = Executed::new(20);
        for length in [15, 15, 10, 2] {
            executed.push(&[&b"N10 X1234.5678"[..length - 1], b"\n"].concat());
        }
        assert_eq!((executed.recent().len(), executed.first_recent()), (27, 2));
    }
}
