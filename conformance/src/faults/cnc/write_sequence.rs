//! Defects of writes, such as those that depend on earlier writes or that execute only a part of a
//! write, and of the read of REQUEST by handle.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::lookup::{handle_of, instance, object_is, one, over};
use super::service::{REQUEST, REQUEST_STATE, RESPONSE, RESPONSE_STATE, read, reads, writes};
use super::{
    CncDefect, ReplyData, Upstream, after_nul, changed, function, group, is, offset, on, row, text,
    u32_at,
};
use crate::simulator::program::lines;

const BY_NAME: &[Function] = &[Function::WriteByName];
const STREAM: &[Function] = &[Function::WriteProgramStream];

/// If `now`, the call is a write of REQUEST_STATE, which sets RESPONSE_STATE to 0: stores
/// RESPONSE_STATE, unless a value is stored, and executes the write. If not `now`, answers a read
/// of RESPONSE_STATE with the stored value, if any, and any other call correctly.
fn keep_response_state(cnc: &Upstream<'_>, call: &Call<'_>, now: bool) -> ReplyData {
    let key = (instance(call), 0x5C, Vec::new());
    if now {
        let before = read(cnc, group(call), RESPONSE_STATE)?;
        let known = cnc.memory().get(&key).unwrap_or(before);
        cnc.memory().store(key, known);
        return cnc.answer(call);
    }
    if reads(call, RESPONSE_STATE) {
        let kept = cnc.memory().get(&key);
        return kept.map_or_else(|| cnc.answer(call), Ok);
    }
    cnc.answer(call)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.com.string-runs-on", &[COM_5],
        "a shorter text that is written to a STRING object keeps the rest of the old text",
        |cnc, call| if is(call, &[Function::WriteObject]) && object_is(cnc, call, b"STRING") {
            let old = cnc.read(call.port, group(call), offset(call)).unwrap_or_default();
            let new = over(text(call.data), text(&old));
            cnc.with(call, &[&new[..], &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.refused-write-done", &[COM_5],
        "the CNC rejects a write of too few bytes to an object, but stores these bytes",
        |cnc, call| match (is(call, &[Function::WriteObject]), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) => {
                let old = cnc.read(call.port, group(call), offset(call)).unwrap_or_default();
                if old.len() > call.data.len() {
                    let _ = cnc.with(call, &over(call.data, &old));
                }
                Err(AdsError::INVALID_SIZE)
            }
            (_, answer) => answer,
        }),
    on("cnc.sda.written-once", &[SDA_9],
        "the CNC rejects every write to an element after the first successful one",
        &[Function::WriteElement], |cnc, call| {
            let key = (group(call), offset(call), Vec::new());
            if cnc.memory().get(&key).is_some() {
                return Err(AdsError::INVALID_ACCESS);
            }
            let reply = cnc.answer(call)?;
            cnc.memory().store(key, Vec::new());
            Ok(reply)
        }),
    row("cnc.sda.blank-written", &[SDA_11],
        "a write at an axis index without an axis succeeds, and its content is read from then on",
        |cnc, call| {
            let key = (group(call), offset(call), Vec::new());
            match (function(call), cnc.answer(call)) {
                (Some(Function::WriteElement), Err(AdsError::INVALID_DATA)) => {
                    cnc.memory().store(key, call.data.to_vec());
                    Ok(Vec::new())
                }
                (Some(Function::ReadElement), Ok(bytes)) => {
                    let blank = bytes.iter().all(|byte| *byte == 0);
                    let kept =
                        cnc.memory().get(&key).filter(|kept| blank && kept.len() == bytes.len());
                    Ok(kept.unwrap_or(bytes))
                }
                (_, answer) => answer,
            }
        }),
    on("cnc.var.write-after-error", &[VAR_13],
        "after a rejected write by name, the next write by name succeeds and changes nothing",
        BY_NAME, |cnc, call| {
            if std::mem::take(&mut cnc.memory().count) == 1 {
                return Ok(Vec::new());
            }
            let reply = cnc.answer(call);
            cnc.memory().count = u32::from(reply.is_err());
            reply
        }),
    on("cnc.stm.same-ignored", &[STM_4, STM_15],
        "the CNC acknowledges and discards a packet that equals the previous one of the channel",
        STREAM, |cnc, call| {
            if cnc.memory().get(&one(instance(call))).as_deref() == Some(call.data) {
                return Ok(Vec::new());
            }
            let reply = cnc.answer(call)?;
            cnc.memory().store(one(instance(call)), call.data.to_vec());
            Ok(reply)
        }),
    on("cnc.stm.again-lost", &[STM_6],
        "after a temporarily rejected stream write, the CNC acknowledges and discards the next one",
        STREAM, |cnc, call| {
            if std::mem::take(&mut cnc.memory().count) == 1 {
                return Ok(Vec::new());
            }
            let reply = cnc.answer(call);
            cnc.memory().count = u32::from(reply == Err(AdsError::INVALID_DATA));
            reply
        }),
    row("cnc.stm.full-in-part", &[STM_6],
        "the CNC temporarily rejects a stream write that does not fit, but takes its first line",
        |cnc, call| match (is(call, STREAM), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_DATA)) => {
                let _ = cnc.with(call, lines(call.data).next().unwrap_or_default());
                Err(AdsError::INVALID_DATA)
            }
            (_, answer) => answer,
        }),
    on("cnc.stm.behind-end-lost", &[STM_10],
        "the CNC acknowledges and discards the packet after a packet with M30",
        STREAM, |cnc, call| {
            if std::mem::take(&mut cnc.memory().count) == 1 {
                return Ok(Vec::new());
            }
            let reply = cnc.answer(call)?;
            let ends = call.data.windows(3).any(|part| part == b"M30");
            cnc.memory().count = u32::from(ends);
            Ok(reply)
        }),
    row("cnc.svc.resets-once", &[SVC_3],
        "only the first write to REQUEST_STATE in a channel sets RESPONSE_STATE to 0",
        |cnc, call| if writes(call, REQUEST_STATE) {
            let key = (instance(call), 0x5D, Vec::new());
            let other = cnc.memory().get(&key).is_some();
            if other {
                return keep_response_state(cnc, call, true);
            }
            cnc.memory().store(key, Vec::new());
            cnc.answer(call)
        } else if writes(call, RESPONSE_STATE) {
            let (stay, once) =
                ((instance(call), 0x5C, Vec::new()), (instance(call), 0x5D, Vec::new()));
            let mut memory = cnc.memory();
            let known = memory.get(&once).is_some();
            let others = memory.get(&stay).is_some();
            if others {
                memory.forget();
            }
            if known {
                memory.store(once, Vec::new());
            }
            drop(memory);
            cnc.answer(call)
        } else {
            keep_response_state(cnc, call, false)
        }),
    row("cnc.svc.response-runs-on", &[SVC_1, SVC_5],
        "a RESPONSE shorter than the previous one is followed by the rest of the previous one",
        |cnc, call| if writes(call, RESPONSE) {
            let old = read(cnc, group(call), RESPONSE)?;
            let new = over(text(after_nul(call.data)), text(&old));
            cnc.with(call, &[RESPONSE.as_bytes(), &[0], &new, &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.finished-everywhere", &[SVC_4, SVC_1],
        "a write to RESPONSE_STATE in one channel sets REQUEST_STATE to 0 in all channels",
        |cnc, call| {
            let reply = cnc.answer(call)?;
            if writes(call, RESPONSE_STATE) {
                let state = [REQUEST_STATE.as_bytes(), &[0; 5]].concat();
                for channel in cnc.channels() {
                    let other = 0x12_2300 | u32::from(channel);
                    let asks = read(cnc, other, REQUEST_STATE)
                        .is_ok_and(|bytes| bytes.iter().any(|byte| *byte != 0));
                    if other & 0xFF != instance(call) && asks {
                        let _ = cnc.at(&Call { data: &state, ..*call }, other, offset(call));
                    }
                }
            }
            Ok(reply)
        }),
    on("cnc.svc.request-by-handle-20", &[SVC_1],
        "a read of REQUEST by handle returns only its first 20 characters",
        &[Function::ReadByHandle],
        |cnc, call| if u32_at(call.data, 0) == handle_of(cnc, group(call), REQUEST) {
            changed(cnc, call, |bytes| bytes.iter_mut().skip(20).for_each(|byte| *byte = 0))
        } else {
            cnc.answer(call)
        }),
];
