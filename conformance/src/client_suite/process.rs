//! A client in its own process, which the suite starts once or for each action.

use std::time::{Duration, Instant};

use super::action::VOCABULARY;
use super::message::{
    ActionResult, ClientHello, ClientReaction, CncAddress, PROTOCOL, action_command, environment,
};
use super::{Action, ClientUnderTest};
use crate::deadline::Deadline;
use crate::process::{GRACE, LineProcess, START, Subprocess, not_json};
use crate::text::did_you_mean;

/// The value of the environment variables `ADS_CNC_SCENARIO` and `ADS_CNC_DO` when the suite
/// requests hello.
const HELLO: &str = "hello";

/// A client that is started by a command line.
#[derive(Debug)]
pub struct ClientProcess {
    process: Subprocess,
    stays: bool,
    /// Lines that the client has printed in addition to its answers; only the first of several at
    /// once.
    unasked: Vec<String>,
}

impl ClientProcess {
    /// Creates a client with its command line and a time limit for each action.
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        Self { process: Subprocess::new(line, timeout), stays: false, unasked: Vec::new() }
    }

    /// Sets a deadline after which no more actions are sent.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { process: self.process.with_deadline(deadline), ..self }
    }

    /// Receives the line with the answer; without a valid line in time, the process is killed.
    fn recv(&mut self, timeout: Duration) -> Result<String, ClientReaction> {
        let line = self.process.recv(timeout);
        if line.is_err() {
            self.process.running = None;
        }
        line
    }

    fn answer(
        &mut self,
        cnc_address: &CncAddress,
        scenario: &str,
        action: &Action,
    ) -> Result<ClientReaction, ClientReaction> {
        if self.process.running.is_none() {
            if self.stays {
                self.hello(cnc_address)?;
                if !self.stays {
                    return Err(ClientReaction::Garbled(
                        "it no longer keeps running, as its first hello claimed".to_owned(),
                    ));
                }
            } else {
                self.process.start(environment(cnc_address, scenario, &action.to_string()))?;
            }
        }
        if self.stays {
            self.process
                .send(action_command(cnc_address, scenario, action).to_string().into_bytes());
        }
        let begun = Instant::now();
        let line = self.recv(self.process.timeout)?;
        if !self.stays {
            let left = self.process.timeout.saturating_sub(begun.elapsed()).max(GRACE);
            match self.process.finish(left) {
                (None, _) => {
                    let limit = left.as_millis();
                    return Err(ClientReaction::Garbled(format!(
                        "the client did not exit within {limit} ms after it"
                    )));
                }
                (_, unasked) => self.unasked.extend(unasked),
            }
        }
        Ok(match serde_json::from_str::<ActionResult>(&line) {
            Ok(answer) => ClientReaction::Answer(answer),
            Err(error) => {
                // The process is killed, because its next line may be the late answer to this
                // action.
                self.process.running = None;
                ClientReaction::Garbled(not_json(&line, &error))
            }
        })
    }
}

/// Rejects a hello with an unknown action: the cases of a misspelt action would only be reported as
/// not applicable.
fn known_actions(hello: &ClientHello) -> Result<(), ClientReaction> {
    let words = || VOCABULARY.iter().map(|word| word.name);
    match hello.actions.iter().find(|one| !words().any(|word| word == one.as_str())) {
        None => Ok(()),
        Some(word) => {
            let near = did_you_mean(word, words());
            Err(ClientReaction::Garbled(format!("its hello has the unknown action {word:?}{near}")))
        }
    }
}

impl ClientUnderTest for ClientProcess {
    fn over(&self) -> Option<String> {
        self.process.over()
    }

    fn hello(&mut self, cnc_address: &CncAddress) -> Result<ClientHello, ClientReaction> {
        self.process.start(environment(cnc_address, HELLO, HELLO))?;
        let line = self.recv(START.max(self.process.timeout))?;
        let hello = serde_json::from_str::<ClientHello>(&line)
            .map_err(|error| ClientReaction::Garbled(not_json(&line, &error)))
            .and_then(|hello| match hello.protocol {
                PROTOCOL => known_actions(&hello).map(|()| hello),
                other => {
                    let why = format!("it uses protocol {other}, not {PROTOCOL}");
                    Err(ClientReaction::Garbled(why))
                }
            });
        let hello = hello.inspect_err(|_| self.process.running = None)?;
        self.stays = hello.stays;
        if !hello.stays {
            self.unasked.extend(self.process.finish(GRACE).1);
        }
        Ok(hello)
    }

    fn act(&mut self, cnc_address: &CncAddress, scenario: &str, action: &Action) -> ClientReaction {
        // If the client has printed an additional line, its next line cannot be attributed to an
        // action, so the process is killed.
        if let Some(unasked) = self.process.running.as_ref().and_then(LineProcess::unasked) {
            self.process.running = None;
            self.unasked.push(unasked);
        }
        self.answer(cnc_address, scenario, action).unwrap_or_else(|reaction| reaction)
    }

    fn bye(&mut self) -> Result<(), String> {
        let (end, unasked) = self.process.bye(b"{\"cmd\":\"bye\"}".to_vec());
        self.unasked.extend(unasked);
        end
    }

    fn unasked(&mut self) -> Vec<String> {
        std::mem::take(&mut self.unasked)
    }

    fn stderr(&self) -> String {
        self.process.stderr()
    }
}
