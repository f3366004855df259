//! Defects that affect only some values or accesses, such as those of one data type, one kind or
//! one attribute, or one of several ways to access the same value.

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::handle::parts;
use super::lookup::{described, descriptor, element_is, indexed, is_string, object_is};
use super::{
    CncDefect, DESCRIPTIONS, LOGICAL, ReplyData, Upstream, changed, dimensions, each, function,
    group, is, number, of_decoder, offset, on, reply, row, set_u32, text, u32_at, within_length,
};

const BOTH: &[Function] = &[Function::DynamicValueByName, Function::DynamicValueByIndex];

/// The REAL64 after a conversion to text with six decimal places, and back.
fn six_digits(bytes: Vec<u8>) -> Vec<u8> {
    let Some(value) = bytes.first_chunk::<8>() else { return bytes };
    let digits = format!("{:.6}", f64::from_le_bytes(*value));
    digits.parse::<f64>().map_or(bytes, |value| value.to_le_bytes().to_vec())
}

/// The REAL64 with its fraction truncated to the precision of a REAL32.
fn rounded(value: [u8; 8]) -> [u8; 8] {
    let bits = u64::from_le_bytes(value);
    // A REAL64 has 52 bits of fraction, a REAL32 has 23.
    (bits & !((1 << 29) - 1)).to_le_bytes()
}

/// Stores the values written to axes through the HLD of channel 1 separately, so that the HLD
/// without a channel and the HLDs of other channels keep the old values of the same platform axes.
fn hld_apart(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let key = (0x3301, offset(call), Vec::new());
    match (group(call) | LOGICAL == 0x12_3301 && offset(call) >= 0x1_0000, function(call)) {
        (true, Some(Function::WriteElement)) => {
            let old = cnc.read(call.port, group(call), offset(call));
            let reply = cnc.answer(call)?;
            cnc.memory().store(key, call.data.to_vec());
            let _ = cnc.with(call, &old?);
            Ok(reply)
        }
        (true, Some(Function::ReadElement)) => {
            let kept = cnc.memory().get(&key);
            kept.map_or_else(|| cnc.answer(call), Ok)
        }
        _ => cnc.answer(call),
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.adr.spindles-without-flag", &[ADR_6, ADR_5],
        "the CNC rejects a read of the write flag of a spindle's element (0x25800)",
        |cnc, call| match group(call) & 0xFF_FF00 {
            0x02_5800 => Err(AdsError::INVALID_GROUP),
            _ => cnc.answer(call),
        }),
    row("cnc.gen.real32-8-bytes", &[GEN_5, SDA_7, SDA_8],
        "a read of a REAL32 element of SDA or GEO returns it as a REAL64 of 8 bytes",
        |cnc, call| if is(call, &[Function::ReadElement]) && element_is(cnc, call, b"REAL32") {
            within_length(
                call,
                cnc.whole(call).map(|bytes| match bytes.first_chunk::<4>() {
                    Some(real) => f64::from(f32::from_le_bytes(*real)).to_le_bytes().to_vec(),
                    None => bytes,
                }),
            )
        } else {
            cnc.answer(call)
        }),
    row("cnc.gen.rows-aligned", &[GEN_2, VAR_14],
        "a read by name of a whole array of two dimensions pads each row to a multiple of 4 bytes",
        |cnc, call| if is(call, &[Function::ReadByName]) && of_decoder(call).is_some() {
            let whole = cnc.whole(call)?;
            let described = described(cnc, group(call), text(call.data)).unwrap_or_default();
            let rows = match (&dimensions(&described).0[..], indexed(text(call.data)).1.len()) {
                ([rows, _], 0) => usize::try_from(*rows).unwrap_or(1),
                _ => return cnc.answer(call),
            };
            let each = whole.len().checked_div(rows).unwrap_or_default().max(1);
            let padded = whole.chunks(each).flat_map(|row| {
                let mut row = row.to_vec();
                row.resize(row.len().next_multiple_of(4), 0);
                row
            });
            within_length(call, Ok(padded.collect()))
        } else {
            cnc.answer(call)
        }),
    row("cnc.gen.latin-1", &[GEN_3],
        "a read by name of a STRING returns question marks for the characters 80 to 9F",
        |cnc, call| if is(call, &[Function::ReadByName]) && of_decoder(call).is_some() {
            let described = described(cnc, group(call), text(call.data)).unwrap_or_default();
            changed(cnc, call, |bytes| {
                if is_string(&described) {
                    let own = bytes.iter_mut().filter(|byte| (0x80..0xA0).contains(*byte));
                    own.for_each(|byte| *byte = b'?');
                }
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.gen.units-ascii", &[GEN_3, SDA_6],
        "units in replies lack their characters beyond ASCII",
        |cnc, call| reply(cnc, call, &[Function::ReadElementUnit], |bytes| {
            bytes.retain(u8::is_ascii);
        })),
    row("cnc.com.string-size", &[COM_2],
        "the size of a STRING in its descriptor does not count the NUL",
        |cnc, call| each(cnc, call, |record| {
            if text(record.get(52..).unwrap_or_default()) == b"STRING" {
                let size = u32_at(record, 4).unwrap_or_default();
                set_u32(record, 4, size.saturating_sub(1));
            }
        })),
    row("cnc.com.lreal-written-narrow", &[COM_5],
        "a write to an LREAL object stores the value with the precision of a REAL",
        |cnc, call| if is(call, &[Function::WriteObject]) && object_is(cnc, call, b"LREAL") {
            match call.data.first_chunk::<8>() {
                Some(value) if call.data.len() == 8 => cnc.with(call, &rounded(*value)),
                _ => cnc.answer(call),
            }
        } else {
            cnc.answer(call)
        }),
    row("cnc.com.read-only-by-index", &[COM_5, ADR_12],
        "the CNC rejects writes to COM objects in addressing by index",
        |cnc, call| {
            let by_index = is(call, &[Function::WriteObject]) && group(call) & LOGICAL == 0;
            if by_index && descriptor(cnc, call).is_some() && offset(call) != 0x90 {
                Err(AdsError::INVALID_ACCESS)
            } else {
                cnc.answer(call)
            }
        }),
    row("cnc.sda.length-of-text", &[SDA_8],
        "the length of a STRING element is that of its current text instead of its content",
        |cnc, call| if is(call, &[Function::ReadElementLength]) && element_is(cnc, call, b"STRING") {
            let content = cnc.read(call.port, group(call) & !0xF00 | 0x300, offset(call))?;
            let len = u32::try_from(text(&content).len()).unwrap_or_default();
            changed(cnc, call, |bytes| set_u32(bytes, 0, len))
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.negative-written-0", &[SDA_7, SDA_9],
        "a write of a negative number to an SGN16 element stores 0",
        |cnc, call| if is(call, &[Function::WriteElement]) && element_is(cnc, call, b"SGN16") {
            match call.data {
                [_, high] if *high >= 0x80 => cnc.with(call, &[0; 2]),
                _ => cnc.answer(call),
            }
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.hld-axes-apart", &[SDA_13],
        "a value written to an axis in the HLD of channel 1 is read only there, not in the other \
         HLDs",
        hld_apart),
    on("cnc.dyn.value-six-digits", &[DYN_3, DYN_4],
        "values of parameters are rounded to six decimal places: 1e-300 is 0",
        BOTH, |cnc, call| cnc.answer(call).map(six_digits)),
    row("cnc.var.read-only-by-handle", &[VAR_6],
        "a write by handle to a READ_ONLY variable succeeds, and reads by handle return the value",
        |cnc, call| match (function(call), parts(call.data)) {
            (Some(Function::WriteByHandle), Some((handle, indices, value))) => {
                match cnc.answer(call) {
                    Err(AdsError::INVALID_ACCESS) => {
                        let key = (group(call) & 0xFF, handle, format!("{indices:?}").into_bytes());
                        cnc.memory().store(key, value.to_vec());
                        Ok(Vec::new())
                    }
                    answer => answer,
                }
            }
            (Some(Function::ReadByHandle), Some((handle, indices, _))) => {
                let key = (group(call) & 0xFF, handle, format!("{indices:?}").into_bytes());
                let kept = cnc.memory().get(&key);
                kept.map_or_else(|| cnc.answer(call), Ok)
            }
            _ => cnc.answer(call),
        }),
    on("cnc.var.strings-read-only", &[VAR_6],
        "STRING variables are described as READ_ONLY, although writes to them succeed",
        DESCRIPTIONS, |cnc, call| {
            let answer = cnc.answer(call)?;
            if is_string(&answer) { number(Ok(answer), 8, |_| 1) } else { Ok(answer) }
        }),
    row("cnc.var.cycle-read-only", &[VAR_18], "the CNC rejects writes to V.CYC variables",
        |cnc, call| if is(call, &[Function::WriteByName]) && call.data.starts_with(b"V.CYC.") {
            Err(AdsError::INVALID_ACCESS)
        } else {
            cnc.answer(call)
        }),
];
