//! Both ends of a stream: the sender and the interface of the simulated CNC.

use ads_cnc::limits::NC_LINE_MAX;
use ads_cnc::streaming::{Ack, NcText};
use ads_cnc_conformance::simulator::program::StreamingInterface;

use super::input::Input;
use crate::common::streaming::{CheckedSender, SenderMutation};
use crate::machines::{CheckedInterface, InterfaceMutation};
use crate::{Defect, Outcome};

/// Input: the number of lines, and one byte for each line: its length (the upper six bits, most
/// lengths are short) and its line end (the lower two bits). Then one byte for each event, which the
/// `match` below interprets. The characters of a line depend on its byte, so that lines differ.
///
/// With any acknowledgements and reads, a sender offers each packet until it is accepted, offers
/// none after a permanent rejection, and counts the accepted packets and lines. The interface is a
/// bounded queue. Its output is the accepted text of the sender, unless somebody else writes or
/// resets, or a packet is acknowledged without being written.
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
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
    // The last line may lack its line end, or have a different one.
    if lines % 2 == 1 {
        text.pop();
    }
    assert!(NcText::new(&text).is_ok(), "the lines can be streamed");

    let mut sender = CheckedSender::new(&text, sender_bend(defect));
    let mut interface = CheckedInterface::new(interface_bend(defect));
    let (mut got, mut verdicts) = (Vec::new(), Vec::new());
    // Whether the interface has received exactly the packets that the sender counts as accepted.
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
                // An acknowledgement although the packet was not written to the interface.
                let ack = [Ack::Busy, Ack::Accepted, Ack::Busy, Ack::Rejected];
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
            // Another client writes.
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

pub(crate) const DEFECTS: &[&str] = &[
    "a packet that was rejected for now is not repeated",
    "a sender continues after a packet was rejected permanently",
    "the second packet counts one line too few",
    "the interface loses the last byte of a write of more than 500",
    "the interface takes the first byte of a write that does not fit",
    "a reset keeps the held bytes if they are more than a packet",
];

fn sender_bend(defect: Defect) -> SenderMutation {
    let mut mutation = SenderMutation::NONE;
    if defect.is(1) {
        mutation.ack = |ack| if ack == Ack::Busy { Ack::Accepted } else { ack };
    }
    if defect.is(2) {
        mutation.ack = |ack| if ack == Ack::Rejected { Ack::Busy } else { ack };
    }
    if defect.is(3) {
        mutation.sent = |mut sent| {
            sent.lines -= usize::from(sent.packets > 1);
            sent
        };
    }
    mutation
}

fn interface_bend(defect: Defect) -> InterfaceMutation {
    let mut mutation = InterfaceMutation::NONE;
    if defect.is(4) {
        mutation.write = |interface, data| match data {
            [data @ .., _] if data.len() >= 500 => interface.write(data),
            data => interface.write(data),
        };
    }
    if defect.is(5) {
        mutation.write = |interface, data| {
            let ack = interface.write(data);
            if ack == Ack::Busy {
                interface.write(&data[..1]);
            }
            ack
        };
    }
    if defect.is(6) {
        mutation.reset = |interface| {
            if interface.len() <= 992 {
                StreamingInterface::reset(interface);
            }
        };
    }
    mutation
}
