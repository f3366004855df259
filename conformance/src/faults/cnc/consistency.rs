//! Defects of elements and of dynamic parameters, many of which show only if replies to different
//! requests are compared (SDA, DYN).

use ads_cnc::address::Class;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::instance::with_instance;
use super::{
    CncDefect, Key, ReplyData, Upstream, absent, class, group, is, number, offset, on, row, text,
    within_length,
};

const WRITE: &[Function] = &[Function::WriteElement];
const NAME: &[Function] = &[Function::DynamicNameByIndex];
const BY_NAME: &[Function] = &[Function::DynamicValueByName];
const VALUES: &[Function] = &[Function::DynamicValueByName, Function::DynamicValueByIndex];

/// Answers a request for one of the functions `of` with the first successful reply to the same
/// request.
pub(super) fn cached(cnc: &Upstream<'_>, call: &Call<'_>, of: &[Function]) -> ReplyData {
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

/// Executes a write and, if it succeeds, the same write at another address. The result of the
/// second write is ignored.
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
        "the object address for every channel above 1 is that for channel 1",
        |cnc, call| with_instance(cnc, call, |channel, axis| (channel.min(1), axis))),
    row("cnc.sda.address-of-channel", &[SDA_1],
        "object addresses of axes of interpolator, decoder and path preparation are those of the \
         channel",
        |cnc, call| match group(call) & 0xF000 {
            0x1000 | 0x2000 | 0x4000 => with_instance(cnc, call, |channel, _| (channel, 0)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.interpolator-no-axes", &[SDA_5],
        "axes of the interpolator are not found, those of the decoder are",
        |cnc, call| absent(cnc, call, |class, _, axis| class == 0x1000 && axis > 0)),
    row("cnc.sda.decoder-one-axis", &[SDA_5],
        "the CNC finds only the first axis of each channel in the decoder",
        |cnc, call| absent(cnc, call, |class, _, axis| class == 0x2000 && axis > 1)),
    row("cnc.sda.axis-24-bit", &[SDA_5, SDA_2],
        "the CNC uses only the lowest 24 bits of the axis in a request for an object address",
        |cnc, call| with_instance(cnc, call, |channel, axis| (channel, axis & 0xFF_FFFF))),
    row("cnc.sda.first-length", &[SDA_8], "the length of element 0 is that of element 1",
        |cnc, call| if is(call, &[Function::ReadElementLength]) && offset(call) & 0xFFF == 0 {
            cnc.at(call, group(call), offset(call) | 1)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.write-every-channel", &[SDA_9, SDA_1],
        "a write to an element of channel 2 also changes the element of channel 1",
        |cnc, call| match (is(call, WRITE), group(call) & 0xFF) {
            (true, 2) => written(cnc, call, group(call) & !0xFF | 1, offset(call)),
            _ => cnc.answer(call),
        }),
    row("cnc.sda.write-every-axis", &[SDA_9, SDA_1],
        "a write to an axis in position controller or path preparation also changes the next axis",
        |cnc, call| match (is(call, WRITE), class(call).map(|at| at.class)) {
            (true, Some(Class::PathPreparation | Class::PositionController)) => {
                written(cnc, call, group(call), offset(call).wrapping_add(0x1_0000))
            }
            _ => cnc.answer(call),
        }),
    on("cnc.dyn.count-8-bit", &[DYN_1],
        "the number of dynamic parameters has only its lowest 8 bits: 257 is 1",
        &[Function::CountDynamic], |cnc, call| number(cnc.answer(call), 0, |count| count & 0xFF)),
    row("cnc.dyn.names-kept", &[DYN_2],
        "a read of a parameter's name always returns the first name that the index had",
        |cnc, call| cached(cnc, call, NAME)),
    row("cnc.dyn.values-kept", &[DYN_3, DYN_4],
        "a read of a parameter always returns the value of the first read by this name or index",
        |cnc, call| cached(cnc, call, VALUES)),
    row("cnc.dyn.names-in-turn", &[DYN_2],
        "names of parameters are returned one after the other, whatever the requested index",
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
    row("cnc.dyn.by-name-8-characters", &[DYN_3],
        "an unknown parameter name addresses a parameter with the same first 8 characters",
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
