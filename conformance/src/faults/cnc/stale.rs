//! Defects of elements, parameters, variables and ADS services, many of which depend on earlier
//! requests or occur in replies to rejected requests.

use ads_cnc::ads::{AdsError, Command};
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::frame::{INVOKE_ID, LENGTH, RESULT, SOURCE, TARGET, sent, set};
use super::handle::{joined, parts};
use super::lookup::{instance, one, over};
use super::{
    CncDefect, ReplyData, Upstream, frame, function, group, is, offset, on, row, text, u32_at,
    within_length,
};

const FIND: &[Function] = &[Function::FindInstance];
const UNIT: &[Function] = &[Function::ReadElementUnit];
const COUNT: &[Function] = &[Function::CountDynamic];
const NAME: &[Function] = &[Function::DynamicNameByIndex];
const BY_INDEX: &[Function] = &[Function::DynamicValueByIndex];

/// Number of handles in the table of `slots`.
const SLOTS: u32 = 16;

/// Stores handles requested by name in a table of `SLOTS` entries. In a full table, a new handle
/// replaces the oldest, and a request with the replaced handle then addresses the variable of the
/// new handle.
fn slots(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let gone = |handle: u32| (0x5106, handle, vec![u8::try_from(instance(call)).unwrap_or(0)]);
    match function(call) {
        Some(Function::HandleByName) => {
            let answer = cnc.answer(call)?;
            let handle = u32_at(&answer, 0).unwrap_or_default();
            let mut memory = cnc.memory();
            let known = (0..SLOTS)
                .any(|slot| memory.get(&(0x5107, slot, Vec::new())).as_ref() == Some(&answer));
            if !known {
                let slot = (0x5107, memory.count % SLOTS, Vec::new());
                if let Some(old) = memory.get(&slot).and_then(|old| u32_at(&old, 0)) {
                    memory.store(gone(old), answer.clone());
                }
                memory.store(gone(handle), answer.clone());
                memory.store(slot, answer.clone());
                memory.count = memory.count.wrapping_add(1);
            }
            Ok(answer)
        }
        Some(Function::ReadByHandle | Function::WriteByHandle) => {
            let Some((handle, indices, value)) = parts(call.data) else { return cnc.answer(call) };
            let now = cnc.memory().get(&gone(handle)).and_then(|now| u32_at(&now, 0));
            cnc.with(call, &joined(now.unwrap_or(handle), &indices, value))
        }
        _ => cnc.answer(call),
    }
}

/// Whether the axis index in the offset has an axis; `None` for calls that do not address the
/// content of an axis of interpolator, decoder or path preparation by the channel's number.
fn occupied(cnc: &Upstream<'_>, call: &Call<'_>) -> Option<bool> {
    let channel = u8::try_from(instance(call)).ok()?;
    let place = u8::try_from(offset(call) >> 16).ok().filter(|place| *place > 0)?;
    let of_place = matches!(group(call) & 0xFFFF_FF00, 0x12_1300 | 0x12_2300 | 0x12_4300);
    of_place.then(|| cnc.cnc.axis_at(channel, place) != 0)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.sda.unit-runs-on", &[SDA_6],
        "a unit that is shorter than the unit read before is followed by the rest of that unit",
        UNIT, |cnc, call| {
            let unit = cnc.whole(call)?;
            let before = cnc.memory().get(&one(1)).unwrap_or_default();
            let unit = over(text(&unit), &before);
            cnc.memory().store(one(1), unit.clone());
            within_length(call, Ok([&unit[..], &[0]].concat()))
        }),
    row("cnc.sda.absent-as-before", &[SDA_2],
        "the object address of an instance that does not exist is the last one that was found",
        |cnc, call| {
            let answer = cnc.answer(call)?;
            match (is(call, FIND), answer.iter().all(|byte| *byte == 0)) {
                (true, true) => Ok(cnc.memory().get(&one(1)).unwrap_or(answer)),
                (true, false) => {
                    cnc.memory().store(one(1), answer.clone());
                    Ok(answer)
                }
                _ => Ok(answer),
            }
        }),
    row("cnc.sda.blank-remains", &[SDA_11],
        "an axis index that its axis has left keeps the contents that were read there last",
        |cnc, call| match (is(call, &[Function::ReadElement]), occupied(cnc, call)) {
            (true, Some(true)) => {
                let bytes = cnc.answer(call)?;
                cnc.memory().store((group(call), offset(call), Vec::new()), bytes.clone());
                Ok(bytes)
            }
            (true, Some(false)) => {
                let kept = cnc.memory().get(&(group(call), offset(call), Vec::new()));
                kept.map_or_else(|| cnc.answer(call), Ok)
            }
            _ => cnc.answer(call),
        }),
    on("cnc.dyn.count-never-falls", &[DYN_1],
        "the number of dynamic parameters does not decrease when parameters are deleted",
        COUNT, |cnc, call| {
            let now = cnc.answer(call)?;
            let key = (group(call) & 0xFF, offset(call), Vec::new());
            let most = cnc.memory().get(&key).filter(|most| u32_at(most, 0) > u32_at(&now, 0));
            let most = most.unwrap_or(now);
            cnc.memory().store(key, most.clone());
            Ok(most)
        }),
    on("cnc.dyn.index-remembered", &[DYN_4],
        "a value by index is always that of the parameter that had the index at the first read",
        BY_INDEX, |cnc, call| {
            let key = (group(call) & 0xFF, offset(call), call.data.to_vec());
            let known = cnc.memory().get(&key);
            let name = match known {
                Some(name) => name,
                None => cnc.ask(group(call), offset(call).wrapping_sub(2), call.data)?,
            };
            cnc.memory().store(key, name.clone());
            let at = offset(call).wrapping_sub(1);
            cnc.at(&Call { data: &name, ..*call }, group(call), at)
        }),
    on("cnc.dyn.name-after-error", &[DYN_2],
        "after a rejected index, the next request for a name returns that of parameter 1",
        NAME, |cnc, call| {
            let answer = cnc.answer(call);
            let before = std::mem::replace(&mut cnc.memory().count, u32::from(answer.is_err()));
            match answer {
                Ok(_) if before == 1 => cnc.with(call, &[1, 0, 0, 0]),
                answer => answer,
            }
        }),
    on("cnc.var.extended-remains", &[VAR_16],
        "the extended description of V.G and V.A is that of the V.E variable that was read last",
        &[Function::DescribeExtended], |cnc, call| {
            let bytes = cnc.answer(call)?;
            if !bytes.is_empty() {
                cnc.memory().store(one(1), bytes.clone());
            }
            let kept = cnc.memory().get(&one(1)).unwrap_or_default();
            within_length(call, Ok(kept))
        }),
    row("cnc.var.handle-slots", &[VAR_10],
        "the CNC keeps 16 handles by name: one more replaces the oldest, which then addresses the \
         new variable",
        slots),
    row("cnc.var.handle-channel-of-last", &[VAR_10, VAR_11],
        "a read by handle uses the channel in which a handle was last requested by name",
        |cnc, call| match function(call) {
            Some(Function::HandleByName) => {
                cnc.memory().count = instance(call);
                cnc.answer(call)
            }
            Some(Function::ReadByHandle) => {
                let channel = cnc.memory().count;
                let at = if channel == 0 { group(call) } else { group(call) & !0xFF | channel };
                cnc.at(call, at, offset(call))
            }
            _ => cnc.answer(call),
        }),
    sent("cnc.ads.target-of-first", &[ADS_5],
        "the target address of every response is that of the client that sent the first request",
        |cnc, _, bytes| {
            let source = bytes.get(TARGET..SOURCE).unwrap_or_default().to_vec();
            let mut memory = cnc.memory();
            if memory.frame.is_empty() {
                memory.frame = source;
            }
            let first = memory.frame.clone();
            set(bytes, TARGET, &first)
        }),
    sent("cnc.ads.result-stays", &[ADS_2, ADS_4],
        "a Write directly after a rejected request is executed, but returns the same error number",
        |cnc, request, bytes| {
            let result = u32_at(&bytes, RESULT).unwrap_or_default();
            let mut memory = cnc.memory();
            match (frame::is(request, &[Command::WRITE]), result) {
                (true, 0) => {
                    let before = std::mem::take(&mut memory.count);
                    set(bytes, RESULT, &before.to_le_bytes())
                }
                _ => {
                    memory.count = result;
                    bytes
                }
            }
        }),
    sent("cnc.ads.refused-invoke-id-0", &[ADS_5],
        "the invoke ID of a response with an error as the result is 0",
        |_, _, bytes| match u32_at(&bytes, RESULT) {
            Some(1..) => set(bytes, INVOKE_ID, &[0; 4]),
            _ => bytes,
        }),
    sent("cnc.ads.refused-data-length", &[ADS_5],
        "the AMS header of a rejected Read or ReadWrite states a data length of 4 instead of 8",
        |_, request, bytes| match u32_at(&bytes, RESULT) {
            Some(1..) if !frame::is(request, &[Command::WRITE]) && bytes.len() > LENGTH => {
                set(bytes, frame::DATA_LENGTH, &[4, 0, 0, 0])
            }
            _ => bytes,
        }),
    row("cnc.ads.read-length-16-bit-wide", &[ADS_1, ADS_3, ADS_4],
        "the CNC uses only the lowest 16 bits of the read length: 0x10002 is 2",
        |cnc, call| cnc.answer(&Call { read_length: call.read_length & 0xFFFF, ..*call })),
    row("cnc.sda.found-not-read", &[SDA_5, ADR_7],
        "the CNC finds all axes in the position controller, but rejects access to those above 3",
        |cnc, call| match group(call) & 0xFF_FFFF {
            0x12_0300..=0x12_08FF if offset(call) >= 0x4_0000 => Err(AdsError::INVALID_OFFSET),
            _ => cnc.answer(call),
        }),
];
