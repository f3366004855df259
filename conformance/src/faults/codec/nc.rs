//! Defects in the check of NC text for streaming (STM).

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::row::{CodecDefect, CodecFault, CorrectAnswer, accepted, rejected, row};
use crate::codec::message::{Answer, Output, Question, Rejection};

/// The text with every line changed.
pub(super) fn lines(text: &[u8], other: impl Fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    text.split_inclusive(|byte| *byte == b'\n').flat_map(other).collect()
}

/// The text with every `word`, in any case, overwritten with `other`, which is not longer. A word
/// that a letter or digit follows stays.
fn without(text: &[u8], word: &str, other: &str) -> Vec<u8> {
    let mut text = text.to_vec();
    let is_word = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_alphanumeric);
    for place in 0..text.len() {
        let end = place.saturating_add(word.len());
        let found =
            text.get(place..end).is_some_and(|part| part.eq_ignore_ascii_case(word.as_bytes()));
        if found && !is_word(text.get(end)) {
            let part = text.iter_mut().skip(place);
            part.zip(other.bytes()).for_each(|(old, new)| *old = new);
        }
    }
    text
}

/// The text with each byte that `of` contains replaced by `other`.
fn bytes(text: &[u8], of: &[u8], other: u8) -> Vec<u8> {
    text.iter().map(|byte| if of.contains(byte) { other } else { *byte }).collect()
}

/// Rejects the NC text of a question with the operation `check` if the text contains this word in
/// any case; `word` is in upper case.
fn rejects(
    correct: CorrectAnswer<'_>,
    question: &Question,
    word: &[u8],
    clause: ClauseId,
) -> Answer {
    let text = question.packets.iter().flatten().flatten().copied().collect::<Vec<u8>>();
    let text = text.to_ascii_uppercase();
    if question.op == "check" && text.windows(word.len()).any(|part| part == word) {
        rejected(clause.as_str())
    } else {
        correct(question)
    }
}

/// Accepts the input of the operation `op` if the correct answer rejects it with this error class.
pub(super) fn accepts(
    correct: CorrectAnswer<'_>,
    question: &Question,
    op: &str,
    class: &str,
) -> Answer {
    match correct(question) {
        Answer::Reject(Rejection { class: Some(found), .. })
            if question.op == op && found == class =>
        {
            match question.op.as_str() {
                "check" => Answer::Ok(Output::default()),
                "packets" => Answer::Ok(Output {
                    packets: Some(vec![question.hex.clone().unwrap_or_default()]),
                    ..Output::default()
                }),
                _ => accepted(),
            }
        }
        answer => answer,
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.nc.blind-for", &[STM_8], "the codec does not detect $FOR in NC text",
        CodecFault::Text(|text| without(text, "$FOR", "XFOR"))),
    row("codec.nc.blind-endfor", &[STM_8], "the codec does not detect $ENDFOR in NC text",
        CodecFault::Text(|text| without(text, "$ENDFOR", "XENDFOR"))),
    row("codec.nc.blind-do", &[STM_8], "the codec does not detect $DO in NC text",
        CodecFault::Text(|text| without(text, "$DO", "XDO"))),
    row("codec.nc.blind-enddo", &[STM_8], "the codec does not detect $ENDDO in NC text",
        CodecFault::Text(|text| without(text, "$ENDDO", "XENDDO"))),
    row("codec.nc.blind-repeat", &[STM_8], "the codec does not detect $REPEAT in NC text",
        CodecFault::Text(|text| without(text, "$REPEAT", "XREPEAT"))),
    row("codec.nc.blind-until", &[STM_8], "the codec does not detect $UNTIL in NC text",
        CodecFault::Text(|text| without(text, "$UNTIL", "XUNTIL"))),
    row("codec.nc.blind-while", &[STM_8], "the codec does not detect $WHILE in NC text",
        CodecFault::Text(|text| without(text, "$WHILE", "XWHILE"))),
    row("codec.nc.blind-endwhile", &[STM_8], "the codec does not detect $ENDWHILE in NC text",
        CodecFault::Text(|text| without(text, "$ENDWHILE", "XENDWHILE"))),
    row("codec.nc.blind-jump", &[STM_8], "the codec does not detect $GOTO in NC text",
        CodecFault::Text(|text| without(text, "$GOTO", "XGOTO"))),
    row("codec.nc.blind-jump-packets", &[STM_8],
        "the codec does not detect a $GOTO to a label in an earlier packet",
        CodecFault::Around(|correct, question| {
            let packets = question.packets.clone().unwrap_or_default();
            let alone = |packet: Vec<u8>| {
                correct(&Question { packets: Some(vec![packet]), ..question.clone() })
            };
            match question.op.as_str() {
                "check" if packets.len() > 1 => {
                    let rejected = |answer: &Answer| matches!(answer, Answer::Reject(_));
                    let first = packets.into_iter().map(alone).find(rejected);
                    first.unwrap_or_else(|| Answer::Ok(Output::default()))
                }
                _ => correct(question),
            }
        })),
    row("codec.nc.jumps-refused", &[STM_19], "the codec rejects NC text with a $GOTO",
        CodecFault::Around(|correct, question| rejects(correct, question, b"$GOTO", STM_8))),
    row("codec.nc.branches-refused", &[STM_19, STM_8], "the codec rejects NC text with an $IF",
        CodecFault::Around(|correct, question| rejects(correct, question, b"$IF", STM_8))),
    row("codec.nc.switch-refused", &[STM_19, STM_8], "the codec rejects NC text with a $SWITCH",
        CodecFault::Around(|correct, question| rejects(correct, question, b"$SWITCH", STM_8))),
    row("codec.nc.subroutine-refused", &[STM_18],
        "the codec rejects NC text that calls a subroutine (L)",
        CodecFault::Around(|correct, question| rejects(correct, question, b" L ", STM_18))),
    row("codec.nc.comment-parentheses", &[STM_9],
        "the codec does not detect comments in parentheses",
        CodecFault::Text(|text| bytes(text, b"()", b' '))),
    row("codec.nc.comment-semicolon", &[STM_9],
        "the codec does not detect comments after a semicolon",
        CodecFault::Text(|text| bytes(text, b";", b' '))),
    row("codec.nc.comment-block", &[STM_9],
        "the codec does not detect comments from #COMMENT BEGIN to #COMMENT END",
        CodecFault::Text(|text| without(text, "#COMMENT", "XCOMMENT"))),
    row("codec.nc.comment-block-never-ends", &[STM_9],
        "the codec does not detect #COMMENT END, the end of a comment block",
        CodecFault::Text(|text| without(text, "END", "XXX"))),
    row("codec.nc.comment-open", &[STM_9],
        "the codec continues an unclosed comment in parentheses on the next line",
        CodecFault::Text(|text| {
            let mut open = false;
            text.iter()
                .map(|&byte| {
                    open = byte == b'(' || open && byte != b')';
                    if open && b"\r\n".contains(&byte) { b' ' } else { byte }
                })
                .collect()
        })),
    row("codec.nc.comment-block-open", &[STM_9],
        "the codec does not report a comment block without an end",
        CodecFault::Around(|correct, question| accepts(correct, question, "check", STM_9.as_str()))),
    row("codec.nc.end-m2", &[STM_10], "the codec does not detect the program end M2",
        CodecFault::Text(|text| without(text, "M2", "M9"))),
    row("codec.nc.end-m30", &[STM_10], "the codec does not detect the program end M30",
        CodecFault::Text(|text| without(text, "M30", "M90"))),
    row("codec.nc.end-m17", &[STM_10], "the codec does not detect the program end M17",
        CodecFault::Text(|text| without(text, "M17", "M90"))),
    row("codec.nc.end-m29", &[STM_10], "the codec does not detect the program end M29",
        CodecFault::Text(|text| without(text, "M29", "M90"))),
    row("codec.nc.next-program", &[STM_17],
        "the codec detects no program end, and sends the next program without waiting",
        CodecFault::Text(|text| {
            let ends = ["M2", "M30", "M17", "M29"];
            ends.iter().fold(text.to_vec(), |text, end| without(&text, end, "M9"))
        })),
    row("codec.nc.end-m3", &[STM_10],
        "the codec treats M3 as the program end M30",
        CodecFault::Text(|text| {
            let long = |line: &[u8]| match line
                .windows(3)
                .position(|part| part == b"M3 " || part == b"M3\r")
            {
                None => line.to_vec(),
                Some(at) => {
                    let (head, tail) =
                        line.split_at_checked(at.saturating_add(2)).unwrap_or_default();
                    [head, b"0", tail].concat()
                }
            };
            lines(text, long)
        })),
];
