//! Types, access and sizes of variables (VAR).

use ads_cnc_vectors::ids::*;

use super::variable::element;
use super::{CncSeed, DESCRIPTIONS, dimensions, number, on, reply, row, set_u32, u32_at};

/// The sizes of elements by type code, without STRING.
const SIZES: [u32; 9] = [0, 1, 1, 1, 2, 2, 4, 4, 8];

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    on("cnc.var.types-from-0", &[VAR_5], "types are counted from 0: BOOLEAN",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| code.wrapping_sub(1))),
    on("cnc.var.types-unsigned-first", &[VAR_5],
        "UNS08, UNS16, UNS32 stand before SGN08, SGN16, SGN32 among the types",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| match code {
            2 | 4 | 6 => code.wrapping_add(1),
            3 | 5 | 7 => code.wrapping_sub(1),
            _ => code,
        })),
    on("cnc.var.types-real32", &[VAR_5], "there is a REAL32 before REAL64: that is 9, STRING 10",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| code.wrapping_add(u32::from(code > 7)))),
    on("cnc.var.type-by-size", &[VAR_5], "every type of 1 byte is UNS08, every one of 4 bytes SGN32",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 4, |code| match code {
            1..=3 => 3,
            4 | 5 => 4,
            6 | 7 => 6,
            _ => code,
        })),
    on("cnc.var.access-from-0", &[VAR_6], "access is 0 for READ_ONLY, 1 for READ_WRITE",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |code| code.wrapping_sub(1))),
    on("cnc.var.access-swapped", &[VAR_6], "access is 2 for READ_ONLY, 1 for READ_WRITE",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |code| code ^ 3)),
    on("cnc.var.access-read-write", &[VAR_6], "access is READ_WRITE for every variable",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |_| 2)),
    on("cnc.var.access-flags", &[VAR_6], "access is a set of flags: 3 for READ_WRITE",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 8, |code| if code == 2 { 3 } else { code })),
    row("cnc.var.elementary-array-of-1", &[VAR_7], "an elementary variable has one dimension of 1",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |mut bytes| {
            if u32_at(&bytes, 16) == Some(0) {
                set_u32(&mut bytes, 16, 1);
                bytes.splice(20..20, [1, 0, 0, 0]);
            }
            bytes
        })),
    row("cnc.var.elementary-array-of-0", &[VAR_7], "an elementary variable has one dimension of 0",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |mut bytes| {
            if u32_at(&bytes, 16) == Some(0) {
                set_u32(&mut bytes, 16, 1);
                bytes.splice(20..20, [0; 4]);
            }
            bytes
        })),
    on("cnc.var.size-of-element", &[VAR_8], "the size in a description is that of one element",
        DESCRIPTIONS, |cnc, call| cnc.answer(call).map(|mut bytes| {
            let size = u32::try_from(element(&bytes)).unwrap_or_default();
            set_u32(&mut bytes, 12, size);
            bytes
        })),
    on("cnc.var.size-in-elements", &[VAR_8], "the size in a description is a number of elements",
        DESCRIPTIONS, |cnc, call| cnc.answer(call).map(|mut bytes| {
            let size =
                dimensions(&bytes).0.iter().fold(1, |all: u32, one| all.saturating_mul(*one));
            set_u32(&mut bytes, 12, size);
            bytes
        })),
    on("cnc.var.size-of-first-dimension", &[VAR_8],
        "the size of an array with more dimensions is that of the first",
        DESCRIPTIONS, |cnc, call| cnc.answer(call).map(|mut bytes| {
            let first = dimensions(&bytes).0.first().copied().unwrap_or(1);
            let size = u32::try_from(element(&bytes)).unwrap_or_default();
            set_u32(&mut bytes, 12, size.saturating_mul(first));
            bytes
        })),
    on("cnc.var.size-aligned", &[VAR_8], "the size in a description is rounded up to 4 bytes",
        DESCRIPTIONS, |cnc, call| number(cnc.answer(call), 12, |size| size.saturating_add(3) & !3)),
    on("cnc.var.size-of-description", &[VAR_8], "the size in a description is its own",
        DESCRIPTIONS, |cnc, call| cnc.answer(call).map(|mut bytes| {
            let len = u32::try_from(bytes.len()).unwrap_or_default();
            set_u32(&mut bytes, 12, len);
            bytes
        })),
    on("cnc.var.description-types-wide", &[VAR_8, GEN_5],
        "sizes count 4 bytes for every element of fewer",
        DESCRIPTIONS, |cnc, call| cnc.answer(call).map(|mut bytes| {
            let kind = u32_at(&bytes, 4).and_then(|kind| usize::try_from(kind).ok());
            let size = kind.and_then(|kind| SIZES.get(kind)).copied().unwrap_or(8);
            let whole = u32_at(&bytes, 12).unwrap_or_default();
            if let Some(elements) = whole.checked_div(size).filter(|_| size < 4) {
                set_u32(&mut bytes, 12, elements.saturating_mul(4));
            }
            bytes
        })),
];
