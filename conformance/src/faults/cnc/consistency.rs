//! Defects whose replies contradict each other (SDA, DYN).

use ads_cnc::address::Class;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, Key, ReplyData, Upstream, class, group, is, number, offset, on, row, set_u32, text,
    u32_at, within_length,
};

const FIND: &[Function] = &[Function::FindInstance];
const WRITE: &[Function] = &[Function::WriteElement];
const NAME: &[Function] = &[Function::DynamicNameByIndex];
const BY_NAME: &[Function] = &[Function::DynamicValueByName];
const VALUES: &[Function] = &[Function::DynamicValueByName, Function::DynamicValueByIndex];

/// The reply with the channel (offset 0) or the axis (offset 4) of a `FindInstance` request changed.
fn with_number(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    place: usize,
    other: fn(u32) -> u32,
) -> ReplyData {
    match (is(call, FIND), u32_at(call.data, place)) {
        (true, Some(number)) => {
            let mut data = call.data.to_vec();
            set_u32(&mut data, place, other(number));
            cnc.with(call, &data)
        }
        _ => cnc.answer(call),
    }
}

/// Finds no instance of the class `of` for axes after `last`.
fn few_axes(cnc: &Upstream<'_>, call: &Call<'_>, of: u32, last: u32) -> ReplyData {
    if is(call, FIND) && group(call) & 0xF000 == of && u32_at(call.data, 4) > Some(last) {
        cnc.answer(call).map(|_| vec![0; 8])
    } else {
        cnc.answer(call)
    }
}

/// Repeats the first reply to a request forever.
fn cached(cnc: &Upstream<'_>, call: &Call<'_>, of: &[Function]) -> ReplyData {
    if !is(call, of) {
        return cnc.answer(call);
    }
    let key: Key = (group(call), offset(call), call.data.to_vec());
    let known = cnc.memory().get(&key);
    if let Some(known) = known {
        return within_length(call, Ok(known));
    }
    let bytes = cnc.answer(call)?;
    cnc.memory().store(key, bytes.clone());
    Ok(bytes)
}

/// Executes a write, and then the same write at another address, where it succeeds only if the content
/// has the same length.
fn written(cnc: &Upstream<'_>, call: &Call<'_>, group: u32, offset: u32) -> ReplyData {
    let reply = cnc.answer(call);
    if reply.is_ok() {
        let _also = cnc.at(call, group, offset);
    }
    reply
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.sda.address-of-channel-1", &[SDA_1],
        "whichever channel is asked for, the address is that of channel 1",
        |cnc, call| with_number(cnc, call, 0, |channel| channel.min(1))),
    row("cnc.sda.address-of-channel", &[SDA_1],
        "whichever axis is asked for, the address is that of the channel",
        |cnc, call| match group(call) & 0xF000 {
            0x1000 | 0x2000 | 0x4000 => with_number(cnc, call, 4, |_| 0),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.interpolator-no-axes", &[SDA_5],
        "axes of the interpolator are not found, those of the decoder are",
        |cnc, call| few_axes(cnc, call, 0x1000, 0)),
    row("cnc.sda.decoder-one-axis", &[SDA_5], "the decoder has the first axis of a channel only",
        |cnc, call| few_axes(cnc, call, 0x2000, 1)),
    row("cnc.sda.axis-24-bit", &[SDA_5, SDA_2], "of the axis asked for the lowest 24 bits count",
        |cnc, call| with_number(cnc, call, 4, |axis| axis & 0xFF_FFFF)),
    row("cnc.sda.first-length", &[SDA_8], "the length of the number of elements is that of element 1",
        |cnc, call| if is(call, &[Function::ReadElementLength]) && offset(call) & 0xFFF == 0 {
            cnc.at(call, group(call), offset(call) | 1)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.write-every-channel", &[SDA_9, SDA_1],
        "a write of an element of channel 2 is one of channel 1 too",
        |cnc, call| match (is(call, WRITE), group(call) & 0xFF) {
            (true, 2) => written(cnc, call, group(call) & !0xFF | 1, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.write-every-axis", &[SDA_9, SDA_1],
        "a write of an element of an axis is one of the next axis too",
        |cnc, call| match (is(call, WRITE), class(call).map(|at| at.class)) {
            (true, Some(Class::PathPreparation | Class::PositionController)) => {
                written(cnc, call, group(call), offset(call).wrapping_add(0x1_0000))
            }
            _ => cnc.answer(call),
        }),
    on("cnc.dyn.count-8-bit", &[DYN_1], "of the number of parameters the lowest byte is told",
        &[Function::CountDynamic], |cnc, call| number(cnc.answer(call), 0, |count| count & 0xFF)),
    row("cnc.dyn.names-kept", &[DYN_2], "the name of an index is what it was when it was first asked for",
        |cnc, call| cached(cnc, call, NAME)),
    row("cnc.dyn.values-kept", &[DYN_3, DYN_4],
        "a parameter has the value it had when it was first asked for",
        |cnc, call| cached(cnc, call, VALUES)),
    row("cnc.dyn.names-in-turn", &[DYN_2],
        "names are returned one after the other, whatever the index of the request",
        |cnc, call| {
            let known = is(call, NAME) && cnc.answer(call).is_ok();
            if !known {
                return cnc.answer(call);
            }
            let mut memory = cnc.memory();
            memory.count = memory.count.wrapping_add(1);
            let next = memory.count;
            drop(memory);
            cnc.with(call, &next.to_le_bytes()).or_else(|_| {
                cnc.memory().count = 1;
                cnc.with(call, &[1, 0, 0, 0])
            })
        }),
    row("cnc.dyn.by-name-8-characters", &[DYN_3], "of a name the first 8 characters are looked at",
        |cnc, call| {
            let first = |name: &[u8]| text(name).get(..8).map(<[u8]>::to_vec);
            let (true, Err(_), Some(wanted)) =
                (is(call, BY_NAME), cnc.answer(call), first(call.data))
            else {
                return cnc.answer(call);
            };
            let found = (1_u32..=300).map_while(|index| {
                let at = offset(call).wrapping_sub(1);
                cnc.ask(group(call), at, &index.to_le_bytes()).ok()
            });
            let found = found.into_iter().find(|name| name.starts_with(&wanted));
            cnc.with(call, found.as_deref().unwrap_or(call.data))
        }),
];
