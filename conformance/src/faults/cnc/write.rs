//! Writes of variables (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::variable::without_indices;
use super::{
    CncSeed, ReplyData, Upstream, WRITES, after_nul, delay_write, function, group, is, of_decoder,
    on, row, text,
};

const BY_HANDLE: &[Function] = &[Function::WriteByHandle];
const BY_NAME: &[Function] = &[Function::WriteByName];

/// A write that is undone after it has succeeded.
fn undone(cnc: &Upstream<'_>, call: &Call<'_>, read: u32, key: &[u8]) -> ReplyData {
    let old = cnc.ask(group(call), read, key);
    let done = cnc.answer(call)?;
    if let Ok(old) = old {
        let head = call.data.len().saturating_sub(old.len());
        let head = call.data.get(..head).unwrap_or_default();
        let _ = cnc.with(call, &[head, &old].concat());
    }
    Ok(done)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    on("cnc.var.write-by-handle-ignored", &[VAR_12], "a write by handle succeeds and changes nothing",
        BY_HANDLE, |cnc, call| {
            let count = super::u32_at(call.data, 4).and_then(|n| usize::try_from(n).ok());
            let head = count.unwrap_or_default().saturating_mul(4).saturating_add(8);
            undone(cnc, call, 0x47, call.data.get(..head).unwrap_or_default())
        }),
    on("cnc.var.write-by-name-ignored", &[VAR_13], "a write by name succeeds and changes nothing",
        BY_NAME, |cnc, call| undone(cnc, call, 0x48, &[text(call.data), &[0]].concat())),
    on("cnc.var.write-late", &[VAR_12, VAR_13], "a write takes effect with the next one",
        WRITES, delay_write),
    on("cnc.var.write-by-handle-refused", &[VAR_12], "writes by handle are refused",
        BY_HANDLE, |_, _| Err(AdsError::INVALID_ACCESS)),
    on("cnc.var.write-by-name-refused", &[VAR_13], "writes by name are refused",
        BY_NAME, |_, _| Err(AdsError::INVALID_ACCESS)),
    row("cnc.var.write-read-only-accepted", &[VAR_6],
        "a write of what is READ_ONLY succeeds, and changes nothing",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_ACCESS)) => Ok(Vec::new()),
            (_, answer) => answer,
        }),
    row("cnc.var.write-read-only-done", &[VAR_6], "what is READ_ONLY is written by name", |cnc, call| {
        let key = (group(call), 0, text(call.data).to_vec());
        match function(call) {
            Some(Function::WriteByName) => match cnc.answer(call) {
                Err(AdsError::INVALID_ACCESS) => {
                    cnc.memory().store(key, after_nul(call.data).to_vec());
                    Ok(Vec::new())
                }
                answer => answer,
            },
            Some(Function::ReadByName) => {
                let kept = cnc.memory().get(&key);
                kept.map_or_else(|| cnc.answer(call), Ok)
            }
            _ => cnc.answer(call),
        }
    }),
    row("cnc.var.write-long-accepted", &[VAR_12, VAR_13],
        "a value of more bytes than the variable has is cut and written",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) => {
                let mut data = call.data.to_vec();
                for _ in 0..8 {
                    data.pop();
                    if cnc.with(call, &data).is_ok() {
                        return Ok(Vec::new());
                    }
                }
                Err(AdsError::INVALID_SIZE)
            }
            (_, answer) => answer,
        }),
    row("cnc.var.write-element-whole", &[VAR_13], "a write by name of an element is one of every element",
        |cnc, call| if is(call, BY_NAME) && text(call.data).ends_with(b"]") {
            let name = without_indices(text(call.data));
            let value = after_nul(call.data);
            let old = cnc.ask(group(call), 0x48, &[name, &[0]].concat());
            let done = cnc.answer(call)?;
            let len = old.map(|old| old.len()).unwrap_or_default();
            let all: Vec<u8> = value.iter().copied().cycle().take(len).collect();
            let _ = cnc.with(call, &[name, &[0], &all].concat());
            Ok(done)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-element-first", &[VAR_13], "a write by name of an element is one of the first",
        |cnc, call| if is(call, BY_NAME) && text(call.data).ends_with(b"]") {
            let name = text(call.data);
            let path = without_indices(name);
            let places = name.iter().skip(path.len()).filter(|byte| **byte == b'[').count();
            let first = b"[0]".repeat(places);
            cnc.with(call, &[path, &first, &[0], after_nul(call.data)].concat())
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.write-behind-256", &[VAR_13], "a written value stands behind a name field of 256 bytes",
        BY_NAME, |cnc, call| match call.data.split_at_checked(256) {
            Some((name, value)) => cnc.with(call, &[text(name), &[0], value].concat()),
            None => Err(AdsError::INVALID_SIZE),
        }),
    row("cnc.var.write-big-endian", &[GEN_1, VAR_13],
        "values of 2 to 8 bytes are written with the most significant byte first",
        |cnc, call| if is(call, BY_NAME) && after_nul(call.data).len() <= 8 {
            let value: Vec<u8> = after_nul(call.data).iter().rev().copied().collect();
            cnc.with(call, &[text(call.data), &[0], &value].concat())
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.write-added", &[VAR_12], "a write by handle inverts the lowest bit of the value",
        BY_HANDLE, |cnc, call| {
            let count = super::u32_at(call.data, 4).and_then(|n| usize::try_from(n).ok());
            let head = count.unwrap_or_default().saturating_mul(4).saturating_add(8);
            let mut data = call.data.to_vec();
            data.iter_mut().skip(head).take(1).for_each(|byte| *byte ^= 1);
            cnc.with(call, &data)
        }),
    row("cnc.var.write-other-channels", &[VAR_13],
        "a write to a variable of channel 2 is one to that of channel 6 too",
        |cnc, call| if is(call, BY_NAME) && group(call) == 0x12_2302 {
            let done = cnc.answer(call);
            if done.is_ok() {
                let _ = cnc.at(call, 0x12_2306, super::offset(call));
            }
            done
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-1024", &[VAR_12, VAR_13], "writes of more than 64 bytes are refused",
        |cnc, call| if is(call, WRITES) && call.data.len() > 64 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-unended", &[VAR_13],
        "the name in a write ends before the last 4 bytes if there is no NUL",
        |cnc, call| match of_decoder(call) {
            Some(0x4A) if !call.data.contains(&0) && call.data.len() > 4 => {
                let at = call.data.len().saturating_sub(4);
                let (name, value) = call.data.split_at_checked(at).unwrap_or_default();
                cnc.with(call, &[name, &[0], value].concat())
            }
            _ => cnc.answer(call),
        }),
];
