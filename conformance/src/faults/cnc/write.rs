//! Defects in writes of variables (mainly VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, WRITES, after_nul, forgiven, function, group, is, of_decoder, on, row, text,
};

const BY_NAME: &[Function] = &[Function::WriteByName];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.var.write-read-only-accepted", &[VAR_6],
        "a write to a READ_ONLY variable succeeds and changes nothing",
        WRITES, |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_ACCESS)),
    row("cnc.var.write-read-only-done", &[VAR_6],
        "a write by name to a READ_ONLY variable succeeds, and reads by name return the value",
        |cnc, call| {
            let key = (group(call), 0, text(call.data).to_vec());
            match function(call) {
                Some(Function::WriteByName) => match cnc.answer(call) {
                    Err(AdsError::INVALID_ACCESS) => {
                        cnc.memory().store(key, after_nul(call.data).to_vec());
                        Ok(Vec::new())
                    }
                    answer => answer,
                },
                Some(Function::ReadByName) => {
                    let kept = cnc.memory().get(&key);
                    kept.map_or_else(|| cnc.answer(call), Ok)
                }
                _ => cnc.answer(call),
            }
        }),
    row("cnc.var.write-long-accepted", &[VAR_12, VAR_13],
        "the CNC cuts a value that has up to 8 bytes too many, and stores it",
        |cnc, call| match (is(call, WRITES), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_SIZE)) => {
                let mut data = call.data.to_vec();
                for _ in 0..8 {
                    data.pop();
                    if cnc.with(call, &data).is_ok() {
                        return Ok(Vec::new());
                    }
                }
                Err(AdsError::INVALID_SIZE)
            }
            (_, answer) => answer,
        }),
    row("cnc.var.write-big-endian", &[GEN_1, VAR_13],
        "a write by name stores values of up to 8 bytes in reverse byte order",
        |cnc, call| if is(call, BY_NAME) && after_nul(call.data).len() <= 8 {
            let value: Vec<u8> = after_nul(call.data).iter().rev().copied().collect();
            cnc.with(call, &[text(call.data), &[0], &value].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-other-channels", &[VAR_13],
        "a write by name to a variable of channel 2 also changes the variable of channel 6",
        |cnc, call| if is(call, BY_NAME) && group(call) == 0x12_2302 {
            let reply = cnc.answer(call);
            if reply.is_ok() {
                let _ = cnc.at(call, 0x12_2306, super::offset(call));
            }
            reply
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-unended", &[VAR_13],
        "the CNC treats the last 4 bytes of a write by name without a NUL as the value",
        |cnc, call| match of_decoder(call) {
            Some(0x4A) if !call.data.contains(&0) && call.data.len() > 4 => {
                let at = call.data.len().saturating_sub(4);
                let (name, value) = call.data.split_at_checked(at).unwrap_or_default();
                cnc.with(call, &[name, &[0], value].concat())
            }
            _ => cnc.answer(call),
        }),
];
