//! Defects in index groups and offsets (ADR).

use ads_cnc::address::{Access, Class, ComTable};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call, Function};
use ads_cnc_vectors::ids::*;

use super::{CncDefect, LOGICAL, class, com_group, group, is, offset, row};

/// Whether the low byte of the index group is a channel number or rank.
fn of_channel(call: &Call<'_>) -> bool {
    match (class(call), com_group(call)) {
        (Some(class), _) => class.class != Class::Spindle && class.instance != 0,
        (_, Some(com)) => com.table == ComTable::Channel && com.instance != 0,
        _ => false,
    }
}

fn by_index(call: &Call<'_>) -> bool {
    group(call) & LOGICAL == 0
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.adr.logical-as-index", &[ADR_1], "a channel addressed logically is the one of that rank",
        |cnc, call| if of_channel(call) {
            cnc.at(call, group(call) & !LOGICAL, offset(call))
        } else {
            cnc.answer(call)
        }),
    row("cnc.adr.rank-of-configured", &[ADR_11],
        "by index a channel is addressed by its rank among all, those that are deactivated too",
        |cnc, call| {
            let rank = usize::try_from(group(call) & 0xFF).unwrap_or_default();
            let number = rank.checked_sub(1).and_then(|before| cnc.channels().get(before).copied());
            match number {
                Some(number) if by_index(call) && of_channel(call) => {
                    let group = group(call) & 0xFFFF_FF00 | LOGICAL | u32::from(number);
                    cnc.at(call, group, offset(call))
                }
                _ => cnc.answer(call),
            }
        }),
    row("cnc.adr.spindle-from-1", &[ADR_2, GEN_6], "spindles are counted from 1",
        |cnc, call| match class(call) {
            Some(at) if at.class == Class::Spindle && at.instance > 0 => {
                cnc.at(call, group(call).wrapping_sub(1), offset(call))
            }
            Some(at) if at.class == Class::Spindle && group(call) & 0xF00 != 0x900 => {
                Err(AdsError::INVALID_GROUP)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.spindle-logical", &[ADR_2, ADR_5],
        "spindles are addressed with the bit of logical addressing, and not without",
        |cnc, call| match group(call) & 0xFF_F000 {
            0x02_5000 => Err(AdsError::INVALID_GROUP),
            0x12_5000 => cnc.at(call, group(call) & !LOGICAL, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.spindle-first", &[ADR_2], "every group of a spindle is the first one's",
        |cnc, call| match group(call) & 0xFF_F000 {
            0x02_5000 => cnc.at(call, group(call) & !0xFF, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-100-missing", &[ADR_3, COM_4],
        "the platform has no group 0x120100, only 0x120101",
        |cnc, call| match group(call) & !LOGICAL {
            0x02_0100 => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-from-0", &[ADR_3, GEN_6], "platform axes of COM are counted from 0",
        |cnc, call| match com_group(call) {
            Some(com) if com.table == ComTable::Axis && offset(call) < 0x1_0000 => {
                cnc.at(call, group(call).wrapping_add(1), offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-first", &[ADR_3, ADR_13], "every platform axis of COM is the first one",
        |cnc, call| match com_group(call) {
            Some(com) if com.table == ComTable::Axis && com.instance > 1 => {
                cnc.at(call, group(call) & !0xFF | 1, offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.object-access-added", &[ADR_4],
        "0x30000 is added to 0x20000: objects are described at 0x150101",
        |cnc, call| match (group(call) & 0x0F_0000, com_group(call)) {
            (0x05_0000, _) => cnc.at(call, group(call).wrapping_sub(0x02_0000), offset(call)),
            (_, Some(com)) if com.access == Access::Object => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.object-access-is-content", &[ADR_4],
        "0x30000 in place of 0x20000 makes no difference: content is read",
        |cnc, call| match com_group(call) {
            Some(com) if com.access == Access::Object && offset(call) != 0 => {
                cnc.at(call, group(call).wrapping_sub(0x01_0000), offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.classes-swapped", &[ADR_5], "the HLD is at 0x124300, path preparation at 0x123300",
        |cnc, call| match group(call) & 0xEF_F000 {
            0x02_3000 | 0x02_4000 => cnc.at(call, group(call) ^ 0x7000, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.interpolator-is-position-controller", &[ADR_5],
        "the bits of the class are counted from the interpolator on: it is at 0x120300",
        |cnc, call| match (group(call) & 0xEF_F000, group(call) & 0xF00) {
            (0x02_0000, 0x300..=0x900) => {
                cnc.at(call, group(call).wrapping_add(0x1000), offset(call))
            }
            (0x02_1000, _) => cnc.at(call, group(call).wrapping_sub(0x1000), offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.length-unit-swapped", &[ADR_6], "attribute 0x300 is the unit, 0x400 the length",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x600) => cnc.at(call, group(call).wrapping_add(0x100), offset(call)),
            (Some(_), 0x700) => cnc.at(call, group(call).wrapping_sub(0x100), offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.attribute-of-first", &[ADR_6],
        "attributes are those of the first element, whichever is asked for",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x400..=0x800) if offset(call) & 0xFFF > 1 => {
                cnc.at(call, group(call), offset(call) & !0xFFF | 1)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.attribute-of-next", &[ADR_6],
        "attributes are counted from 0: they are those of the next element",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x400..=0x800) => cnc.at(call, group(call), offset(call).wrapping_add(1)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.stride-1000", &[ADR_7], "an axis of SDA and GEO takes 0x1000 of the index offset",
        |cnc, call| match class(call) {
            Some(at) if (at.class != Class::Hld || at.instance != 0) && !is(call, FUNCTIONS) => {
                let (axis, element) = (offset(call) >> 12, offset(call) & 0xFFF);
                cnc.at(call, group(call), axis << 16 | element)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.axis-from-0", &[ADR_7, GEN_6], "axes in the index offset are counted from 0",
        |cnc, call| match class(call) {
            Some(_) if offset(call) > 0xFFFF => {
                cnc.at(call, group(call), offset(call).wrapping_add(0x1_0000))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-exchanged", &[ADR_13],
        "axis exchange in channel 1 changes the addresses of platform axes too",
        |cnc, call| match com_group(call) {
            Some(com)
                if com.table == ComTable::Axis
                    && com.access == Access::Element
                    && (1..=3).contains(&com.instance)
                    && call.service == AdsService::Read =>
            {
                let place = u32::from(com.instance) << 16;
                cnc.at(call, 0x12_0101, place | offset(call) & 0xFFFF)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.place-keeps-axis", &[ADR_13],
        "a place of channel 1 stays that of its first axis: exchange does not show in COM",
        |cnc, call| match com_group(call) {
            Some(com)
                if com.table == ComTable::Channel
                    && com.access == Access::Element
                    && com.instance == 1
                    && (0x1_0000..0x4_0000).contains(&offset(call))
                    && call.service == AdsService::Read =>
            {
                let axis = offset(call) >> 16;
                cnc.at(call, 0x12_0200 | axis, offset(call) & 0xFFFF)
            }
            _ => cnc.answer(call),
        }),
];

/// Functions at index offsets of the decoder where other classes have elements.
const FUNCTIONS: &[Function] = &[
    Function::AxisHandleByName,
    Function::AxisReadByName,
    Function::AxisWriteByName,
    Function::CountDynamic,
];
