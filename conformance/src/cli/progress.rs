//! Shows the progress of a command on stderr.

use std::io::{self, IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::number::to_u32;
use crate::process::progress::{Counts, counts};
use crate::text::plural;

/// Minimum time between two updates of the line on a terminal, except for an event that is shown at
/// once.
pub(super) const UPDATE_INTERVAL: Duration = Duration::from_millis(100);
/// Maximum number of characters of the line on a terminal. A longer line would wrap on a terminal
/// of 80 columns, and a part of it would stay on the screen.
pub(super) const WIDTH: usize = 76;

/// A line on stderr, overwritten in place on a terminal.
#[derive(Debug)]
pub(super) struct ProgressLine {
    pub(super) live: bool,
    last: Instant,
}

/// Number of characters of the line that is shown on the terminal.
static SHOWN: AtomicUsize = AtomicUsize::new(0);

impl ProgressLine {
    pub(super) fn new() -> Self {
        Self { live: io::stderr().is_terminal(), last: Instant::now() }
    }

    /// Shows a text on a terminal, unless the line was created or updated within the last
    /// [`UPDATE_INTERVAL`].
    pub(super) fn update(&mut self, text: impl FnOnce() -> String) {
        if self.live && self.is_due(UPDATE_INTERVAL) {
            self.show(&text());
        }
    }

    /// Whether the last update, or the creation of the line, is at least this long ago.
    pub(super) fn is_due(&self, every: Duration) -> bool {
        self.last.elapsed() >= every
    }

    /// Replaces the progress line if stderr is a terminal, otherwise writes a new line.
    pub(super) fn show(&mut self, text: &str) {
        self.last = Instant::now();
        let line = self.fitted(text);
        // A run must not fail because its progress cannot be shown.
        let _unseen = if self.live {
            let width = SHOWN.swap(line.chars().count(), Ordering::Relaxed);
            write!(io::stderr(), "\r{line:<width$}")
        } else {
            writeln!(io::stderr(), "{line}")
        };
    }

    /// The first [`WIDTH`] characters of a text on a terminal, otherwise the whole text.
    pub(super) fn fitted(&self, text: &str) -> String {
        let most = if self.live { WIDTH } else { usize::MAX };
        text.chars().take(most).collect()
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        clear();
    }
}

/// Clears the line of the terminal.
pub(super) fn clear() {
    let width = SHOWN.swap(0, Ordering::Relaxed);
    if width > 0 {
        let _unseen = write!(io::stderr(), "\r{:width$}\r", "");
    }
}

/// The time after which [`Watch`] first shows the progress on a terminal.
const SHORT_RUN: Duration = Duration::from_secs(1);

/// Time between two lines if stderr is not a terminal; for [`Watch`], also the time before the
/// first line.
pub(super) const LOG_INTERVAL: Duration = Duration::from_secs(10);

/// Shows the counts of `process::progress` on stderr until it is dropped.
#[derive(Debug)]
pub(super) struct Watch {
    thread: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Watch {
    /// Starts the thread that shows the progress; `unit` names the counted steps, as in "cases".
    pub(super) fn start(unit: &'static str) -> Self {
        let (stop, stopped) = mpsc::channel();
        let shows = move || {
            let (mut line, begin) = (ProgressLine::new(), Instant::now());
            let (mut wait, later) = match line.live {
                true => (SHORT_RUN, UPDATE_INTERVAL),
                false => (LOG_INTERVAL, LOG_INTERVAL),
            };
            while stopped.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                wait = later;
                line.show(&progress_text(counts(), unit, begin.elapsed()));
            }
        };
        // A run must not fail because its progress cannot be shown.
        let thread = thread::Builder::new().name("progress".to_owned()).spawn(shows).ok();
        Self { thread: thread.map(|thread| (stop, thread)) }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        if let Some((stop, thread)) = self.thread.take() {
            drop(stop);
            let _panicked = thread.join();
        }
    }
}

pub(super) fn progress_text(counts: Counts, unit: &str, elapsed: Duration) -> String {
    let Counts { all, done, failed, requests } = counts;
    // When a testee or a client is judged, `all` is 0 until it has answered hello.
    let mut text = match all {
        0 if requests == 0 => "waiting for the first message".to_owned(),
        _ => format!("{done} of {all} {unit}"),
    };
    if requests > 0 {
        text.push_str(&format!(", {}", plural(requests, "request")));
    }
    if failed > 0 {
        text.push_str(&format!(", {failed} failed"));
    }
    let (done, left) = (to_u32(done), all.saturating_sub(done));
    let left = elapsed.checked_div(done).map(|each| each * u32::try_from(left).unwrap_or(0));
    text.push_str(&format!(", {} s", elapsed.as_secs()));
    match left {
        Some(left) if !left.is_zero() => text + &format!(", about {} s left", left.as_secs()),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_estimates_the_remaining_time() {
        let counts = Counts { all: 20, done: 5, failed: 1, requests: 300 };
        assert_eq!(
            progress_text(counts, "cases", Duration::from_secs(10)),
            "5 of 20 cases, 300 requests, 1 failed, 10 s, about 30 s left"
        );
        let counts = Counts { all: 20, done: 0, failed: 0, requests: 0 };
        assert_eq!(progress_text(counts, "cases", Duration::from_secs(3)), "0 of 20 cases, 3 s");
    }
}
