//! Writes the output of a command to stdout or to a file.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::message::exit_with_error;
use crate::exit::Exit;
use crate::session::ToolError;

/// Whether the file name is `-`, which is stdout.
pub(super) fn is_stdout(file: &Path) -> bool {
    file.as_os_str() == "-"
}

/// Writes to a file, or to stdout if its name is `-`.
pub(super) fn write(
    file: &Path,
    make: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if is_stdout(file) {
        return show(make);
    }
    let named =
        |error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", file.display()));
    let mut out = BufWriter::new(File::create(file).map_err(named)?);
    make(&mut out).and_then(|()| out.flush()).map_err(named)
}

/// Writes to stdout; a broken pipe is not an error.
pub(super) fn show(make: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    // Ignore a closed pipe: the exit code must depend on the result, not on the reader of stdout.
    make(&mut out).and_then(|()| out.flush()).or_else(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Ok(()),
        _ => Err(error),
    })
}

/// Writes the only output of a command to stdout, and returns the exit code of the command.
pub(super) fn print_output(make: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Exit {
    show(make).map_or_else(lost, |()| Exit::Success)
}

/// Prints that the output cannot be written, and returns the exit code of an internal error.
pub(super) fn lost(error: io::Error) -> Exit {
    exit_with_error(Exit::Internal, not_written(error))
}

/// Like [`show`], but returns a [`ToolError`].
pub(super) fn print(make: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), ToolError> {
    show(make).map_err(|error| ToolError::Internal(not_written(error)))
}

/// The message for output that cannot be written.
fn not_written(error: io::Error) -> String {
    format!("cannot write the output: {error}")
}
