//! Text in CP1252.

use super::input::Input;
use crate::common::text::{CncStrBend, check_cp1252, check_utf8};
use crate::{Defect, Outcome};

/// A byte that says what the rest is: CP1252 (even), or UTF-8; what is no UTF-8 is each a
/// character of three bytes.
///
/// Text has the characters, the bytes and the faults that encoding_rs says, and comes back both
/// ways.
pub(crate) fn cp1252(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let of_utf8 = input.byte() % 2 == 1;
    let bytes = input.bytes(usize::MAX);
    let bend = bend(defect);
    let verdict = match of_utf8 {
        false => check_cp1252(bytes, bend),
        true => match std::str::from_utf8(bytes) {
            Ok(text) => check_utf8(text, bend),
            Err(_) => {
                let wide = |three: &[u8]| {
                    let number = three.iter().fold(0, |high, &low| high << 8 | u32::from(low));
                    char::from_u32(number % 0x11_0000)
                };
                check_utf8(&bytes.chunks(3).filter_map(wide).collect::<String>(), bend)
            }
        },
    };
    match verdict {
        Ok(text) => Outcome::accepted(text),
        Err((kind, offset, found)) => Outcome::refused((format!("{kind:?}"), offset, found)),
    }
}

pub(crate) const DEFECTS: &[&str] = &[
    "the byte 0x9F is the control character of its number",
    "the byte of a dash is that of another",
    "characters beyond ASCII count as many as they have bytes of UTF-8",
    "an error is a character off behind the fourth",
    "a character without a byte is no error",
];

fn bend(defect: Defect) -> CncStrBend {
    let mut bend = CncStrBend::NONE;
    if defect.is(1) {
        bend.shown = |text| text.replace('\u{178}', "\u{9F}");
    }
    if defect.is(2) {
        bend.bytes = |bytes| {
            bytes.iter_mut().filter(|byte| **byte == 0x96).for_each(|byte| *byte = 0x97);
        };
    }
    if defect.is(3) {
        bend.len = |_, text| text.len();
    }
    if defect.is(4) {
        bend.fault = |(kind, at, found)| Some((kind, if at > 4 { at - 1 } else { at }, found));
    }
    if defect.is(5) {
        bend.fault =
            |fault| Some(fault).filter(|(kind, ..)| *kind != ads_cnc::ErrorKind::NotCp1252);
    }
    bend
}
