//! Runs the command of `service` for a request.

use std::io::{Read, Write as _};
use std::process::{self, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::CncStr;
use ads_cnc::service::ServiceId;

use super::response::{CommandEnd, STDOUT_MAX, ServiceResponse, answer};
use crate::mutex::lock;
use crate::process::RunningCommand;
use crate::process::interrupt::Interrupt;

/// Time for which stdout may stay open after the command has ended: a process that the command
/// started may still have it open.
const GRACE: Duration = Duration::from_millis(500);

/// Interval at which the command is polled.
const POLL_INTERVAL: Duration = Duration::from_millis(5);

/// Maximum number of ended commands whose stdout a process still keeps open. Each such stdout
/// occupies a thread of this tool. The process was started by the command and, on Unix, has its own
/// process group: other processes are ended with the command.
const HOLDERS_MAX: usize = 8;

/// The command that answers each request.
pub(super) struct ServiceCommand<'s> {
    /// The program and its arguments.
    pub(super) words: &'s [String],
    pub(super) channel: u8,
    pub(super) limit: Duration,
    pub(super) interrupt: &'s Interrupt,
    /// Number of threads that read the stdout of a command.
    pub(super) readers: Arc<AtomicUsize>,
}

impl ServiceCommand<'_> {
    /// Runs the command for a request, until it ends, the time limit is over or a signal arrives.
    pub(super) fn run(&self, uuid: ServiceId, request: CncStr<'_>, state: u32) -> ServiceResponse {
        let started = Instant::now();
        match self.start(uuid, state) {
            Err(why) => answer(&CommandEnd::NotStarted(why), &[]),
            Ok(child) => {
                let stdout = CapturedOutput::start(&child, &self.readers);
                if let Some(mut stdin) = child.take_stdin() {
                    // This does not block, even if the command does not read stdin: the request
                    // fits into the pipe's buffer.
                    let _unread = writeln!(stdin, "{}", utf8(request));
                }
                let ended = self.wait(&child, started);
                let closed = !matches!(ended, CommandEnd::Exited(_)) || stdout.closes();
                // This ends the command and the processes that it started, except those with their
                // own process group.
                drop(child);
                stdout.closes();
                let mut answer = answer(&ended, &stdout.bytes());
                if !closed {
                    let warning = "a process started by the command kept its stdout open; it was \
                                   ended unless it has its own process group";
                    answer.warnings.push(warning.to_owned());
                }
                answer
            }
        }
    }

    fn start(&self, uuid: ServiceId, state: u32) -> Result<RunningCommand, String> {
        if self.readers.load(Ordering::SeqCst) >= HOLDERS_MAX {
            return Err(format!(
                "{HOLDERS_MAX} processes started by earlier commands still hold their stdout; \
                 end them"
            ));
        }
        let (program, arguments) = self.words.split_first().ok_or("no command")?;
        let mut command = process::Command::new(program);
        command
            .args(arguments)
            .env("ADS_CNC_UUID", uuid.to_string())
            .env("ADS_CNC_REQUEST_STATE", state.to_string())
            .env("ADS_CNC_CHANNEL", self.channel.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit());
        RunningCommand::start(command).map_err(|error| format!("{program}: {error}"))
    }

    fn wait(&self, child: &RunningCommand, started: Instant) -> CommandEnd {
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return CommandEnd::Exited(status),
                Ok(None) => {}
                Err(error) => return CommandEnd::NotStarted(error.to_string()),
            }
            let left = self.limit.saturating_sub(started.elapsed());
            if left.is_zero() {
                return CommandEnd::TimeOver(self.limit);
            }
            if self.interrupt.sleep(left.min(POLL_INTERVAL)) {
                return CommandEnd::Interrupted;
            }
        }
    }
}

/// The first [`STDOUT_MAX`] bytes of a command's output.
struct CapturedOutput {
    kept: Arc<Mutex<Vec<u8>>>,
    closed: mpsc::Receiver<()>,
}

impl CapturedOutput {
    fn start(child: &RunningCommand, readers: &Arc<AtomicUsize>) -> Self {
        let (tell, closed) = mpsc::channel::<()>();
        let kept = Arc::new(Mutex::new(Vec::new()));
        if let Some(stdout) = child.take_stdout() {
            let (keep, reading) = (Arc::clone(&kept), Arc::clone(readers));
            readers.fetch_add(1, Ordering::SeqCst);
            let read = move || {
                read(stdout, &keep);
                reading.fetch_sub(1, Ordering::SeqCst);
                drop(tell);
            };
            if thread::Builder::new().name("stdout".to_owned()).spawn(read).is_err() {
                // Without the thread, no output is read, so the response contains no output.
                readers.fetch_sub(1, Ordering::SeqCst);
            }
        }
        Self { kept, closed }
    }

    /// Waits until stdout is closed and all output is stored, for at most [`GRACE`]. Returns
    /// whether stdout is closed.
    fn closes(&self) -> bool {
        self.closed.recv_timeout(GRACE) != Err(RecvTimeoutError::Timeout)
    }

    fn bytes(&self) -> Vec<u8> {
        lock(&self.kept).clone()
    }
}

/// Stores the first [`STDOUT_MAX`] bytes, but reads to the end, because a command whose stdout is
/// not read would block.
fn read(mut from: impl Read, keep: &Mutex<Vec<u8>>) {
    let mut chunk = [0; 4096];
    while let Ok(len @ 1..) = from.read(&mut chunk) {
        let mut kept = lock(keep);
        let room = STDOUT_MAX.saturating_sub(kept.len());
        kept.extend(chunk.iter().take(len.min(room)));
    }
}

/// Converts a CP1252 text to UTF-8, in which the command receives the request.
pub(super) fn utf8(text: CncStr<'_>) -> String {
    text.chars().collect()
}
