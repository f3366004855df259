//! Shows the progress of streaming on stderr.

use std::time::{Duration, Instant};

use ads_cnc::streaming::{self, NcText};

use super::super::progress::{self, UPDATE_INTERVAL};
use crate::text::plural;

/// Minimum time between two lines if stderr is not a terminal.
const LINE_INTERVAL: Duration = Duration::from_secs(5);

/// Shows the progress: on a terminal, a line that is overwritten; otherwise, a new line at most
/// every [`LINE_INTERVAL`].
pub(super) struct StreamProgress {
    lines: usize,
    bytes: usize,
    started: Instant,
    line: progress::ProgressLine,
    quiet: bool,
    waited: bool,
}

impl StreamProgress {
    pub(super) fn new(text: NcText<'_>, quiet: bool) -> Self {
        Self {
            lines: text.line_count(),
            bytes: text.wire_len(),
            started: Instant::now(),
            line: progress::ProgressLine::new(),
            quiet,
            waited: false,
        }
    }

    pub(super) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    /// If an update is due, shows how much the CNC has accepted and, if `waits` is set, why the
    /// command waits. With --quiet, shows nothing.
    pub(super) fn show(&mut self, sent: streaming::Progress, waits: Option<&str>) {
        let due = if !self.line.live {
            LINE_INTERVAL
        } else if waits.is_some() && !self.waited {
            // Show a wait at once: it may be the last update for a long time.
            Duration::ZERO
        } else {
            UPDATE_INTERVAL
        };
        self.waited = waits.is_some();
        if !self.quiet && self.line.is_due(due) {
            self.line.show(&self.text(sent, waits));
        }
    }

    fn text(&self, sent: streaming::Progress, waits: Option<&str>) -> String {
        let streaming::Progress { lines, bytes, .. } = sent;
        let (all, of, rate) = (self.lines, byte_count(self.bytes), rate(bytes, self.elapsed()));
        let bytes = byte_count(bytes);
        let (comma, waits) = waits.map_or(("", ""), |waits| (", ", waits));
        format!("{lines} of {}, {bytes} of {of}, {rate}{comma}{waits}", plural(all, "line"))
    }
}

/// A number of bytes with a unit.
pub(super) fn byte_count(bytes: usize) -> String {
    scaled(to_float(bytes))
}

/// A number of bytes and the time in which they were accepted, as bytes per second.
pub(super) fn rate(bytes: usize, took: Duration) -> String {
    // Avoid a division by zero.
    let seconds = took.as_secs_f64().max(0.001);
    scaled(to_float(bytes) / seconds) + "/s"
}

fn to_float(bytes: usize) -> f64 {
    u32::try_from(bytes).map_or(f64::MAX, f64::from)
}

fn scaled(bytes: f64) -> String {
    match bytes {
        bytes if bytes < 10_000.0 => plural(bytes.round(), "byte"),
        bytes if bytes < 10_000_000.0 => format!("{:.1} kB", bytes / 1e3),
        bytes => format!("{:.1} MB", bytes / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_a_fitting_unit() {
        for (bytes, shown) in [
            (0, "0 bytes"),
            (1, "1 byte"),
            (9_999, "9999 bytes"),
            (10_000, "10.0 kB"),
            (10_485_760, "10.5 MB"),
        ] {
            assert_eq!(byte_count(bytes), shown);
        }
        assert_eq!(rate(4000, Duration::from_secs(2)), "2000 bytes/s");
        assert_eq!(rate(10, Duration::ZERO), "10.0 kB/s");
    }

    #[test]
    fn a_line_shows_the_accepted_part() {
        let text = NcText::new(b"N10 G0 X0\nN20 M30\n").unwrap();
        let progress = StreamProgress::new(text, false);
        let sent = streaming::Progress { packets: 1, lines: 1, bytes: 11 };
        let line = progress.text(sent, Some("rejected 3 times"));
        assert!(line.starts_with("1 of 2 lines, 11 bytes of 20 bytes, "), "{line}");
        assert!(line.ends_with("/s, rejected 3 times"), "{line}");
        let mut progress = StreamProgress { lines: 12_345_678, ..progress };
        progress.line.live = true;
        let sent = streaming::Progress { packets: 123_456, lines: 1_234_567, bytes: 123_456_789 };
        let line = progress.text(sent, Some("rejected 1200 times with 0x706"));
        let line = progress.line.fitted(&line);
        assert_eq!(line.chars().count(), progress::WIDTH, "{line}");
    }
}
