//! A row of the tables of defects of a codec, and how the defect is applied.

use ads_cnc::layout::{FieldSpec, Stream, Type};
use ads_cnc_vectors::ClauseId;
use serde_json::Value as Json;

use crate::codec::message::{Answer, Output, Question, Rejection};
use crate::faults::{FieldChange, FieldDefect};

pub(super) type CorrectAnswer<'a> = &'a dyn Fn(&Question) -> Answer;

/// How a defect of a codec works.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CodecFault {
    /// Accepts input that the correct codec rejects; arguments are the error class and the stream.
    Accepts(&'static str, &'static str),
    /// Rejects this stream, when it is decoded, if it has its maximum length.
    Longest(&'static str),
    /// Exchanges two fields of a stream; arguments are the stream and the names of the fields.
    Swaps(&'static str, &'static str, &'static str),
    /// Encodes and decodes the numbers of the stream in big-endian order.
    BigEndian(Stream),
    /// Changes values after decoding and before encoding; arguments are the stream and the value.
    Value(fn(&str, &mut Json)),
    /// Changes the bytes of a stream after encoding; arguments are the stream and its bytes.
    Bytes(fn(&str, Vec<u8>) -> Vec<u8>),
    /// Changes the packets into which the correct codec has split NC text.
    Packets(fn(Vec<Vec<u8>>) -> Vec<Vec<u8>>),
    /// Changes NC text before the correct codec splits or checks it.
    Text(fn(&[u8]) -> Vec<u8>),
    /// Any other change; arguments are the correct codec and the question.
    Around(fn(CorrectAnswer<'_>, &Question) -> Answer),
}

impl CodecFault {
    pub(crate) fn answer(self, correct: CorrectAnswer<'_>, question: &Question) -> Answer {
        let stream = question.stream.as_str();
        match self {
            Self::Accepts(class, of) => match correct(question) {
                Answer::Reject(reject)
                    if of == stream && reject.class.as_deref() == Some(class) =>
                {
                    accepted()
                }
                answer => answer,
            },
            Self::Longest(of) => {
                let longest = Stream::by_name(of).map(|stream| stream.layout().max);
                let len = question.hex.as_ref().and_then(|hex| u32::try_from(hex.len()).ok());
                if of == stream && question.op == "decode" && len == longest {
                    rejected("too-long")
                } else {
                    correct(question)
                }
            }
            Self::Swaps(of, one, other) => {
                if of == stream {
                    around_value(correct, question, |value| swap(value, one, other))
                } else {
                    correct(question)
                }
            }
            Self::BigEndian(of) => {
                if of.layout().name == stream {
                    big_endian(correct, question, of)
                } else {
                    correct(question)
                }
            }
            Self::Value(change) => around_value(correct, question, |value| change(stream, value)),
            Self::Bytes(change) => match correct(question) {
                Answer::Ok(Output { hex: Some(bytes), .. }) if question.op == "encode" => {
                    Answer::Ok(Output { hex: Some(change(stream, bytes)), ..Output::default() })
                }
                answer => answer,
            },
            Self::Packets(change) => match correct(question) {
                Answer::Ok(Output { packets: Some(packets), .. }) => {
                    Answer::Ok(Output { packets: Some(change(packets)), ..Output::default() })
                }
                answer => answer,
            },
            Self::Text(change) => {
                let mut other = question.clone();
                if question.op == "packets" {
                    other.hex = question.hex.as_deref().map(change);
                }
                for packet in other.packets.iter_mut().flatten() {
                    *packet = change(packet);
                }
                correct(&other)
            }
            Self::Around(change) => change(correct, question),
        }
    }
}

/// The answer that accepts the input; its value is empty.
pub(super) fn accepted() -> Answer {
    let value = Some(Json::Object(serde_json::Map::default()));
    Answer::Ok(Output { value, ..Output::default() })
}

pub(super) fn rejected(class: &str) -> Answer {
    Answer::Reject(Rejection { class: Some(class.to_owned()), ..Rejection::default() })
}

/// The answer to a question, with the value changed after `decode` and before `encode`.
fn around_value(
    correct: CorrectAnswer<'_>,
    question: &Question,
    change: impl Fn(&mut Json),
) -> Answer {
    let mut other = question.clone();
    if let Some(fields) = &question.value
        && let Ok(mut value) = serde_json::to_value(fields)
    {
        change(&mut value);
        match serde_json::from_value(value) {
            Ok(fields) => other.value = Some(fields),
            Err(error) => return Answer::Error { message: error.to_string() },
        }
    }
    match correct(&other) {
        Answer::Ok(Output { value: Some(mut value), .. }) => {
            change(&mut value);
            Answer::Ok(Output { value: Some(value), ..Output::default() })
        }
        answer => answer,
    }
}

/// Exchanges two fields in a value, or in each record of a list.
fn swap(value: &mut Json, one: &str, other: &str) {
    match value {
        Json::Array(items) => items.iter_mut().for_each(|item| swap(item, one, other)),
        Json::Object(fields) => match (fields.remove(one), fields.remove(other)) {
            (Some(first), Some(second)) => {
                fields.insert(one.to_owned(), second);
                fields.insert(other.to_owned(), first);
            }
            _ => fields.values_mut().for_each(|field| swap(field, one, other)),
        },
        _ => {}
    }
}

fn big_endian(correct: CorrectAnswer<'_>, question: &Question, stream: Stream) -> Answer {
    let all = FieldDefect::of_stream(stream);
    let numbers = all.iter().filter(|one| one.change == FieldChange::SwapBytes && is_number(one));
    let turn = |bytes: &[u8]| numbers.clone().fold(bytes.to_vec(), |bytes, one| one.apply(&bytes));
    let mut other = question.clone();
    other.hex = question.hex.as_deref().map(turn);
    match correct(&other) {
        Answer::Ok(Output { hex: Some(bytes), .. }) => {
            Answer::Ok(Output { hex: Some(turn(&bytes)), ..Output::default() })
        }
        answer => answer,
    }
}

pub(super) fn is_number(defect: &FieldDefect) -> bool {
    let number = |field: &FieldSpec| {
        matches!(field.ty, Type::Uns16 | Type::Uns32 | Type::Unsigned | Type::Real64)
    };
    defect.field.spec().is_some_and(number)
}

/// A row of the tables of defects.
pub(super) struct CodecDefect {
    pub(super) id: &'static str,
    pub(super) breaks: &'static [ClauseId],
    pub(super) what: &'static str,
    pub(super) fault: CodecFault,
}

pub(super) const fn row(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    fault: CodecFault,
) -> CodecDefect {
    CodecDefect { id, breaks, what, fault }
}
