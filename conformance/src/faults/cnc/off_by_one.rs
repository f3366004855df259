//! Defects that mix the data of different channels, axes, kinds, records or indices, or that
//! separate two interfaces to the same value.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::handle::{joined, parts};
use super::lookup::{described, instance, is_string, name_of};
use super::{
    CncDefect, LOGICAL, after_nul, changed, each, function, group, is, offset, on, row, set_u32,
    text, u32_at,
};

const DESCRIPTORS: &[Function] = &[Function::ReadDescriptors];
const STREAM: &[Function] = &[Function::WriteProgramStream];
const WRITE: &[Function] = &[Function::WriteElement];

/// Overwrites a text field of 32 bytes in each record without clearing it first, so that the rest
/// of the longer text of the previous record remains after a shorter text.
fn run_on(records: &mut [[u8; 84]], field: usize) {
    let mut before: Vec<u8> = Vec::new();
    for record in records {
        let Some(bytes) = record.get_mut(field..field.saturating_add(32)) else { continue };
        let len = text(bytes).len();
        let rest = before.iter().skip(len);
        bytes.iter_mut().skip(len).zip(rest).for_each(|(byte, old)| *byte = *old);
        before = text(bytes).to_vec();
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.adr.spindle-written-first", &[ADR_2, SDA_9],
        "a write to any spindle changes the first spindle",
        |cnc, call| match (is(call, WRITE), group(call)) {
            (true, 0x02_5301..=0x02_53FF) => cnc.at(call, 0x02_5300, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.attributes-of-channel", &[ADR_6, ADR_7],
        "type, length and unit of element i of an axis are those of element i of the channel",
        |cnc, call| if is(
            call,
            &[Function::ReadElementType, Function::ReadElementLength, Function::ReadElementUnit],
        ) && instance(call) > 0 {
            cnc.at(call, group(call), offset(call) & 0xFFFF).or_else(|_| cnc.answer(call))
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.many-access-stays", &[COM_2, COM_3],
        "in a reply, the descriptors after one with write access have write access too",
        |cnc, call| {
            let mut writable = false;
            each(cnc, call, |record| {
                writable |= record.get(8) == Some(&1);
                record.iter_mut().skip(8).take(1).for_each(|byte| *byte = u8::from(writable));
            })
        }),
    on("cnc.com.many-types-run-on", &[COM_2, COM_3],
        "in a reply, a type shorter than that of the previous descriptor is followed by its rest",
        DESCRIPTORS, |cnc, call| changed(cnc, call, |bytes| {
            let mut records = super::records(bytes);
            run_on(&mut records, 52);
            *bytes = records.concat();
        })),
    row("cnc.com.write-first-channel-too", &[COM_5],
        "a write to an object of channel 2 also changes the object of channel 1",
        |cnc, call| {
            let reply = cnc.answer(call);
            if reply.is_ok()
                && is(call, &[Function::WriteObject])
                && group(call) | LOGICAL == 0x12_0102
            {
                let _ = cnc.at(call, 0x12_0101, offset(call));
            }
            reply
        }),
    on("cnc.dyn.names-sorted", &[DYN_4, DYN_2],
        "names of parameters by index are in alphabetical order, unlike the values by index",
        &[Function::DynamicNameByIndex], |cnc, call| {
            cnc.answer(call)?;
            let all = (1_u32..).map_while(|index| cnc.with(call, &index.to_le_bytes()).ok());
            let mut all: Vec<Vec<u8>> = all.collect();
            all.sort();
            let place = u32_at(call.data, 0).and_then(|index| usize::try_from(index).ok());
            let place = place.and_then(|place| place.checked_sub(1)).unwrap_or_default();
            super::within_length(call, all.get(place).cloned().ok_or(AdsError::INVALID_DATA))
        }),
    row("cnc.var.strings-127-apart", &[VAR_11, VAR_14],
        "a read by handle of element i of a STRING array starts i bytes too early",
        |cnc, call| match (is(call, &[Function::ReadByHandle]), parts(call.data)) {
            (true, Some((handle, indices, _))) if indices.len() == 1 => {
                let correct = cnc.answer(call)?;
                let name = name_of(cnc, group(call), handle).unwrap_or_default();
                let described = described(cnc, group(call), &name).unwrap_or_default();
                let whole = cnc.whole(&Call { data: &joined(handle, &[], &[]), ..*call })?;
                let index = indices.first().and_then(|one| usize::try_from(*one).ok());
                let start = correct.len().saturating_sub(1).saturating_mul(index.unwrap_or_default());
                let part = whole.get(start..start.saturating_add(correct.len()));
                if is_string(&described) { Ok(part.map_or(correct, <[u8]>::to_vec)) } else { Ok(correct) }
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.sum-with-cycle", &[VAR_1], "the number of variables of all kinds counts V.CYC too",
        |cnc, call| if is(call, &[Function::CountVariables]) && text(call.data).is_empty() {
            let names = [&b"V.CYC.count\0"[..], b"V.CYC.matrix\0"];
            let there = names.iter().filter(|name| cnc.ask(group(call), 0x48, name).is_ok());
            let more = u32::try_from(there.count()).unwrap_or_default();
            changed(cnc, call, |bytes| {
                let sum = u32_at(bytes, 0).unwrap_or_default();
                set_u32(bytes, 0, sum.wrapping_add(more));
            })
        } else {
            cnc.answer(call)
        }),
    on("cnc.stm.room-of-all", &[STM_3],
        "the limit of 4094 bytes applies to the streaming interfaces of all channels together",
        STREAM, |cnc, call| {
            let total = |channel: u8| cnc.cnc.with_program(channel, |program| program.buffered());
            let total: usize = cnc.channels().into_iter().filter_map(|one| total(one).ok()).sum();
            if total.saturating_add(call.data.len()) > 4094 {
                Err(AdsError::INVALID_DATA)
            } else {
                cnc.answer(call)
            }
        }),
    row("cnc.var.axis-two-copies", &[VAR_26],
        "a value written on the axis interface is read only there, not on the channel interface",
        |cnc, call| {
            let key = (group(call) & 0xFF, offset(call) >> 16, text(call.data).to_vec());
            match function(call) {
                Some(Function::AxisWriteByName) => {
                    let name = [text(call.data), &[0]].concat();
                    let old = cnc.ask(group(call), offset(call).wrapping_sub(1), &name);
                    let reply = cnc.answer(call)?;
                    cnc.memory().store(key, after_nul(call.data).to_vec());
                    let _ = cnc.with(call, &[&name[..], &old?].concat());
                    Ok(reply)
                }
                Some(Function::AxisReadByName) => {
                    let kept = cnc.memory().get(&key);
                    kept.map_or_else(|| cnc.answer(call), Ok)
                }
                _ => cnc.answer(call),
            }
        }),
];
