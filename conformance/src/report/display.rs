//! Options for showing a report on the console.

use anstyle::{AnsiColor, Style};

use crate::judge::Verdict;

/// The parts of a report that are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// Only the last line and, above it, the stale waivers, the requirements whose cause the run
    /// does not judge, and the rejected requests.
    Quiet,
    /// A line for each subject, and the groups of checks that did not pass, up to a maximum number.
    #[default]
    Normal,
    /// Also every case, and the verdicts on the requirements by area.
    Verbose,
}

/// Options for showing a report on the console.
#[derive(Clone, Copy, Debug, Default)]
pub struct DisplayOptions {
    pub detail: Detail,
    pub color: bool,
    /// Whether the terminal already shows the result of the queries before the cases.
    pub found_shown: bool,
}

/// Width of wrapped text in characters.
pub(super) const WIDTH: usize = 98;
/// Maximum number of characters of most shortened texts, such as results and notes.
pub(super) const RESULT_MAX: usize = 160;
/// Maximum number of names in a shortened list.
pub(super) const NAMES_MAX: usize = 5;

impl DisplayOptions {
    /// The verdict in capitals, coloured by its effect on the run.
    pub(super) fn verdict(self, verdict: Verdict, waived: bool) -> String {
        let color = match verdict {
            _ if waived => AnsiColor::Yellow,
            Verdict::Pass => AnsiColor::Green,
            verdict if verdict.fails_run() => AnsiColor::Red,
            _ => AnsiColor::Yellow,
        };
        self.paint(color, &worded(verdict, waived).to_uppercase())
    }

    pub(super) fn paint(self, color: AnsiColor, text: &str) -> String {
        if !self.color {
            return text.to_owned();
        }
        let style: Style = color.on_default().bold();
        format!("{style}{text}{style:#}")
    }
}

/// A verdict, and whether it is waived.
pub(super) fn worded(verdict: Verdict, waived: bool) -> String {
    if waived { format!("{verdict}, waived") } else { verdict.to_string() }
}
