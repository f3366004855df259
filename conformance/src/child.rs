//! Commands that a user names: started apart from this process, and ended with all they started.

mod spoken;

use std::process::{Child, Command};
use std::time::Duration;

pub(crate) use spoken::front;
pub use spoken::{LINE_MAX, Spoken, Stderr, Unheard, cut, read_line, text};

/// How long a command has at least for its first word: some languages take longer for starting than
/// for any answer.
pub const START: Duration = Duration::from_secs(20);

/// A command line as the user's shell understands it.
pub fn shell(line: &str) -> Command {
    #[cfg(windows)]
    let (program, option) = ("cmd", "/C");
    #[cfg(not(windows))]
    let (program, option) = ("sh", "-c");
    let mut command = Command::new(program);
    command.arg(option).arg(line);
    command
}

/// Ctrl-C is for this tool alone, which answers for the command; and what the command starts can be
/// ended with it.
#[cfg(unix)]
pub fn apart(command: &mut Command) {
    use std::os::unix::process::CommandExt as _;

    command.process_group(0);
}

/// Ctrl-C is for this tool alone, which answers for the command.
#[cfg(windows)]
pub fn apart(command: &mut Command) {
    use std::os::windows::process::CommandExt as _;

    const CREATE_NEW_PROCESS_GROUP: u32 = 0x200;
    command.creation_flags(CREATE_NEW_PROCESS_GROUP);
}

/// Nothing can be done to keep a command apart here.
#[cfg(not(any(unix, windows)))]
pub fn apart(_: &mut Command) {}

/// Ends a command that runs, and what it has started.
pub fn end(child: &mut Child) {
    #[cfg(unix)]
    if let Ok(group) = i32::try_from(child.id()) {
        use nix::sys::signal::{Signal, killpg};
        use nix::unistd::Pid;

        // Nobody has waited for it: its number is still its own.
        let _gone = killpg(Pid::from_raw(group), Signal::SIGKILL);
    }
    let _ended = child.kill().and_then(|()| child.wait());
}
