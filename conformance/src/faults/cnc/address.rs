//! Defects in index groups and offsets (mainly ADR).

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
    row("cnc.adr.logical-as-index", &[ADR_1],
        "the CNC treats the channel number of logical addressing as the channel's rank",
        |cnc, call| if of_channel(call) {
            cnc.at(call, group(call) & !LOGICAL, offset(call))
        } else {
            cnc.answer(call)
        }),
    row("cnc.adr.rank-of-configured", &[ADR_11],
        "in addressing by index, the CNC counts deactivated channels in the rank of a channel",
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
    row("cnc.adr.spindle-from-1", &[ADR_2, GEN_6],
        "the CNC counts spindles in index groups from 1: 0x25301 is the first spindle",
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
        "the CNC accepts groups of spindles only with the bit of logical addressing: 0x125300",
        |cnc, call| match group(call) & 0xFF_F000 {
            0x02_5000 => Err(AdsError::INVALID_GROUP),
            0x12_5000 => cnc.at(call, group(call) & !LOGICAL, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.spindle-first", &[ADR_2],
        "the CNC treats the index group of every spindle as that of the first spindle",
        |cnc, call| match group(call) & 0xFF_F000 {
            0x02_5000 => cnc.at(call, group(call) & !0xFF, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-100-missing", &[ADR_3, COM_4],
        "the CNC rejects platform contents in group 0x120100; it has them only in 0x120101",
        |cnc, call| match group(call) & !LOGICAL {
            0x02_0100 => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-from-0", &[ADR_3, GEN_6],
        "the CNC counts platform axes in groups of COM from 0: 0x120200 is the first axis",
        |cnc, call| match com_group(call) {
            Some(com) if com.table == ComTable::Axis && offset(call) < 0x1_0000 => {
                cnc.at(call, group(call).wrapping_add(1), offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-first", &[ADR_3, ADR_13],
        "the CNC treats the COM group of every platform axis as that of the first platform axis",
        |cnc, call| match com_group(call) {
            Some(com) if com.table == ComTable::Axis && com.instance > 1 => {
                cnc.at(call, group(call) & !0xFF | 1, offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.object-access-added", &[ADR_4],
        "descriptors are in group 0x150101 (0x120101 + 0x30000) instead of group 0x130101",
        |cnc, call| match (group(call) & 0x0F_0000, com_group(call)) {
            (0x05_0000, _) => cnc.at(call, group(call).wrapping_sub(0x02_0000), offset(call)),
            (_, Some(com)) if com.access == Access::Object => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.object-access-is-content", &[ADR_4],
        "a read of a descriptor (object access) returns the content at the same index offset",
        |cnc, call| match com_group(call) {
            Some(com) if com.access == Access::Object && offset(call) != 0 => {
                cnc.at(call, group(call).wrapping_sub(0x01_0000), offset(call))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.classes-swapped", &[ADR_5],
        "the HLD is in group 0x124300, and path preparation in group 0x123300",
        |cnc, call| match group(call) & 0xEF_F000 {
            0x02_3000 | 0x02_4000 => cnc.at(call, group(call) ^ 0x7000, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.interpolator-is-position-controller", &[ADR_5],
        "the interpolator is in group 0x120300, and the position controller in group 0x121300",
        |cnc, call| match (group(call) & 0xEF_F000, group(call) & 0xF00) {
            (0x02_0000, 0x300..=0x900) => {
                cnc.at(call, group(call).wrapping_add(0x1000), offset(call))
            }
            (0x02_1000, _) => cnc.at(call, group(call).wrapping_sub(0x1000), offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.length-unit-swapped", &[ADR_6],
        "the attributes 0x300 (length) and 0x400 (unit) are exchanged",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x600) => cnc.at(call, group(call).wrapping_add(0x100), offset(call)),
            (Some(_), 0x700) => cnc.at(call, group(call).wrapping_sub(0x100), offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.attribute-of-first", &[ADR_6],
        "name, type, length, unit and write flag of elements above 1 are those of element 1",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x400..=0x800) if offset(call) & 0xFFF > 1 => {
                cnc.at(call, group(call), offset(call) & !0xFFF | 1)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.attribute-of-next", &[ADR_6],
        "name, type, length, unit and write flag of an element are those of the next element",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(_), 0x400..=0x800) => cnc.at(call, group(call), offset(call).wrapping_add(1)),
            _ => cnc.answer(call),
        }),
    row("cnc.adr.stride-1000", &[ADR_7],
        "the CNC uses the stride 0x1000 instead of 0x10000 for the axes of SDA and GEO elements",
        |cnc, call| match class(call) {
            Some(at) if (at.class != Class::Hld || at.instance != 0) && !is(call, FUNCTIONS) => {
                let (axis, element) = (offset(call) >> 12, offset(call) & 0xFFF);
                cnc.at(call, group(call), axis << 16 | element)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.axis-from-0", &[ADR_7, GEN_6],
        "the CNC counts the axes in index offsets of SDA and GEO from 0: axis 1 is the second",
        |cnc, call| match class(call) {
            Some(_) if offset(call) > 0xFFFF => {
                cnc.at(call, group(call), offset(call).wrapping_add(0x1_0000))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.adr.platform-axis-exchanged", &[ADR_13],
        "a read of platform axis 1, 2 or 3 in COM returns the axis at this axis index of channel 1",
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
        "a read of axis index n of channel 1 in COM returns platform axis n, despite axis exchange",
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

/// Functions of the decoder to which the defect `cnc.adr.stride-1000` does not apply its stride,
/// because the stride applies only to elements.
const FUNCTIONS: &[Function] = &[
    Function::AxisHandleByName,
    Function::AxisReadByName,
    Function::AxisWriteByName,
    Function::CountDynamic,
];
