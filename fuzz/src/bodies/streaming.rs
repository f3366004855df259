//! NC text, its packets, and both ends of the stream.

use ads_cnc::limits::NC_LINE_MAX;
use ads_cnc::streaming::{Ack, NcText, StreamingInterface};

use super::input::Input;
use crate::common::streaming::{CheckedInterface, CheckedSender, EndsBend, TextBend, check_text};
use crate::{Defect, Outcome};

/// The input is NC text.
///
/// Its first fault is found, or its packets together are the text with CR LF, each is legal, and
/// none could be fuller.
pub(crate) fn packets(data: &[u8], defect: Defect) -> Outcome {
    let mut bend = TextBend::NONE;
    if defect.is(1) {
        bend.packets = |packets| {
            if let Some(last) = packets.last_mut().filter(|last| last.len() > 100) {
                last.remove(last.len() - 2);
            }
        };
    }
    if defect.is(2) {
        bend.packets = |packets| {
            if packets.len() > 1 {
                let second = packets.remove(1);
                packets[0].extend(second);
            }
        };
    }
    if defect.is(3) {
        bend.packets = |packets| {
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
        bend.fault = |(line, column, kind)| Some((line, column + usize::from(line > 1), kind));
    }
    if defect.is(5) {
        bend.fault = |fault| Some(fault).filter(|&(line, ..)| line < 3);
    }
    match check_text(data, bend) {
        Ok(packets) => Outcome::accepted(packets),
        Err((line, column, kind)) => Outcome::refused((line, column, kind)),
    }
}

pub(crate) const PACKETS_DEFECTS: &[&str] = &[
    "a line loses its CR at the end of a text of more than a hundred bytes",
    "the first packet takes in the second one",
    "a packet that begins with a block number ends behind its first line",
    "a fault is a column off if it is not in the first line",
    "a fault is overlooked behind the second line",
];

/// How many lines there are and a byte each: how long it is (the upper six bits, most of them
/// short), how it ends (the lower two); then events, a byte each: see below. A line is of that
/// byte, so that lines differ.
///
/// Whatever is acknowledged and read: a sender loses and repeats nothing and counts right, the
/// interface is a bounded queue, and what comes out of it is the text.
pub(crate) fn ends(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let lines = input.byte() % 8;
    let mut text = Vec::new();
    for byte in (0..lines).map(|_| input.byte()) {
        let len = match usize::from(byte >> 2) {
            len @ ..48 => len,
            more => NC_LINE_MAX - 30 * (63 - more),
        };
        text.resize(text.len() + len, b' ' + byte % 0x5F);
        text.extend_from_slice([&b"\r\n"[..], b"\n", b"\r", b"\r\n"][usize::from(byte % 4)]);
    }
    // The last line may be open, or end in another way.
    if lines % 2 == 1 {
        text.pop();
    }
    assert!(NcText::new(&text).is_ok(), "lines are made to be streamed");

    let bend = bend(defect);
    let mut sender = CheckedSender::new(&text, bend);
    let mut interface = CheckedInterface::new(bend);
    let (mut got, mut verdicts) = (Vec::new(), Vec::new());
    // As long as nothing else comes between, the interface gets what the sender sends.
    let mut pure = true;
    for event in input.take(200) {
        match event % 8 {
            0..3 => {
                if let Some(packet) = sender.packet() {
                    sender.acknowledge(interface.write(&packet));
                }
            }
            3 => drop(sender.packet()),
            4 => {
                // The answer to a write that never came to the interface.
                let ack = [Ack::Later, Ack::Accepted, Ack::Later, Ack::Refused];
                let ack = ack[usize::from(event >> 3) % 4];
                sender.acknowledge(ack);
                pure &= ack != Ack::Accepted;
            }
            5 => match interface.read() {
                Ok(lines) => got.extend(lines),
                Err(fault) => verdicts.push(fault),
            },
            6 if event == 0xFE => {
                interface.reset();
                pure = false;
            }
            6 => {}
            // Somebody else writes.
            _ => {
                let line = b"N1 \r\n\n\r".repeat(143);
                interface.write(&line[..usize::from(event >> 3) * 32 + 1]);
                pure = false;
            }
        }
    }
    sender.check_left();
    match interface.read() {
        Ok(lines) => got.extend(lines),
        Err(fault) => verdicts.push(fault),
    }
    if pure {
        assert_eq!((&got[..], &verdicts[..]), (sender.taken(), &[][..]));
    }
    Outcome::accepted((sender.taken(), got, verdicts))
}

pub(crate) const ENDS_DEFECTS: &[&str] = &[
    "a packet that is refused for now is not repeated",
    "a sender hands out packets after one was refused for good",
    "the second packet counts a line too few",
    "the interface loses the last byte of a write of more than 500",
    "the interface takes the first byte of a write that does not fit",
    "a reset keeps what is there if it is more than a packet",
];

fn bend(defect: Defect) -> EndsBend {
    let mut bend = EndsBend::NONE;
    if defect.is(1) {
        bend.ack = |ack| if ack == Ack::Later { Ack::Accepted } else { ack };
    }
    if defect.is(2) {
        bend.ack = |ack| if ack == Ack::Refused { Ack::Later } else { ack };
    }
    if defect.is(3) {
        bend.sent = |mut sent| {
            sent.lines -= usize::from(sent.packets > 1);
            sent
        };
    }
    if defect.is(4) {
        bend.write = |interface, data| match data {
            [data @ .., _] if data.len() >= 500 => interface.write(data),
            data => interface.write(data),
        };
    }
    if defect.is(5) {
        bend.write = |interface, data| {
            let ack = interface.write(data);
            if ack == Ack::Later {
                interface.write(&data[..1]);
            }
            ack
        };
    }
    if defect.is(6) {
        bend.reset = |interface| {
            if interface.len() <= 992 {
                StreamingInterface::reset(interface);
            }
        };
    }
    bend
}
