//! What the tool says on stderr.

use std::io::Write as _;
use std::process::ExitCode;

use crate::judge::Exit;

/// Says what is wrong on stderr; if nobody listens there, that is no more to be helped.
pub(super) fn complain(why: impl std::fmt::Display) {
    // Devices, files and testees are quoted in it.
    let why = crate::text::escape_lines(&why.to_string());
    let _unprinted = writeln!(std::io::stderr(), "ads-cnc: {why}");
}

/// Says what is wrong and how the process ends.
pub(super) fn refuse(exit: Exit, why: impl std::fmt::Display) -> ExitCode {
    complain(why);
    exit.into()
}
