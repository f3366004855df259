//! How far it is, on the terminal of whoever waits. One line that counts takes no crate.

use std::io::{self, IsTerminal as _, Write as _};
use std::time::{Duration, Instant};

/// How often the line is written.
const EVERY: Duration = Duration::from_millis(100);
/// So that it never wraps, which would leave lines behind.
pub(super) const WIDTH: usize = 76;

/// A line on stderr, written over and over; nothing where stderr is no terminal.
#[derive(Debug)]
pub(super) struct Progress {
    live: bool,
    last: Instant,
    width: usize,
}

impl Progress {
    pub(super) fn new() -> Self {
        Self { live: io::stderr().is_terminal(), last: Instant::now(), width: 0 }
    }

    /// Shows this, unless something was shown just now.
    pub(super) fn tell(&mut self, text: impl FnOnce() -> String) {
        if self.live && self.last.elapsed() >= EVERY {
            self.last = Instant::now();
            self.show(&text());
        }
    }

    /// Takes the line away.
    pub(super) fn clear(&mut self) {
        if self.width > 0 {
            self.show("");
            let _unread = write!(io::stderr(), "\r");
            self.width = 0;
        }
    }

    fn show(&mut self, text: &str) {
        let line: String = text.chars().take(WIDTH).collect();
        let (len, width) = (line.chars().count(), self.width);
        let _unread = write!(io::stderr(), "\r{line:<width$}");
        self.width = len;
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}
