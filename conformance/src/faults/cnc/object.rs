//! Defects in the contents of objects (mainly COM).

use ads_cnc::address::{Access, ComGroup, ComTable};
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::com::{each, is_named, set};
use super::{CncDefect, LOGICAL, at, changed, com_group, forgiven, group, is, offset, on, row};

const READ: &[Function] = &[Function::ReadObject];
const WRITE: &[Function] = &[Function::WriteObject];

/// The key of an address in the defect's memory, with the bit of logical addressing always set.
fn key(call: &Call<'_>) -> (u32, u32, Vec<u8>) {
    (group(call) | LOGICAL, offset(call), Vec::new())
}

fn content(call: &Call<'_>) -> Option<ComGroup> {
    com_group(call).filter(|com| com.access == Access::Element)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.com.content-big-endian", &[GEN_1, COM_5],
        "contents of objects of up to 8 bytes have the most significant byte first",
        |cnc, call| match (is(call, READ), is(call, WRITE)) {
            (true, _) => changed(cnc, call, |bytes| {
                if bytes.len() <= 8 {
                    bytes.reverse();
                }
            }),
            (_, true) if call.data.len() <= 8 => {
                let data: Vec<u8> = call.data.iter().rev().copied().collect();
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.com.content-of-channel-1", &[COM_5],
        "the CNC reads and writes the objects of every channel in channel 1",
        |cnc, call| match content(call) {
            Some(com) if com.table == ComTable::Channel && com.instance > 1 => {
                cnc.at(call, 0x12_0101, offset(call))
            }
            _ => cnc.answer(call),
        }),
    on("cnc.com.write-read-only-accepted", &[COM_2],
        "a write to a read-only object succeeds and changes nothing",
        WRITE, |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_ACCESS)),
    row("cnc.com.write-read-only-done", &[COM_2],
        "a write to a read-only object succeeds, and the written value is read from then on",
        |cnc, call| {
            if let Some(kept) = cnc.memory().get(&key(call))
                && is(call, READ)
            {
                return Ok(kept);
            }
            match (is(call, WRITE), cnc.answer(call)) {
                (true, Err(AdsError::INVALID_ACCESS)) => {
                    cnc.memory().store(key(call), call.data.to_vec());
                    Ok(Vec::new())
                }
                (_, answer) => answer,
            }
        }),
    row("cnc.com.write-two", &[COM_5],
        "a write to an object with an axis in its index offset also changes that of axes 1 to 3",
        |cnc, call| if is(call, WRITE) && offset(call) >= 0x1_0000 && offset(call) & 0xFFFF != 3 {
            let reply = cnc.answer(call);
            if reply.is_ok() {
                for axis in 1..=3 {
                    let _ = cnc.at(call, group(call), offset(call) & 0xFFFF | axis << 16);
                }
            }
            reply
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.write-bit", &[COM_5],
        "a write to an object of 1 byte stores 0 for any value other than 0, and 1 for 0",
        |cnc, call| if is(call, WRITE) && call.data.len() == 1 {
            let data: Vec<u8> = call.data.iter().map(|byte| u8::from(*byte == 0)).collect();
            cnc.with(call, &data)
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.axis-not-in-offset", &[COM_6],
        "the CNC rejects a platform axis in the offset, as in (0x120200, 0x10001)",
        |cnc, call| match content(call) {
            Some(com) if com.table == ComTable::Axis && com.instance == 0 => {
                Err(AdsError::INVALID_OFFSET)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.com.command-elsewhere", &[COM_6],
        "mc_command_single_block_w is at offset 0x2 instead of 0x1, as its descriptor states",
        |cnc, call| match (content(call), offset(call)) {
            (Some(com), 1) if com.table == ComTable::Channel => Err(AdsError::INVALID_OFFSET),
            (Some(com), 2) if com.table == ComTable::Channel && com.instance > 0 => {
                cnc.at(call, group(call), 1)
            }
            _ => each(cnc, call, |record| if is_named(record, b"mc_command_single") {
                set(record, 16, &[2]);
            }),
        }),
    row("cnc.com.platform-elsewhere", &[COM_6],
        "the platform content at offset 0x251 is in group 0x120200 instead of 0x120100",
        |cnc, call| match (group(call) & !LOGICAL, offset(call)) {
            (0x02_0100 | 0x02_0101, 0x251) => Err(AdsError::INVALID_OFFSET),
            (0x02_0200, 0x251) => cnc.answer(&at(call, 0x12_0100, 0x251)),
            _ => cnc.answer(call),
        }),
];
