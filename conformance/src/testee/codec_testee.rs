//! Uses this project's codec as a testee.

use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::streaming::{CheckEvent, Checker, LineErrorKind, NcText};
use ads_cnc_vectors::vectors;

use crate::codec::message::{
    Answer, Capabilities, Identity, Output, PROTOCOL, Question, Rejection, TesteeHello,
};
use crate::codec::{self, CodecError};
use crate::faults::{FieldDefect, SeededDefect};

/// Answers questions with this project's codec, optionally with a defect.
#[derive(Clone, Debug, Default)]
pub struct CodecTestee {
    pub defect: Option<SeededDefect>,
}

impl CodecTestee {
    /// The answer to hello, which claims all ops of the protocol, all streams of the vectors, and
    /// both editions.
    pub fn hello(&self) -> TesteeHello {
        let mut streams: Vec<String> = vectors().iter().map(|one| one.stream.clone()).collect();
        streams.sort();
        streams.dedup();
        let name = match &self.defect {
            None => "ads-cnc".to_owned(),
            Some(defect) => format!("ads-cnc with the defect {}", defect.id),
        };
        TesteeHello {
            protocol: PROTOCOL,
            testee: Identity {
                name,
                version: env!("CARGO_PKG_VERSION").to_owned(),
                language: "Rust".to_owned(),
            },
            capabilities: Capabilities {
                ops: ["decode", "encode", "packets", "check"].map(str::to_owned).to_vec(),
                streams,
                editions: ["en-1.05", "de-1.051"].map(str::to_owned).to_vec(),
            },
        }
    }

    pub fn answer(&self, question: &Question) -> Answer {
        match self.defect.as_ref().and_then(SeededDefect::of_codec) {
            Some(fault) => fault.answer(&|question| self.answer_right(question), question),
            None => self.answer_right(question),
        }
    }

    fn answer_right(&self, question: &Question) -> Answer {
        match self.try_answer(question) {
            Ok(output) => Answer::Ok(output),
            Err(answer) => answer,
        }
    }

    fn try_answer(&self, question: &Question) -> Result<Output, Answer> {
        let Question { op, stream, hex, value, packets, .. } = question;
        let lacks = |what: &str| Answer::Error { message: format!("{op} requires {what}") };
        let context = question.context.context().ok_or_else(|| unsupported("context"))?;
        match op.as_str() {
            "decode" => {
                let bytes = hex.as_deref().ok_or_else(|| lacks("hex"))?;
                let changed = self.changed(stream, bytes);
                let decoded =
                    codec::decode_stream(stream, &context, &changed).map_err(rejection)?;
                let error = |error| Answer::Error { message: format!("{error}") };
                let value = serde_json::to_value(decoded.fields).map_err(error)?;
                Ok(Output { value: Some(value), ..Output::default() })
            }
            "encode" => {
                let fields = value.as_ref().ok_or_else(|| lacks("value"))?;
                let bytes = codec::encode(stream, &context, fields).map_err(rejection)?;
                Ok(Output { hex: Some(self.changed(stream, &bytes)), ..Output::default() })
            }
            "packets" => split(hex.as_deref().ok_or_else(|| lacks("hex"))?),
            "check" => check(packets.as_deref().ok_or_else(|| lacks("packets"))?),
            _ => Err(unsupported("op")),
        }
    }

    fn changed(&self, stream: &str, bytes: &[u8]) -> Vec<u8> {
        let stream = ads_cnc::layout::Stream::by_name(stream);
        let touches = |defect: &&FieldDefect| stream.is_some_and(|stream| defect.touches(stream));
        match self.defect.as_ref().and_then(SeededDefect::field).filter(touches) {
            None => bytes.to_vec(),
            Some(defect) => defect.apply(bytes),
        }
    }
}

fn unsupported(what: &str) -> Answer {
    Answer::Unsupported { what: what.to_owned() }
}

fn rejection(rejected: CodecError) -> Answer {
    match rejected {
        CodecError::Error(error) => Answer::Reject(Rejection {
            class: Some(codec::class(&error).to_owned()),
            at: Some(error.offset().into()),
            message: Some(error.to_string()),
            ..Rejection::default()
        }),
        CodecError::InvalidFields(why) => {
            Answer::Reject(Rejection { message: Some(why), ..Rejection::default() })
        }
        CodecError::Unsupported(what) => {
            if what.starts_with("stream ") {
                unsupported("stream")
            } else {
                unsupported("context")
            }
        }
    }
}

/// Splits NC text into the packets that a client writes to the program stream.
fn split(text: &[u8]) -> Result<Output, Answer> {
    let text = NcText::new(text).map_err(|error| {
        let class = match error.kind() {
            LineErrorKind::TooLong { .. } => "too-long",
            LineErrorKind::NotAscii { .. } => "not-ascii",
            LineErrorKind::Nul => "nul",
            _ => "other",
        };
        Answer::Reject(Rejection {
            class: Some(class.to_owned()),
            line: Some(error.line().into()),
            message: Some(error.to_string()),
            ..Rejection::default()
        })
    })?;
    let mut packets = text.packets();
    let mut buf = [0; STREAM_PACKET_MAX];
    let mut all = Vec::new();
    while let Some(packet) = packets.next_into(&mut buf) {
        all.push(packet.to_vec());
    }
    Ok(Output { packets: Some(all), ..Output::default() })
}

/// Checks packets by the rules of streaming, in the order in which a CNC receives them. Rejects the
/// packets with the clause and the line of the first diagnostic or, without any, of a comment that
/// is open at the end.
fn check(packets: &[Vec<u8>]) -> Result<Output, Answer> {
    let mut checker = Checker::new();
    let mut found = None;
    for packet in packets {
        for one in checker.check(packet) {
            if let (None, CheckEvent::Diagnostic(finding)) = (&found, one) {
                found = Some(finding);
            }
        }
    }
    match found.or_else(|| checker.open_comment()) {
        None => Ok(Output::default()),
        Some(finding) => Err(Answer::Reject(Rejection {
            class: Some(finding.kind.clause().to_owned()),
            line: Some(finding.line.into()),
            ..Rejection::default()
        })),
    }
}
