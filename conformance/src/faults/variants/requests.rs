//! Valid variants that accept or reject other requests than the simulated CNC, where the manuals do
//! not specify which are rejected. One variant has other handles on the axis interface.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Function, OffsetRule};

use super::row::unprinted;
use crate::faults::cnc::{
    CncDefect, INDEXED, NAMED, WRITES, function, functions, group, is, is_at, is_lookup, number,
    of_decoder, offset, row, set_u32, text, u32_at,
};

const COUNT: &[Function] = &[Function::CountVariables];
const OF_AXES: &[Function] = functions!(|spec| matches!(spec.offset, OffsetRule::OfAxis(_)));

/// The bit that the variant `different.axis-handles` sets in handles of the axis interface, to
/// distinguish them from other handles.
const OF_AXIS_INTERFACE: u32 = 0x1000_0000;

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("different.name-unended", &[], "the CNC accepts names of variables without a NUL",
        |cnc, call| if is_at(call, NAMED) && !call.data.contains(&0) && !call.data.is_empty() {
            cnc.with(call, &[call.data, &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("different.name-bytes-behind", &[],
        "the CNC ignores bytes after the NUL of a name in a query",
        |cnc, call| if is_lookup(call) && call.data.contains(&0) {
            cnc.with(call, &[text(call.data), &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("different.kind-of-256", &[], "the CNC rejects a kind of more than 32 bytes including NULs",
        |cnc, call| if is(call, COUNT) && call.data.len() > 32 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("different.kind-unended", &[],
        "the CNC accepts a kind without a NUL in a request for the number of variables",
        |cnc, call| match of_decoder(call) {
            Some(0x44) if !call.data.contains(&0) && call.service == AdsService::ReadWrite => {
                cnc.with(call, &[call.data, &[0]].concat())
            }
            _ => cnc.answer(call),
        }),
    row("different.kind-of-259", &[],
        "the CNC rejects an index and a kind of more than 36 bytes including NULs",
        |cnc, call| if is(call, INDEXED) && call.data.len() > 36 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("different.index-261", &[],
        "the CNC accepts an index and a kind of more than 260 bytes, and ignores the excess bytes",
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
        "the CNC pads values up to 8 bytes too short with zeros, but not for names of V.G.SERVICE",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) if !call.data.starts_with(b"V.G.SERVICE.") => {
                let longer = (1..=8).map(|more| [call.data, &vec![0; more]].concat());
                let reply = longer.map(|data| cnc.with(call, &data)).find(Result::is_ok);
                reply.unwrap_or(Err(AdsError::INVALID_SIZE))
            }
            (_, answer) => answer,
        }),
    unprinted(row("different.axis-handles", &[],
        "handles of the axis interface are other numbers than those of the channel interface",
        |cnc, call| match function(call) {
            Some(Function::AxisHandleByName) => {
                number(cnc.answer(call), 0, |handle| handle | OF_AXIS_INTERFACE)
            }
            Some(Function::ReadByHandle | Function::WriteByHandle) => {
                let mut data = call.data.to_vec();
                let handle = u32_at(&data, 0).unwrap_or_default();
                // In the default model, the top byte of an axis handle is 1 without this bit.
                if handle >> 24 == (OF_AXIS_INTERFACE >> 24) | 1 {
                    set_u32(&mut data, 0, handle & !OF_AXIS_INTERFACE);
                }
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        })),
    row("different.empty-places-refused", &[],
        "on the axis interface, an axis index without an axis has no variables",
        |cnc, call| match (is(call, OF_AXES), group(call), offset(call) >> 16) {
            (true, 0x12_2302 | 0x12_2306, 2..) => Err(AdsError::SYMBOL_NOT_FOUND),
            _ => cnc.answer(call),
        }),
];
