//! A testee that is a process of its own.

use std::time::Duration;

use super::{Reaction, Testee};
use crate::codec::message::{Answer, Command, Hello, PROTOCOL, Question, Reply};
use crate::deadline::Deadline;
use crate::process::interrupt;
use crate::process::{LineProcess, RecvError, START, Stderr, cut, shell};
use crate::text::shorten;

/// How long it has for ending after `bye`.
const GRACE: Duration = Duration::from_secs(2);

/// As much of a line as a person reads.
const SHOWN: usize = 400;

/// Who is started to be judged.
#[derive(Debug)]
pub struct Process {
    line: String,
    timeout: Duration,
    seq: u64,
    running: Option<LineProcess>,
    stderr: Stderr,
    sent: Option<String>,
    received: Option<String>,
    deadline: Option<Deadline>,
    /// How often it was started.
    pub starts: usize,
}

impl Process {
    /// A testee that is started by a command line, with so much time for each answer.
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        Self {
            line: line.into(),
            timeout,
            seq: 0,
            running: None,
            stderr: Stderr::default(),
            sent: None,
            received: None,
            deadline: None,
            starts: 0,
        }
    }

    /// With a moment after which nothing more is asked.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }

    /// The last of what it wrote to stderr.
    pub fn stderr(&self) -> String {
        self.stderr.text()
    }

    /// The lines sent and received last, each cut to what a person reads.
    pub fn last(&self) -> (Option<String>, Option<String>) {
        (self.sent.clone(), self.received.clone())
    }

    fn limit(&self, time: Duration) -> Duration {
        self.deadline.map_or(time, |deadline| deadline.limit(time))
    }

    fn start(&mut self) -> Result<(), Reaction> {
        if interrupt::came() {
            return Err(Reaction::Broken("interrupted".to_owned()));
        }
        self.starts = self.starts.saturating_add(1);
        let started = LineProcess::start(shell(&self.line), &self.stderr);
        let running =
            started.map_err(|error| Reaction::Broken(format!("it cannot be started: {error}")))?;
        self.running = Some(running);
        Ok(())
    }

    fn exchange(&mut self, command: &Command, timeout: Duration) -> Result<String, Reaction> {
        let line = serde_json::to_vec(command)
            .map_err(|error| Reaction::Broken(format!("the question: {error}")))?;
        (self.sent, self.received) = (Some(shorten(&String::from_utf8_lossy(&line), SHOWN)), None);
        let Some(running) = &self.running else {
            return Err(Reaction::Broken("it is not running".to_owned()));
        };
        running.send(line);
        match running.recv(self.limit(timeout)) {
            Ok(line) => {
                self.received = Some(shorten(&line, SHOWN));
                Ok(line)
            }
            Err(RecvError::NoText(why)) => Err(Reaction::Garbled(why)),
            Err(RecvError::Garbled(why)) => {
                self.running = None;
                Err(Reaction::Garbled(why))
            }
            Err(RecvError::Silence) => {
                self.running = None;
                Err(Reaction::Silent(timeout))
            }
            Err(RecvError::Interrupted) => {
                self.running = None;
                Err(Reaction::Broken("interrupted".to_owned()))
            }
            Err(RecvError::Closed) => Err(Reaction::Crashed(self.ended())),
        }
    }

    /// How it has ended that has closed its stdout.
    fn ended(&mut self) -> String {
        let Some(running) = self.running.take() else {
            return "it was not running".to_owned();
        };
        match running.ended(GRACE) {
            Some(status) => format!("it ended, {status}"),
            None => "it closed its stdout".to_owned(),
        }
    }
}

impl Testee for Process {
    fn hello(&mut self) -> Result<Hello, Reaction> {
        self.running = None;
        self.start()?;
        let line =
            self.exchange(&Command::Hello { protocol: PROTOCOL }, START.max(self.timeout))?;
        greeted(&line)
    }

    fn ask(&mut self, question: &Question) -> Reaction {
        if self.running.is_none()
            && let Err(reaction) = self.hello()
        {
            return reaction;
        }
        self.seq = self.seq.saturating_add(1);
        let command = Command::Case { seq: self.seq, question: Box::new(question.clone()) };
        let line = match self.exchange(&command, self.timeout) {
            Ok(line) => line,
            Err(reaction) => return reaction,
        };
        let (reaction, in_step) = answered(&line, self.seq);
        if !in_step {
            self.running = None;
        }
        reaction
    }

    fn bye(&mut self) -> Result<(), String> {
        let Some(running) = self.running.take() else { return Ok(()) };
        running.send(serde_json::to_vec(&Command::Bye).unwrap_or_default());
        match running.finish(self.limit(GRACE.max(self.timeout))) {
            (_, Some(unasked)) => Err(format!("it said {unasked}, which nobody asked for")),
            (Some(status), _) if status.success() => Ok(()),
            (Some(status), _) => Err(format!("it ended with {status} after bye")),
            (None, _) => Err("it did not end after bye".to_owned()),
        }
    }

    fn stderr(&self) -> String {
        Process::stderr(self)
    }

    fn over(&self) -> Option<String> {
        self.deadline.filter(Deadline::is_over).map(|deadline| deadline.to_string())
    }
}

/// What a testee says of itself with the line that answers `hello`.
///
/// # Errors
/// That this is no answer to it.
pub fn greeted(line: &str) -> Result<Hello, Reaction> {
    let hello: Hello = serde_json::from_str(line).map_err(|error| {
        Reaction::Garbled(format!("{error} in the answer to hello: {}", cut(line)))
    })?;
    match hello.protocol {
        PROTOCOL => Ok(hello),
        other => Err(Reaction::Garbled(format!("it speaks protocol {other}, not {PROTOCOL}"))),
    }
}

/// What the line is that came for the case of this number; and whether the next line may answer the
/// next case. After the answer to another case it cannot be told from what was said too late.
///
/// ```
/// use ads_cnc_conformance::testee::{Answer, Output, Reaction, answered};
///
/// let ok = Reaction::Answer(Answer::Ok(Output::default()));
/// assert_eq!(answered(r#"{"seq": 7, "ok": {}}"#, 7), (ok, true));
/// assert!(matches!(answered(r#"{"seq": 6, "ok": {}}"#, 7), (Reaction::Garbled(_), false)));
/// assert!(matches!(answered("Hello!", 7), (Reaction::Garbled(_), true)));
/// ```
pub fn answered(line: &str, seq: u64) -> (Reaction, bool) {
    match serde_json::from_str::<Reply>(line) {
        Ok(reply) if reply.seq == Some(seq) => (Reaction::Answer(reply.answer), true),
        Ok(Reply { seq: None, answer: Answer::Error { message } }) => {
            (Reaction::Garbled(format!("it could not read the case: {message}")), true)
        }
        Ok(reply) => {
            let found = reply.seq.map_or_else(|| "none".to_owned(), |seq| seq.to_string());
            (Reaction::Garbled(format!("seq {found} answers seq {seq}")), false)
        }
        Err(error) => (Reaction::Garbled(format!("{error}: {}", cut(line))), true),
    }
}
