//! Commands that a user names: started apart from this process, and ended with all they started.

pub(crate) mod interrupt;
mod lines;
mod subprocess;

use std::io;
use std::process::{ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

#[cfg(unix)]
use process_wrap::std::ProcessGroup;
use process_wrap::std::{ChildWrapper, CommandWrap};
#[cfg(windows)]
use process_wrap::std::{CreationFlags, JobObject};

pub use lines::{LINE_MAX, LineProcess, RecvError, Stderr, cut, read_line, text};
pub use subprocess::{GRACE, Reaction, Subprocess};

/// How long a command has at least for its first word: some languages take longer for starting than
/// for any answer.
pub const START: Duration = Duration::from_secs(20);

/// A command line as the user's shell understands it.
pub fn shell(line: &str) -> Command {
    #[cfg(windows)]
    {
        use std::os::windows::process::CommandExt as _;

        // cmd does not know the escapes of `arg`. With /S it removes the outer quotes, and no others.
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

/// Commands that run.
static RUNNING: Mutex<Vec<Weak<SharedChild>>> = Mutex::new(Vec::new());

/// A command that was started. When it is dropped, it is ended with what it has started, also if it
/// has ended itself: on Unix the processes of its group - one that has made a group or a session of
/// its own goes on -, on Windows those of its job.
///
/// Ctrl-C of a terminal is for this tool alone, which answers for the command.
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
        // Held while it starts: what ends all commands ends this one too.
        let mut running = lock(&RUNNING);
        let child = Arc::new(Mutex::new(command.spawn()?));
        running.retain(|one| one.strong_count() > 0);
        running.push(Arc::downgrade(&child));
        Ok(Self(child))
    }

    /// Its stdin, if that is a pipe and was not taken before.
    pub fn take_stdin(&self) -> Option<ChildStdin> {
        lock(&self.0).stdin().take()
    }

    /// Its stdout, if that is a pipe and was not taken before.
    pub fn take_stdout(&self) -> Option<ChildStdout> {
        lock(&self.0).stdout().take()
    }

    /// Its stderr, if that is a pipe and was not taken before.
    pub fn take_stderr(&self) -> Option<ChildStderr> {
        lock(&self.0).stderr().take()
    }

    /// How it has ended, if it has.
    pub fn try_wait(&self) -> io::Result<Option<ExitStatus>> {
        lock(&self.0).try_wait()
    }
}

impl Drop for RunningCommand {
    fn drop(&mut self) {
        let mut child = lock(&self.0);
        // What it has started may run on when it has ended. Of a group of which nothing runs any
        // more the number is not given anew in so short a time.
        let _ended = child.start_kill();
        let _waited = child.inner_mut().wait();
    }
}

/// Ends all commands that run; none can be started any more.
pub(crate) fn end_all() {
    let running = lock(&RUNNING);
    for child in running.iter().filter_map(Weak::upgrade) {
        // Who holds it ends it just now, or looks whether it has ended.
        let _ended = lock(&child).start_kill();
    }
    std::mem::forget(running);
}

fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Whatever panicked, what it has written is whole.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
