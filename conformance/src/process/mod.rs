//! Runs the user's commands, each in its own process group, and ends them together with the
//! processes that they started, see [`RunningCommand`].

pub(crate) mod interrupt;
mod lines;
pub(crate) mod progress;
mod subprocess;

use std::io;
use std::process::{ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus};
use std::sync::{Arc, Mutex, Weak};
use std::thread;
use std::time::{Duration, Instant};

#[cfg(unix)]
use process_wrap::std::ProcessGroup;
use process_wrap::std::{ChildWrapper, CommandWrap};
#[cfg(windows)]
use process_wrap::std::{CreationFlags, JobObject};

use crate::mutex::lock;

pub(crate) use lines::not_json;
pub use lines::{LINE_MAX, LineProcess, RecvError, Stderr, cut, read_line, text};
pub use subprocess::{GRACE, Reaction, Subprocess};

/// Minimum time limit for the first line of a testee or client: some languages start slowly.
pub const START: Duration = Duration::from_secs(20);

/// Interval at which to check whether a command has ended.
const POLL: Duration = Duration::from_millis(2);

/// Time limit for a killed command to end: a command that runs as another user cannot be killed.
const KILL_MAX: Duration = Duration::from_secs(1);

/// The command that runs a command line in a shell: `sh`, or `cmd` on Windows.
pub fn shell(line: &str) -> Command {
    #[cfg(windows)]
    {
        use std::os::windows::process::CommandExt as _;

        // cmd does not understand the escapes that `arg` writes. With /S, cmd only removes the
        // outer quotes.
        let mut command = Command::new("cmd");
        command.raw_arg(format!("/S /C \"{line}\""));
        command
    }
    #[cfg(not(windows))]
    {
        let mut command = Command::new("sh");
        command.args(["-c", line]);
        command
    }
}

type SharedChild = Mutex<Box<dyn ChildWrapper>>;

/// The commands that were started; one that was dropped is removed at the next start.
static RUNNING: Mutex<Vec<Weak<SharedChild>>> = Mutex::new(Vec::new());

/// A running command. Dropping it ends the command and the processes that it started, even if the
/// command has already ended: on Unix its process group (a process that the command started, and that
/// created its own group or session, continues), on Windows its job.
///
/// Because the command has its own process group, Ctrl-C in a terminal reaches only this tool,
/// which then ends the command.
#[derive(Debug)]
pub struct RunningCommand(Arc<SharedChild>);

impl RunningCommand {
    pub fn start(command: Command) -> io::Result<Self> {
        let mut command = CommandWrap::from(command);
        #[cfg(unix)]
        command.wrap(ProcessGroup::leader());
        #[cfg(windows)]
        command
            .wrap(CreationFlags(windows::Win32::System::Threading::CREATE_NEW_PROCESS_GROUP))
            .wrap(JobObject);
        // The lock is held during the start, so that `end_all` cannot miss the new command.
        let mut running = lock(&RUNNING);
        let child = Arc::new(Mutex::new(command.spawn()?));
        running.retain(|one| one.strong_count() > 0);
        running.push(Arc::downgrade(&child));
        Ok(Self(child))
    }

    /// Takes the command's stdin, if it is a pipe and was not taken before.
    pub fn take_stdin(&self) -> Option<ChildStdin> {
        lock(&self.0).stdin().take()
    }

    /// Takes the command's stdout, if it is a pipe and was not taken before.
    pub fn take_stdout(&self) -> Option<ChildStdout> {
        lock(&self.0).stdout().take()
    }

    /// Takes the command's stderr, if it is a pipe and was not taken before.
    pub fn take_stderr(&self) -> Option<ChildStderr> {
        lock(&self.0).stderr().take()
    }

    /// The exit status, if the command has ended.
    pub fn try_wait(&self) -> io::Result<Option<ExitStatus>> {
        // The wrapper would look only in the process group, which the command may have left.
        lock(&self.0).inner_mut().try_wait()
    }
}

impl Drop for RunningCommand {
    fn drop(&mut self) {
        kill(&self.0);
        // The lock is released between the polls, because `end_all` needs it.
        let begun = Instant::now();
        while matches!(self.try_wait(), Ok(None)) && begun.elapsed() < KILL_MAX {
            thread::sleep(POLL);
        }
    }
}

/// Kills the processes that a command started and, if it has not ended, the command.
fn kill(child: &SharedChild) {
    let mut child = lock(child);
    // Even if the command has ended, processes that it started may still run, so the group is
    // killed. It is assumed that the system does not reuse the ID of an empty group so quickly.
    let _ended = child.start_kill();
    // The command itself may have left its group.
    let command = child.inner_mut();
    if matches!(command.try_wait(), Ok(None)) {
        let _ended = command.start_kill();
    }
}

/// Ends all running commands, and prevents the start of further commands by never releasing the
/// lock of `RUNNING`.
pub(crate) fn end_all() {
    let running = lock(&RUNNING);
    // Another thread holds the lock of a child only for a short time, to kill or to poll the child.
    running.iter().filter_map(Weak::upgrade).for_each(|child| kill(&child));
    std::mem::forget(running);
}
