//! Defects of the Service Interface (SVC).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc::service::ServiceVariable;
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, ReplyData, Upstream, after_nul, changed, function, group, is, name_in, number,
    offset, on, program, row, text, u32_at, within_length,
};
use crate::simulator::program::Policy;

pub(super) const UUID: &str = ServiceVariable::UUID;
pub(super) const REQUEST: &str = ServiceVariable::REQUEST;
pub(super) const REQUEST_STATE: &str = ServiceVariable::REQUEST_STATE;
pub(super) const RESPONSE_STATE: &str = ServiceVariable::RESPONSE_STATE;
pub(super) const RESPONSE: &str = ServiceVariable::RESPONSE;

/// Whether a call reads the variable with this name by name.
pub(super) fn reads(call: &Call<'_>, name: &str) -> bool {
    is(call, &[Function::ReadByName]) && text(call.data) == name.as_bytes()
}

/// Whether a call writes the variable with this name by name.
pub(super) fn writes(call: &Call<'_>, name: &str) -> bool {
    is(call, &[Function::WriteByName]) && text(call.data) == name.as_bytes()
}

/// Whether the data of a call starts with the name of a variable of the Service Interface.
fn of_service(call: &Call<'_>) -> bool {
    text(call.data).starts_with(b"V.G.SERVICE.")
}

fn key(call: &Call<'_>) -> (u32, u32, Vec<u8>) {
    (group(call) & 0xFF, 0, Vec::new())
}

/// Reads the variable with this name by name.
pub(super) fn read(cnc: &Upstream<'_>, group: u32, name: &str) -> ReplyData {
    cnc.ask(group, 0x48, &[name.as_bytes(), &[0]].concat())
}

fn state(cnc: &Upstream<'_>, call: &Call<'_>, name: &str) -> u32 {
    read(cnc, group(call), name).ok().and_then(|bytes| u32_at(&bytes, 0)).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.svc.missing", &[SVC_1, SVC_11],
        "the CNC rejects the names of the variables of the Service Interface as unknown",
        |cnc, call| if of_service(call) && super::of_decoder(call).is_some() {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.channel-1", &[SVC_1], "all channels share the Service Interface of channel 1",
        |cnc, call| if of_service(call) && super::of_decoder(call).is_some() {
            cnc.at(call, 0x12_2301, offset(call))
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.response-20", &[SVC_1],
        "the CNC stores only the first 20 characters of a RESPONSE",
        |cnc, call| if writes(call, RESPONSE) && after_nul(call.data).len() > 21 {
            let response = after_nul(call.data).get(..20).unwrap_or_default();
            cnc.with(call, &[text(call.data), &[0], response, &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.response-64", &[SVC_1], "the CNC rejects a RESPONSE of more than 64 bytes",
        |cnc, call| if writes(call, RESPONSE) && after_nul(call.data).len() > 64 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.response-129", &[SVC_1],
        "the CNC accepts a RESPONSE of more than 128 bytes and stores its first 127 characters",
        |cnc, call| if writes(call, RESPONSE) && after_nul(call.data).len() > 128 {
            let response = after_nul(call.data).get(..127).unwrap_or_default();
            cnc.with(call, &[text(call.data), &[0], response, &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.request-64", &[SVC_1],
        "a read of REQUEST by name returns only its first 63 characters",
        |cnc, call| if reads(call, REQUEST) {
            changed(cnc, call, |bytes| {
                bytes.truncate(64);
                bytes.iter_mut().skip(63).for_each(|byte| *byte = 0);
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.texts-upper-case", &[SVC_1],
        "a read of REQUEST by name returns its text in upper case",
        |cnc, call| if reads(call, REQUEST) {
            cnc.answer(call).map(|bytes| bytes.to_ascii_uppercase())
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.response-read-empty", &[SVC_1], "a read of RESPONSE by name returns an empty text",
        |cnc, call| if reads(call, RESPONSE) {
            cnc.answer(call).map(|bytes| vec![0; bytes.len()])
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.states-real", &[SVC_1],
        "REQUEST_STATE and RESPONSE_STATE are read as REAL64 instead of UNS32",
        |cnc, call| if reads(call, REQUEST_STATE) || reads(call, RESPONSE_STATE) {
            cnc.answer(call).map(|bytes| {
                f64::from(u32_at(&bytes, 0).unwrap_or_default()).to_le_bytes().to_vec()
            })
        } else {
            cnc.answer(call)
        }),
    on("cnc.svc.types-uns08", &[SVC_1],
        "descriptions of UUID, REQUEST and RESPONSE have the type UNS08 instead of STRING",
        &[Function::DescribeByIndex, Function::DescribeByName],
        |cnc, call| cnc.answer(call).and_then(|bytes| {
            let name = match function(call) {
                Some(Function::DescribeByName) => text(call.data),
                _ => name_in(&bytes),
            };
            if name.starts_with(b"V.G.SERVICE.") && u32_at(&bytes, 4) == Some(9) {
                number(Ok(bytes), 4, |_| 3)
            } else {
                Ok(bytes)
            }
        })),
    row("cnc.svc.read-only", &[SVC_1], "the CNC rejects writes to RESPONSE and RESPONSE_STATE",
        |cnc, call| if writes(call, RESPONSE) || writes(call, RESPONSE_STATE) {
            Err(AdsError::INVALID_ACCESS)
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.uuid-and-request-swapped", &[SVC_1],
        "a read of UUID returns REQUEST, and a read of REQUEST returns UUID",
        |cnc, call| match (reads(call, UUID), reads(call, REQUEST)) {
            (true, _) => read(cnc, group(call), REQUEST),
            (_, true) => read(cnc, group(call), UUID),
            _ => cnc.answer(call),
        }),
    row("cnc.svc.request-state-resets-not", &[SVC_3],
        "a write to REQUEST_STATE does not set RESPONSE_STATE to 0",
        |cnc, call| {
            if reads(call, RESPONSE_STATE)
                && let Some(kept) = cnc.memory().get(&key(call))
            {
                return Ok(kept);
            }
            if writes(call, REQUEST_STATE) {
                let before = read(cnc, group(call), RESPONSE_STATE)?;
                if before.iter().any(|byte| *byte != 0) {
                    cnc.memory().store(key(call), before);
                }
            } else if writes(call, RESPONSE_STATE) {
                cnc.memory().forget();
            }
            cnc.answer(call)
        }),
    row("cnc.svc.request-state-0-resets-not", &[SVC_3],
        "a write to REQUEST_STATE empties RESPONSE instead of setting RESPONSE_STATE to 0",
        |cnc, call| {
            let mut empty = false;
            if writes(call, REQUEST_STATE) {
                let kept = read(cnc, group(call), RESPONSE_STATE)?;
                let mut memory = cnc.memory();
                memory.store(key(call), kept);
                memory.count = 1;
            } else if writes(call, RESPONSE_STATE) || writes(call, RESPONSE) {
                let mut memory = cnc.memory();
                memory.forget();
                memory.count = 0;
            } else {
                empty = cnc.memory().count == 1;
            }
            match (reads(call, RESPONSE_STATE), reads(call, RESPONSE)) {
                (true, _) => cnc.memory().get(&key(call)).map_or_else(|| cnc.answer(call), Ok),
                (_, true) if empty => cnc.answer(call).map(|bytes| vec![0; bytes.len()]),
                _ => cnc.answer(call),
            }
        }),
    row("cnc.svc.request-state-stays", &[SVC_4],
        "REQUEST_STATE does not become 0 when the service writes RESPONSE_STATE",
        |cnc, call| {
            if reads(call, REQUEST_STATE)
                && let Some(kept) = cnc.memory().get(&key(call))
            {
                return within_length(call, Ok(kept));
            }
            if writes(call, RESPONSE_STATE) {
                let before = read(cnc, group(call), REQUEST_STATE)?;
                cnc.memory().store(key(call), before);
            } else if writes(call, REQUEST_STATE) {
                cnc.memory().forget();
            }
            cnc.answer(call)
        }),
    row("cnc.svc.request-cleared", &[SVC_1, SVC_2],
        "a read of REQUEST returns an empty text while REQUEST_STATE is not 0",
        |cnc, call| if reads(call, REQUEST) && state(cnc, call, REQUEST_STATE) != 0 {
            cnc.answer(call).map(|bytes| vec![0; bytes.len()])
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.request-state-1", &[SVC_1],
        "a read of REQUEST_STATE returns 1 for every value other than 0",
        |cnc, call| if reads(call, REQUEST_STATE) {
            number(cnc.answer(call), 0, |state| state.min(1))
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.response-state-8-bit", &[SVC_1],
        "a read of RESPONSE_STATE returns only its lowest byte",
        |cnc, call| if reads(call, RESPONSE_STATE) {
            number(cnc.answer(call), 0, |state| state & 0xFF)
        } else {
            cnc.answer(call)
        }),
    row("cnc.svc.by-other-names", &[SVC_1],
        "the variables of the Service Interface are called V.G.SERVICE_UUID and so on",
        |cnc, call| {
            let name = text(call.data);
            match name.strip_prefix(b"V.G.SERVICE_") {
                Some(rest) => {
                    let data = [b"V.G.SERVICE.", rest, &[0], after_nul(call.data)].concat();
                    cnc.with(call, &data)
                }
                None if of_service(call) => Err(AdsError::SYMBOL_NOT_FOUND),
                None => cnc.answer(call),
            }
        }),
    program("cnc.svc.program-waits-not", &[SVC_6],
        "the NC program reads RESPONSE without waiting for RESPONSE_STATE",
        Policy { awaits_response: false, ..Policy::DEFAULT }),
    program("cnc.svc.program-state-first", &[SVC_12],
        "the NC program also writes REQUEST_STATE before UUID and REQUEST",
        Policy { state_first: true, ..Policy::DEFAULT }),
    program("cnc.svc.program-waits-for-ever", &[SVC_8],
        "the cycle SysServiceWait does not stop waiting after the time @P2",
        Policy { times_out: false, ..Policy::DEFAULT }),
];
