//! Valid variants that differ in replies, such as in errors, delays, names and the ends of replies.

use std::thread;
use std::time::Duration;

use ads_cnc::ads::{AdsError, Command};
use ads_cnc::operation::Function;
use ads_cnc::service::ServiceVariable;

use super::row::{sent, unprinted};
use crate::faults::cnc::{
    CncDefect, ELEMENT_TEXTS, function, group, is, measured, offset, on, or_short, row, set_u32,
    text, u32_at,
};

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("different.request-over-early", &[],
        "REQUEST_STATE becomes 0 as soon as RESPONSE is written, before RESPONSE_STATE is",
        |cnc, call| {
            let name = ServiceVariable::RESPONSE.as_bytes();
            let reply = cnc.answer(call);
            if reply.is_ok() && is(call, &[Function::WriteByName]) && text(call.data) == name {
                let state = [ServiceVariable::REQUEST_STATE.as_bytes(), &[0; 5]].concat();
                cnc.with(call, &state)?;
            }
            reply
        }),
    row("different.instances-named-alike", &[], "the name of element 0 of an axis is that of its channel",
        |cnc, call| if is(call, &[Function::ReadElementName]) && offset(call) & 0xFFFF == 0 {
            cnc.at(call, group(call), 0).or_else(|_| cnc.answer(call))
        } else {
            cnc.answer(call)
        }),
    sent("different.errors-in-both",
        "errors are both in the AMS header and in the result",
        |_, _, mut bytes| {
            if let Some(error @ 1..) = u32_at(&bytes, 38) {
                set_u32(&mut bytes, 30, error);
            }
            bytes
        }),
    sent("different.slow", "the CNC delays every 128th response by 20 ms", |cnc, _, bytes| {
        let mut memory = cnc.memory();
        memory.count = memory.count.wrapping_add(1);
        if memory.count % 128 == 0 {
            drop(memory);
            thread::sleep(Duration::from_millis(20));
        }
        bytes
    }),
    sent("different.device-silent-of-itself", "ReadDeviceInfo and ReadState are rejected",
        |_, request, mut bytes| {
            let inquiries = [Command::READ_DEVICE_INFO, Command::READ_STATE];
            if inquiries.contains(&request.header().command) {
                bytes.truncate(42);
                set_u32(&mut bytes, 38, AdsError::SERVICE_NOT_SUPPORTED.0);
            }
            measured(bytes)
        }),
    on("different.extended-external-only", &[],
        "the CNC rejects requests for extended descriptions of V.G and V.A",
        &[Function::DescribeExtended], |cnc, call| cnc.answer(call).and_then(|bytes| if bytes.is_empty() {
            Err(AdsError::INVALID_DATA)
        } else {
            Ok(bytes)
        })),
    unprinted(row("different.remains-behind-names", &[],
        "names, types and units in replies have arbitrary bytes after their NUL",
        |cnc, call| match function(call) {
            Some(Function::DescribeByIndex | Function::DynamicNameByIndex) => {
                let remains = |bytes: Vec<u8>| {
                    // Appends the bytes only to short replies, because a reply must not exceed its
                    // maximum length.
                    let room = if is(call, &[Function::DynamicNameByIndex]) { 90 } else { 240 };
                    let remains = if bytes.len() < room { &b"ns\0of"[..] } else { &[] };
                    [&bytes[..], remains].concat()
                };
                or_short(cnc, call, cnc.whole(call).map(remains))
            }
            Some(function) if ELEMENT_TEXTS.contains(&function) => {
                or_short(cnc, call, cnc.whole(call).map(|bytes| [&bytes[..], b"x\0"].concat()))
            }
            _ => cnc.answer(call),
        })),
    unprinted(row("different.texts-end", &[],
        "a read of a STRING variable returns no bytes after the NUL",
        |cnc, call| {
            // The key under which the variant stores the handle of a STRING when it sends a
            // description. The key omits the bit of logical addressing, because a handle is valid
            // with and without it.
            let key = |handle: u32| (group(call) & 0xFF, handle, Vec::new());
            let is_text =
                |bytes: &[u8]| (u32_at(bytes, 4), u32_at(bytes, 16)) == (Some(9), Some(0));
            let answer = cnc.answer(call);
            let text_now = match function(call) {
                Some(Function::DescribeByIndex | Function::DescribeByName) => {
                    if let Ok(bytes) = &answer
                        && is_text(bytes)
                    {
                        cnc.memory().store(key(u32_at(bytes, 0).unwrap_or_default()), Vec::new());
                    }
                    false
                }
                Some(Function::ReadByName) => {
                    cnc.ask(group(call), 0x4C, call.data).is_ok_and(|bytes| is_text(&bytes))
                }
                Some(Function::ReadByHandle) => {
                    let handle = u32_at(call.data, 0).unwrap_or_default();
                    cnc.memory().get(&key(handle)).is_some()
                }
                _ => false,
            };
            answer.map(|mut bytes| {
                if text_now {
                    bytes.truncate(text(&bytes).len() + 1);
                }
                bytes
            })
        })),
];
