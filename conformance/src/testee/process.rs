//! A testee that is a process of its own.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read, Write as _};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::message::{Answer, Command, Hello, LINE_MAX, PROTOCOL, Question, Reply};
use super::{Reaction, Testee};
use crate::child;

/// The last of what it wrote to stderr that is kept.
const STDERR_KEPT: usize = 64 << 10;

/// How long it has for ending after `bye`.
const GRACE: Duration = Duration::from_secs(2);

/// Who is started to be judged.
#[derive(Debug)]
pub struct Process {
    line: String,
    timeout: Duration,
    seq: u64,
    running: Option<Running>,
    stderr: Arc<Mutex<VecDeque<u8>>>,
    sent: Option<String>,
    received: Option<String>,
    /// How often it was started.
    pub starts: usize,
}

#[derive(Debug)]
struct Running {
    child: Child,
    to: Sender<Vec<u8>>,
    from: Receiver<Result<String, String>>,
}

impl Process {
    /// A testee that is started by a command line, with so much time for each answer.
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        Self {
            line: line.into(),
            timeout,
            seq: 0,
            running: None,
            stderr: Arc::default(),
            sent: None,
            received: None,
            starts: 0,
        }
    }

    /// The last of what it wrote to stderr.
    pub fn stderr(&self) -> String {
        let kept = self.stderr.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&kept.iter().copied().collect::<Vec<u8>>()).into_owned()
    }

    /// The lines sent and received last, each cut to what a person reads.
    pub fn last(&self) -> (Option<String>, Option<String>) {
        (self.sent.clone(), self.received.clone())
    }

    fn start(&mut self) -> Result<(), Reaction> {
        let broken = |error: io::Error| Reaction::Broken(format!("it cannot be started: {error}"));
        self.starts = self.starts.saturating_add(1);
        let mut command = child::shell(&self.line);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        child::apart(&mut command);
        let mut child = command.spawn().map_err(broken)?;
        let (to, lines) = mpsc::channel();
        let (tell, from) = mpsc::sync_channel(4);
        if let Some(stdin) = child.stdin.take() {
            spawn("to testee", move || write(stdin, &lines)).map_err(broken)?;
        }
        if let Some(stdout) = child.stdout.take() {
            let tell = move || {
                let mut stdout = BufReader::new(stdout);
                while let Some(line) = line(&mut stdout) {
                    let over = line.is_err();
                    if tell.send(line).is_err() || over {
                        break;
                    }
                }
            };
            spawn("from testee", tell).map_err(broken)?;
        }
        if let Some(stderr) = child.stderr.take() {
            let kept = Arc::clone(&self.stderr);
            spawn("testee's stderr", move || keep(stderr, &kept)).map_err(broken)?;
        }
        self.running = Some(Running { child, to, from });
        Ok(())
    }

    fn exchange(&mut self, command: &Command) -> Result<String, Reaction> {
        let mut line = serde_json::to_vec(command)
            .map_err(|error| Reaction::Broken(format!("the question: {error}")))?;
        (self.sent, self.received) = (Some(front(&String::from_utf8_lossy(&line))), None);
        line.push(b'\n');
        let Some(running) = &mut self.running else {
            return Err(Reaction::Broken("it is not running".to_owned()));
        };
        // Who has ended reads nothing: its end is seen when the answer is waited for.
        let _gone = running.to.send(line);
        match running.from.recv_timeout(self.timeout) {
            Ok(Ok(line)) => {
                self.received = Some(front(&line));
                Ok(line)
            }
            Ok(Err(why)) => {
                self.kill();
                Err(Reaction::Garbled(why))
            }
            Err(RecvTimeoutError::Timeout) => {
                self.kill();
                Err(Reaction::Silent(self.timeout))
            }
            Err(RecvTimeoutError::Disconnected) => Err(Reaction::Crashed(self.ended())),
        }
    }

    /// How it has ended that has closed its stdout.
    fn ended(&mut self) -> String {
        let Some(mut running) = self.running.take() else {
            return "it was not running".to_owned();
        };
        let status = wait(&mut running.child, GRACE);
        match status {
            Some(status) => format!("it ended, {status}"),
            None => {
                child::end(&mut running.child);
                "it closed its stdout".to_owned()
            }
        }
    }

    fn kill(&mut self) {
        if let Some(mut running) = self.running.take() {
            child::end(&mut running.child);
        }
    }
}

impl Testee for Process {
    fn hello(&mut self) -> Result<Hello, Reaction> {
        self.kill();
        self.start()?;
        let line = self.exchange(&Command::Hello { protocol: PROTOCOL })?;
        let hello: Hello = serde_json::from_str(&line).map_err(|error| {
            Reaction::Garbled(format!("{error} in the answer to hello: {}", cut(&line)))
        })?;
        match hello.protocol {
            PROTOCOL => Ok(hello),
            other => Err(Reaction::Garbled(format!("it speaks protocol {other}, not {PROTOCOL}"))),
        }
    }

    fn ask(&mut self, question: &Question) -> Reaction {
        if self.running.is_none()
            && let Err(reaction) = self.hello()
        {
            return reaction;
        }
        self.seq = self.seq.saturating_add(1);
        let command = Command::Case { seq: self.seq, question: Box::new(question.clone()) };
        let line = match self.exchange(&command) {
            Ok(line) => line,
            Err(reaction) => return reaction,
        };
        match serde_json::from_str::<Reply>(&line) {
            Ok(Reply { seq, answer }) if seq == Some(self.seq) => Reaction::Answer(answer),
            Ok(Reply { seq: None, answer: Answer::Error { message } }) => {
                Reaction::Garbled(format!("it could not read the case: {message}"))
            }
            Ok(Reply { seq, .. }) => {
                // What it says from now on cannot be told from what it has said too late.
                self.kill();
                let seq = seq.map_or_else(|| "none".to_owned(), |seq| seq.to_string());
                Reaction::Garbled(format!("seq {seq} answers seq {}", self.seq))
            }
            Err(error) => Reaction::Garbled(format!("{error}: {}", cut(&line))),
        }
    }

    fn bye(&mut self) -> Result<(), String> {
        let Some(mut running) = self.running.take() else { return Ok(()) };
        let mut line = serde_json::to_vec(&Command::Bye).unwrap_or_default();
        line.push(b'\n');
        let _gone = running.to.send(line);
        drop(running.to);
        match wait(&mut running.child, GRACE.max(self.timeout)) {
            Some(status) if status.success() => Ok(()),
            Some(status) => Err(format!("it ended with {status} after bye")),
            None => {
                child::end(&mut running.child);
                Err("it did not end after bye".to_owned())
            }
        }
    }

    fn stderr(&self) -> String {
        Process::stderr(self)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.kill();
    }
}

fn spawn(name: &str, run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().name(name.to_owned()).spawn(run).map(drop)
}

/// A testee that does not read must not keep the suite from waiting for its answer.
fn write(mut stdin: ChildStdin, lines: &Receiver<Vec<u8>>) {
    while let Ok(line) = lines.recv() {
        if stdin.write_all(&line).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

/// The next line without its end; none at the end of the stream.
fn line(from: &mut impl BufRead) -> Option<Result<String, String>> {
    let limit = u64::try_from(LINE_MAX).unwrap_or(u64::MAX).saturating_add(2);
    let mut line = Vec::new();
    match from.take(limit).read_until(b'\n', &mut line) {
        Err(_) | Ok(0) => return None,
        Ok(_) => {}
    }
    if line.last() == Some(&b'\n') {
        line.pop();
    } else if line.len() > LINE_MAX {
        return Some(Err(format!("a line of more than {LINE_MAX} bytes")));
    }
    if line.last() == Some(&b'\r') {
        line.pop();
    }
    Some(Ok(String::from_utf8_lossy(&line).into_owned()))
}

fn keep(mut from: impl Read, kept: &Mutex<VecDeque<u8>>) {
    let mut chunk = [0; 4096];
    while let Ok(len @ 1..) = from.read(&mut chunk) {
        let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.extend(chunk.iter().take(len));
        let over = kept.len().saturating_sub(STDERR_KEPT);
        kept.drain(..over);
    }
}

fn wait(child: &mut Child, limit: Duration) -> Option<std::process::ExitStatus> {
    let until = Instant::now().checked_add(limit)?;
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) if Instant::now() < until => thread::sleep(Duration::from_millis(2)),
            _ => return None,
        }
    }
}

/// As much of a line as a person reads.
fn front(line: &str) -> String {
    let shown: String = line.chars().take(400).collect();
    if shown.len() < line.len() { format!("{shown}…") } else { shown }
}

/// The front of a line, for a message.
fn cut(line: &str) -> String {
    let shown: String = line.chars().take(120).collect();
    if shown.len() < line.len() { format!("{shown:?}…") } else { format!("{shown:?}") }
}
