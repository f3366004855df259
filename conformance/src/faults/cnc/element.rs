//! Defects in the attributes of elements of SDA and GEO (SDA).

use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::{CncDefect, reply, row, text};

const TYPE: &[Function] = &[Function::ReadElementType];
const FLAG: &[Function] = &[Function::ReadElementWriteFlag];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.sda.types-of-com", &[SDA_7],
        "types of elements have the names of COM types, such as BOOL, DWORD and LREAL",
        |cnc, call| reply(cnc, call, TYPE, |bytes| {
            let other: &[u8] = match text(bytes) {
                b"BOOLEAN" => b"BOOL\0",
                b"UNS08" => b"BYTE\0",
                b"SGN08" => b"SINT\0",
                b"UNS16" => b"WORD\0",
                b"SGN16" => b"INT\0",
                b"UNS32" => b"DWORD\0",
                b"SGN32" => b"DINT\0",
                b"REAL32" => b"REAL\0",
                b"REAL64" => b"LREAL\0",
                _ => return,
            };
            *bytes = other.to_vec();
        })),
    row("cnc.sda.types-short", &[SDA_7],
        "types of elements with one digit are written without the 0: UNS8 instead of UNS08",
        |cnc, call| reply(cnc, call, TYPE, |bytes| bytes.retain(|&byte| byte != b'0'))),
    row("cnc.sda.flag-always", &[SDA_9], "the write flag is always TRUE",
        |cnc, call| reply(cnc, call, FLAG, |bytes| *bytes = vec![1])),
    row("cnc.sda.flag-text", &[SDA_9],
        "the write flag is the character 0 or 1 instead of a BOOLEAN",
        |cnc, call| reply(cnc, call, FLAG, |bytes| {
            bytes.iter_mut().for_each(|byte| *byte |= b'0');
        })),
];
