//! Tests codecs. A command answers questions over stdin and stdout; each question and each answer
//! is a line of JSON.
//!
//! `conformance/adapters/README.md` specifies the protocol. [`CodecTestee`] answers with this
//! project's codec, without a process; [`TesteeProcess`] runs a command. [`judge`] asks a testee
//! the questions that are made from the golden vectors and the NC texts in `spec-vectors/data`.

mod blame;
mod check;
mod codec_testee;
mod compare;
mod describe;
mod judge;
mod level;
mod miniature;
mod plan;
mod process;
mod protocol_rules;
mod verdicts;

pub use crate::codec::message::{
    Answer, AnswerLine, Capabilities, Identity, Output, PROTOCOL, Question, QuestionContext,
    Rejection, TesteeCommand, TesteeHello,
};
pub use crate::process::LINE_MAX;
pub use check::{ProtocolStepResult, check_protocol};
pub use codec_testee::CodecTestee;
pub use judge::{JudgedTestee, judge};
pub use miniature::{Miniature, MiniatureAction};
pub use plan::questions;
pub use process::{TesteeProcess, answered, greeted};
pub use verdicts::JudgementOptions;

/// A codec that is judged by the golden vectors.
pub trait Testee {
    /// Starts the codec and returns its capabilities.
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction>;

    /// Asks a question. A process that has ended is restarted.
    fn ask(&mut self, question: &Question) -> TesteeReaction;

    /// Tells the codec to exit, and checks its exit code.
    fn bye(&mut self) -> Result<(), String>;

    /// Why the suite may ask no more questions; `None` if it may.
    fn over(&self) -> Option<String> {
        None
    }

    /// The end of the codec's output to stderr.
    fn stderr(&self) -> String {
        String::new()
    }
}

/// The reaction of a testee to a question.
pub type TesteeReaction = crate::process::Reaction<Answer>;

impl Testee for CodecTestee {
    fn hello(&mut self) -> Result<TesteeHello, TesteeReaction> {
        Ok(CodecTestee::hello(self))
    }

    fn ask(&mut self, question: &Question) -> TesteeReaction {
        TesteeReaction::Answer(self.answer(question))
    }

    fn bye(&mut self) -> Result<(), String> {
        Ok(())
    }
}
