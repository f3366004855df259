//! Defects of variables, many of which show only if several replies are compared (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call, Function};
use ads_cnc_vectors::ids::*;

use super::consistency::cached;
use super::{
    CncDefect, NAMED, Upstream, WRITES, after_nul, descriptions, function, group, is, name_in,
    of_decoder, offset, on, reply, row, text, u32_at, value_at,
};

/// Whether a call is a query that names a variable: its value, its handle or its description.
fn is_query(call: &Call<'_>) -> bool {
    is(call, NAMED) && call.service == AdsService::ReadWrite
}

/// The names of all V.E variables and then all V.G variables, in the order of their indices.
fn listed(cnc: &Upstream<'_>, call: &Call<'_>) -> Vec<Vec<u8>> {
    let all = [b"V.E".as_slice(), b"V.G"].into_iter();
    let all = all.flat_map(|kind| descriptions(cnc, group(call), kind));
    all.map(|found| name_in(&found).to_vec()).collect()
}

/// The current value at the address of a write.
fn old(cnc: &Upstream<'_>, call: &Call<'_>) -> Vec<u8> {
    let head = call.data.get(..value_at(call)).unwrap_or_default();
    let read = match function(call) {
        Some(Function::WriteByHandle | Function::WriteByName) => offset(call).wrapping_sub(2),
        _ => offset(call).wrapping_sub(1),
    };
    cnc.ask(group(call), read, head).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.name-compared-8", &[VAR_9],
        "an unknown name addresses a variable whose name has the same first 8 characters",
        |cnc, call| match (is_query(call), cnc.answer(call)) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => {
                let name = text(call.data);
                let same = |other: &Vec<u8>| name.len() > 8 && other.get(..8) == name.get(..8);
                let other = listed(cnc, call).into_iter().find(same);
                cnc.with(call, &[other.as_deref().unwrap_or(name), &[0]].concat())
            }
            (_, answer) => answer,
        }),
    on("cnc.var.write-low-byte", &[VAR_12, VAR_13],
        "a write to a variable changes only the first byte of the value",
        WRITES, |cnc, call| {
            let (at, old) = (value_at(call), old(cnc, call));
            let mut data = call.data.to_vec();
            let value = data.iter_mut().skip(at).zip(old).skip(1);
            value.for_each(|(byte, old)| *byte = old);
            cnc.with(call, &data)
        }),
    row("cnc.var.write-refused-done", &[VAR_12, VAR_13],
        "the CNC rejects a value with more bytes than the variable, but stores the first of them",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) => {
                let len = value_at(call).saturating_add(old(cnc, call).len());
                let _ = cnc.with(call, call.data.get(..len).unwrap_or(call.data));
                Err(AdsError::INVALID_SIZE)
            }
            (_, answer) => answer,
        }),
    row("cnc.var.write-read-only-refused-done", &[VAR_6],
        "the CNC rejects a write by name to a READ_ONLY variable, but reads return the new value",
        |cnc, call| {
            let key = (group(call), 0, text(call.data).to_vec());
            match function(call) {
                Some(Function::WriteByName) => cnc.answer(call).inspect_err(|error| {
                    if *error == AdsError::INVALID_ACCESS {
                        cnc.memory().store(key, after_nul(call.data).to_vec());
                    }
                }),
                Some(Function::ReadByName) => {
                    let kept = cnc.memory().get(&key);
                    kept.map_or_else(|| cnc.answer(call), Ok)
                }
                _ => cnc.answer(call),
            }
        }),
    on("cnc.var.text-keeps-rest", &[VAR_12, VAR_13, VAR_25],
        "a shorter text that is written to a STRING variable keeps the rest of the old text",
        WRITES, |cnc, call| {
            let (at, old) = (value_at(call), old(cnc, call));
            let value = call.data.get(at..).unwrap_or_default();
            let text = text(value);
            if value.len() == old.len() || text.len() == value.len() {
                cnc.answer(call)
            } else {
                let rest = old.get(text.len()..).unwrap_or_default();
                let head = call.data.get(..at).unwrap_or_default();
                cnc.with(call, &[head, text, rest].concat())
            }
        }),
    row("cnc.var.extended-swapped", &[VAR_15],
        "an extended description has the validity before the synchronisation",
        |cnc, call| reply(cnc, call, &[Function::DescribeExtended], |bytes| {
            if bytes.len() == 8 {
                bytes.rotate_left(4);
            }
        })),
    on("cnc.var.axis-write-all", &[VAR_26],
        "a write on the axis interface changes the variable of all axes of the channel",
        &[Function::AxisWriteByName], |cnc, call| {
            let reply = cnc.answer(call);
            for axis in (1..=3).filter(|_| reply.is_ok()) {
                let _ = cnc.at(call, group(call), axis << 16 | offset(call) & 0xFFFF);
            }
            reply
        }),
    row("cnc.var.axis-name-optional", &[VAR_26],
        "on the channel interface, a V.A name without an axis addresses the first axis",
        |cnc, call| match (of_decoder(call), text(call.data)) {
            (Some(at @ (0x46 | 0x48)), name)
                if name.starts_with(b"V.A.")
                    && name.iter().filter(|byte| **byte == b'.').count() == 2 =>
            {
                let function = if at == 0x46 { 4 } else { 5 };
                cnc.at(call, group(call), 0x1_0000 | function)
            }
            _ => cnc.answer(call),
        }),
    on("cnc.var.value-cached", &[VAR_13, VAR_14],
        "a read by name always returns the value of the first read by this name",
        &[Function::ReadByName], |cnc, call| {
            // A name may be padded with NULs.
            let name = [text(call.data), &[0]].concat();
            cached(cnc, &Call { data: &name, ..*call }, &[Function::ReadByName])
        }),
    row("cnc.var.count-8-bit-of-indices", &[VAR_11, VAR_24],
        "the CNC uses only the lowest byte of the number of indices in a read by handle",
        |cnc, call| match (of_decoder(call), u32_at(call.data, 4)) {
            (Some(0x47), Some(count @ 0x100..)) => {
                let mut data = call.data.to_vec();
                super::set_u32(&mut data, 4, count & 0xFF);
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.structure-index-beyond", &[VAR_20],
        "the CNC treats the first index in an unknown name as 0",
        |cnc, call| match (is_query(call), cnc.answer(call)) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => {
                let name = String::from_utf8_lossy(text(call.data)).into_owned();
                let Some((head, tail)) = name.split_once('[') else {
                    return Err(AdsError::SYMBOL_NOT_FOUND);
                };
                let tail = tail.split_once(']').map_or("", |(_, tail)| tail);
                cnc.with(call, format!("{head}[0]{tail}\0").as_bytes())
            }
            (_, answer) => answer,
        }),
];
