//! Defects in the types, access codes and dimensions of variables (VAR).

use ads_cnc_vectors::ids::*;

use super::{CncDefect, DESCRIPTIONS, number, on, reply, row, set_u32, u32_at};

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.var.types-unsigned-first", &[VAR_5],
        "the type codes of UNS08, UNS16 and UNS32 are exchanged with SGN08, SGN16 and SGN32",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| match code {
            2 | 4 | 6 => code.wrapping_add(1),
            3 | 5 | 7 => code.wrapping_sub(1),
            _ => code,
        })),
    on("cnc.var.type-by-size", &[VAR_5],
        "type codes depend only on the size: UNS08, SGN16 or SGN32 for BOOLEAN and all integers",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| match code {
            1..=3 => 3,
            4 | 5 => 4,
            6 | 7 => 6,
            _ => code,
        })),
    on("cnc.var.access-swapped", &[VAR_6], "access is 2 for READ_ONLY, 1 for READ_WRITE",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |code| code ^ 3)),
    on("cnc.var.access-read-write", &[VAR_6], "access is READ_WRITE for every variable",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |_| 2)),
    row("cnc.var.elementary-array-of-1", &[VAR_7],
        "an elementary variable is described with one dimension of 1 element",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |bytes| {
            if u32_at(bytes, 16) == Some(0) {
                set_u32(bytes, 16, 1);
                bytes.splice(20..20, [1, 0, 0, 0]);
            }
        })),
    row("cnc.var.elementary-array-of-0", &[VAR_7],
        "an elementary variable is described with one dimension of 0 elements",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |bytes| {
            if u32_at(bytes, 16) == Some(0) {
                set_u32(bytes, 16, 1);
                bytes.splice(20..20, [0; 4]);
            }
        })),
];
