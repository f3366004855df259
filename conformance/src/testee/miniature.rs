//! Miniatures: testees that misbehave, each of which the suite must detect, and three correct
//! testees. All are made of this project's codec.

use super::CodecTestee;
use crate::codec::message::{
    Answer, AnswerLine, Capabilities, Output, Question, Rejection, TesteeCommand, TesteeHello,
};
use crate::text::named;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Miniature {
    /// Accepts invalid input: returns an empty value for input that must be rejected.
    AcceptsAll,
    /// Rejects the input of every question with a known op and stream.
    RejectsAll,
    /// Returns the input of each question with a known op and stream as the answer.
    Echoes,
    /// Hangs at every fortieth question.
    Hangs,
    /// Crashes at every tenth question.
    Crashes,
    /// Claims streams that it does not implement.
    Overclaims,
    /// Accepts ops and streams that do not exist, instead of answering that they are unsupported.
    AcceptsUnknown,
    /// Reports an internal error instead of rejecting faulty input.
    InternalErrors,
    /// Answers every tenth question with the number of the next question.
    WrongNumbers,
    /// Answers every tenth question with a line that is not JSON.
    NotJson,
    /// After a hundred questions, rejects the input of every question with a known op and stream.
    RejectsLater,
    /// Does not exit after `bye`.
    IgnoresBye,
    /// Writes much text to stderr. This testee is correct.
    Noisy,
    /// Implements and claims only `decode`. This testee is correct.
    DecodesOnly,
    /// Omits the parts of values that are not significant. This testee is correct.
    Terse,
}

named! { Miniature:
    AcceptsAll "accepts-all", RejectsAll "rejects-all", Echoes "echoes", Hangs "hangs",
    Crashes "crashes", Overclaims "overclaims", AcceptsUnknown "accepts-unknown",
    InternalErrors "internal-errors", WrongNumbers "wrong-numbers", NotJson "not-json",
    RejectsLater "rejects-later", IgnoresBye "ignores-bye", Noisy "noisy",
    DecodesOnly "decodes-only", Terse "terse",
}

impl Miniature {
    /// Whether the miniature is correct.
    pub const fn is_right(self) -> bool {
        matches!(self, Self::Noisy | Self::DecodesOnly | Self::Terse)
    }

    /// The miniature with this name.
    ///
    /// # Errors
    /// If no miniature has this name; the error lists the valid names.
    pub fn by_name(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|one| one.name() == name).ok_or_else(|| {
            let names: Vec<&str> = Self::ALL.iter().map(|one| one.name()).collect();
            format!("miniatures: {}", names.join(", "))
        })
    }

    pub fn hello(self, own: &CodecTestee) -> TesteeHello {
        let mut hello = own.hello();
        hello.testee.name = format!("miniature {}", self.name());
        if self == Self::DecodesOnly {
            let capabilities = hello.capabilities;
            hello.capabilities = Capabilities { ops: vec!["decode".to_owned()], ..capabilities };
        }
        hello
    }

    /// The reaction of the miniature to a line, which contains the question with the number `seq`.
    pub fn act(self, own: &CodecTestee, line: &str, seq: u64) -> MiniatureAction {
        let Ok(TesteeCommand::Case { question, .. }) = serde_json::from_str(line) else {
            return MiniatureAction::Say(
                r#"{"seq":null,"error":{"message":"no case"}}"#.to_owned(),
            );
        };
        let tenth = seq % 10 == 9;
        match self {
            Self::Hangs if seq % 40 == 9 => return MiniatureAction::Hang,
            Self::Crashes if tenth => return MiniatureAction::Crash,
            Self::NotJson if tenth => return MiniatureAction::Say("what?".to_owned()),
            _ => {}
        }
        let answer = self.answer(own, &question, seq);
        let seq = if self == Self::WrongNumbers && tenth { seq.saturating_add(1) } else { seq };
        let line = serde_json::to_string(&AnswerLine { seq: Some(seq), answer });
        MiniatureAction::Say(line.unwrap_or_default())
    }

    fn answer(self, own: &CodecTestee, question: &Question, seq: u64) -> Answer {
        let rejected = || Answer::Reject(Rejection::default());
        let unsupported = |what: &str| Answer::Unsupported { what: what.to_owned() };
        let right = own.answer(question);
        match (self, right) {
            (_, unsupported @ Answer::Unsupported { .. }) if self != Self::AcceptsUnknown => {
                unsupported
            }
            (Self::AcceptsUnknown, Answer::Unsupported { .. })
            | (Self::AcceptsAll, Answer::Reject(_)) => {
                Answer::Ok(Output { value: Some(serde_json::json!({})), ..Output::default() })
            }
            (Self::RejectsAll, _) => rejected(),
            (Self::Echoes, _) => Answer::Ok(Output {
                value: question.value.as_ref().and_then(|value| serde_json::to_value(value).ok()),
                hex: question.hex.clone(),
                packets: question.packets.clone(),
            }),
            (Self::Overclaims, _) if question.stream.starts_with("variable") => {
                unsupported("stream")
            }
            (Self::InternalErrors, Answer::Reject(_)) => {
                Answer::Error { message: "an exception".to_owned() }
            }
            (Self::RejectsLater, _) if seq > 100 => rejected(),
            (Self::Terse, Answer::Ok(mut output)) => {
                output.value.iter_mut().for_each(strip);
                Answer::Ok(output)
            }
            (_, right) => right,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MiniatureAction {
    /// Print a line.
    Say(String),
    /// Hang.
    Hang,
    /// Crash.
    Crash,
}

/// Removes the parts of values that are not significant: the `value` of texts and bytes, whose
/// `hex` is significant, and of floats, whose `bits` are.
fn strip(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Array(items) => items.iter_mut().for_each(strip),
        serde_json::Value::Object(fields) => {
            if fields.get("type").is_some_and(serde_json::Value::is_string) {
                if fields.contains_key("hex") || fields.contains_key("bits") {
                    fields.remove("value");
                }
            } else {
                fields.values_mut().for_each(strip);
            }
        }
        _ => {}
    }
}
