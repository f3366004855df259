//! The output of a testee on stdout, line by line.

use std::io::BufReader;

use ads_cnc_conformance::process::{read_line, text};
use ads_cnc_conformance::testee::{Answer, AnswerLine, TesteeReaction, answered, greeted};
use serde_json::Value;

use super::Input;
use crate::{Defect, Outcome};

pub(crate) const DEFECTS: &[&str] = &[
    "a line that is one byte too long is accepted",
    "a line that is too long is buffered completely",
    "invalid UTF-8 is replaced",
    "the answer to the previous case is accepted for this case",
    "the first of two answers in a line is accepted",
    "the offset of a rejection is lost",
];

/// The number of the case to which the lines are answers.
const SEQ: u64 = 258;

/// Input: the maximum length of a line (1 byte), the number of bytes per read (1 byte), the output.
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    // 0 selects a long maximum, which most answers need.
    let most = match input.byte() {
        0 => 4096,
        most => usize::from(most),
    };
    let mut said = BufReader::with_capacity(usize::from(input.byte()).max(1), input.rest());
    let mut expected = lines(data.get(2..).unwrap_or_default());
    let mut seen = Vec::new();
    loop {
        let wanted = expected.next();
        let limit = most + usize::from(defect.is(1));
        match (read_line(&mut said, limit), wanted) {
            (None, None) => break,
            (Some(Ok(mut line)), Some(wanted)) => {
                if defect.is(2) {
                    line.reserve(16 * most);
                }
                assert!(line.len() <= most && line.capacity() <= 2 * most + 64, "{line:?}");
                assert_eq!(line, wanted);
                seen.push(judge(line, defect));
            }
            (Some(Err(why)), Some(wanted)) => {
                assert!(wanted.len() > most && why.len() < 100, "{why}: {wanted:?}");
                seen.push((false, why));
                break;
            }
            other => panic!("{other:?}"),
        }
    }
    match seen.iter().any(|(answer, _)| *answer) {
        true => Outcome::accepted(seen),
        false => Outcome::rejected(seen),
    }
}

/// The lines, which end with LF or CR LF; the last may lack a line end.
fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    let whole = bytes.strip_suffix(b"\n").unwrap_or(bytes);
    let none = bytes.is_empty();
    let lines = whole.split(|&byte| byte == b'\n').filter(move |_| !none);
    lines.map(|line| line.strip_suffix(b"\r").unwrap_or(line))
}

/// Returns whether a line is an answer, and the answer or the error as text.
fn judge(line: Vec<u8>, defect: Defect) -> (bool, String) {
    let is_text = std::str::from_utf8(&line).is_ok();
    let read = match defect.is(3) {
        true => Ok(String::from_utf8_lossy(&line).into_owned()),
        false => text(line),
    };
    assert_eq!(read.is_ok(), is_text, "{read:?}");
    let line = match read {
        Ok(line) => line,
        Err(why) => return (false, format!("{why:?}")),
    };
    // The message of an error contains at most a part of the line.
    let short = |reaction: &TesteeReaction| match reaction {
        TesteeReaction::Garbled(why) => assert!(why.len() < 2000, "{why}"),
        other => assert!(matches!(other, TesteeReaction::Answer(_)), "{other:?}"),
    };
    let hello = greeted(&line);
    match &hello {
        Ok(hello) => {
            let again = serde_json::to_string(hello).expect("JSON");
            assert_eq!(greeted(&again).as_ref(), Ok(hello), "{line}");
        }
        Err(reaction) => short(reaction),
    }
    let asked = if defect.is(4) && line.contains("257") { SEQ - 1 } else { SEQ };
    let first = match defect.is(5) {
        true => line.replace(", \"unsupported\"", ", \"unknown\""),
        false => line.clone(),
    };
    let (reaction, in_step) = answered(&first, asked);
    short(&reaction);
    if let TesteeReaction::Answer(answer) = &reaction {
        assert!(in_step);
        is_one(&line);
        again(answer.clone(), defect);
    }
    (
        hello.is_ok() || matches!(reaction, TesteeReaction::Answer(_)),
        format!("{hello:?} {reaction:?}"),
    )
}

/// An answer has the number of the case, and exactly one of the four kinds of answer.
fn is_one(line: &str) {
    // Ignored fields may have strings that `Value` rejects.
    let Ok(value) = serde_json::from_str::<Value>(line) else { return };
    assert_eq!(value.get("seq"), Some(&Value::from(SEQ)), "{line}");
    let kinds = ["ok", "reject", "unsupported", "error"];
    assert_eq!(kinds.iter().filter(|kind| value.get(**kind).is_some()).count(), 1, "{line}");
}

/// A serialised answer is read as the same answer.
fn again(mut answer: Answer, defect: Defect) {
    let line = serde_json::to_string(&AnswerLine { seq: Some(SEQ), answer: answer.clone() });
    if let (true, Answer::Reject(rejection)) = (defect.is(6), &mut answer) {
        rejection.at = None;
    }
    let read = answered(&line.expect("JSON"), SEQ);
    assert_eq!(read, (TesteeReaction::Answer(answer), true));
}
