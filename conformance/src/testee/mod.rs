//! Codecs of others: a command that is asked over stdin and stdout, one line of JSON at a time.
//!
//! The protocol is described in `adapters/README.md`. [`Own`] answers it with this project's codec;
//! [`TesteeProcess`] is whoever else does. [`judge`] asks either everything the golden vectors have.

mod check;
mod compare;
mod describe;
mod judge;
mod miniature;
mod own;
mod plan;
mod process;
mod protocol_rules;
mod verdicts;

pub use crate::codec::message::{
    Answer, Capabilities, Identity, Known, Output, PROTOCOL, Question, Rejection, Reply,
    TesteeCommand, TesteeHello,
};
pub use crate::process::LINE_MAX;
pub use check::{Finding, check_protocol};
pub use judge::{JudgedTestee, judge};
pub use miniature::{Act, Miniature};
pub use own::Own;
pub use plan::questions;
pub use process::{TesteeProcess, answered, greeted};
pub use verdicts::Terms;

/// Who is judged by the golden vectors.
pub trait Testee {
    /// Starts it and asks what it can do.
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction>;

    /// Asks it something; one that has ended before is started anew.
    fn ask(&mut self, question: &Question) -> TesteeReaction;

    /// Lets it end.
    fn bye(&mut self) -> Result<(), String>;

    /// Why it is not to be asked any more.
    fn over(&self) -> Option<String> {
        None
    }

    /// What it had to say beside its answers.
    fn stderr(&self) -> String {
        String::new()
    }
}

/// What a testee does when it is asked.
pub type TesteeReaction = crate::process::Reaction<Answer>;

impl Testee for Own {
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
        Ok(Own::hello(self))
    }

    fn ask(&mut self, question: &Question) -> TesteeReaction {
        TesteeReaction::Answer(self.answer(question))
    }

    fn bye(&mut self) -> Result<(), String> {
        Ok(())
    }
}
