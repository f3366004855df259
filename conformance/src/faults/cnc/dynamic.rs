//! Defects of dynamic parameters (DYN).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, group, is, number, of_decoder, offset, on, row, set_u32, text, u32_at, within_length,
};

const COUNT: &[Function] = &[Function::CountDynamic];
const NAME: &[Function] = &[Function::DynamicNameByIndex];
const BY_NAME: &[Function] = &[Function::DynamicValueByName];
const VALUES: &[Function] = &[Function::DynamicValueByName, Function::DynamicValueByIndex];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.dyn.count-one-more", &[DYN_1], "the number of dynamic parameters is one too high",
        COUNT, |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_add(1))),
    row("cnc.dyn.index-0", &[DYN_5], "the CNC treats index 0 of a dynamic parameter as index 1",
        |cnc, call| match (of_decoder(call), call.data) {
            (Some(0x1B..=0x26), [0, 0, 0, 0]) => cnc.with(call, &[1, 0, 0, 0]),
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.by-name-one-character", &[DYN_3],
        "an unknown parameter name addresses the parameter whose name lacks the last character",
        |cnc, call| match (is(call, BY_NAME), cnc.answer(call)) {
            (true, Err(_)) => {
                let name = text(call.data);
                let name = name.split_last().map_or(name, |(_, name)| name);
                cnc.with(call, &[name, &[0]].concat())
            }
            (_, answer) => answer,
        }),
    row("cnc.dyn.name-of-97", &[DYN_6],
        "the CNC cuts a parameter name of more than 96 bytes including NULs, and looks it up",
        |cnc, call| match of_decoder(call) {
            Some(0x1C | 0x1F | 0x22 | 0x25) if call.data.len() > 96 => {
                let name = text(call.data);
                cnc.with(call, &[name.get(..95).unwrap_or(name), &[0]].concat())
            }
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.name-of-32", &[DYN_6],
        "the CNC rejects a read of a parameter by a name of more than 32 bytes including NULs",
        |cnc, call| match of_decoder(call) {
            Some(0x1C | 0x1F | 0x22 | 0x25) if call.data.len() > 32 => Err(AdsError::INVALID_SIZE),
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.p1-value", &[DYN_7], "the value of P1 is 4712 instead of 4711",
        |cnc, call| if is(call, VALUES) && offset(call) < 0x1E {
            cnc.answer(call).map(|bytes| match real(&bytes) {
                4711.0 => 4712_f64.to_le_bytes().to_vec(),
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.dyn.p1-name", &[DYN_2, DYN_7],
        "names of P parameters begin with V. in requests and replies: V.P1 instead of P1",
        |cnc, call| match (is(call, NAME), is(call, BY_NAME), offset(call)) {
            (true, _, 0x1B) => {
                within_length(call, cnc.whole(call).map(|bytes| [b"V.", bytes.as_slice()].concat()))
            }
            (_, true, 0x1C) => match call.data.strip_prefix(b"V.") {
                Some(name) => cnc.with(call, name),
                None => Err(AdsError::SYMBOL_NOT_FOUND),
            },
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.p1-count", &[DYN_7],
        "the number of P parameters is that of P, V.L, V.P and V.S together",
        |cnc, call| if is(call, COUNT) && offset(call) == 2 {
            let mut sum = cnc.answer(call)?;
            for place in 3..=5 {
                let more = cnc.at(call, group(call), place)?;
                let total = u32_at(&sum, 0).unwrap_or_default();
                set_u32(&mut sum, 0, total.wrapping_add(u32_at(&more, 0).unwrap_or_default()));
            }
            Ok(sum)
        } else {
            cnc.answer(call)
        }),
];

fn real(bytes: &[u8]) -> f64 {
    bytes.first_chunk::<8>().map_or(0.0, |bytes| f64::from_le_bytes(*bytes))
}
