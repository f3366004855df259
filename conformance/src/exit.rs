//! The exit codes of all commands. `judge/tally.rs` determines the exit code of a run from its
//! verdicts; `report/build.rs` and `cli/run.rs` replace it for rejected writes and for values that
//! are left changed. After a second signal, a process that catches signals and leaves no value
//! changed ends with 130, which is not in [`Exit`] (`process/interrupt.rs`).

use std::process::ExitCode;

/// The exit code of a command. It does not depend on the number of failures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// 0: success. A run may have warnings, differences and waived failures.
    Success,
    /// 1: a verdict that is not waived is fail or vacuous; or a tool reports a failure, for example
    /// because the CNC returned an error.
    Failure,
    /// 2: the command line or a file that it names is wrong.
    Usage,
    /// 3: nothing was judged, a verdict is inconclusive, or the run was interrupted; or a tool has
    /// no complete result, for example because it received no reply.
    Nothing,
    /// 4: the gate rejected a request or must not be used for the target; or, in a run, the file of
    /// `--allow-write` has expired or does not fit the target (`report/build.rs`).
    NotPermitted,
    /// 5: a waiver is stale (`judge/waivers.rs`).
    Stale,
    /// 6: a value was changed and could not be restored.
    UnrestoredValue,
    /// 70: an error of the suite, such as a case that panics, or an unexpected error of the system.
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

    /// All exit codes, in the order of precedence: if several codes apply, the first is used.
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
