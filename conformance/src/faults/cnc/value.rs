//! Defects in the values and extended descriptions of variables (VAR).

use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::consistency::cached;
use super::variable::{described, element, first_element};
use super::{CncDefect, VALUES, changed, is, on, reply, row, text, u32_at, within_length};

const EXTENDED: &[Function] = &[Function::DescribeExtended];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.value-first", &[VAR_14],
        "a read by name of a whole array returns only its first element",
        |cnc, call| match (is(call, &[Function::ReadByName]), text(call.data).ends_with(b"]")) {
            (true, false) => first_element(cnc, call),
            _ => cnc.answer(call),
        }),
    row("cnc.var.value-2048", &[VAR_14],
        "values of variables in replies are padded with zeros to 2048 bytes",
        |cnc, call| reply(cnc, call, VALUES, |bytes| bytes.resize(2048, 0))),
    row("cnc.var.value-by-handle-other", &[VAR_14, VAR_11],
        "a read by handle always returns the value of the first read with this handle and indices",
        |cnc, call| cached(cnc, call, &[Function::ReadByHandle])),
    row("cnc.var.arrays-reversed", &[VAR_14],
        "a read by name of a whole array returns its elements in reverse order",
        |cnc, call| if is(call, &[Function::ReadByName]) && !text(call.data).ends_with(b"]") {
            let len = described(cnc, call).map_or(0, |found| element(&found));
            cnc.answer(call).map(|bytes| match len {
                0 => bytes,
                len => bytes.rchunks(len).flatten().copied().collect(),
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.extended-of-global", &[VAR_16],
        "V.G variables have an extended description: SYNCHRONIZED and GLOBAL",
        |cnc, call| if is(call, EXTENDED) && text(call.data.get(4..).unwrap_or_default()) == b"V.G" {
            within_length(call, cnc.answer(call).map(|_| vec![2, 0, 0, 0, 2, 0, 0, 0]))
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.extended-of-axis", &[VAR_16],
        "V.A variables have an extended description of 8 zero bytes",
        |cnc, call| if is(call, EXTENDED) && text(call.data.get(4..).unwrap_or_default()) == b"V.A" {
            within_length(call, cnc.answer(call).map(|_| vec![0; 8]))
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.string-cut", &[VAR_25],
        "a read of a STRING of at least 20 bytes returns only its first 8 bytes",
        VALUES, |cnc, call| {
            let is_text =
                described(cnc, call).is_some_and(|found| u32_at(&found, 4) == Some(9));
            changed(cnc, call, |bytes| if is_text && bytes.len() >= 20 {
                bytes.truncate(8);
            })
        }),
];
