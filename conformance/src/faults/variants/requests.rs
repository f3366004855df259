//! Valid variants that accept requests which no client should send, or lack optional functions: the
//! manuals do not specify which requests are rejected.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Function, OffsetRule};

use super::row::unprinted;
use crate::faults::cnc::{
    CncDefect, INDEXED, NAMED, WRITES, function, functions, group, is, is_at, is_lookup, number,
    of_decoder, offset, row, set_u32, text, u32_at,
};

const COUNT: &[Function] = &[Function::CountVariables];
const OF_AXES: &[Function] = functions!(|spec| matches!(spec.offset, OffsetRule::OfAxis(_)));

/// The bit that this variant sets in handles of the axis interface, to distinguish them from other
/// handles.
const OF_AXIS_INTERFACE: u32 = 0x1000_0000;

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("different.name-unended", &[], "names without a NUL are taken",
        |cnc, call| if is_at(call, NAMED) && !call.data.contains(&0) && !call.data.is_empty() {
            cnc.with(call, &[call.data, &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("different.name-bytes-behind", &[], "bytes after the NUL of a name are ignored",
        |cnc, call| if is_lookup(call) && call.data.contains(&0) {
            cnc.with(call, &[text(call.data), &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("different.kind-of-256", &[], "a kind takes 32 bytes at most, NULs after it counted",
        |cnc, call| if is(call, COUNT) && call.data.len() > 32 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("different.kind-unended", &[], "a kind without a NUL is taken", |cnc, call| match of_decoder(call) {
        Some(0x44) if !call.data.contains(&0) && call.service == AdsService::ReadWrite => {
            cnc.with(call, &[call.data, &[0]].concat())
        }
        _ => cnc.answer(call),
    }),
    row("different.kind-of-259", &[], "an index and a kind take 36 bytes at most, NULs after it counted",
        |cnc, call| if is(call, INDEXED) && call.data.len() > 36 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("different.index-261", &[], "an index and a kind may be longer than 260 bytes",
        |cnc, call| match of_decoder(call) {
            Some(0x45 | 0x4B) if call.data.len() > 260 => {
                cnc.with(call, call.data.get(..260).unwrap_or_default())
            }
            _ => cnc.answer(call),
        }),
    row("different.index-kind-unended", &[], "a kind without a NUL is accepted after an index",
        |cnc, call| match (of_decoder(call), call.data.get(4..)) {
            (Some(0x45 | 0x4B), Some(kind)) if !kind.contains(&0) => {
                cnc.with(call, &[call.data, &[0]].concat())
            }
            _ => cnc.answer(call),
        }),
    row("different.short-values", &[],
        "a value of fewer bytes than the variable has is written, and zeros after it, but to a service",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) if !call.data.starts_with(b"V.G.SERVICE.") => {
                let longer = (1..=8).map(|more| [call.data, &vec![0; more]].concat());
                let reply = longer.map(|data| cnc.with(call, &data)).find(Result::is_ok);
                reply.unwrap_or(Err(AdsError::INVALID_SIZE))
            }
            (_, answer) => answer,
        }),
    unprinted(row("different.axis-handles", &[],
        "the axis interface has handles of its own, that are understood as the others are",
        |cnc, call| match function(call) {
            Some(Function::AxisHandleByName) => {
                number(cnc.answer(call), 0, |handle| handle | OF_AXIS_INTERFACE)
            }
            Some(Function::ReadByHandle | Function::WriteByHandle) => {
                let mut data = call.data.to_vec();
                let handle = u32_at(&data, 0).unwrap_or_default();
                // The top byte of an axis handle is 1 without this bit.
                if handle >> 24 == (OF_AXIS_INTERFACE >> 24) | 1 {
                    set_u32(&mut data, 0, handle & !OF_AXIS_INTERFACE);
                }
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        })),
    row("different.empty-places-refused", &[],
        "on the axis interface a place where no axis is has no variables",
        |cnc, call| match (is(call, OF_AXES), group(call), offset(call) >> 16) {
            (true, 0x12_2302 | 0x12_2306, 2..) => Err(AdsError::SYMBOL_NOT_FOUND),
            _ => cnc.answer(call),
        }),
];
