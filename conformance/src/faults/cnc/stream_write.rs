//! Defects in the writes of data streaming (STM).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, LOGICAL, ReplyData, Upstream, at, function, group, later, offset, records_mut, row,
};

/// Whether a call writes to a program stream, with any length.
fn stream(call: &Call<'_>) -> bool {
    group(call) & 0xEF_FF00 == 0x02_0100
        && offset(call) == 0x90
        && call.service == ads_cnc::operation::AdsService::Write
}

/// Changes the data of a write to a program stream with `other`.
fn written(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(&[u8]) -> Vec<u8>) -> ReplyData {
    if stream(call) { cnc.with(call, &other(call.data)) } else { cnc.answer(call) }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.stm.object-renamed", &[STM_1], "the object of the stream is called mc_program_stream",
        |cnc, call| {
            let mut answer = cnc.answer(call)?;
            if function(call) == Some(Function::ReadDescriptors) {
                for record in records_mut(&mut answer) {
                    let name =
                        record.iter().skip(20).zip(b"mc_program_stream_w").all(|(a, b)| a == b);
                    if name {
                        record.iter_mut().skip(37).take(2).for_each(|byte| *byte = 0);
                    }
                }
            }
            Ok(answer)
        }),
    row("cnc.stm.object-moved", &[STM_1],
        "the stream is written at the offset 0x91, as its descriptor says",
        |cnc, call| match (stream(call), offset(call)) {
            (true, _) => Err(AdsError::INVALID_OFFSET),
            (_, 0x91) if group(call) & 0xEF_FF00 == 0x02_0100 => {
                cnc.answer(&at(call, group(call), 0x90))
            }
            _ => {
                let mut answer = cnc.answer(call)?;
                if function(call) == Some(Function::ReadDescriptors) {
                    for record in records_mut(&mut answer) {
                        let name = record.iter().skip(20).zip(b"mc_program_stream_w");
                        if name.into_iter().all(|(a, b)| a == b) {
                            record.iter_mut().skip(16).take(1).for_each(|byte| *byte = 0x91);
                        }
                    }
                }
                Ok(answer)
            }
        }),
    row("cnc.stm.group-logical-only", &[STM_1, ADR_12],
        "the stream is written at 0x120100 + channel, and not at 0x20100 + channel",
        |cnc, call| if stream(call) && group(call) & LOGICAL == 0 {
            Err(AdsError::INVALID_GROUP)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.by-read-write", &[STM_1], "the stream takes a ReadWrite, and no Write",
        |cnc, call| if stream(call) { Err(AdsError::SERVICE_NOT_SUPPORTED) } else { cnc.answer(call) }),
    row("cnc.stm.first-channel", &[STM_1], "what is written to the stream of any channel runs in channel 1",
        |cnc, call| if stream(call) { cnc.at(call, 0x12_0101, 0x90) } else { cnc.answer(call) }),
    row("cnc.stm.packet-993", &[STM_2], "a write of up to 1024 bytes is taken",
        |cnc, call| if stream(call) && (993..=1024).contains(&call.data.len()) {
            let (one, other) = call.data.split_at_checked(512).unwrap_or_default();
            cnc.with(call, one)?;
            cnc.with(call, other)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-cut", &[STM_2], "a write of more than 992 bytes is taken, and what is more is lost",
        |cnc, call| if stream(call) && call.data.len() > 992 {
            cnc.with(call, call.data.get(..992).unwrap_or_default())
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-991", &[STM_2], "a write of 992 bytes is rejected",
        |cnc, call| if stream(call) && call.data.len() == 992 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.packet-512", &[STM_2], "a write of more than 512 bytes is rejected",
        |cnc, call| if stream(call) && call.data.len() > 512 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.stm.never-full", &[STM_3, STM_6],
        "the interface is never full: what it has no room for is acknowledged and kept",
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
    row("cnc.stm.full-lost", &[STM_6], "what the interface has no room for is acknowledged and lost",
        |cnc, call| match (stream(call), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_DATA)) => Ok(Vec::new()),
            (_, answer) => answer,
        }),
    row("cnc.stm.taken-refused", &[STM_6], "every fourth write is taken and acknowledged negatively",
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
    row("cnc.stm.full-for-good", &[STM_6], "once full, the interface takes nothing any more",
        |cnc, call| if !stream(call) {
            cnc.answer(call)
        } else if cnc.memory().count > 0 {
            Err(AdsError::INVALID_DATA)
        } else {
            cnc.answer(call).inspect_err(|error| {
                cnc.memory().count = u32::from(*error == AdsError::INVALID_DATA);
            })
        }),
    row("cnc.stm.one-line", &[STM_4], "of a write the first line is taken",
        |cnc, call| written(cnc, call, |data| {
            data.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default().to_vec()
        })),
    row("cnc.stm.lines-merged", &[STM_4], "the lines of a write are taken as one",
        |cnc, call| written(cnc, call, |data| {
            let (lines, end) =
                data.split_at_checked(data.len().saturating_sub(2)).unwrap_or_default();
            let one =
                lines.iter().map(|byte| if b"\r\n".contains(byte) { b' ' } else { *byte });
            one.chain(end.iter().copied()).collect()
        })),
    row("cnc.stm.lf-mended", &[STM_5], "a line that ends in LF alone is taken as one that ends in CR LF",
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
    row("cnc.stm.end-mended", &[STM_5], "a last line without an end is given one",
        |cnc, call| written(cnc, call, |data| match data {
            [.., b'\r' | b'\n'] => data.to_vec(),
            data => [data, b"\r\n"].concat(),
        })),
    row("cnc.stm.end-awaited", &[STM_5], "a line without an end is kept until the next write brings it",
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
    row("cnc.stm.upper-case", &[STM_7], "the characters of a stream are made upper case",
        |cnc, call| written(cnc, call, <[u8]>::to_ascii_uppercase)),
    row("cnc.stm.blanks-dropped", &[STM_7], "blanks in a stream are dropped",
        |cnc, call| written(cnc, call, |data| data.iter().copied().filter(|byte| *byte != b' ').collect())),
    row("cnc.stm.order-swapped", &[STM_15], "of two writes the second is taken before the first",
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
    row("cnc.stm.taken-twice", &[STM_15], "every write is taken twice", |cnc, call| {
        if stream(call) {
            cnc.answer(call)?;
        }
        cnc.answer(call)
    }),
    row("cnc.stm.line-of-512", &[STM_20], "a line of more than 510 characters is rejected", |cnc, call| {
        let long = |line: &[u8]| line.len() > 512;
        if stream(call) && call.data.split_inclusive(|byte| *byte == b'\n').any(long) {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }
    }),
];
