//! `ads-cnc serve --executed`: writes the executed lines of streamed programs to files.

use std::fs::File;
use std::io::Write as _;
use std::path::PathBuf;
use std::str::FromStr;

use crate::simulator::Cnc;
use crate::simulator::program::ProgramState;

/// A channel, and the file for its executed lines.
#[derive(Clone, Debug)]
pub(super) struct ExecutedTo {
    channel: u8,
    file: PathBuf,
}

impl FromStr for ExecutedTo {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (channel, file) = text.split_once('=').ok_or(NEEDED)?;
        match (channel.parse(), file) {
            (Err(_), _) | (_, "") => Err(NEEDED),
            (Ok(channel), file) => Ok(Self { channel, file: file.into() }),
        }
    }
}

const NEEDED: &str = "expected the number of a channel and a file, such as 1=executed.nc";

/// The open file of a channel. It is opened before a program is streamed, so that an error is
/// reported early.
#[derive(Debug)]
pub(super) struct ExecutedFile<'a>(&'a ExecutedTo, File);

impl ExecutedTo {
    pub(super) fn open(&self, cnc: &Cnc) -> Result<ExecutedFile<'_>, String> {
        cnc.with_program(self.channel, |_| ()).map_err(|error| error.to_string())?;
        match File::create(&self.file) {
            Ok(file) => Ok(ExecutedFile(self, file)),
            Err(error) => Err(format!("{}: {error}", self.file.display())),
        }
    }
}

impl ExecutedFile<'_> {
    /// Writes the latest executed lines that the simulated CNC has stored.
    pub(super) fn write(mut self, cnc: &Cnc) -> Result<(), String> {
        let executed = cnc.with_program(self.0.channel, |program| program.executed().clone());
        let executed = executed.map_err(|error| error.to_string())?;
        let written = self.1.write_all(executed.recent()).and_then(|()| self.1.flush());
        written.map_err(|error| format!("{}: {error}", self.0.file.display()))
    }
}

/// Logs the number of executed lines of each channel that has executed lines, or whose streaming
/// was aborted.
pub(super) fn log(cnc: &Cnc) {
    for channel in cnc.model().channels() {
        let ran =
            cnc.with_program(channel, |program| (program.executed().clone(), program.state()));
        let Ok((executed, state)) = ran else { continue };
        let (lines, bytes) = (executed.line_count(), executed.byte_count());
        match state {
            ProgramState::Aborted(why) => {
                tracing::warn!(channel, lines, bytes, "streaming was aborted: {why}");
            }
            _ if lines > 0 => tracing::info!(channel, lines, bytes, "NC lines were run"),
            _ => {}
        }
    }
}
