//! Defects that violate the general rules (GEN), such as those for byte order, padding, code page,
//! tasks and the sizes of types.

use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::layout::{FieldSpec, Size, Type};
use ads_cnc::operation::{Call, Function, FunctionSpec};
use ads_cnc::text::cp1252_to_char;
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, DESCRIPTIONS, NAMED, ReplyData, Upstream, VALUES, WRITES, after_nul, changed,
    dimensions, first, function, functions, number, on, records, reply, row, set_u32, text, u32_at,
    within_length,
};

/// Functions whose reply is a number of 4 bytes.
const NUMBERS: &[Function] =
    functions!(|spec| matches!(fields(spec), [FieldSpec { size: Size::Fixed(4), .. }]));

/// Functions whose reply is a text.
const TEXTS: &[Function] =
    functions!(|spec| matches!(fields(spec), [FieldSpec { ty: Type::String, .. }]));

/// The fields of the reply.
const fn fields(spec: &FunctionSpec) -> &'static [FieldSpec] {
    match spec.reply {
        Some(stream) => stream.layout().fields,
        None => &[],
    }
}

/// Changes texts in replies with `outwards`: a text that is the whole reply, and the name in a
/// description by index. Changes the names in requests for the functions `NAMED` with `inwards`.
fn texts(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    outwards: fn(&[u8]) -> Vec<u8>,
    inwards: fn(&[u8]) -> Vec<u8>,
) -> ReplyData {
    let answer = match function(call) {
        Some(function) if TEXTS.contains(&function) => {
            cnc.whole(call).map(|bytes| again(text(&bytes), outwards, &[0]))
        }
        Some(Function::DescribeByIndex) => cnc.whole(call).map(|bytes| {
            let (_, name) = dimensions(&bytes);
            let (head, name) = bytes.split_at_checked(name).unwrap_or_default();
            [head, &again(text(name), outwards, &[0])].concat()
        }),
        Some(function) if NAMED.contains(&function) => {
            let value = if WRITES.contains(&function) { after_nul(call.data) } else { &[] };
            let tail = [&[0], value].concat();
            return cnc.with(call, &again(text(call.data), inwards, &tail));
        }
        _ => return cnc.answer(call),
    };
    within_length(call, answer)
}

fn again(text: &[u8], other: fn(&[u8]) -> Vec<u8>, tail: &[u8]) -> Vec<u8> {
    let mut bytes = other(text);
    bytes.extend_from_slice(tail);
    bytes
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.gen.numbers-big-endian", &[GEN_1],
        "a reply of one UNS32 (a count or a handle) has the most significant byte first",
        NUMBERS, |cnc, call| number(cnc.answer(call), 0, u32::swap_bytes)),
    row("cnc.gen.reals-big-endian", &[GEN_1],
        "the REAL64 of a dynamic parameter has the most significant byte first in replies",
        |cnc, call| match function(call) {
            Some(Function::DynamicValueByName | Function::DynamicValueByIndex) => {
                changed(cnc, call, |bytes| bytes.reverse())
            }
            _ => cnc.answer(call),
        }),
    row("cnc.gen.reals-words-swapped", &[GEN_1],
        "a variable's value of 8 bytes, such as a REAL64, has its two halves exchanged in replies",
        |cnc, call| match function(call) {
            Some(function) if VALUES.contains(&function) => {
                let answer = cnc.answer(call)?;
                match answer.split_at_checked(4) {
                    Some((low, high)) if high.len() == 4 => Ok([high, low].concat()),
                    _ => Ok(answer),
                }
            }
            _ => cnc.answer(call),
        }),
    row("cnc.gen.requests-big-endian", &[GEN_1],
        "the CNC reads the index at the start of a request with the most significant byte first",
        |cnc, call| match function(call) {
            Some(function) if first(function.spec().request) == b"index" => {
                let mut data = call.data.to_vec();
                if let Some(index) = u32_at(&data, 0) {
                    set_u32(&mut data, 0, index.swap_bytes());
                }
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.gen.description-aligned", &[GEN_2],
        "the name in a description by index starts at an offset that is a multiple of 8",
        |cnc, call| reply(cnc, call, &[Function::DescribeByIndex], |bytes| {
            let (_, name) = dimensions(bytes);
            if name % 8 != 0 && name <= bytes.len() {
                bytes.splice(name..name, [0; 4]);
            }
        })),
    on("cnc.gen.descriptor-access-wide", &[GEN_2],
        "the write access in a descriptor takes 4 bytes, so the fields from offset 12 on move by \
         2 bytes",
        &[Function::ReadDescriptors], |cnc, call| cnc.answer(call).map(|bytes| {
            let records = records(&bytes);
            let wide = |record: &[u8; 84]| {
                let (head, tail) = record.split_at(12);
                [head, &[0, 0], tail.split_last_chunk::<2>().map_or(tail, |(tail, _)| tail)]
                    .concat()
            };
            records.iter().flat_map(wide).collect()
        })),
    row("cnc.gen.utf-8", &[GEN_3],
        "the CNC uses UTF-8 instead of CP1252 for names in requests and texts in replies",
        |cnc, call| {
            let outwards = |text: &[u8]| {
                let text: String = text.iter().map(|&byte| cp1252_to_char(byte)).collect();
                text.into_bytes()
            };
            let inwards = |text: &[u8]| {
                let text = String::from_utf8_lossy(text).into_owned();
                text.chars().map(|one| u8::try_from(one).unwrap_or(b'?')).collect()
            };
            texts(cnc, call, outwards, inwards)
        }),
    row("cnc.gen.ascii", &[GEN_3],
        "names, types and units in replies have question marks in place of characters beyond ASCII",
        |cnc, call| {
            let outwards = |text: &[u8]| {
                text.iter().map(|byte| if byte.is_ascii() { *byte } else { b'?' }).collect()
            };
            texts(cnc, call, outwards, <[u8]>::to_vec)
        }),
    row("cnc.gen.seven-bits", &[GEN_3],
        "the CNC ignores the highest bit of each character of a variable's name in a request",
        |cnc, call| texts(cnc, call, <[u8]>::to_vec, |text| text.iter().map(|&byte| byte & 0x7F).collect())),
    row("cnc.gen.com-at-sda", &[GEN_4],
        "the CNC serves the COM task at port 552 instead of port 553",
        |cnc, call| match (call.port, super::com_group(call)) {
            (AmsPort::COM, Some(_)) => Err(AdsError::INVALID_GROUP),
            (AmsPort::SDA, Some(_)) => cnc.answer(&Call { port: AmsPort::COM, ..*call }),
            _ => cnc.answer(call),
        }),
    row("cnc.gen.any-port", &[GEN_4],
        "the CNC serves all three tasks at each of their ports 551, 552 and 553",
        |cnc, call| match super::com_group(call) {
            Some(_) => cnc.answer(&Call { port: AmsPort::COM, ..*call }),
            None => cnc.answer(&Call { port: AmsPort::SDA, ..*call }),
        }),
    row("cnc.gen.boolean-4-bytes", &[GEN_5],
        "BOOLEAN variables are described with 4 bytes per element, and one element is read as 4 \
         bytes",
        |cnc, call| match function(call) {
            Some(function) if DESCRIPTIONS.contains(&function) => {
                changed(cnc, call, |bytes| {
                    if u32_at(bytes, 4) == Some(1) {
                        let size = u32_at(bytes, 12).unwrap_or_default();
                        set_u32(bytes, 12, size.wrapping_mul(4));
                    }
                })
            }
            Some(Function::ReadByName | Function::ReadByHandle) => {
                let answer = cnc.answer(call)?;
                match (answer.as_slice(), call.read_length) {
                    ([one @ (0 | 1)], 4..) => Ok(vec![*one, 0, 0, 0]),
                    _ => Ok(answer),
                }
            }
            _ => cnc.answer(call),
        }),
];
