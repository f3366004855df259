//! Defects that occur only for some indices, lengths, numbers of dimensions or values, such as the
//! last index or the maximum length.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::lookup::{indexed, instance, with_indices};
use super::service::{RESPONSE, UUID, reads, writes};
use super::{
    CncDefect, DESCRIPTIONS, after_nul, changed, dimensions, group, is, number, offset, on,
    records, reply, row, text, u32_at,
};

const DESCRIPTORS: &[Function] = &[Function::ReadDescriptors];
const STREAM: &[Function] = &[Function::WriteProgramStream];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.adr.platform-axis-last", &[ADR_3],
        "the CNC has descriptors of the last platform axis, but rejects its contents",
        |cnc, call| {
            let next = cnc.read(call.port, (group(call) | 0x13_0000).wrapping_add(1), 0);
            if group(call) & 0xEF_FF00 == 0x02_0200 && instance(call) > 0 && next.is_err() {
                Err(AdsError::INVALID_GROUP)
            } else {
                cnc.answer(call)
            }
        }),
    row("cnc.adr.axis-8-bit", &[ADR_7, SDA_5],
        "the CNC uses only 8 bits of the axis in an index offset of SDA and GEO: 257 is axis 1",
        |cnc, call| match group(call) & 0xF00 {
            0x300..=0x800 => cnc.at(call, group(call), offset(call) & 0xFF_FFFF),
            _ => cnc.answer(call),
        }),
    on("cnc.com.many-12", &[COM_3],
        "a reply has at most 12 descriptors, as many as fit into 1024 bytes",
        DESCRIPTORS, |cnc, call| changed(cnc, call, |bytes| bytes.truncate(84 * 12))),
    on("cnc.com.many-to-last", &[COM_3],
        "a reply with several descriptors lacks that of the last object of the list",
        DESCRIPTORS, |cnc, call| {
            let count = u32_at(&cnc.read(call.port, group(call), 0)?, 0).unwrap_or_default();
            changed(cnc, call, |bytes| {
                let given = u32::try_from(records(bytes).len()).unwrap_or_default();
                let end = offset(call).wrapping_add(given).wrapping_sub(1);
                if given > 1 && end == count {
                    bytes.truncate(bytes.len().saturating_sub(84));
                }
            })
        }),
    row("cnc.dyn.name-of-96", &[DYN_6],
        "the CNC rejects a read of a parameter by a name of 96 bytes including NULs, the maximum",
        |cnc, call| if is(call, &[Function::DynamicValueByName]) && call.data.len() == 96 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.index-one-digit", &[VAR_20],
        "the CNC uses only the first digit of the index of an element in a name: [12] is [1]",
        &[Function::ReadByName], |cnc, call| {
            let (name, indices) = indexed(text(call.data));
            let first = |index: &u32| {
                std::iter::successors(Some(*index), |index| Some(index / 10).filter(|n| *n > 0))
                    .last()
                    .unwrap_or_default()
            };
            let indices: Vec<u32> = indices.iter().map(first).collect();
            if indices.is_empty() { cnc.answer(call) } else { cnc.with(call, &with_indices(name, &indices)) }
        }),
    row("cnc.var.write-2048", &[VAR_12, VAR_13],
        "the CNC rejects a write by handle or name with 2048 bytes of data, the maximum",
        |cnc, call| if is(call, &[Function::WriteByHandle, Function::WriteByName])
            && call.data.len() == 2048 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.read-2048", &[VAR_14],
        "the CNC rejects a read by handle of a value of 2048 bytes, the maximum",
        |cnc, call| match (is(call, &[Function::ReadByHandle]), cnc.answer(call)) {
            (true, Ok(bytes)) if bytes.len() == 2048 => Err(AdsError::INVALID_SIZE),
            (_, answer) => answer,
        }),
    row("cnc.var.write-name-of-255", &[VAR_13],
        "the CNC rejects a write by name with a name of 255 characters, the maximum",
        |cnc, call| if is(call, &[Function::WriteByName]) && text(call.data).len() == 255 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.dimensions-2", &[VAR_4, VAR_8],
        "a description has only the first two dimensions of an array with more",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |bytes| {
            let (numbers, end) = dimensions(bytes);
            if numbers.len() > 2 {
                bytes.drain(28..end);
                super::set_u32(bytes, 16, 2);
            }
        })),
    on("cnc.var.whole-first-row", &[VAR_14],
        "a read by name of a whole array of several dimensions returns only its first row",
        &[Function::ReadByName], |cnc, call| {
            let described = super::lookup::described(cnc, group(call), text(call.data));
            let numbers = dimensions(&described.unwrap_or_default()).0;
            let whole = indexed(text(call.data)).1.is_empty();
            changed(cnc, call, |bytes| {
                if let ([rows, _, ..], true) = (&numbers[..], whole) {
                    let rows = usize::try_from(*rows).unwrap_or(1);
                    bytes.truncate(bytes.len().checked_div(rows).unwrap_or_default());
                }
            })
        }),
    on("cnc.stm.room-4093", &[STM_3],
        "the CNC temporarily rejects the write that would fill the streaming interface to 4094 \
         bytes",
        STREAM, |cnc, call| {
            let channel = u8::try_from(instance(call)).unwrap_or_default();
            let buffered =
                cnc.cnc.with_program(channel, |program| program.buffered()).unwrap_or_default();
            if buffered.saturating_add(call.data.len()) == 4094 {
                Err(AdsError::INVALID_DATA)
            } else {
                cnc.answer(call)
            }
        }),
    row("cnc.stm.length-8-bit", &[STM_2, STM_4],
        "the CNC acknowledges and discards a packet whose length is a multiple of 256 bytes",
        |cnc, call| if is(call, STREAM) && call.data.len() % 256 == 0 {
            Ok(Vec::new())
        } else {
            cnc.answer(call)
        }),
    on("cnc.stm.lines-of-80", &[STM_20, STM_7],
        "the CNC keeps only the first 80 characters of each line in a stream",
        STREAM, |cnc, call| {
            let kept: Vec<u8> = call
                .data
                .split_inclusive(|byte| *byte == b'\n')
                .flat_map(|line| match line.strip_suffix(b"\r\n") {
                    Some(line) => [line.get(..80).unwrap_or(line), b"\r\n"].concat(),
                    None => line.to_vec(),
                })
                .collect();
            cnc.with(call, &kept)
        }),
    row("cnc.svc.response-127", &[SVC_1],
        "the CNC rejects a RESPONSE of 128 bytes including its NUL, the maximum",
        |cnc, call| {
            if writes(call, RESPONSE) && after_nul(call.data).len() == 128 {
                Err(AdsError::INVALID_SIZE)
            } else {
                cnc.answer(call)
            }
        }),
    row("cnc.svc.uuid-35", &[SVC_1, SVC_2], "a read of UUID returns only its first 35 characters",
        |cnc, call| if reads(call, UUID) {
            changed(cnc, call, |bytes| bytes.iter_mut().skip(35).for_each(|byte| *byte = 0))
        } else {
            cnc.answer(call)
        }),
    on("cnc.dyn.by-index-positive", &[DYN_4],
        "a read of a parameter by index returns its value without the sign",
        &[Function::DynamicValueByIndex], |cnc, call| number(cnc.answer(call), 4, |high| high & 0x7FFF_FFFF)),
];
