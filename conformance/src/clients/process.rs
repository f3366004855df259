//! A client that is a process of its own: started for each action, or spoken with.

use std::time::Duration;

use super::message::{Answer, Hello, PROTOCOL, Place, Reaction, environment, told};
use super::{Action, Actor};
use crate::deadline::Deadline;
use crate::process::{LineProcess, RecvError, START, Stderr, cut, shell};

/// How long it has for ending when all is said.
const GRACE: Duration = Duration::from_secs(2);

/// The scenario in which a client says who it is.
const HELLO: &str = "hello";

/// A client that is started by a command line.
#[derive(Debug)]
pub struct Process {
    line: String,
    timeout: Duration,
    /// One that stays.
    running: Option<LineProcess>,
    stays: bool,
    stderr: Stderr,
    /// What it has said without being asked.
    unasked: Vec<String>,
    deadline: Option<Deadline>,
}

impl Process {
    /// A client with so much time for each action.
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        let stderr = Stderr::default();
        let (line, unasked) = (line.into(), Vec::new());
        Self { line, timeout, running: None, stays: false, stderr, unasked, deadline: None }
    }

    /// With a moment after which it is told nothing more.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { deadline: Some(deadline), ..self }
    }

    fn limit(&self, time: Duration) -> Duration {
        self.deadline.map_or(time, |deadline| deadline.limit(time))
    }

    fn start(&self, place: &Place, scenario: &str, action: &str) -> Result<LineProcess, Reaction> {
        let mut command = shell(&self.line);
        command.envs(environment(place, scenario, action));
        LineProcess::start(command, &self.stderr)
            .map_err(|error| Reaction::Broken(format!("it cannot be started: {error}")))
    }

    /// The line it answers with; ended if there is none.
    fn recv(
        &self,
        running: LineProcess,
        timeout: Duration,
    ) -> Result<(String, LineProcess), Reaction> {
        match running.recv(self.limit(timeout)) {
            Ok(line) => Ok((line, running)),
            Err(RecvError::Garbled(why) | RecvError::NoText(why)) => Err(Reaction::Garbled(why)),
            Err(RecvError::Silence) => Err(Reaction::Hung(timeout)),
            Err(RecvError::Interrupted) => Err(Reaction::Broken("interrupted".to_owned())),
            Err(RecvError::Closed) => Err(Reaction::Died(match running.ended(GRACE) {
                Some(status) => status.to_string(),
                None => "it closed its stdout".to_owned(),
            })),
        }
    }
}

impl Actor for Process {
    fn over(&self) -> Option<String> {
        self.deadline.filter(Deadline::is_over).map(|deadline| deadline.to_string())
    }

    fn hello(&mut self, place: &Place) -> Result<Hello, Reaction> {
        let running = self.start(place, HELLO, HELLO)?;
        let (line, running) = self.recv(running, START.max(self.timeout))?;
        let hello: Hello = serde_json::from_str(&line)
            .map_err(|error| Reaction::Garbled(format!("{error} in the hello {}", cut(&line))))?;
        if hello.protocol != PROTOCOL {
            let other = hello.protocol;
            return Err(Reaction::Garbled(format!("it speaks protocol {other}, not {PROTOCOL}")));
        }
        self.stays = hello.stays;
        if hello.stays {
            self.running = Some(running);
        } else {
            self.unasked.extend(running.finish(GRACE).1);
        }
        Ok(hello)
    }

    fn act(&mut self, place: &Place, scenario: &str, action: &Action) -> Reaction {
        // Of one that has said too much, what comes next cannot be told from an answer.
        let unasked = self.running.as_ref().and_then(LineProcess::unasked);
        if unasked.is_some() {
            self.running = None;
            self.unasked.extend(unasked);
        }
        let started = match self.running.take() {
            Some(running) => Ok(running),
            None if self.stays => match self.hello(place) {
                Ok(_) => match self.running.take() {
                    Some(running) => Ok(running),
                    None => Err(Reaction::Garbled("it stays no longer".to_owned())),
                },
                Err(reaction) => Err(reaction),
            },
            None => self.start(place, scenario, &action.to_string()),
        };
        let heard = started.and_then(|running| {
            if self.stays {
                running.send(told(place, scenario, action).to_string().into_bytes());
            }
            self.recv(running, self.timeout)
        });
        let (line, running) = match heard {
            Ok(heard) => heard,
            Err(reaction) => return reaction,
        };
        let answer = serde_json::from_str::<Answer>(&line);
        if self.stays {
            self.running = Some(running);
        } else {
            match running.finish(GRACE) {
                (None, _) => return Reaction::Hung(GRACE),
                (_, unasked) => self.unasked.extend(unasked),
            }
        }
        match answer {
            Ok(answer) => Reaction::Answer(answer),
            Err(error) => Reaction::Garbled(format!("{error}: {}", cut(&line))),
        }
    }

    fn bye(&mut self) -> Result<(), String> {
        let Some(running) = self.running.take() else { return Ok(()) };
        running.send(b"{\"cmd\":\"bye\"}".to_vec());
        let (status, unasked) = running.finish(self.limit(GRACE.max(self.timeout)));
        self.unasked.extend(unasked);
        match status {
            Some(status) if status.success() => Ok(()),
            Some(status) => Err(format!("it ended with {status} after bye")),
            None => Err("it did not end after bye".to_owned()),
        }
    }

    fn unasked(&mut self) -> Vec<String> {
        std::mem::take(&mut self.unasked)
    }

    fn stderr(&self) -> String {
        self.stderr.text()
    }
}
