//! Attributes of elements of SDA and GEO (SDA).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::{CncSeed, ELEMENT_TEXTS, group, is, offset, on, reply, row, set_u32, text, u32_at};

const NAME: &[Function] = &[Function::ReadElementName];
const TYPE: &[Function] = &[Function::ReadElementType];
const LENGTH: &[Function] = &[Function::ReadElementLength];
const UNIT: &[Function] = &[Function::ReadElementUnit];
const FLAG: &[Function] = &[Function::ReadElementWriteFlag];

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    row("cnc.sda.instance-name-missing", &[SDA_4], "element 0 has no name",
        |cnc, call| if is(call, NAME) && offset(call) & 0xFFF == 0 {
            Err(AdsError::INVALID_OFFSET)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.instance-name-empty", &[SDA_4], "the name of element 0 is empty",
        |cnc, call| if is(call, NAME) && offset(call) & 0xFFF == 0 {
            cnc.answer(call).map(|_| vec![0])
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.instance-name-of-element", &[SDA_4], "the name of element 0 is that of element 1",
        |cnc, call| if is(call, NAME) && offset(call) & 0xFFF == 0 {
            cnc.at(call, group(call), offset(call) | 1)
        } else {
            cnc.answer(call)
        }),
    row("cnc.sda.text-length-first", &[SDA_6], "a text comes with its length, an UNS32, in front",
        |cnc, call| reply(cnc, call, ELEMENT_TEXTS, |bytes| {
            let length = u32::try_from(text(&bytes).len()).unwrap_or_default();
            [&length.to_le_bytes(), bytes.as_slice()].concat()
        })),
    row("cnc.sda.text-wide", &[SDA_6], "texts take two bytes a character",
        |cnc, call| reply(cnc, call, ELEMENT_TEXTS,
            |bytes| bytes.iter().flat_map(|&byte| [byte, 0]).collect())),
    row("cnc.sda.names-empty", &[SDA_6], "elements have no names: they are empty",
        |cnc, call| reply(cnc, call, NAME, |_| vec![0])),
    on("cnc.sda.unit-refused", &[SDA_6, ADR_6], "elements have no unit: it is refused",
        UNIT, |_, _| Err(AdsError::INVALID_OFFSET)),
    row("cnc.sda.unit-code", &[SDA_6, SDA_10], "the unit is a code of 4 bytes",
        |cnc, call| reply(cnc, call, UNIT, |_| vec![0x81, 1, 0, 0])),
    row("cnc.sda.types-of-com", &[SDA_7], "types are named as in COM: BOOL, DWORD, LREAL",
        |cnc, call| reply(cnc, call, TYPE, |bytes| {
            let other: &[u8] = match text(&bytes) {
                b"BOOLEAN" => b"BOOL\0",
                b"UNS08" => b"BYTE\0",
                b"SGN08" => b"SINT\0",
                b"UNS16" => b"WORD\0",
                b"SGN16" => b"INT\0",
                b"UNS32" => b"DWORD\0",
                b"SGN32" => b"DINT\0",
                b"REAL32" => b"REAL\0",
                b"REAL64" => b"LREAL\0",
                _ => return bytes,
            };
            other.to_vec()
        })),
    row("cnc.sda.types-lower-case", &[SDA_7], "types are written in lower case",
        |cnc, call| reply(cnc, call, TYPE, |bytes| bytes.to_ascii_lowercase())),
    row("cnc.sda.types-short", &[SDA_7], "types of one digit are written without the 0: UNS8",
        |cnc, call| reply(cnc, call, TYPE, |mut bytes| {
            bytes.retain(|&byte| byte != b'0');
            bytes
        })),
    row("cnc.sda.type-uns32", &[SDA_7, SDA_8], "every element is of type UNS32",
        |cnc, call| reply(cnc, call, TYPE, |_| b"UNS32\0".to_vec())),
    row("cnc.sda.length-one-more", &[SDA_8], "the length is one more than that of the content",
        |cnc, call| reply(cnc, call, LENGTH, |mut bytes| {
            let length = u32_at(&bytes, 0).unwrap_or_default();
            set_u32(&mut bytes, 0, length.wrapping_add(1));
            bytes
        })),
    row("cnc.sda.length-in-bits", &[SDA_8], "the length is in bits",
        |cnc, call| reply(cnc, call, LENGTH, |mut bytes| {
            let length = u32_at(&bytes, 0).unwrap_or_default();
            set_u32(&mut bytes, 0, length.wrapping_mul(8));
            bytes
        })),
    row("cnc.sda.length-aligned", &[SDA_8], "the length is 4 at least",
        |cnc, call| reply(cnc, call, LENGTH, |mut bytes| {
            let length = u32_at(&bytes, 0).unwrap_or_default();
            set_u32(&mut bytes, 0, length.max(4));
            bytes
        })),
    row("cnc.sda.length-text", &[SDA_8], "the length is a text",
        |cnc, call| reply(cnc, call, LENGTH, |bytes| {
            let length = u32_at(&bytes, 0).unwrap_or_default();
            format!("{length}\0\0").into_bytes()
        })),
    row("cnc.sda.flag-inverted", &[SDA_9],
        "the write flag is TRUE for what is read-only (write protection)",
        |cnc, call| reply(cnc, call, FLAG, |bytes| bytes.iter().map(|&byte| u8::from(byte == 0)).collect())),
    row("cnc.sda.flag-always", &[SDA_9], "the write flag is always TRUE",
        |cnc, call| reply(cnc, call, FLAG, |_| vec![1])),
    row("cnc.sda.flag-never", &[SDA_9], "the write flag is always FALSE",
        |cnc, call| reply(cnc, call, FLAG, |_| vec![0])),
    row("cnc.sda.flag-4-bytes", &[SDA_9, GEN_5], "the write flag takes 4 bytes",
        |cnc, call| reply(cnc, call, FLAG, |bytes| [bytes.as_slice(), &[0; 3]].concat())),
    row("cnc.sda.flag-text", &[SDA_9], "the write flag is a digit of text",
        |cnc, call| reply(cnc, call, FLAG, |bytes| bytes.iter().map(|byte| byte | b'0').collect())),
];
