//! How far it is, on the terminal of whoever waits. One line that counts takes no crate.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// How often the line of a terminal changes.
pub(super) const EVERY: Duration = Duration::from_millis(100);
/// So that it never wraps, which would leave old lines.
pub(super) const WIDTH: usize = 76;

/// A line on stderr, written over and over where that is a terminal.
#[derive(Debug)]
pub(super) struct ProgressLine {
    pub(super) live: bool,
    last: Instant,
    width: usize,
}

impl ProgressLine {
    pub(super) fn new() -> Self {
        Self { live: io::stderr().is_terminal(), last: Instant::now(), width: 0 }
    }

    /// Shows this on a terminal, unless something was shown just now.
    pub(super) fn update(&mut self, text: impl FnOnce() -> String) {
        if self.live && self.is_due(EVERY) {
            self.show(&text());
        }
    }

    /// Whether nothing was shown for this long.
    pub(super) fn is_due(&self, every: Duration) -> bool {
        self.last.elapsed() >= every
    }

    /// Replaces the progress line on a terminal; elsewhere writes a new line.
    pub(super) fn show(&mut self, text: &str) {
        self.last = Instant::now();
        let line = self.fitted(text);
        // A run must not fail because its progress cannot be written.
        let _unseen = if self.live {
            write!(io::stderr(), "\r{line:<0$}", self.width)
        } else {
            writeln!(io::stderr(), "{line}")
        };
        self.width = line.chars().count();
    }

    /// As much of a text as a terminal's line takes.
    pub(super) fn fitted(&self, text: &str) -> String {
        let most = if self.live { WIDTH } else { usize::MAX };
        text.chars().take(most).collect()
    }

    /// Takes the line off the terminal.
    pub(super) fn clear(&mut self) {
        if self.live && self.width > 0 {
            self.show("");
            let _unseen = write!(io::stderr(), "\r");
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        self.clear();
    }
}
