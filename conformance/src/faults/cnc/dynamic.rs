//! Dynamic parameters (DYN).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncSeed, ReplyData, Upstream, group, is, number, of_decoder, offset, on, row, set_u32, text,
    u32_at, within_length,
};

const COUNT: &[Function] = &[Function::CountDynamic];
const NAME: &[Function] = &[Function::DynamicNameByIndex];
const BY_NAME: &[Function] = &[Function::DynamicValueByName];
const BY_INDEX: &[Function] = &[Function::DynamicValueByIndex];
const INDEXED: &[Function] = &[Function::DynamicNameByIndex, Function::DynamicValueByIndex];
const VALUES: &[Function] = &[Function::DynamicValueByName, Function::DynamicValueByIndex];

/// Changes the index of the request.
fn index(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    of: &[Function],
    other: impl FnOnce(u32) -> u32,
) -> ReplyData {
    match (is(call, of), u32_at(call.data, 0)) {
        (true, Some(index)) => cnc.with(call, &other(index).to_le_bytes()),
        _ => cnc.answer(call),
    }
}

/// The number of parameters of the requested kind.
fn count(cnc: &Upstream<'_>, call: &Call<'_>) -> u32 {
    let place = match offset(call) {
        0x1B..=0x1D => 2,
        0x1E..=0x20 => 3,
        0x21..=0x23 => 4,
        _ => 5,
    };
    let count = cnc.read(call.port, group(call), place);
    count.ok().and_then(|count| u32_at(&count, 0)).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    on("cnc.dyn.count-one-more", &[DYN_1], "numbers of parameters are one more",
        COUNT, |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_add(1))),
    on("cnc.dyn.count-highest-index", &[DYN_1],
        "numbers of parameters are one less, as if the index ran from 0",
        COUNT, |cnc, call| number(cnc.answer(call), 0, |count| count.saturating_sub(1))),
    row("cnc.dyn.count-kinds-swapped", &[DYN_1], "the number of V.L is at 0x04, that of V.P at 0x03",
        |cnc, call| match (is(call, COUNT), offset(call)) {
            (true, 3) => cnc.at(call, group(call), 4),
            (true, 4) => cnc.at(call, group(call), 3),
            _ => cnc.answer(call),
        }),
    on("cnc.dyn.count-p", &[DYN_1], "the number is that of P, whichever kind is asked",
        COUNT, |cnc, call| cnc.at(call, group(call), 2)),
    on("cnc.dyn.count-refused", &[DYN_1], "the number takes a ReadWrite with no data",
        COUNT, |_, _| Err(AdsError::SERVICE_NOT_SUPPORTED)),
    on("cnc.dyn.names-of-channel-1", &[DYN_1], "the numbers of parameters are those of channel 1",
        COUNT, |cnc, call| cnc.at(call, 0x12_2301, offset(call))),
    row("cnc.dyn.name-from-0", &[DYN_5], "names are counted from 0",
        |cnc, call| index(cnc, call, NAME, |index| index.wrapping_add(1))),
    row("cnc.dyn.value-from-0", &[DYN_5, DYN_4], "values by index are counted from 0",
        |cnc, call| index(cnc, call, BY_INDEX, |index| index.wrapping_add(1))),
    row("cnc.dyn.index-0", &[DYN_5], "index 0 is taken for 1",
        |cnc, call| match (of_decoder(call), call.data) {
            (Some(0x1B..=0x26), [0, 0, 0, 0]) => cnc.with(call, &[1, 0, 0, 0]),
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.index-beyond", &[DYN_5], "an index behind the last is taken for the last",
        |cnc, call| index(cnc, call, INDEXED, |index| index.min(count(cnc, call).max(1)))),
    row("cnc.dyn.index-beyond-empty", &[DYN_5], "behind the last there is an empty name and the value 0",
        |cnc, call| match (is(call, NAME), is(call, BY_INDEX), cnc.answer(call)) {
            (true, _, Err(AdsError::INVALID_DATA)) => Ok(vec![0]),
            (_, true, Err(AdsError::INVALID_DATA)) => Ok(vec![0; 8]),
            (.., answer) => answer,
        }),
    row("cnc.dyn.index-8-bit", &[DYN_5], "of an index the lowest byte counts",
        |cnc, call| index(cnc, call, INDEXED, |index| index & 0xFF)),
    row("cnc.dyn.name-of-first", &[DYN_2], "every name is that of the first parameter",
        |cnc, call| index(cnc, call, NAME, |index| index.min(1))),
    row("cnc.dyn.name-kinds-swapped", &[DYN_2], "names of V.P are at 0x24, those of V.S at 0x21",
        |cnc, call| match (is(call, NAME), offset(call)) {
            (true, 0x21) => cnc.at(call, group(call), 0x24),
            (true, 0x24) => cnc.at(call, group(call), 0x21),
            _ => cnc.answer(call),
        }),
    on("cnc.dyn.name-empty", &[DYN_2], "names are empty",
        NAME, |cnc, call| cnc.answer(call).map(|_| vec![0])),
    on("cnc.dyn.name-without-kind", &[DYN_2, DYN_3],
        "names come without V.L, V.P, V.S, and are not found as they come",
        NAME, |cnc, call| cnc.answer(call).map(|mut bytes| {
            if bytes.starts_with(b"V.") {
                bytes.drain(..4.min(bytes.len()));
            }
            bytes
        })),
    on("cnc.dyn.name-256", &[DYN_2, DYN_6], "names are padded to 256 bytes",
        NAME, |cnc, call| within_length(
            call,
            cnc.whole(call).map(|mut bytes| {
                bytes.resize(256, 0);
                bytes
            }),
        )),
    on("cnc.dyn.name-index-first", &[DYN_2], "the index is repeated in front of the name",
        NAME, |cnc, call| within_length(call, cnc.whole(call).map(|bytes| [call.data, &bytes].concat()))),
    on("cnc.dyn.name-upper-case", &[DYN_2, DYN_3], "names are told in upper case, and not found so",
        NAME, |cnc, call| cnc.answer(call).map(|bytes| bytes.to_ascii_uppercase())),
    on("cnc.dyn.by-name-first", &[DYN_3],
        "the value by name is that of the first parameter, whatever the name",
        BY_NAME, |cnc, call| {
            cnc.answer(call)?;
            cnc.answer(&Call {
                data: &[1, 0, 0, 0],
                ..super::at(call, group(call), offset(call).wrapping_add(1))
            })
        }),
    row("cnc.dyn.by-name-unknown", &[DYN_3], "a name that is not there has the value 0",
        |cnc, call| match (is(call, BY_NAME), cnc.answer(call)) {
            (true, Err(_)) => Ok(vec![0; 8]),
            (_, answer) => answer,
        }),
    on("cnc.dyn.by-name-4-bytes", &[DYN_3], "the value by name is a REAL32",
        BY_NAME, |cnc, call| cnc.answer(call).map(|bytes| narrow(&bytes))),
    on("cnc.dyn.by-name-text", &[DYN_3], "the value by name is a text",
        BY_NAME, |cnc, call| cnc.answer(call).map(|bytes| {
            let mut text = real(&bytes).to_string().into_bytes();
            text.resize(8, 0);
            text
        })),
    row("cnc.dyn.by-name-one-character", &[DYN_3], "the last character of a name is not looked at",
        |cnc, call| match (is(call, BY_NAME), cnc.answer(call)) {
            (true, Err(_)) => {
                let name = text(call.data);
                let name = name.split_last().map_or(name, |(_, name)| name);
                cnc.with(call, &[name, &[0]].concat())
            }
            (_, answer) => answer,
        }),
    on("cnc.dyn.by-index-refused", &[DYN_4], "values by index are refused",
        BY_INDEX, |_, _| Err(AdsError::SERVICE_NOT_SUPPORTED)),
    row("cnc.dyn.by-index-first", &[DYN_4], "the value by index is that of the first parameter",
        |cnc, call| index(cnc, call, BY_INDEX, |index| index.min(1))),
    on("cnc.dyn.by-index-4-bytes", &[DYN_4], "the value by index is a REAL32",
        BY_INDEX, |cnc, call| cnc.answer(call).map(|bytes| narrow(&bytes))),
    on("cnc.dyn.by-index-whole", &[DYN_4], "the value by index is rounded to a whole number",
        BY_INDEX, |cnc, call| cnc.answer(call).map(|bytes| real(&bytes).round().to_le_bytes().to_vec())),
    row("cnc.dyn.by-index-reversed", &[DYN_4], "values by index are counted from the last",
        |cnc, call| index(cnc, call, BY_INDEX, |index| match index {
            0 => 0,
            index => count(cnc, call).wrapping_add(1).checked_sub(index).unwrap_or(index),
        })),
    row("cnc.dyn.name-of-97", &[DYN_6], "names of more than 96 bytes are cut and looked up",
        |cnc, call| match of_decoder(call) {
            Some(0x1C | 0x1F | 0x22 | 0x25) if call.data.len() > 96 => {
                let name = text(call.data);
                cnc.with(call, &[name.get(..95).unwrap_or(name), &[0]].concat())
            }
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.name-of-32", &[DYN_6],
        "names of more than 32 bytes, NULs behind them counted, are refused",
        |cnc, call| match of_decoder(call) {
            Some(0x1C | 0x1F | 0x22 | 0x25) if call.data.len() > 32 => Err(AdsError::INVALID_SIZE),
            _ => cnc.answer(call),
        }),
    row("cnc.dyn.p1-value", &[DYN_7], "the value of P1 is 4712",
        |cnc, call| if is(call, VALUES) && offset(call) < 0x1E {
            cnc.answer(call).map(|bytes| match real(&bytes) {
                4711.0 => 4712_f64.to_le_bytes().to_vec(),
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.dyn.p1-name", &[DYN_7], "the name of P1 is V.P1, and it is found by that",
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
    row("cnc.dyn.p1-count", &[DYN_7], "the number of P is that of all kinds",
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

/// Rounds to a REAL32; the parameters of the model have no more digits.
fn narrow(bytes: &[u8]) -> Vec<u8> {
    real(bytes).to_string().parse::<f32>().unwrap_or_default().to_le_bytes().to_vec()
}
