//! Defects in the object lists of COM and in the contents of the platform (mainly COM).

use ads_cnc::address::{Access, ComTable};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, ReplyData, Upstream, com_group, group, is, number, offset, on, records, records_mut,
    row, u32_at,
};

/// Changes each descriptor in the reply.
pub(in crate::faults) fn each(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    other: impl FnMut(&mut [u8; 84]),
) -> ReplyData {
    let mut answer = cnc.answer(call)?;
    if is(call, &[Function::ReadDescriptors]) {
        records_mut(&mut answer).for_each(other);
    }
    Ok(answer)
}

/// Changes the list of descriptors in the reply.
fn list(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(&mut Vec<[u8; 84]>)) -> ReplyData {
    let answer = cnc.answer(call)?;
    if !is(call, &[Function::ReadDescriptors]) {
        return Ok(answer);
    }
    let mut records = records(&answer);
    other(&mut records);
    Ok(records.concat())
}

pub(in crate::faults) fn set(record: &mut [u8; 84], place: usize, bytes: &[u8]) {
    let field = record.iter_mut().skip(place);
    field.zip(bytes).for_each(|(old, new)| *old = *new);
}

/// Whether the name in a descriptor starts with `start`.
pub(super) fn is_named(record: &[u8; 84], start: &[u8]) -> bool {
    record.iter().skip(20).zip(start).all(|(a, b)| a == b)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.com.count-one-less", &[COM_1, OBJ_1],
        "the number of objects in a list is one too low",
        &[Function::CountObjects], |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_sub(1))),
    row("cnc.com.access-always", &[COM_2], "the write access in every descriptor is TRUE",
        |cnc, call| each(cnc, call, |record| set(record, 8, &[1, 0]))),
    row("cnc.com.size-of-descriptor", &[COM_2],
        "the size in every descriptor is 84, that of the descriptor instead of the content",
        |cnc, call| each(cnc, call, |record| set(record, 4, &[84, 0, 0, 0]))),
    row("cnc.com.size-in-bits", &[COM_2],
        "the size in a descriptor is in bits instead of bytes",
        |cnc, call| each(cnc, call, |record| {
            let size = u32_at(record, 4).unwrap_or_default();
            set(record, 4, &size.wrapping_mul(8).to_le_bytes());
        })),
    row("cnc.com.size-even", &[COM_2], "the size in a descriptor is rounded up to an even number",
        |cnc, call| each(cnc, call, |record| {
            let size = u32_at(record, 4).unwrap_or_default();
            set(record, 4, &size.wrapping_add(size & 1).to_le_bytes());
        })),
    row("cnc.com.type-dword", &[COM_2, GEN_5],
        "the type in every descriptor is DWORD, whatever the size of the object",
        |cnc, call| each(cnc, call, |record| set(record, 52, b"DWORD\0\0\0"))),
    row("cnc.com.many-same", &[COM_3], "all descriptors in a reply are copies of the first",
        |cnc, call| list(cnc, call, |records| {
            let first = records.first().copied();
            records.iter_mut().for_each(|record| *record = first.unwrap_or(*record));
        })),
    row("cnc.com.many-reversed", &[COM_3], "several descriptors come in reverse order",
        |cnc, call| list(cnc, call, |records| records.reverse())),
    row("cnc.com.many-one-short", &[COM_3],
        "a reply with several descriptors lacks the last of them",
        |cnc, call| list(cnc, call, |records| {
            if records.len() > 1 {
                records.pop();
            }
        })),
    row("cnc.com.many-one", &[COM_3],
        "a reply has only one descriptor, even if several are requested",
        |cnc, call| list(cnc, call, |records| records.truncate(1))),
    row("cnc.com.many-two", &[COM_3],
        "a reply has at most two descriptors, even if more are requested",
        |cnc, call| list(cnc, call, |records| records.truncate(2))),
    row("cnc.com.many-refused", &[COM_3], "a read of more than one descriptor is rejected",
        |cnc, call| if is(call, &[Function::ReadDescriptors]) && call.read_length >= 168 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.many-from-1", &[COM_3],
        "a read of several descriptors starts with object 1, whatever its index offset",
        |cnc, call| if is(call, &[Function::ReadDescriptors]) && call.read_length >= 168 {
            cnc.at(call, group(call), 1)
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.many-padded", &[COM_3],
        "descriptors in a reply are 88 bytes apart instead of 84, and the reply keeps its length",
        |cnc, call| {
            let answer = cnc.answer(call)?;
            if !is(call, &[Function::ReadDescriptors]) || answer.len() <= 84 {
                return Ok(answer);
            }
            let len = answer.len();
            let records = records(&answer);
            let mut bytes: Vec<u8> =
                records.iter().flat_map(|record| record.iter().copied().chain([0; 4])).collect();
            bytes.truncate(len);
            Ok(bytes)
        }),
    row("cnc.com.platform-list-missing", &[COM_4],
        "the CNC rejects the object list 0x130100; platform objects are only in that of channel 1",
        |cnc, call| match com_group(call) {
            Some(com)
                if com.access == Access::Object
                    && com.table == ComTable::Channel
                    && com.instance == 0 =>
            {
                Err(AdsError::INVALID_GROUP)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.com.platform-not-in-channel-1", &[COM_4],
        "the CNC rejects platform contents in group 0x120101; it has them only in 0x120100",
        |cnc, call| match (com_group(call), offset(call)) {
            (Some(com), 0x251 | 0x252)
                if com.access == Access::Element
                    && com.table == ComTable::Channel
                    && com.instance == 1 =>
            {
                Err(AdsError::INVALID_OFFSET)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.com.platform-other-in-channel-1", &[COM_4],
        "platform contents are zeros in group 0x120101, and correct in group 0x120100",
        |cnc, call| match (com_group(call), offset(call)) {
            (Some(com), 0x251 | 0x252)
                if com.access == Access::Element
                    && com.table == ComTable::Channel
                    && com.instance == 1 =>
            {
                cnc.answer(call).map(|bytes| vec![0; bytes.len()])
            }
            _ => cnc.answer(call),
        }),
];
