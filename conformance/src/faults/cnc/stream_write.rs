//! Defects of the stream object and of the writes to it (mainly STM).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc_vectors::ids::*;

use super::com::{each, is_named, set};
use super::{CncDefect, LOGICAL, ReplyData, Upstream, at, forgiven, group, later, offset, row};

/// Whether a call writes to a program stream, with any length.
fn stream(call: &Call<'_>) -> bool {
    group(call) & 0xEF_FF00 == 0x02_0100
        && offset(call) == 0x90
        && call.service == AdsService::Write
}

/// Changes the data of a write to a program stream with `other`.
fn written(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(&[u8]) -> Vec<u8>) -> ReplyData {
    if stream(call) { cnc.with(call, &other(call.data)) } else { cnc.answer(call) }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.stm.object-renamed", &[STM_1],
        "the name of the stream object is mc_program_stream instead of mc_program_stream_w",
        |cnc, call| each(cnc, call, |record| if is_named(record, b"mc_program_stream_w") {
            set(record, 37, &[0, 0]);
        })),
    row("cnc.stm.object-moved", &[STM_1],
        "the stream object is at offset 0x91 instead of 0x90, as its descriptor states",
        |cnc, call| match (stream(call), offset(call)) {
            (true, _) => Err(AdsError::INVALID_OFFSET),
            (_, 0x91) if group(call) & 0xEF_FF00 == 0x02_0100 => {
                cnc.answer(&at(call, group(call), 0x90))
            }
            _ => each(cnc, call, |record| if is_named(record, b"mc_program_stream_w") {
                set(record, 16, &[0x91]);
            }),
        }),
    row("cnc.stm.group-logical-only", &[STM_1, ADR_12],
        "the CNC accepts stream writes in group 0x120100 + channel, but not in 0x20100 + channel",
        |cnc, call| if stream(call) && group(call) & LOGICAL == 0 {
            Err(AdsError::INVALID_GROUP)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.by-read-write", &[STM_1],
        "the CNC accepts a ReadWrite to the stream object, but rejects a Write because of its service",
        |cnc, call| {
            let write = Call { service: AdsService::Write, ..*call };
            match (stream(&write), call.service) {
                (true, AdsService::Write) => Err(AdsError::SERVICE_NOT_SUPPORTED),
                (true, AdsService::ReadWrite) => cnc.answer(&write),
                _ => cnc.answer(call),
            }
        }),
    row("cnc.stm.first-channel", &[STM_1],
        "a write to the stream object of any channel reaches the streaming interface of channel 1",
        |cnc, call| if stream(call) { cnc.at(call, 0x12_0101, 0x90) } else { cnc.answer(call) }),
    row("cnc.stm.packet-993", &[STM_2], "the CNC accepts stream writes of 993 to 1024 bytes",
        |cnc, call| if stream(call) && (993..=1024).contains(&call.data.len()) {
            let (one, other) = call.data.split_at_checked(512).unwrap_or_default();
            cnc.with(call, one)?;
            cnc.with(call, other)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-cut", &[STM_2],
        "the CNC acknowledges a stream write of more than 992 bytes and discards the excess bytes",
        |cnc, call| if stream(call) && call.data.len() > 992 {
            cnc.with(call, call.data.get(..992).unwrap_or_default())
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-991", &[STM_2], "the CNC rejects a stream write of 992 bytes, the maximum",
        |cnc, call| if stream(call) && call.data.len() == 992 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-512", &[STM_2], "the CNC rejects stream writes of more than 512 bytes",
        |cnc, call| if stream(call) && call.data.len() > 512 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.never-full", &[STM_3, STM_6],
        "the CNC accepts and keeps a write that does not fit into the streaming interface",
        |cnc, call| {
            let mut waiting = std::mem::take(&mut cnc.memory().later);
            while let Some(first) = waiting.first() {
                if cnc.late(first).is_err() {
                    break;
                }
                waiting.remove(0);
            }
            let answer = if stream(call) && !waiting.is_empty() {
                Err(AdsError::INVALID_DATA)
            } else {
                cnc.answer(call)
            };
            let answer = match (stream(call), answer) {
                (true, Err(AdsError::INVALID_DATA)) => {
                    waiting.push(later(call));
                    Ok(Vec::new())
                }
                (_, answer) => answer,
            };
            cnc.memory().later = waiting;
            answer
        }),
    row("cnc.stm.full-lost", &[STM_6],
        "the CNC acknowledges and discards a write that does not fit into the streaming interface",
        |cnc, call| if stream(call) {
            forgiven(cnc.answer(call), AdsError::INVALID_DATA)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.taken-refused", &[STM_6],
        "the CNC takes the data of every fourth stream write, but acknowledges it negatively",
        |cnc, call| if stream(call) {
            let reply = cnc.answer(call);
            let mut memory = cnc.memory();
            memory.count = memory.count.wrapping_add(1);
            match memory.count & 3 {
                0 => reply.and(Err(AdsError::INVALID_DATA)),
                _ => reply,
            }
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.full-for-good", &[STM_6],
        "after the streaming interface was full once, the CNC rejects every stream write",
        |cnc, call| if !stream(call) {
            cnc.answer(call)
        } else if cnc.memory().count > 0 {
            Err(AdsError::INVALID_DATA)
        } else {
            cnc.answer(call).inspect_err(|error| {
                cnc.memory().count = u32::from(*error == AdsError::INVALID_DATA);
            })
        }),
    row("cnc.stm.one-line", &[STM_4], "the CNC takes only the first line of a stream write",
        |cnc, call| written(cnc, call, |data| {
            data.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default().to_vec()
        })),
    row("cnc.stm.lines-merged", &[STM_4],
        "the CNC joins the lines of a stream write to one line, with blanks between them",
        |cnc, call| written(cnc, call, |data| {
            let (lines, end) =
                data.split_at_checked(data.len().saturating_sub(2)).unwrap_or_default();
            let one =
                lines.iter().map(|byte| if b"\r\n".contains(byte) { b' ' } else { *byte });
            one.chain(end.iter().copied()).collect()
        })),
    row("cnc.stm.lf-mended", &[STM_5],
        "the CNC treats a streamed line that ends with LF alone like one that ends with CR LF",
        |cnc, call| written(cnc, call, |data| {
            let lines = data.split_inclusive(|byte| *byte == b'\n');
            lines
                .flat_map(|line| match line {
                    [.., b'\r', b'\n'] => line.to_vec(),
                    [text @ .., b'\n'] => [text, b"\r\n"].concat(),
                    line => line.to_vec(),
                })
                .collect()
        })),
    row("cnc.stm.end-mended", &[STM_5],
        "the CNC adds CR LF to a stream write that does not end with CR or LF",
        |cnc, call| written(cnc, call, |data| match data {
            [.., b'\r' | b'\n'] => data.to_vec(),
            data => [data, b"\r\n"].concat(),
        })),
    row("cnc.stm.end-awaited", &[STM_5],
        "the CNC keeps a last line without its end until another stream write completes it",
        |cnc, call| if stream(call) {
            let key = (group(call), 0, Vec::new());
            let before = cnc.memory().get(&key).unwrap_or_default();
            let data = [before.as_slice(), call.data].concat();
            let end = data
                .iter()
                .rposition(|byte| *byte == b'\n')
                .map_or(0, |at| at.saturating_add(1));
            let (lines, rest) = data.split_at_checked(end).unwrap_or_default();
            cnc.memory().store(key, rest.to_vec());
            if lines.is_empty() { Ok(Vec::new()) } else { cnc.with(call, lines) }
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.upper-case", &[STM_7], "the CNC converts streamed text to upper case",
        |cnc, call| written(cnc, call, <[u8]>::to_ascii_uppercase)),
    row("cnc.stm.blanks-dropped", &[STM_7], "the CNC removes blanks from streamed text",
        |cnc, call| written(cnc, call, |data| data.iter().copied().filter(|byte| *byte != b' ').collect())),
    row("cnc.stm.order-swapped", &[STM_15],
        "of each two stream writes, the CNC takes the second before the first",
        |cnc, call| if stream(call) {
            let before = std::mem::take(&mut cnc.memory().later);
            match before.first() {
                None => {
                    cnc.memory().later.push(later(call));
                    Ok(Vec::new())
                }
                Some(first) => {
                    let reply = cnc.answer(call);
                    cnc.late(first)?;
                    reply
                }
            }
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.taken-twice", &[STM_15],
        "the CNC takes the data of each stream write twice",
        |cnc, call| {
            if stream(call) {
                cnc.answer(call)?;
            }
            cnc.answer(call)
        }),
    row("cnc.stm.line-of-512", &[STM_20],
        "the CNC rejects a stream write with a line of more than 510 characters",
        |cnc, call| {
            let long = |line: &[u8]| line.len() > 512;
            if stream(call) && call.data.split_inclusive(|byte| *byte == b'\n').any(long) {
                Err(AdsError::INVALID_SIZE)
            } else {
                cnc.answer(call)
            }
        }),
];
