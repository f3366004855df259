//! Text in CP1252.

use super::input::Input;
use crate::common::text::{CncStrMutation, check_cp1252, check_utf8};
use crate::{Defect, Outcome};

/// Input: a byte, even for CP1252 or odd for UTF-8, then the text. If a text after an odd byte is
/// not valid UTF-8, each three bytes of the text are the number of a character; numbers that are
/// not characters are left out.
///
/// Text is converted to the same characters, bytes and faults as by encoding_rs, and the reverse conversion
/// gives the original text.
pub(crate) fn cp1252(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let of_utf8 = input.byte() % 2 == 1;
    let bytes = input.bytes(usize::MAX);
    let mutation = mutation(defect);
    let verdict = match of_utf8 {
        false => check_cp1252(bytes, mutation),
        true => match std::str::from_utf8(bytes) {
            Ok(text) => check_utf8(text, mutation),
            Err(_) => {
                let wide = |three: &[u8]| {
                    let number = three.iter().fold(0, |high, &low| high << 8 | u32::from(low));
                    char::from_u32(number % 0x11_0000)
                };
                check_utf8(&bytes.chunks(3).filter_map(wide).collect::<String>(), mutation)
            }
        },
    };
    match verdict {
        Ok(text) => Outcome::accepted(text),
        Err((kind, offset, found)) => Outcome::rejected((format!("{kind:?}"), offset, found)),
    }
}

pub(crate) const DEFECTS: &[&str] = &[
    "the byte 0x9F is decoded as the control character U+009F",
    "a dash is encoded as a different dash",
    "a character outside ASCII counts as its number of UTF-8 bytes",
    "the offset of an error after the fourth character is off by one",
    "a character without a CP1252 byte is not an error",
];

fn mutation(defect: Defect) -> CncStrMutation {
    let mut mutation = CncStrMutation::NONE;
    if defect.is(1) {
        mutation.shown = |text| text.replace('\u{178}', "\u{9F}");
    }
    if defect.is(2) {
        mutation.bytes = |bytes| {
            bytes.iter_mut().filter(|byte| **byte == 0x96).for_each(|byte| *byte = 0x97);
        };
    }
    if defect.is(3) {
        mutation.len = |_, text| text.len();
    }
    if defect.is(4) {
        mutation.fault = |(kind, at, found)| Some((kind, if at > 4 { at - 1 } else { at }, found));
    }
    if defect.is(5) {
        mutation.fault =
            |fault| Some(fault).filter(|(kind, ..)| *kind != ads_cnc::ErrorKind::NotCp1252);
    }
    mutation
}
