//! Valid variants of a CNC: they behave differently from the simulated CNC, in ways that the
//! manuals permit.

mod elements;
mod models;
mod replies;
mod requests;
mod row;
mod unspecified;

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};

use super::cnc::{
    CncDefect, CncFault, ELEMENT_TEXTS, INDEXED, ReplyData, Upstream, changed, dimensions, each,
    fault, first, function, group, is, measured, number, offset, on, or_short, reply, row, set,
    set_u32, text, u32_at,
};
use row::{sent, unprinted};

/// Changes the handles in replies with `other`, and changes the handles in requests back with the
/// same function, which must be its own inverse.
fn handles(cnc: &Upstream<'_>, call: &Call<'_>, other: fn(u32) -> u32) -> ReplyData {
    let spec = function(call).map(Function::spec);
    match spec.map(|spec| (first(spec.request), first(spec.reply))) {
        Some((_, b"handle")) => number(cnc.answer(call), 0, other),
        Some((b"handle", _)) => {
            let mut data = call.data.to_vec();
            let handle = u32_at(&data, 0).unwrap_or_default();
            set_u32(&mut data, 0, other(handle));
            cnc.with(call, &data)
        }
        _ => cnc.answer(call),
    }
}

/// Pads the bytes from the offset `from` on with NULs to `len` bytes, if they are fewer.
fn padded(mut bytes: Vec<u8>, from: usize, len: usize) -> Vec<u8> {
    let end = from.saturating_add(len).max(bytes.len());
    bytes.resize(end, 0);
    bytes
}

pub(super) fn rows() -> impl Iterator<Item = &'static CncDefect> {
    let areas =
        [ROWS, elements::ROWS, unspecified::ROWS, replies::ROWS, models::ROWS, requests::ROWS];
    areas.into_iter().flatten()
}

#[rustfmt::skip]
const ROWS: &[CncDefect] = &[
    unprinted(row("different.names-padded", &[],
        "the CNC pads names, types and units in replies with NULs",
        |cnc, call| match function(call) {
            Some(Function::DescribeByIndex) => {
                let answer = cnc.whole(call);
                or_short(
                    cnc,
                    call,
                    answer.map(|bytes| {
                        let (_, name) = dimensions(&bytes);
                        let room = 2048_usize.saturating_sub(name).min(256);
                        padded(bytes, name, room)
                    }),
                )
            }
            Some(Function::DynamicNameByIndex) => {
                let answer = cnc.whole(call);
                or_short(cnc, call, answer.map(|bytes| padded(bytes, 0, 96)))
            }
            Some(function) if ELEMENT_TEXTS.contains(&function) => {
                let answer = cnc.whole(call);
                or_short(cnc, call, answer.map(|bytes| padded(bytes, 0, 64)))
            }
            _ => cnc.answer(call),
        })),
    unprinted(row("different.names-open", &[],
        "names, types and units end with the reply, without a NUL",
        |cnc, call| match function(call) {
            Some(Function::DescribeByIndex | Function::DynamicNameByIndex) => {
                changed(cnc, call, |bytes| _ = bytes.pop())
            }
            Some(function) if ELEMENT_TEXTS.contains(&function) => {
                cnc.answer(call).map(|bytes| match text(&bytes) {
                    [] => bytes,
                    text => text.to_vec(),
                })
            }
            _ => cnc.answer(call),
        })),
    fault("different.bytes-alone", &[],
        "the CNC sends each byte of a response separately",
        CncFault::Pieces(1)),
    fault("different.pieces-of-40", &[],
        "the CNC sends responses in pieces of at most 40 bytes",
        CncFault::Pieces(40)),
    row("different.error-numbers", &[], "errors have other numbers than those of the simulated CNC",
        |cnc, call| cnc.answer(call).map_err(|error| AdsError(error.0 ^ 0x9811_0000))),
    row("different.error-one", &[], "every error has the same number",
        |cnc, call| cnc.answer(call).map_err(|_| AdsError(0x706))),
    sent("different.errors-without-data", "a reply with an error ends after the result", |_, _, mut bytes| {
        if u32_at(&bytes, 38).is_some_and(|result| result != 0) {
            bytes.truncate(42);
        }
        measured(bytes)
    }),
    sent("different.errors-in-header", "errors are in the AMS header of a response without data",
        |_, _, mut bytes| match u32_at(&bytes, 38) {
            Some(error @ 1..) => {
                set_u32(&mut bytes, 30, error);
                bytes.truncate(38);
                measured(bytes)
            }
            _ => bytes,
        }),
    unprinted(row("different.handles", &[],
        "variables have other handles than those of the simulated CNC",
        |cnc, call| handles(cnc, call, |handle| handle ^ 0xC0DE_5A00))),
    unprinted(row("different.variables-reversed", &[], "the variables of a kind are in reverse order",
        |cnc, call| match (function(call), u32_at(call.data, 0), call.data.get(4..)) {
            (
                Some(function),
                Some(index),
                Some(kind),
            ) if INDEXED.contains(&function) => {
                let count = cnc.ask(group(call), 0x44, kind)?;
                let last = u32_at(&count, 0).unwrap_or_default().wrapping_sub(1);
                let index = last.wrapping_sub(index);
                cnc.with(call, &[&index.to_le_bytes(), kind].concat())
            }
            _ => cnc.answer(call),
        })),
    unprinted(on("different.objects-reversed", &[], "the objects of COM are in reverse order",
        &[Function::ReadDescriptors], |cnc, call| {
            let count = cnc.read(call.port, group(call), 0)?;
            let count = u32_at(&count, 0).unwrap_or_default();
            let first = offset(call);
            let last =
                first.saturating_add((call.read_length / 84).saturating_sub(1)).min(count);
            let one = |index: u32| {
                let index = count.wrapping_add(1).wrapping_sub(index);
                cnc.at(&Call { read_length: 84, ..*call }, group(call), index)
            };
            if first > count || call.read_length < 84 {
                cnc.answer(call)
            } else {
                (first..=last).map(one).collect::<Result<Vec<_>, _>>().map(|all| all.concat())
            }
        })),
    row("different.true-255", &[],
        "TRUE is 0xFF in write flags of elements and 0xFFFF in the write access of descriptors",
        |cnc, call| match function(call) {
            Some(Function::ReadElementWriteFlag) => cnc.answer(call).map(|bytes| {
                bytes.into_iter().map(|byte| if byte == 0 { 0 } else { 0xFF }).collect()
            }),
            _ => each(cnc, call, |record| {
                if record.iter().skip(8).take(2).any(|byte| *byte != 0) {
                    set(record, 8, &[0xFF; 2]);
                }
            }),
        }),
    unprinted(row("different.length-1-byte", &[], "the length of an element takes 1 byte",
        |cnc, call| reply(cnc, call, &[Function::ReadElementLength], |bytes| bytes.truncate(1)))),
    unprinted(row("different.length-2-bytes", &[], "the length of an element takes 2 bytes",
        |cnc, call| reply(cnc, call, &[Function::ReadElementLength], |bytes| bytes.truncate(2)))),
    unprinted(row("different.descriptor-remains", &[],
        "descriptors have arbitrary bytes in the unassigned field and after the NULs of texts",
        |cnc, call| each(cnc, call, |record| {
            set(record, 10, &[0xAA; 2]);
            for field in [20, 52] {
                let ended = record.iter_mut().skip(field).take(32).skip_while(|byte| **byte != 0);
                ended.skip(1).for_each(|byte| *byte = b'x');
            }
        }))),
    row("different.no-axis-lists", &[],
        "the CNC has no object lists of platform axes (0x130200 + axis)",
        |cnc, call| match group(call) & 0xEF_FF00 {
            0x03_0200 => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    on("different.many-exactly", &[],
        "the CNC rejects a read of descriptors whose read length is not that of the reply",
        &[Function::ReadDescriptors], |cnc, call| cnc.answer(call).and_then(|bytes| {
            let len = u32::try_from(bytes.len()).unwrap_or_default();
            if len == call.read_length { Ok(bytes) } else { Err(AdsError::INVALID_SIZE) }
        })),
    row("different.short-writes", &[],
        "the CNC pads the data of a shorter write to the size of the object",
        |cnc, call| match (is(call, &[Function::WriteObject]), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) => {
                let old = cnc.read(call.port, group(call), offset(call))?;
                cnc.with(call, &padded(call.data.to_vec(), 0, old.len()))
            }
            (_, answer) => answer,
        }),
    row("different.kind-with-nul", &[],
        "the CNC rejects the empty kind without a NUL, which is a request without data",
        |cnc, call| if is(call, &[Function::CountVariables]) && call.data.is_empty() {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("different.absent-refused", &[],
        "a request for the object address of an instance that does not exist returns an error",
        |cnc, call| match (is(call, &[Function::FindInstance]), cnc.answer(call)) {
            (true, Ok(bytes)) if bytes.iter().all(|byte| *byte == 0) => {
                Err(AdsError::SYMBOL_NOT_FOUND)
            }
            (_, answer) => answer,
        }),
];
