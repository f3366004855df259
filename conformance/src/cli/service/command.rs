//! Runs a command for a request.

use std::io::{Read, Write as _};
use std::process::{self, Child, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::CncStr;
use ads_cnc::service::ServiceId;

use super::super::interrupt::Interrupt;
use super::response::{Answer, Ended, KEPT, answer};
use super::utf8;
use crate::child::{apart, end};

/// How long stdout may stay open when the command has ended: what it has started may hold it.
const GRACE: Duration = Duration::from_millis(500);

/// How often it looks whether the command has ended.
const LOOK: Duration = Duration::from_millis(5);

/// What is run for each request.
pub(super) struct Command<'s> {
    /// The program and its arguments.
    pub(super) words: &'s [String],
    pub(super) channel: u8,
    pub(super) limit: Duration,
    pub(super) interrupt: &'s Interrupt,
}

impl Command<'_> {
    /// Runs it for a request, for as long as it may take.
    pub(super) fn run(&self, uuid: ServiceId, request: CncStr<'_>, state: u32) -> Answer {
        let started = Instant::now();
        match self.start(uuid, state) {
            Err(why) => answer(&Ended::NotStarted(why), &[]),
            Ok(mut child) => {
                let stdout = Capture::start(&mut child);
                if let Some(mut stdin) = child.stdin.take() {
                    // A command need not read it. It fits every pipe.
                    let _unread = writeln!(stdin, "{}", utf8(request));
                }
                let ended = self.wait(&mut child, started);
                let (stdout, closed) = stdout.end(&ended);
                let mut answer = answer(&ended, &stdout);
                if !closed {
                    let warning = "something that the command has started still has its stdout";
                    answer.warnings.push(warning.to_owned());
                }
                answer
            }
        }
    }

    fn start(&self, uuid: ServiceId, state: u32) -> Result<Child, String> {
        let (program, arguments) = self.words.split_first().ok_or("there is none")?;
        let mut command = process::Command::new(program);
        command
            .args(arguments)
            .env("ADS_CNC_UUID", uuid.to_string())
            .env("ADS_CNC_REQUEST_STATE", state.to_string())
            .env("ADS_CNC_CHANNEL", self.channel.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit());
        apart(&mut command);
        command.spawn().map_err(|error| format!("{program}: {error}"))
    }

    fn wait(&self, child: &mut Child, started: Instant) -> Ended {
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return Ended::Exited(status),
                Ok(None) => {}
                Err(error) => {
                    end(child);
                    return Ended::NotStarted(error.to_string());
                }
            }
            let left = self.limit.saturating_sub(started.elapsed());
            if left.is_zero() {
                end(child);
                return Ended::TimeOver(self.limit);
            }
            if self.interrupt.sleep(left.min(LOOK)) {
                end(child);
                return Ended::Interrupted;
            }
        }
    }
}

/// The front of what a command writes.
struct Capture {
    kept: Arc<Mutex<Vec<u8>>>,
    closed: mpsc::Receiver<()>,
}

impl Capture {
    fn start(child: &mut Child) -> Self {
        let (tell, closed) = mpsc::channel::<()>();
        let kept = Arc::new(Mutex::new(Vec::new()));
        if let Some(stdout) = child.stdout.take() {
            let keep = Arc::clone(&kept);
            let read = move || {
                read(stdout, &keep);
                drop(tell);
            };
            // Without a thread there is no output, which the answer shows.
            let _thread = thread::Builder::new().name("stdout".to_owned()).spawn(read);
        }
        Self { kept, closed }
    }

    /// What was written, and whether that is all.
    fn end(self, ended: &Ended) -> (Vec<u8>, bool) {
        let open = self.closed.recv_timeout(GRACE) == Err(RecvTimeoutError::Timeout);
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner).clone();
        (kept, !open || !matches!(ended, Ended::Exited(_)))
    }
}

/// Reads to the end, and keeps the front. A command whose stdout nobody reads would stand still.
fn read(mut from: impl Read, keep: &Mutex<Vec<u8>>) {
    let mut chunk = [0; 4096];
    while let Ok(len @ 1..) = from.read(&mut chunk) {
        let mut kept = keep.lock().unwrap_or_else(PoisonError::into_inner);
        let room = KEPT.saturating_sub(kept.len());
        kept.extend(chunk.iter().take(len.min(room)));
    }
}
