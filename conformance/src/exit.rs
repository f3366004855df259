//! The exit codes of all commands. `judge/tally.rs` determines the one of a run.

use std::process::ExitCode;

/// The exit code of a run; it is never a count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: every judged requirement passed; warnings and differences are permitted.
    Success,
    /// 1: a verdict is fail or vacuous.
    Failure,
    /// 2: the command line is wrong.
    Usage,
    /// 3: nothing was judged, a verdict is inconclusive, or the run was interrupted.
    Nothing,
    /// 4: the gate rejected a request, or the file of `--allow-write` does not fit the target
    /// (`report/build.rs`).
    NotPermitted,
    /// 5: a waiver is stale (`judge/waivers.rs`).
    Stale,
    /// 6: a value was changed and could not be restored.
    UnrestoredValue,
    /// 70: an error of the suite, such as a case that panics.
    Internal,
}

impl Exit {
    pub const fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Failure => 1,
            Self::Usage => 2,
            Self::Nothing => 3,
            Self::NotPermitted => 4,
            Self::Stale => 5,
            Self::UnrestoredValue => 6,
            Self::Internal => 70,
        }
    }

    pub fn from_code(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|exit| exit.code() == code)
    }

    /// All exit codes, in the order of precedence.
    pub const ALL: [Self; 8] = [
        Self::Internal,
        Self::UnrestoredValue,
        Self::Usage,
        Self::NotPermitted,
        Self::Failure,
        Self::Stale,
        Self::Nothing,
        Self::Success,
    ];
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
