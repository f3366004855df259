//! Defects that reject valid input.

use ads_cnc_vectors::ids::*;

use super::row::{CodecDefect, CodecFault, CorrectAnswer, rejected, row};
use crate::codec::message::{Answer, Question};

/// The UNS32 at an offset of the first input.
fn at(question: &Question, offset: usize) -> Option<u32> {
    let bytes = question.hex.as_deref()?.get(offset..)?.first_chunk::<4>()?;
    Some(u32::from_le_bytes(*bytes))
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
    row("codec.refuses.elementary", &[VAR_7], "a description without dimensions is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-description", |question| at(question, 16) == Some(0))
        })),
    row("codec.refuses.arrays", &[VAR_4], "a description of more than one dimension is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-description", |question| {
                at(question, 16).is_some_and(|m| m > 1)
            })
        })),
    row("codec.refuses.whole", &[VAR_11], "a read by handle without indices is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-handle-read", |question| at(question, 4) == Some(0))
        })),
    row("codec.refuses.extended-empty", &[VAR_16], "an extended description without data is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "variable-extended-description", |question| {
                question.hex.as_ref().is_some_and(Vec::is_empty)
            })
        })),
    row("codec.refuses.absent-instance", &[SDA_2], "the object address (0, 0) is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "object-address", |question| at(question, 0) == Some(0))
        })),
    row("codec.refuses.result-alone", &[ADS_6],
        "a reply that ends after a result that is not 0 is rejected",
        CodecFault::Around(|correct, question| {
            let alone = question.hex.as_ref().is_some_and(|hex| hex.len() == 4);
            if question.op == "decode" && alone && question.stream.ends_with("read-reply") {
                rejected("truncated")
            } else {
                strict(correct, question, "read-write-reply", |_| alone)
            }
        })),
    row("codec.refuses.sum", &[VAR_1], "the empty kind is rejected", CodecFault::Around(|correct, question| {
        strict(correct, question, "variable-kind", |question| {
            question.hex.as_deref() == Some(&[0])
        })
    })),
    row("codec.refuses.empty-packet", &[STM_2, STM_4], "a packet of more than one line is rejected",
        CodecFault::Around(|correct, question| {
            strict(correct, question, "program-stream", |question| {
                question
                    .hex
                    .as_deref()
                    .is_some_and(|hex| hex.iter().filter(|byte| **byte == b'\n').count() > 1)
            })
        })),
];
