//! A testee in its own process.

use std::time::Duration;

use super::{Testee, TesteeReaction};
use crate::codec::message::{Answer, AnswerLine, PROTOCOL, Question, TesteeCommand, TesteeHello};
use crate::deadline::Deadline;
use crate::process::{START, Subprocess, not_json};
use crate::text::shorten;

/// Maximum number of characters of a line that are stored for a message.
const SHOWN: usize = 400;

/// A testee that is started by a command.
#[derive(Debug)]
pub struct TesteeProcess {
    process: Subprocess,
    seq: u64,
    sent: Option<String>,
    received: Option<String>,
    /// How often the process was started.
    pub starts: usize,
}

impl TesteeProcess {
    /// Creates a testee with its command line and a time limit for each answer.
    pub fn new(line: impl Into<String>, timeout: Duration) -> Self {
        Self {
            process: Subprocess::new(line, timeout),
            seq: 0,
            sent: None,
            received: None,
            starts: 0,
        }
    }

    /// Sets a deadline after which no more questions are asked.
    #[must_use]
    pub fn with_deadline(self, deadline: Deadline) -> Self {
        Self { process: self.process.with_deadline(deadline), ..self }
    }

    /// The end of the testee's output to stderr.
    pub fn stderr(&self) -> String {
        self.process.stderr()
    }

    /// Starts the testee if it is not running.
    ///
    /// # Errors
    /// If the deadline is over, the testee cannot be started, or it does not answer `hello`.
    pub(super) fn ensure_running(&mut self) -> Result<(), TesteeReaction> {
        match self.process.running {
            _ if self.over().is_some() => Err(TesteeReaction::Silent(Duration::ZERO)),
            Some(_) => Ok(()),
            None => self.hello().map(drop),
        }
    }

    /// The last line sent to the testee, except for `bye`, and the answer to it, each truncated to
    /// 400 characters; `None` for a line that was not sent or received.
    pub fn last(&self) -> (Option<String>, Option<String>) {
        (self.sent.clone(), self.received.clone())
    }

    fn exchange(
        &mut self,
        command: &TesteeCommand,
        timeout: Duration,
    ) -> Result<String, TesteeReaction> {
        let line = serde_json::to_vec(command).map_err(|error| {
            TesteeReaction::Broken(format!("the question could not be sent: {error}"))
        })?;
        (self.sent, self.received) = (Some(shorten(&String::from_utf8_lossy(&line), SHOWN)), None);
        self.process.send(line);
        let line = self.process.recv(timeout)?;
        self.received = Some(shorten(&line, SHOWN));
        Ok(line)
    }
}

impl Testee for TesteeProcess {
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
        self.process.start([])?;
        self.starts = self.starts.saturating_add(1);
        let timeout = START.max(self.process.timeout);
        let line = self.exchange(&TesteeCommand::Hello { protocol: PROTOCOL }, timeout)?;
        greeted(&line)
    }

    fn ask(&mut self, question: &Question) -> TesteeReaction {
        if let Err(reaction) = self.ensure_running() {
            return reaction;
        }
        self.seq = self.seq.saturating_add(1);
        let command = TesteeCommand::Case { seq: self.seq, question: Box::new(question.clone()) };
        let line = match self.exchange(&command, self.process.timeout) {
            Ok(line) => line,
            Err(reaction) => return reaction,
        };
        let (reaction, in_step) = answered(&line, self.seq);
        if !in_step {
            self.process.running = None;
        }
        match reaction {
            TesteeReaction::Answer(Answer::Ok(output)) => {
                TesteeReaction::Answer(Answer::Ok(output.of_op(&question.op)))
            }
            other => other,
        }
    }

    fn bye(&mut self) -> Result<(), String> {
        match self.process.bye(serde_json::to_vec(&TesteeCommand::Bye).unwrap_or_default()) {
            (_, Some(unasked)) => {
                Err(format!("it sent {unasked}, which is not a reply to a request"))
            }
            (end, None) => end,
        }
    }

    fn stderr(&self) -> String {
        TesteeProcess::stderr(self)
    }

    fn over(&self) -> Option<String> {
        self.process.over()
    }
}

/// Parses the answer to `hello`.
///
/// # Errors
/// If the line is not an answer to `hello`, has another protocol version, or claims an op, a stream
/// or an edition that does not exist.
pub fn greeted(line: &str) -> Result<TesteeHello, TesteeReaction> {
    let hello: TesteeHello = serde_json::from_str(line)
        .map_err(|error| TesteeReaction::Garbled(not_json(line, &error)))?;
    match hello.protocol {
        PROTOCOL => match hello.capabilities.misspelt() {
            None => Ok(hello),
            Some(why) => Err(TesteeReaction::Garbled(why)),
        },
        other => Err(TesteeReaction::Garbled(format!("it uses protocol {other}, not {PROTOCOL}"))),
    }
}

/// Parses the line received for the question `seq`. Returns the reaction, and whether the next line
/// can be attributed to the next question. It cannot after an answer with another `seq`, or after
/// one without `seq` that is not an `error`, because the next answer may be late too.
///
/// ```
/// use ads_cnc_conformance::testee::{Answer, Output, TesteeReaction, answered};
///
/// let ok = TesteeReaction::Answer(Answer::Ok(Output::default()));
/// assert_eq!(answered(r#"{"seq": 7, "ok": {}}"#, 7), (ok, true));
/// assert!(matches!(answered(r#"{"seq": 6, "ok": {}}"#, 7), (TesteeReaction::Garbled(_), false)));
/// assert!(matches!(answered("Hello!", 7), (TesteeReaction::Garbled(_), true)));
/// ```
pub fn answered(line: &str, seq: u64) -> (TesteeReaction, bool) {
    match serde_json::from_str::<AnswerLine>(line) {
        Ok(reply) if reply.seq == Some(seq) => (TesteeReaction::Answer(reply.answer), true),
        Ok(AnswerLine { seq: None, answer: Answer::Error { message } }) => {
            (TesteeReaction::Garbled(format!("it could not read the case: {message}")), true)
        }
        Ok(AnswerLine { seq: None, .. }) => (
            TesteeReaction::Garbled(format!("the answer has no seq; seq {seq} is expected")),
            false,
        ),
        Ok(AnswerLine { seq: Some(other), .. }) => {
            let why = format!("the answer has seq {other}; seq {seq} is expected");
            (TesteeReaction::Garbled(why), false)
        }
        Err(error) => (TesteeReaction::Garbled(not_json(line, &error)), true),
    }
}
