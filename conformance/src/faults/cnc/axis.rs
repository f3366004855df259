//! Defects of the axis interface of variables (VAR).

use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{CncDefect, function, group, of_decoder, offset, row};

/// The axis index that a call to the axis interface addresses, and the lower 16 bits of its index
/// offset, which select the function or a reserved place; `None` for other calls.
fn of_axis(call: &Call<'_>) -> Option<(u32, u32)> {
    let offset = of_decoder(call)?;
    let (axis, function) = (offset >> 16, offset & 0xFFFF);
    (axis > 0 && (4..=9).contains(&function)).then_some((axis, function))
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.axis-of-channel-1", &[VAR_26],
        "the CNC answers requests on the axis interface of any channel for channel 1",
        |cnc, call| match of_axis(call) {
            Some(_) => cnc.at(call, 0x12_2301, offset(call)),
            None => cnc.answer(call),
        }),
    row("cnc.var.axis-keeps", &[VAR_26],
        "a read on the axis interface of channel 1 returns the axis that had the index before \
         axis exchange",
        |cnc, call| match (of_axis(call), function(call)) {
            (Some((axis, function_offset)), Some(Function::AxisReadByName))
                if group(call) & 0xFF == 1 =>
            {
                let place = (1..=3).find(|place| {
                    let at = place << 16 | 3;
                    let number = cnc.read(ads_cnc::ads::AmsPort::COM, 0x12_0101, at);
                    number.ok().and_then(|bytes| bytes.first().copied()).map(u32::from)
                        == Some(axis)
                });
                cnc.at(call, group(call), place.unwrap_or(axis) << 16 | function_offset)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-handle-own", &[VAR_10],
        "a handle by name on the axis interface is the axis index instead of a variable's handle",
        |cnc, call| match of_axis(call) {
            Some((axis, 4)) => cnc.answer(call).map(|_| axis.to_le_bytes().to_vec()),
            _ => cnc.answer(call),
        }),
    row("cnc.var.axis-reserved", &[VAR_26],
        "the reserved offsets 0x7 to 0x9 of the axis interface have the functions of 0x4 to 0x6",
        |cnc, call| match of_axis(call) {
            Some((_, 7..)) => cnc.at(call, group(call), offset(call).wrapping_sub(3)),
            _ => cnc.answer(call),
        }),
];
