//! NC text and its packets.

use crate::common::streaming::{TextMutation, check_text};
use crate::{Defect, Outcome};

/// Input: NC text.
///
/// Either the first fault of the text is found, or its packets together are the text with CR LF
/// after each line, and each packet is valid and as full as possible.
pub(crate) fn packets(data: &[u8], defect: Defect) -> Outcome {
    let mut mutation = TextMutation::NONE;
    if defect.is(1) {
        mutation.packets = |packets| {
            if let Some(last) = packets.last_mut().filter(|last| last.len() > 100) {
                last.remove(last.len() - 2);
            }
        };
    }
    if defect.is(2) {
        mutation.packets = |packets| {
            if packets.len() > 1 {
                let second = packets.remove(1);
                packets[0].extend(second);
            }
        };
    }
    if defect.is(3) {
        mutation.packets = |packets| {
            let line = packets.iter().position(|packet| packet.starts_with(b"N"));
            let Some(place) = line else { return };
            let end = packets[place].iter().position(|&byte| byte == b'\n').unwrap_or(0) + 1;
            if end < packets[place].len() {
                let rest = packets[place].split_off(end);
                packets.insert(place + 1, rest);
            }
        };
    }
    if defect.is(4) {
        mutation.fault = |(line, column, kind)| Some((line, column + usize::from(line > 1), kind));
    }
    if defect.is(5) {
        mutation.fault = |fault| Some(fault).filter(|&(line, ..)| line < 3);
    }
    match check_text(data, mutation) {
        Ok(packets) => Outcome::accepted(packets),
        Err((line, column, kind)) => Outcome::rejected((line, column, kind)),
    }
}

pub(crate) const PACKETS_DEFECTS: &[&str] = &[
    "a line loses its CR at the end of a text of more than a hundred bytes",
    "the first packet contains the second one",
    "a packet that begins with a block number ends after its first line",
    "the column of a fault after the first line is off by one",
    "a fault after the second line is not found",
];
