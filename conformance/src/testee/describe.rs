//! Describes the questions and answers of a testee in words.

use super::TesteeReaction;
use crate::codec::message::{Answer, Output, Question};
use crate::evidence::Evidence;
use crate::judge::TEXT_MAX;
use crate::text::{hex::compact, plural, shorten};
use crate::vector_format::show;

/// The beginning of the description of a line that is not a valid answer of the protocol.
pub(super) const NO_ANSWER: &str = "invalid answer: ";

pub(super) fn describe(reaction: &TesteeReaction) -> String {
    shorten(&described(reaction), TEXT_MAX)
}

fn described(reaction: &TesteeReaction) -> String {
    match reaction {
        TesteeReaction::Answer(Answer::Ok(output)) => match output {
            Output { value: Some(value), .. } => format!("accepted: {value}"),
            Output { hex: Some(hex), .. } => format!("accepted: {}", compact::show(hex)),
            Output { packets: Some(packets), .. } => plural(packets.len(), "packet"),
            _ => "accepted".to_owned(),
        },
        TesteeReaction::Answer(Answer::Reject(reject)) => {
            let mut text = "rejected".to_owned();
            if let Some(class) = &reject.class {
                text.push_str(&format!(": {class}"));
            }
            if let Some(at) = reject.at {
                text.push_str(&format!(" at offset {at}"));
            }
            if let Some(message) = &reject.message {
                text.push_str(&format!(" ({message})"));
            }
            text
        }
        TesteeReaction::Answer(Answer::Unsupported { what }) => {
            format!("unsupported: {what}, although it is claimed")
        }
        TesteeReaction::Answer(Answer::Error { message }) => {
            format!("an internal error: {message}")
        }
        TesteeReaction::Garbled(why) => format!("{NO_ANSWER}{why}"),
        TesteeReaction::Died(how) => format!("a crash: {how}"),
        TesteeReaction::Silent(limit) => format!("no answer within {} ms", limit.as_millis()),
        TesteeReaction::Broken(why) => why.clone(),
    }
}

pub(super) fn evidence(
    question: &Question,
    reaction: &TesteeReaction,
    id: &str,
    expected: Option<Vec<u8>>,
) -> Evidence {
    let stream = ads_cnc::layout::Stream::by_name(&question.stream);
    let stream = stream.map(|stream| stream.layout().name);
    let received = match reaction {
        TesteeReaction::Answer(Answer::Ok(Output { hex: Some(hex), .. })) => {
            Some(Evidence::start(hex).to_vec())
        }
        _ => None,
    };
    let shown = match &question.value {
        Some(fields) => show(fields),
        None => question.stream.clone(),
    };
    let sent = match (&question.hex, &question.packets) {
        (Some(hex), _) => hex.clone(),
        (None, Some(packets)) => packets.concat(),
        (None, None) => Vec::new(),
    };
    let id = id.strip_prefix("vec-").unwrap_or(id);
    Evidence {
        call: format!("{} {shown} ({id})", question.op),
        request_stream: stream,
        reply_stream: stream,
        sent,
        expected: expected.filter(|_| received.is_some()),
        received,
        values: question.context.context().as_ref().map(crate::judge::typed).unwrap_or_default(),
        result: describe(reaction),
        ..Evidence::default()
    }
}
