//! Defects in the elements of SDA and GEO, at axis indices without an axis, and in the functions
//! whose index offsets are between those of the decoder's elements (SDA).

use ads_cnc::address::Class;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{AdsService, Call, Function, GroupRule, OffsetRule};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, at, class, forgiven, function, functions, group, is, is_at, offset, on, row,
};

const FUNCTIONS: &[Function] = functions!(|spec| matches!(
    (spec.group, spec.offset),
    (GroupRule::ChannelOf(Class::Decoder), OffsetRule::At(_) | OffsetRule::OfKind(_))
));

const fn is_blank(offset: u32) -> bool {
    offset >= 0x2_0000
}

/// Whether the call addresses an axis index of 2 or above in the interpolator, decoder or path
/// preparation of a channel whose number or rank is above 1. In the default model, these indices
/// have no axis.
pub(in crate::faults) fn empty_place(call: &Call<'_>) -> bool {
    class(call).is_some_and(|at| {
        matches!(at.class, Class::Interpolator | Class::Decoder | Class::PathPreparation)
            && at.instance > 1
            && is_blank(offset(call))
    })
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.sda.write-read-only", &[SDA_9],
        "a write to a read-only element succeeds and changes nothing",
        &[Function::WriteElement],
        |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_ACCESS)),
    row("cnc.sda.feedhold-2", &[SDA_10],
        "the content of feedhold.enable, a BOOLEAN of the HLD of channel 1, is 2",
        |cnc, call| if feedhold(call, 0x300) && call.service == AdsService::Read {
            cnc.answer(call).map(|_| vec![2])
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.feedhold-name", &[SDA_10],
        "the name of feedhold.enable, element 1 of the HLD of channel 1, is feedhold_enable",
        |cnc, call| if feedhold(call, 0x400) {
            cnc.answer(call).map(|_| b"feedhold_enable\0".to_vec())
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.feedhold-unit", &[SDA_10],
        "the unit of feedhold.enable, element 1 of the HLD of channel 1, is empty",
        |cnc, call| if feedhold(call, 0x700) { cnc.answer(call).map(|_| vec![0]) } else { cnc.answer(call) }),
    row("cnc.sda.feedhold-type", &[SDA_10],
        "the type of feedhold.enable, element 1 of the HLD of channel 1, is UNS08",
        |cnc, call| if feedhold(call, 0x500) {
            cnc.answer(call).map(|_| b"UNS08\0".to_vec())
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-refused", &[SDA_11],
        "the CNC rejects access to the content of an element at an axis index without an axis",
        |cnc, call| if empty_place(call) && group(call) & 0xF00 == 0x300 {
            Err(AdsError::INVALID_DATA)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-axis-number", &[SDA_11],
        "the logical axis number at an axis index without an axis is 0xFFFF instead of 0",
        |cnc, call| if empty_place(call) && is(call, &[Function::ReadElement]) {
            cnc.answer(call).map(|bytes| match bytes.len() {
                2 => vec![0xFF; 2],
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-of-first", &[SDA_11],
        "a read of an element at an axis index without an axis returns that of axis index 1",
        |cnc, call| if empty_place(call) && is(call, &[Function::ReadElement]) {
            cnc.at(call, group(call), offset(call) & 0xFFFF | 0x1_0000)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.blank-com-refused", &[SDA_11],
        "the CNC rejects access to COM objects at an axis index without an axis",
        |cnc, call| match (group(call) & 0xEF_FFFF, is_blank(offset(call))) {
            (0x02_0102 | 0x02_0103 | 0x02_0106, true) => Err(AdsError::INVALID_DATA),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.functions-shadowed", &[SDA_12],
        "the number of dynamic parameters is replaced by a decoder element with the bytes A5",
        |cnc, call| match function(call) {
            Some(Function::CountDynamic) => cnc.answer(call).map(|bytes| vec![0xA5; bytes.len()]),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.functions-behind-content", &[SDA_12],
        "the functions of the decoder are at offsets 0x100 too high, such as 0x144 instead of 0x44",
        |cnc, call| match super::of_decoder(call) {
            Some(_) if is_at(call, FUNCTIONS) => Err(AdsError::INVALID_OFFSET),
            Some(0x102..=0x1FF) => cnc.answer(&at(call, group(call), offset(call) & 0xFF)),
            _ => cnc.answer(call),
        }),
];

/// Whether the call addresses this attribute of the element in the manual's example, element 1 of
/// the HLD of channel 1.
fn feedhold(call: &Call<'_>, attribute: u32) -> bool {
    group(call) & 0xEF_FFFF == 0x02_3001 | attribute && offset(call) == 1
}
