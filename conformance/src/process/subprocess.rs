//! A program that exchanges lines with the suite over its stdin and stdout.

use std::process::ExitStatus;
use std::time::Duration;

use super::{LineProcess, RecvError, Stderr, cut, interrupt, shell};
use crate::deadline::Deadline;

/// Time limit for a program to end after its stdin is closed; after `bye`, the time limit for an
/// answer applies if it is longer.
pub const GRACE: Duration = Duration::from_secs(2);

/// The reaction of a program to a line that was sent to it.
#[derive(Clone, Debug, PartialEq)]
pub enum Reaction<A> {
    Answer(A),
    /// The program sent a line that is not a valid answer.
    Garbled(String),
    /// The program ended, or closed its stdout.
    Died(String),
    /// No line arrived within this time limit.
    Silent(Duration),
    /// The program could not be started or is not running, or a signal interrupted the exchange.
    Broken(String),
}

/// A program that is started with a command line.
#[derive(Debug)]
pub struct Subprocess {
    line: String,
    /// The time limit for each answer.
    pub timeout: Duration,
    stderr: Stderr,
    deadline: Option<Deadline>,
    /// The process; `None` if it is not started, or was found to have ended, or was ended.
    pub(crate) running: Option<LineProcess>,
}

impl Subprocess {
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        let (line, stderr) = (line.into(), Stderr::default());
        Self { line, timeout, stderr, deadline: None, running: None }
    }

    /// Sets a deadline, which also limits each wait for an answer. After the deadline, the caller
    /// must send no more lines, see [`over`](Self::over).
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }

    /// The reason why no further line may be sent; `None` if sending is allowed.
    pub fn over(&self) -> Option<String> {
        self.deadline.filter(Deadline::is_over).map(|deadline| deadline.to_string())
    }

    /// The end of the program's stderr.
    pub fn stderr(&self) -> String {
        self.stderr.text()
    }

    /// Starts or restarts the program with these environment variables.
    ///
    /// # Errors
    /// [`Reaction::Broken`], if the program cannot be started, or a signal was received.
    pub fn start<A>(
        &mut self,
        variables: impl IntoIterator<Item = (&'static str, String)>,
    ) -> Result<(), Reaction<A>> {
        self.running = None;
        if interrupt::is_requested() {
            return Err(Reaction::Broken("interrupted".to_owned()));
        }
        self.stderr.begin();
        let mut command = shell(&self.line);
        command.envs(variables);
        let started = LineProcess::start(command, &self.stderr);
        let broken = |error| Reaction::Broken(format!("it cannot be started: {error}"));
        self.running = Some(started.map_err(broken)?);
        Ok(())
    }

    /// Sends a line, if the program is running.
    pub fn send(&self, line: Vec<u8>) {
        if let Some(running) = &self.running {
            running.send(line);
        }
    }

    /// Receives the line of an answer. After a line that is not UTF-8 or has too many values, the
    /// program continues to run; after any other error, it is killed.
    ///
    /// # Errors
    /// The reaction of the program, if it is not a line of text.
    pub fn recv<A>(&mut self, timeout: Duration) -> Result<String, Reaction<A>> {
        let limit = self.limit(timeout);
        let Some(running) = self.running.take() else {
            return Err(Reaction::Broken("it is not running".to_owned()));
        };
        match running.recv(limit) {
            Ok(line) => {
                self.running = Some(running);
                Ok(line)
            }
            Err(RecvError::NoText(why)) => {
                self.running = Some(running);
                Err(Reaction::Garbled(why))
            }
            Err(RecvError::Garbled(why)) => Err(Reaction::Garbled(why)),
            Err(RecvError::Silence) => Err(Reaction::Silent(timeout)),
            Err(RecvError::Interrupted) => Err(Reaction::Broken("interrupted".to_owned())),
            Err(RecvError::Closed) => {
                let end = match running.ended(GRACE) {
                    Some(status) => format!("it ended, {status}"),
                    None => "it closed its stdout".to_owned(),
                };
                let stderr = self.stderr.latest();
                let last = stderr.lines().rev().find(|line| !line.trim().is_empty());
                let last = last.map(|last| format!("; its stderr ends with: {}", cut(last)));
                Err(Reaction::Died(end + &last.unwrap_or_default()))
            }
        }
    }

    /// Closes the program's stdin and waits for its end. Returns the exit status if the program
    /// ended in time, and the first line that the program sent before.
    pub fn finish(&mut self, limit: Duration) -> (Option<ExitStatus>, Option<String>) {
        let limit = self.limit(limit);
        self.running.take().map_or((None, None), |running| running.finish(limit))
    }

    /// Sends the line that tells a running program to end. Returns an error if it does not end in
    /// time with exit code 0, and the first line that it sent before; no error if no program runs.
    pub fn bye(&mut self, line: Vec<u8>) -> (Result<(), String>, Option<String>) {
        if self.running.is_none() {
            return (Ok(()), None);
        }
        self.send(line);
        let (status, unasked) = self.finish(GRACE.max(self.timeout));
        let end = match status {
            Some(status) if status.success() => Ok(()),
            Some(status) => Err(format!("it ended with {status} after bye")),
            None => Err("it did not end after bye".to_owned()),
        };
        (end, unasked)
    }

    fn limit(&self, time: Duration) -> Duration {
        self.deadline.map_or(time, |deadline| deadline.limit(time))
    }
}
