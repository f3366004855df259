//! Defects in the addresses of instances of SDA and GEO, and in the use of the port of GEO (SDA,
//! GEN).

use ads_cnc::address::Class;
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, LOGICAL, ReplyData, Upstream, changed, class, group, is, offset, reply, row,
    set_u32, u32_at,
};

const FIND: &[Function] = &[Function::FindInstance];

/// The reply to a `FindInstance` request with its channel and axis changed by `other`.
pub(super) fn with_instance(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    other: fn(u32, u32) -> (u32, u32),
) -> ReplyData {
    let (Some(channel), Some(axis)) = (u32_at(call.data, 0), u32_at(call.data, 4)) else {
        return cnc.answer(call);
    };
    if !is(call, FIND) {
        return cnc.answer(call);
    }
    let (channel, axis) = other(channel, axis);
    let mut data = call.data.to_vec();
    set_u32(&mut data, 0, channel);
    set_u32(&mut data, 4, axis);
    cnc.with(call, &data)
}

/// Replies with the object address (0, 0) to requests for the instances for which `is_absent`
/// returns true. Its arguments are the class in bits 12 to 15 of the index group, the channel and
/// the axis.
pub(in crate::faults) fn absent(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    is_absent: fn(u32, u32, u32) -> bool,
) -> ReplyData {
    let numbers = (u32_at(call.data, 0), u32_at(call.data, 4));
    match (is(call, FIND), numbers) {
        (true, (Some(channel), Some(axis))) if is_absent(group(call) & 0xF000, channel, axis) => {
            cnc.answer(call).map(|_| vec![0; 8])
        }
        _ => cnc.answer(call),
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.sda.address-swapped", &[SDA_1],
        "an object address has the index offset before the index group",
        |cnc, call| reply(cnc, call, FIND, |bytes| bytes.rotate_left(4))),
    row("cnc.sda.query-with-channel", &[SDA_1],
        "the CNC accepts requests for object addresses only at groups with a channel: 0x123901",
        |cnc, call| match (class(call), group(call) & 0xF00) {
            (Some(of), 0x900) if of.class != Class::Spindle => match of.instance {
                0 => Err(AdsError::INVALID_GROUP),
                _ => cnc.at(call, group(call) & !0xFF, offset(call)),
            },
            _ => cnc.answer(call),
        }),
    row("cnc.sda.address-of-query", &[SDA_1],
        "the index group in an object address is 0x600 too high: 0x123901 instead of 0x123301",
        |cnc, call| reply(cnc, call, FIND, |bytes| match u32_at(bytes, 0) {
            Some(0) | None => {}
            Some(group) => set_u32(bytes, 0, group.wrapping_add(0x600)),
        })),
    row("cnc.sda.address-by-index", &[SDA_3],
        "the index group in an object address lacks the bit of logical addressing",
        |cnc, call| reply(cnc, call, FIND, |bytes| {
            let group = u32_at(bytes, 0).unwrap_or_default();
            set_u32(bytes, 0, group & !LOGICAL);
        })),
    row("cnc.sda.address-16-bit", &[SDA_1],
        "the index group in an object address is cut to 16 bits: 0x3301 instead of 0x123301",
        |cnc, call| reply(cnc, call, FIND, |bytes| {
            let group = u32_at(bytes, 0).unwrap_or_default();
            set_u32(bytes, 0, group & 0xFFFF);
        })),
    row("cnc.sda.absent-answered", &[SDA_2],
        "the CNC returns an object address even for an instance that does not exist",
        |cnc, call| reply(cnc, call, FIND, |bytes| if bytes.iter().all(|byte| *byte == 0) {
            let channel = u32_at(call.data, 0).unwrap_or_default() & 0xFF;
            set_u32(bytes, 0, group(call).wrapping_sub(0x600) | channel);
            set_u32(bytes, 4, u32_at(call.data, 4).unwrap_or_default() << 16);
        })),
    row("cnc.sda.absent-ones", &[SDA_2],
        "the object address of an instance that does not exist has the bytes FF instead of 00",
        |cnc, call| reply(cnc, call, FIND, |bytes| if bytes.iter().all(|byte| *byte == 0) {
            *bytes = vec![0xFF; 8];
        })),
    row("cnc.sda.absent-nothing", &[SDA_2],
        "a request for the address of an instance that does not exist succeeds without data",
        |cnc, call| reply(cnc, call, FIND, |bytes| if bytes.iter().all(|byte| *byte == 0) {
            bytes.clear();
        })),
    row("cnc.sda.hld-stride-10000", &[SDA_3],
        "platform axes of the HLD have the stride 0x10000 instead of 0x1000",
        |cnc, call| match (is(call, FIND), group(call) & 0xEF_F0FF) {
            (true, 0x02_3000) => changed(cnc, call, |bytes| {
                if u32_at(bytes, 0) == Some(0x12_3300) {
                    let offset = u32_at(bytes, 4).unwrap_or_default();
                    set_u32(bytes, 4, offset << 4);
                }
            }),
            (false, 0x02_3000) if offset(call) >= 0x1_0000 => {
                let (axis, element) = (offset(call) >> 16, offset(call) & 0xFFF);
                cnc.at(call, group(call), axis << 12 | element)
            }
            (false, 0x02_3000) => Err(AdsError::INVALID_OFFSET),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.channel-1-only", &[SDA_5],
        "the CNC finds no interpolator, decoder, path preparation or HLD of channels above 1",
        |cnc, call| absent(cnc, call, |class, channel, _| (0x1000..0x5000).contains(&class) && channel > 1)),
    row("cnc.sda.no-axes", &[SDA_5], "axes of interpolator, decoder and path preparation are not found",
        |cnc, call| absent(cnc, call, |class, _, axis| {
            matches!(class, 0x1000 | 0x2000 | 0x4000) && axis > 0
        })),
    row("cnc.sda.no-axis-0", &[SDA_5],
        "the CNC finds no interpolator, decoder or path preparation of a channel with axis 0",
        |cnc, call| absent(cnc, call, |class, _, axis| {
            matches!(class, 0x1000 | 0x2000 | 0x4000) && axis == 0
        })),
    row("cnc.sda.position-controller-channel-1", &[SDA_5],
        "the position controller is found with channel 1, and not with 0",
        |cnc, call| match group(call) & 0xF000 {
            0 => with_instance(cnc, call, |channel, axis| match channel {
                1 => (0, axis),
                _ => (9, axis),
            }),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.position-controller-one-axis", &[SDA_5],
        "the last axis of the position controller is not found",
        |cnc, call| absent(cnc, call, |class, _, axis| class == 0 && axis > 4)),
    row("cnc.sda.position-controller-axis-from-0", &[SDA_5, GEN_6],
        "the CNC counts axes of the position controller from 0 in requests for object addresses",
        |cnc, call| match group(call) & 0xF000 {
            0 => with_instance(cnc, call, |channel, axis| (channel, axis.wrapping_add(1))),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.position-controller-any-channel", &[SDA_5],
        "the position controller is found with any channel",
        |cnc, call| match group(call) & 0xF000 {
            0 => with_instance(cnc, call, |_, axis| (0, axis)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.channel-0", &[SDA_5, GEN_6],
        "the CNC finds interpolator, decoder and path preparation of channel 1 with channel 0 too",
        |cnc, call| match group(call) & 0xF000 {
            0x1000 | 0x2000 | 0x4000 => with_instance(cnc, call, |channel, axis| (channel.max(1), axis)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.channel-8-bit", &[SDA_5, SDA_2],
        "the CNC uses only 8 bits of the channel in a request for an object address: 257 is 1",
        |cnc, call| with_instance(cnc, call, |channel, axis| (channel & 0xFF, axis))),
    row("cnc.sda.axis-16-bit", &[SDA_5, SDA_2],
        "the CNC uses only the lowest 16 bits of the axis in a request for an object address",
        |cnc, call| with_instance(cnc, call, |channel, axis| (channel, axis & 0xFFFF))),
    row("cnc.sda.hld-channel-missing", &[SDA_5], "the HLD of a channel is not found without an axis",
        |cnc, call| absent(cnc, call, |class, channel, axis| class == 0x3000 && channel > 0 && axis == 0)),
    row("cnc.sda.hld-platform-missing", &[SDA_5], "the HLD of an axis is not found without a channel",
        |cnc, call| absent(cnc, call, |class, channel, axis| class == 0x3000 && channel == 0 && axis > 0)),
    row("cnc.sda.spindle-from-1", &[SDA_5, GEN_6],
        "the CNC counts spindles from 1 in requests for object addresses",
        |cnc, call| match group(call) & 0xF000 {
            0x5000 => with_instance(cnc, call, |spindle, axis| (spindle.wrapping_sub(1), axis)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.spindle-one-only", &[SDA_5], "the CNC finds only the first spindle",
        |cnc, call| absent(cnc, call, |class, spindle, _| class == 0x5000 && spindle > 0)),
    row("cnc.sda.hld-own-axes", &[SDA_13],
        "the HLD of channel 1 has only the axes of the channel, not those of the whole platform",
        |cnc, call| match (group(call) & 0xEF_FFFF, is(call, FIND)) {
            (0x02_3900, true) => absent(cnc, call, |_, channel, axis| channel == 1 && axis > 3),
            (0x02_3301..=0x02_38FF, _) if group(call) & 0xFF == 1 && offset(call) >= 0x4_0000 => {
                Err(AdsError::INVALID_OFFSET)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.sda.hld-no-axes", &[SDA_13], "the HLD of the first channel has no axes",
        |cnc, call| match (group(call) & 0xEF_FFFF, is(call, FIND)) {
            (0x02_3900, true) => absent(cnc, call, |_, channel, axis| channel == 1 && axis > 0),
            (0x02_3301..=0x02_38FF, _) if group(call) & 0xFF == 1 && offset(call) >= 0x1_0000 => {
                Err(AdsError::INVALID_OFFSET)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.gen.geo-missing", &[GEN_4],
        "the CNC rejects every Read, Write and ReadWrite at port 551 (GEO) as an unknown port",
        |cnc, call| match call.port {
            AmsPort::GEO => Err(AdsError::TARGET_PORT_NOT_FOUND),
            _ => cnc.answer(call),
        }),
];
