//! Defects in the check of NC text for streaming (STM).

use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::row::{CodecDefect, CodecFault, CorrectAnswer, accepted, rejected, row};
use crate::codec::message::{Answer, Output, Question, Rejection};

/// The text with every line changed.
pub(super) fn lines(text: &[u8], other: impl Fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    text.split_inclusive(|byte| *byte == b'\n').flat_map(other).collect()
}

/// The text with every occurrence of `word`, in upper or lower case, replaced by `other`, which has
/// the same length.
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

/// Rejects NC text that contains this word, which is in upper case; lower case in the text matches too.
fn refuses(
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

/// Accepts the text if the correct answer rejects it with this error class.
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
    row("codec.nc.blind-for", &[STM_8], "$FOR is overlooked",
        CodecFault::Text(|text| without(text, "$FOR", "XFOR"))),
    row("codec.nc.blind-endfor", &[STM_8], "$ENDFOR is overlooked",
        CodecFault::Text(|text| without(text, "$ENDFOR", "XENDFOR"))),
    row("codec.nc.blind-do", &[STM_8], "$DO is overlooked",
        CodecFault::Text(|text| without(text, "$DO", "XDO"))),
    row("codec.nc.blind-enddo", &[STM_8], "$ENDDO is overlooked",
        CodecFault::Text(|text| without(text, "$ENDDO", "XENDDO"))),
    row("codec.nc.blind-repeat", &[STM_8], "$REPEAT is overlooked",
        CodecFault::Text(|text| without(text, "$REPEAT", "XREPEAT"))),
    row("codec.nc.blind-until", &[STM_8], "$UNTIL is overlooked",
        CodecFault::Text(|text| without(text, "$UNTIL", "XUNTIL"))),
    row("codec.nc.blind-while", &[STM_8], "$WHILE is overlooked",
        CodecFault::Text(|text| without(text, "$WHILE", "XWHILE"))),
    row("codec.nc.blind-endwhile", &[STM_8], "$ENDWHILE is overlooked",
        CodecFault::Text(|text| without(text, "$ENDWHILE", "XENDWHILE"))),
    row("codec.nc.blind-jump", &[STM_8], "$GOTO is overlooked",
        CodecFault::Text(|text| without(text, "$GOTO", "XGOTO"))),
    row("codec.nc.blind-jump-packets", &[STM_8], "a jump back into a packet before is overlooked",
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
    row("codec.nc.jumps-refused", &[STM_19], "every $GOTO is rejected",
        CodecFault::Around(|correct, question| refuses(correct, question, b"$GOTO", STM_8))),
    row("codec.nc.branches-refused", &[STM_19, STM_8], "$IF is rejected",
        CodecFault::Around(|correct, question| refuses(correct, question, b"$IF", STM_8))),
    row("codec.nc.switch-refused", &[STM_19, STM_8], "$SWITCH is rejected",
        CodecFault::Around(|correct, question| refuses(correct, question, b"$SWITCH", STM_8))),
    row("codec.nc.subroutine-refused", &[STM_18], "a call of a subroutine is rejected",
        CodecFault::Around(|correct, question| refuses(correct, question, b" L ", STM_18))),
    row("codec.nc.comment-parentheses", &[STM_9], "comments in parentheses are looked through",
        CodecFault::Text(|text| bytes(text, b"()", b' '))),
    row("codec.nc.comment-semicolon", &[STM_9], "comments after a semicolon are looked through",
        CodecFault::Text(|text| bytes(text, b";", b' '))),
    row("codec.nc.comment-block", &[STM_9],
        "what is between #COMMENT BEGIN and #COMMENT END is looked through",
        CodecFault::Text(|text| without(text, "#COMMENT", "XCOMMENT"))),
    row("codec.nc.comment-block-never-ends", &[STM_9], "#COMMENT END is overlooked",
        CodecFault::Text(|text| without(text, "END", "XXX"))),
    row("codec.nc.comment-open", &[STM_9], "a parenthesis that is not closed goes on in the next line",
        CodecFault::Text(|text| {
            let mut open = false;
            text.iter()
                .map(|&byte| {
                    open = byte == b'(' || open && byte != b')';
                    if open && b"\r\n".contains(&byte) { b' ' } else { byte }
                })
                .collect()
        })),
    row("codec.nc.comment-block-open", &[STM_9], "a comment that is never ended is not told",
        CodecFault::Around(|correct, question| accepts(correct, question, "check", STM_9.as_str()))),
    row("codec.nc.end-m2", &[STM_10], "M2 is overlooked",
        CodecFault::Text(|text| without(text, "M2", "M9"))),
    row("codec.nc.end-m30", &[STM_10], "M30 is overlooked",
        CodecFault::Text(|text| without(text, "M30", "M90"))),
    row("codec.nc.end-m17", &[STM_10], "M17 is overlooked",
        CodecFault::Text(|text| without(text, "M17", "M90"))),
    row("codec.nc.end-m29", &[STM_10], "M29 is overlooked",
        CodecFault::Text(|text| without(text, "M29", "M90"))),
    row("codec.nc.next-program", &[STM_17], "the next program is sent with the end of the one before",
        CodecFault::Text(|text| {
            let ends = ["M2", "M30", "M17", "M29"];
            ends.iter().fold(text.to_vec(), |text, end| without(&text, end, "M9"))
        })),
    row("codec.nc.end-m3", &[STM_10], "M3 is taken for M30", CodecFault::Text(|text| {
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
