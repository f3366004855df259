//! Defects that reject valid input.

use ads_cnc_vectors::ids::*;

use super::row::{CodecDefect, CodecFault, CorrectAnswer, rejected, row};
use crate::codec::message::{Answer, Question};
use crate::number::u32_at;

/// The UNS32 at an offset of the stream in the question.
fn at(question: &Question, offset: usize) -> Option<u32> {
    u32_at(question.hex.as_deref()?, offset)
}

/// Rejects the decoding of a stream if the question meets the condition `is`.
fn strict(
    correct: CorrectAnswer<'_>,
    question: &Question,
    stream: &str,
    is: impl FnOnce(&Question) -> bool,
) -> Answer {
    if question.op == "decode" && question.stream == stream && is(question) {
        rejected("truncated")
    } else {
        correct(question)
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.refuses.elementary", &[VAR_7], "the codec rejects a description without dimensions",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-description", |question| at(question, 16) == Some(0))
        })),
    row("codec.refuses.arrays", &[VAR_4],
        "the codec rejects a description with more than one dimension",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-description", |question| {
                at(question, 16).is_some_and(|m| m > 1)
            })
        })),
    row("codec.refuses.whole", &[VAR_11], "the codec rejects a read by handle without indices",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-handle-read", |question| at(question, 4) == Some(0))
        })),
    row("codec.refuses.extended-empty", &[VAR_16],
        "the codec rejects an extended description without data",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-extended-description", |question| {
                question.hex.as_ref().is_some_and(Vec::is_empty)
            })
        })),
    row("codec.refuses.absent-instance", &[SDA_2], "the codec rejects the object address (0, 0)",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "object-address", |question| at(question, 0) == Some(0))
        })),
    row("codec.refuses.result-alone", &[ADS_6],
        "the codec rejects the reply to a Read or ReadWrite that ends after an error number",
        CodecFault::Around(|correct, question| {
            let alone = question.hex.as_ref().is_some_and(|hex| hex.len() == 4);
            if question.op == "decode" && alone && question.stream.ends_with("read-reply") {
                rejected("truncated")
            } else {
                strict(correct, question, "read-write-reply", |_| alone)
            }
        })),
    row("codec.refuses.sum", &[VAR_1],
        "the codec rejects the empty kind",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-kind", |question| {
                question.hex.as_deref() == Some(&[0])
            })
        })),
    row("codec.refuses.empty-packet", &[STM_2, STM_4],
        "the codec rejects a packet of more than one line",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "program-stream", |question| {
                question
                    .hex
                    .as_deref()
                    .is_some_and(|hex| hex.iter().filter(|byte| **byte == b'\n').count() > 1)
            })
        })),
];
