//! The axis interface of variables (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncSeed, ReplyData, Upstream, function, group, of_decoder, offset, on, row, text, u32_at,
};

const READ: &[Function] = &[Function::AxisReadByName];
const WRITE: &[Function] = &[Function::AxisWriteByName];

/// The function of the axis interface, and the axis, if the call is one.
fn of_axis(call: &Call<'_>) -> Option<(u32, u32)> {
    let offset = of_decoder(call)?;
    let (axis, function) = (offset >> 16, offset & 0xFFFF);
    (axis > 0 && (4..=9).contains(&function)).then_some((axis, function))
}

/// Calls the same function of another axis.
fn other_axis(cnc: &Upstream<'_>, call: &Call<'_>, other: impl FnOnce(u32) -> u32) -> ReplyData {
    match of_axis(call) {
        Some((axis, function)) => cnc.at(call, group(call), other(axis) << 16 | function),
        None => cnc.answer(call),
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    row("cnc.var.axis-first", &[VAR_26], "the axis interface is always that of the first axis",
        |cnc, call| other_axis(cnc, call, |_| 1)),
    row("cnc.var.axis-from-0", &[VAR_26, GEN_6], "axes of the axis interface are counted from 0",
        |cnc, call| other_axis(cnc, call, |axis| axis.wrapping_add(1))),
    row("cnc.var.axis-stride-1000", &[VAR_26, ADR_7], "the axis interface is at 0x1000 times the axis",
        |cnc, call| match of_decoder(call) {
            Some(at @ 0x1000..=0xFFFF) => cnc.at(call, group(call), (at >> 12) << 16 | at & 0xFFF),
            Some(0x1_0000..) if of_axis(call).is_some() => Err(AdsError::INVALID_OFFSET),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-of-channel-1", &[VAR_26], "the axis interface is that of channel 1",
        |cnc, call| match of_axis(call) {
            Some(_) => cnc.at(call, 0x12_2301, offset(call)),
            None => cnc.answer(call),
        }),
    row("cnc.var.axis-keeps", &[VAR_26],
        "the axis interface stays that of the axis which was first at the place",
        |cnc, call| match (of_axis(call), function(call)) {
            (Some((axis, _)), Some(Function::AxisReadByName)) if group(call) & 0xFF == 1 => {
                let place = (1..=3).find(|place| {
                    let at = place << 16 | 3;
                    let number = cnc.read(ads_cnc::ads::AmsPort::COM, 0x12_0101, at);
                    number.ok().and_then(|bytes| bytes.first().copied()).map(u32::from)
                        == Some(axis)
                });
                other_axis(cnc, call, |axis| place.unwrap_or(axis))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-name-needed", &[VAR_26], "names on the axis interface carry the name of the axis",
        |cnc, call| match (of_axis(call), function(call)) {
            (Some(_), Some(Function::AxisHandleByName | Function::AxisReadByName)) => {
                let name = text(call.data);
                match name.iter().filter(|byte| **byte == b'.').count() {
                    3.. => {
                        let at = name.iter().rposition(|byte| *byte == b'.').unwrap_or_default();
                        cnc.with(call, &[name.get(..at).unwrap_or_default(), &[0]].concat())
                    }
                    _ => Err(AdsError::SYMBOL_NOT_FOUND),
                }
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-handle-of-first", &[VAR_26, VAR_10],
        "the axis interface has the handle of the first axis for all",
        |cnc, call| match of_axis(call) {
            Some((_, 4)) => other_axis(cnc, call, |_| 1),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-handle-own", &[VAR_10],
        "handles of the axis interface are counted from 1, unlike those of the channel interface",
        |cnc, call| match of_axis(call) {
            Some((axis, 4)) => cnc.answer(call).map(|_| axis.to_le_bytes().to_vec()),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-functions-moved", &[VAR_26], "the axis interface reads at 0x4 and has handles at 0x5",
        |cnc, call| match of_axis(call) {
            Some((_, 4)) => cnc.at(call, group(call), offset(call).wrapping_add(1)),
            Some((_, 5)) => cnc.at(call, group(call), offset(call).wrapping_sub(1)),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-reserved", &[VAR_26],
        "the reserved offsets 0x7 to 0x9 of the axis interface answer as 0x4 to 0x6 do",
        |cnc, call| match of_axis(call) {
            Some((_, 7..)) => cnc.at(call, group(call), offset(call).wrapping_sub(3)),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-beyond", &[VAR_26], "an axis that is not there is taken for the last of the channel",
        |cnc, call| other_axis(cnc, call, |axis| axis.min(3))),
    on("cnc.var.axis-read-4-bytes", &[VAR_26, VAR_14],
        "the axis interface reads the lower half of a value",
        READ, |cnc, call| cnc.answer(call).map(|mut bytes| {
            bytes.truncate(4);
            bytes
        })),
    on("cnc.var.axis-write-refused", &[VAR_26], "the axis interface does not write",
        WRITE, |_, _| Err(AdsError::INVALID_ACCESS)),
    on("cnc.var.axis-write-first", &[VAR_26], "the axis interface writes to the first axis",
        WRITE, |cnc, call| other_axis(cnc, call, |_| 1)),
    on("cnc.var.axis-write-ignored", &[VAR_26],
        "a write on the axis interface succeeds and changes nothing",
        WRITE, |cnc, call| {
            let name = [text(call.data), &[0]].concat();
            let old = cnc.ask(group(call), offset(call).wrapping_sub(1), &name)?;
            cnc.answer(call)?;
            cnc.with(call, &[name, old].concat())
        }),
    on("cnc.var.axis-of-described-swapped", &[VAR_10],
        "handles of axis variables in descriptions are those of the next place",
        &[Function::DescribeByIndex], |cnc, call| cnc.answer(call).map(|mut bytes| {
            let handle = u32_at(&bytes, 0).unwrap_or_default();
            if handle & 0xFF00_FF00 == 0x0100_0000 {
                super::set_u32(&mut bytes, 0, handle.wrapping_add(0x1_0000));
            }
            bytes
        })),
];
