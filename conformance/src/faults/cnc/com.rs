//! Object lists of COM (COM, OBJ).

use ads_cnc::address::{Access, ComTable};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncSeed, ReplyData, Upstream, com_group, group, is, number, offset, on, records, records_mut,
    row, u32_at,
};

const LEN: u32 = 84;

/// Changes each descriptor of the answer.
fn each(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(&mut [u8; 84])) -> ReplyData {
    let mut answer = cnc.answer(call)?;
    if is(call, &[Function::ReadDescriptors]) {
        records_mut(&mut answer).for_each(other);
    }
    Ok(answer)
}

/// Changes the list of descriptors of the answer.
fn list(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(&mut Vec<[u8; 84]>)) -> ReplyData {
    let answer = cnc.answer(call)?;
    if !is(call, &[Function::ReadDescriptors]) {
        return Ok(answer);
    }
    let mut records = records(&answer);
    other(&mut records);
    Ok(records.concat())
}

pub(super) fn set(record: &mut [u8; 84], place: usize, bytes: &[u8]) {
    let field = record.iter_mut().skip(place);
    field.zip(bytes).for_each(|(old, new)| *old = *new);
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    on("cnc.com.count-one-more", &[COM_1], "the number of objects counts itself",
        &[Function::CountObjects], |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_add(1))),
    on("cnc.com.count-one-less", &[COM_1, OBJ_1],
        "the number of objects is that of the last, counted from 0: the last is not counted",
        &[Function::CountObjects], |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_sub(1))),
    on("cnc.com.count-of-channel-1", &[COM_1],
        "the number of objects is that of channel 1, whichever list is asked",
        &[Function::CountObjects], |cnc, call| cnc.at(call, 0x13_0101, 0)),
    on("cnc.com.descriptors-of-channel-1", &[COM_2, COM_4],
        "descriptors are those of channel 1, whichever list is asked",
        &[Function::ReadDescriptors], |cnc, call| cnc.at(call, 0x13_0101, offset(call))),
    on("cnc.com.count-in-bytes", &[COM_1], "the number of objects is that of their bytes",
        &[Function::CountObjects], |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_mul(LEN))),
    on("cnc.com.descriptors-from-0", &[COM_2],
        "descriptors are counted from 0, so that each is that of the next object",
        &[Function::ReadDescriptors], |cnc, call| cnc.at(call, group(call), offset(call).wrapping_add(1))),
    row("cnc.com.descriptors-from-2", &[COM_2],
        "the number takes a place among the descriptors: the first is at index 2",
        |cnc, call| match (is(call, &[Function::ReadDescriptors]), offset(call)) {
            (true, 1) => Err(AdsError::INVALID_OFFSET),
            (true, index) => cnc.at(call, group(call), index.wrapping_sub(1)),
            _ => cnc.answer(call),
        }),
    on("cnc.com.descriptor-of-first", &[COM_2], "every descriptor is that of the first object",
        &[Function::ReadDescriptors], |cnc, call| cnc.at(call, group(call), 1)),
    row("cnc.com.descriptor-beyond", &[COM_2], "behind the last object its descriptor is answered again",
        |cnc, call| match (is(call, &[Function::ReadDescriptors]), cnc.answer(call)) {
            (true, Err(_)) => {
                let last = cnc.read(call.port, group(call), 0)?;
                cnc.at(call, group(call), u32_at(&last, 0).unwrap_or_default())
            }
            (_, answer) => answer,
        }),
    row("cnc.com.access-inverted", &[COM_2],
        "the descriptor has TRUE for what is read-only (write protection)",
        |cnc, call| each(cnc, call, |record| {
            let writable = record.iter().skip(8).take(2).any(|byte| *byte != 0);
            set(record, 8, &[u8::from(!writable), 0]);
        })),
    row("cnc.com.access-always", &[COM_2], "the descriptor has TRUE for every object (describable)",
        |cnc, call| each(cnc, call, |record| set(record, 8, &[1, 0]))),
    row("cnc.com.access-never", &[COM_2], "the descriptor has FALSE for every object",
        |cnc, call| each(cnc, call, |record| set(record, 8, &[0, 0]))),
    row("cnc.com.id-same", &[COM_2], "every object has the same ID",
        |cnc, call| each(cnc, call, |record| set(record, 0, &[1, 0, 0, 0]))),
    row("cnc.com.size-of-descriptor", &[COM_2], "the size is that of the descriptor, 84",
        |cnc, call| each(cnc, call, |record| set(record, 4, &[84, 0, 0, 0]))),
    row("cnc.com.size-in-bits", &[COM_2], "the size is in bits", |cnc, call| each(cnc, call, |record| {
        let size = u32_at(record, 4).unwrap_or_default();
        set(record, 4, &size.wrapping_mul(8).to_le_bytes());
    })),
    row("cnc.com.size-even", &[COM_2], "sizes are rounded up to an even number",
        |cnc, call| each(cnc, call, |record| {
            let size = u32_at(record, 4).unwrap_or_default();
            set(record, 4, &size.wrapping_add(size & 1).to_le_bytes());
        })),
    row("cnc.com.address-of-descriptor", &[COM_2, COM_5],
        "the index group of a descriptor is that of the descriptor, 0x130101, not of the content",
        |cnc, call| each(cnc, call, |record| {
            let group = u32_at(record, 12).unwrap_or_default();
            set(record, 12, &group.wrapping_add(0x1_0000).to_le_bytes());
        })),
    row("cnc.com.address-counted", &[COM_2, COM_5],
        "the index offset of a descriptor is one more than that of the content",
        |cnc, call| each(cnc, call, |record| {
            let offset = u32_at(record, 16).unwrap_or_default();
            set(record, 16, &offset.wrapping_add(1).to_le_bytes());
        })),
    row("cnc.com.address-swapped", &[COM_2], "the descriptor has the index offset before the index group",
        |cnc, call| each(cnc, call, |record| {
            let (group, offset) = (u32_at(record, 12), u32_at(record, 16));
            set(record, 12, &offset.unwrap_or_default().to_le_bytes());
            set(record, 16, &group.unwrap_or_default().to_le_bytes());
        })),
    row("cnc.com.name-type-swapped", &[COM_2], "the descriptor has the type before the name",
        |cnc, call| each(cnc, call, |record| {
            let old = *record;
            let (_, texts) = old.split_at(20);
            let (name, kind) = texts.split_at(32);
            set(record, 20, kind);
            set(record, 52, name);
        })),
    row("cnc.com.name-blank", &[COM_2], "the names of descriptors are padded with blanks",
        |cnc, call| each(cnc, call, |record| {
            record.iter_mut().skip(20).filter(|byte| **byte == 0).for_each(|byte| *byte = b' ');
        })),
    row("cnc.com.types-of-sda", &[COM_2], "types are named as in SDA: UNS32 for DWORD, REAL64 for LREAL",
        |cnc, call| each(cnc, call, |record| {
            let names: [(&[u8], &[u8]); 10] = [
                (b"BOOL\0", b"BOOLEAN\0"),
                (b"BYTE\0", b"UNS08\0"),
                (b"SINT\0", b"SGN08\0"),
                (b"WORD\0", b"UNS16\0"),
                (b"INT\0\0", b"SGN16\0"),
                (b"DWORD\0", b"UNS32\0"),
                (b"DINT\0", b"SGN32\0"),
                (b"REAL\0", b"REAL32\0"),
                (b"LREAL\0", b"REAL64\0"),
                (b"LINT\0", b"SGN64\0"),
            ];
            let (_, kind) = record.split_at(52);
            let other =
                names.iter().find(|(name, _)| kind.starts_with(name)).map(|(_, new)| *new);
            set(record, 52, other.unwrap_or_default());
        })),
    row("cnc.com.type-dword", &[COM_2, GEN_5], "every object is of type DWORD, whatever its size",
        |cnc, call| each(cnc, call, |record| set(record, 52, b"DWORD\0\0\0"))),
    row("cnc.com.many-same", &[COM_3], "when several descriptors are asked for, all are the first one's",
        |cnc, call| list(cnc, call, |records| {
            let first = records.first().copied();
            records.iter_mut().for_each(|record| *record = first.unwrap_or(*record));
        })),
    row("cnc.com.many-reversed", &[COM_3], "several descriptors come in reverse order",
        |cnc, call| list(cnc, call, |records| records.reverse())),
    row("cnc.com.many-one-short", &[COM_3], "the last of several descriptors is left out",
        |cnc, call| list(cnc, call, |records| {
            if records.len() > 1 {
                records.pop();
            }
        })),
    row("cnc.com.many-one", &[COM_3], "there is one descriptor, however many are asked for",
        |cnc, call| list(cnc, call, |records| records.truncate(1))),
    row("cnc.com.many-two", &[COM_3], "there are two descriptors at most, however many are asked for",
        |cnc, call| list(cnc, call, |records| records.truncate(2))),
    row("cnc.com.many-refused", &[COM_3], "a read of more than one descriptor is refused",
        |cnc, call| if is(call, &[Function::ReadDescriptors]) && call.read_length >= 168 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.many-from-1", &[COM_3],
        "several descriptors begin with the first object's, wherever they are asked for",
        |cnc, call| if is(call, &[Function::ReadDescriptors]) && call.read_length >= 168 {
            cnc.at(call, group(call), 1)
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.many-padded", &[COM_3], "several descriptors are 4 bytes apart", |cnc, call| {
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
        "platform data is described under channel 1 only: 0x130100 is refused",
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
        "platform data is read under channel 0 only: under channel 1 it is refused",
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
        "platform data is another under channel 1 than under channel 0",
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
