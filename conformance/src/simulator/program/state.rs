//! The state of a streaming program.

use std::fmt;

use ads_cnc::streaming::{Diagnostic, LineError, ProgramEnd};

/// The state of a streaming program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProgramState {
    /// The program has not been started, or was ended by an NC reset (STM-11, STM-14).
    Stopped,
    /// The program has started, and has lines to read or execute.
    Running,
    /// The program has executed all lines that were written. A real CNC stops motion until the next
    /// write (STM-16).
    Dry,
    /// The program has ended, and with it streaming mode (STM-10).
    Ended(ProgramEnd),
    /// An error aborted streaming mode (STM-5, STM-8). Of the functions of the program, only an NC
    /// reset ends this state.
    Aborted(Message),
}

/// An error that the CNC reports, such as `streaming.nc:4:5: error 21476: …`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Error number; `None` for loops and backward jumps, whose numbers are not documented.
    pub number: Option<u32>,
    pub file: String,
    /// The line number since the start of the program, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    pub text: String,
}

impl Message {
    /// The message for a line without CR LF. `before` is the number of lines that the program has
    /// read before the bytes with this line.
    pub(super) fn of_line_end(file: &str, number: u32, before: u32, error: &LineError) -> Self {
        Self {
            number: Some(number),
            file: file.to_owned(),
            line: before.saturating_add(error.line()),
            column: error.column(),
            text: format!("streaming data without a correct line end: {}", error.kind()),
        }
    }

    pub(super) fn of_finding(file: &str, finding: &Diagnostic) -> Self {
        Self {
            number: None,
            file: file.to_owned(),
            line: finding.line,
            column: finding.column,
            text: finding.kind.to_string(),
        }
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, file, line, column, text } = self;
        write!(f, "{file}:{line}:{column}: ")?;
        if let Some(number) = number {
            write!(f, "error {number}: ")?;
        }
        f.write_str(text)
    }
}

/// The reason why a streaming program cannot be started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    /// The streaming program has no name, so streaming is disabled (STM-13).
    #[error("P-CHAN-00158 streaming_prog_file is empty: name of the streaming program expected")]
    NoName,
    /// The program has started, and is [running](ProgramState::Running) or
    /// [dry](ProgramState::Dry).
    #[error("the streaming program is running")]
    Running,
    /// The program was aborted; an NC reset is required first (assumed).
    #[error("the streaming program was aborted: NC reset expected")]
    Aborted,
}
