//! Progress on the terminal.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// The line of a terminal changes at most this often.
pub(super) const UPDATE_INTERVAL: Duration = Duration::from_millis(100);
/// Short enough not to wrap: the rest of a wrapped line would stay on the screen.
pub(super) const WIDTH: usize = 76;

/// A line on stderr, overwritten in place on a terminal.
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

    /// Shows a text on a terminal, unless the line was updated a moment ago.
    pub(super) fn update(&mut self, text: impl FnOnce() -> String) {
        if self.live && self.is_due(UPDATE_INTERVAL) {
            self.show(&text());
        }
    }

    /// Whether the last update is at least this long ago.
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

    /// The part of a text that fits on a line of the terminal.
    pub(super) fn fitted(&self, text: &str) -> String {
        let most = if self.live { WIDTH } else { usize::MAX };
        text.chars().take(most).collect()
    }

    /// Clears the line of a terminal.
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
