//! Defects in splitting NC text into packets (STM).

use ads_cnc_vectors::ids::*;

use super::nc::{accepts, lines};
use super::row::{CodecDefect, CodecFault, rejected, row};

/// The text of these packets, split into packets of whole lines with at most `most` bytes each. A
/// longer line has its own packet.
fn packed(packets: &[Vec<u8>], most: usize) -> Vec<Vec<u8>> {
    let mut all: Vec<Vec<u8>> = Vec::new();
    let text = packets.concat();
    for line in text.split_inclusive(|byte| *byte == b'\n') {
        match all.last_mut() {
            Some(last) if last.len().saturating_add(line.len()) <= most => last.extend(line),
            _ => all.push(line.to_vec()),
        }
    }
    all
}

#[rustfmt::skip]
pub(super) const ROWS: &[CodecDefect] = &[
    row("codec.nc.cut-992", &[STM_4],
        "the codec splits NC text every 992 bytes, even within a line",
        CodecFault::Packets(|packets| packets.concat().chunks(992).map(<[u8]>::to_vec).collect())),
    row("codec.nc.cut-in-line-end", &[STM_4], "the codec ends packets between CR and LF",
        CodecFault::Packets(|mut packets| {
            let mut carried: Option<u8> = None;
            for packet in &mut packets {
                if let Some(byte) = carried {
                    packet.insert(0, byte);
                }
                carried = packet.pop();
            }
            packets.extend(carried.map(|byte| vec![byte]));
            packets
        })),
    row("codec.nc.packets-993", &[STM_2],
        "the codec splits NC text into packets of up to 993 bytes",
        CodecFault::Packets(|packets| packed(&packets, 993))),
    row("codec.nc.packets-4094", &[STM_2],
        "the codec splits NC text into packets of up to 4094 bytes",
        CodecFault::Packets(|packets| packed(&packets, 4094))),
    row("codec.nc.lf-alone", &[STM_4, STM_5],
        "the codec ends lines with LF alone",
        CodecFault::Packets(|packets| {
            let lf = |packet: Vec<u8>| packet.into_iter().filter(|byte| *byte != b'\r').collect();
            packets.into_iter().map(lf).collect()
        })),
    row("codec.nc.cr-alone", &[STM_4, STM_5],
        "the codec ends lines with CR alone",
        CodecFault::Packets(|packets| {
            let cr = |packet: Vec<u8>| packet.into_iter().filter(|byte| *byte != b'\n').collect();
            packets.into_iter().map(cr).collect()
        })),
    row("codec.nc.lf-cr", &[STM_4, STM_5],
        "the codec ends lines with LF CR",
        CodecFault::Packets(|packets| {
            let turned = |packet: Vec<u8>| {
                packet
                    .into_iter()
                    .map(|byte| match byte {
                        b'\r' => b'\n',
                        b'\n' => b'\r',
                        byte => byte,
                    })
                    .collect()
            };
            packets.into_iter().map(turned).collect()
        })),
    row("codec.nc.last-line-open", &[STM_4, STM_5], "the codec omits CR LF after the last line",
        CodecFault::Packets(|mut packets| {
            if let Some(last) = packets.last_mut() {
                last.truncate(last.len().saturating_sub(2));
            }
            packets
        })),
    row("codec.nc.empty-packet", &[STM_4], "the codec adds an empty packet at the end",
        CodecFault::Packets(|mut packets| {
            packets.push(Vec::new());
            packets
        })),
    row("codec.nc.packets-reversed", &[STM_15], "the codec returns the packets in reverse order",
        CodecFault::Packets(|packets| packets.into_iter().rev().collect())),
    row("codec.nc.last-packet-missing", &[STM_4], "the codec omits the last packet",
        CodecFault::Packets(|mut packets| {
            packets.pop();
            packets
        })),
    row("codec.nc.nul-behind", &[STM_7],
        "the codec adds a NUL at the end of each packet",
        CodecFault::Packets(|mut packets| {
            packets.iter_mut().for_each(|packet| packet.push(0));
            packets
        })),
    row("codec.nc.length-first", &[STM_7],
        "the codec writes the length of each packet before its text",
        CodecFault::Packets(|mut packets| {
            for packet in &mut packets {
                let len = u32::try_from(packet.len()).unwrap_or_default();
                packet.splice(..0, len.to_le_bytes());
            }
            packets
        })),
    row("codec.nc.upper-case", &[STM_7], "the codec converts NC text to upper case",
        CodecFault::Packets(|packets| packets.iter().map(|packet| packet.to_ascii_uppercase()).collect())),
    row("codec.nc.blanks-dropped", &[STM_7], "the codec removes blanks from NC text",
        CodecFault::Packets(|packets| {
            let dense = |packet: Vec<u8>| packet.into_iter().filter(|byte| *byte != b' ').collect();
            packets.into_iter().map(dense).collect()
        })),
    row("codec.nc.empty-lines-dropped", &[STM_4],
        "the codec removes empty lines from NC text",
        CodecFault::Packets(|packets| {
            let text = lines(&packets.concat(), |line| match line {
                b"\r\n" => Vec::new(),
                line => line.to_vec(),
            });
            packed(&[text], 992)
        })),
    row("codec.nc.comments-dropped", &[STM_7],
        "the codec removes comments in parentheses from NC text",
        CodecFault::Packets(|packets| {
            let mut open = false;
            let text = packets.concat().into_iter().filter(|byte| {
                open = *byte == b'(' || open && *byte != b'\r' && *byte != b')';
                !open && *byte != b')'
            });
            packed(&[text.collect()], 992)
        })),
    row("codec.nc.takes-cp1252", &[STM_7], "the codec accepts NC text with characters beyond ASCII",
        CodecFault::Around(|correct, question| accepts(correct, question, "packets", "not-ascii"))),
    row("codec.nc.takes-nul", &[STM_7], "the codec accepts NC text with a NUL",
        CodecFault::Around(|correct, question| accepts(correct, question, "packets", "nul"))),
    row("codec.nc.takes-long-lines", &[STM_20],
        "the codec accepts NC text with lines of more than 990 characters",
        CodecFault::Around(|correct, question| accepts(correct, question, "packets", "too-long"))),
    row("codec.nc.cuts-long-lines", &[STM_20],
        "the codec rejects NC text with a line of 990 characters, the maximum",
        CodecFault::Around(|correct, question| {
            let text = question.hex.as_deref().unwrap_or_default();
            let long =
                |line: &[u8]| line.iter().filter(|byte| !b"\r\n".contains(byte)).count() == 990;
            if question.op == "packets" && text.split(|byte| *byte == b'\n').any(long) {
                rejected("too-long")
            } else {
                correct(question)
            }
        })),
];
