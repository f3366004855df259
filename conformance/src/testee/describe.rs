//! What a testee was asked and did, for people.

use super::Reaction;
use crate::codec::message::{Answer, Output, Question};
use crate::judge::{Evidence, TEXT_MAX};
use crate::show::show;
use crate::text::{hex::compact, shorten};

pub(super) fn describe(reaction: &Reaction) -> String {
    shorten(&described(reaction), TEXT_MAX)
}

fn described(reaction: &Reaction) -> String {
    match reaction {
        Reaction::Answer(Answer::Ok(output)) => match output {
            Output { value: Some(value), .. } => format!("accepted: {value}"),
            Output { hex: Some(hex), .. } => format!("accepted: {}", compact::show(hex)),
            Output { packets: Some(packets), .. } => format!("{} packets", packets.len()),
            _ => "accepted".to_owned(),
        },
        Reaction::Answer(Answer::Reject(reject)) => {
            let mut text = "refused".to_owned();
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
        Reaction::Answer(Answer::Unsupported { what }) => {
            format!("unsupported: {what}, which it claims to support")
        }
        Reaction::Answer(Answer::Error { message }) => format!("an error of its own: {message}"),
        Reaction::Garbled(why) => format!("no answer of the protocol: {why}"),
        Reaction::Died(how) => format!("a crash: {how}"),
        Reaction::Silent(limit) => format!("no answer within {} ms", limit.as_millis()),
        Reaction::Broken(why) => why.clone(),
    }
}

pub(super) fn evidence(
    question: &Question,
    reaction: &Reaction,
    id: &str,
    expected: Option<Vec<u8>>,
) -> Evidence {
    let stream = ads_cnc::layout::Stream::by_name(&question.stream);
    let stream = stream.map(|stream| stream.layout().name);
    let received = match reaction {
        Reaction::Answer(Answer::Ok(Output { hex: Some(hex), .. })) => {
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
