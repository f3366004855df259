//! Defects in the contents of elements of SDA and GEO (SDA).

use ads_cnc::address::Class;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call, Function, GroupRule, OffsetRule};
use ads_cnc_vectors::ids::*;

use super::{CncDefect, at, class, function, functions, group, is, is_at, offset, row};

const WRITE: &[Function] = &[Function::WriteElement];
const FUNCTIONS: &[Function] = functions!(|spec| matches!(
    (spec.group, spec.offset),
    (GroupRule::ChannelOf(Class::Decoder), OffsetRule::At(_) | OffsetRule::OfKind(_))
));

const fn is_blank(offset: u32) -> bool {
    offset >= 0x2_0000
}

/// Whether the call addresses an axis place of channel 2 or 6 that has no axis.
fn empty_place(call: &Call<'_>) -> bool {
    class(call).is_some_and(|at| {
        matches!(at.class, Class::Interpolator | Class::Decoder | Class::PathPreparation)
            && at.instance > 1
            && is_blank(offset(call))
    })
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.sda.write-read-only", &[SDA_9], "a write of an element that is read-only succeeds",
        |cnc, call| match (is(call, WRITE), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_ACCESS)) => Ok(Vec::new()),
            (_, answer) => answer,
        }),
    row("cnc.sda.feedhold-2", &[SDA_10], "the content of feedhold.enable is 2",
        |cnc, call| if feedhold(call, 0x300) && call.service == AdsService::Read {
            cnc.answer(call).map(|_| vec![2])
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.feedhold-name", &[SDA_10], "feedhold.enable is called feedhold_enable",
        |cnc, call| if feedhold(call, 0x400) {
            cnc.answer(call).map(|_| b"feedhold_enable\0".to_vec())
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.feedhold-unit", &[SDA_10], "the unit of feedhold.enable is empty",
        |cnc, call| if feedhold(call, 0x700) { cnc.answer(call).map(|_| vec![0]) } else { cnc.answer(call) }),
    row("cnc.sda.feedhold-type", &[SDA_10], "feedhold.enable is an UNS08",
        |cnc, call| if feedhold(call, 0x500) {
            cnc.answer(call).map(|_| b"UNS08\0".to_vec())
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-refused", &[SDA_11], "reading at a place without an axis is rejected",
        |cnc, call| if empty_place(call) && group(call) & 0xF00 == 0x300 {
            Err(AdsError::INVALID_DATA)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-axis-number", &[SDA_11],
        "the logical axis number of a place without an axis is 0xFFFF",
        |cnc, call| if empty_place(call) && is(call, &[Function::ReadElement]) {
            cnc.answer(call).map(|bytes| match bytes.len() {
                2 => vec![0xFF; 2],
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-of-first", &[SDA_11],
        "reading at a place without an axis gives what the first place has",
        |cnc, call| if empty_place(call) && is(call, &[Function::ReadElement]) {
            cnc.at(call, group(call), offset(call) & 0xFFFF | 0x1_0000)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-com-refused", &[SDA_11], "objects of COM at a place without an axis are rejected",
        |cnc, call| match (group(call) & 0xEF_FFFF, is_blank(offset(call))) {
            (0x02_0102 | 0x02_0103 | 0x02_0106, true) => Err(AdsError::INVALID_DATA),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.functions-shadowed", &[SDA_12],
        "contents of the decoder are where the numbers of dynamic parameters should be",
        |cnc, call| match function(call) {
            Some(Function::CountDynamic) => cnc.answer(call).map(|bytes| vec![0xA5; bytes.len()]),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.functions-behind-content", &[SDA_12],
        "the functions of the decoder have offsets from 0x100 on, after its contents",
        |cnc, call| match super::of_decoder(call) {
            Some(_) if is_at(call, FUNCTIONS) => Err(AdsError::INVALID_OFFSET),
            Some(0x102..=0x1FF) => cnc.answer(&at(call, group(call), offset(call) & 0xFF)),
            _ => cnc.answer(call),
        }),
];

/// Whether the call addresses this attribute of the element in the manual's example, element 1 of the
/// HLD of channel 1.
fn feedhold(call: &Call<'_>, attribute: u32) -> bool {
    group(call) & 0xEF_FFFF == 0x02_3001 | attribute && offset(call) == 1
}
