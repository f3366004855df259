//! Messages on stderr.

use std::io::Write as _;

use crate::exit::Exit;

/// Writes an error or a message to stderr; ignores a failure of the write.
pub(super) fn print_error(why: impl std::fmt::Display) {
    // The text may quote control characters of a device, a file or a testee.
    let why = crate::text::escape_lines(&why.to_string());
    super::progress::clear();
    let _unprinted = writeln!(std::io::stderr(), "ads-cnc: {why}");
}

/// Writes an error to stderr and returns the exit code.
pub(super) fn exit_with_error(exit: Exit, why: impl std::fmt::Display) -> Exit {
    print_error(why);
    exit
}
