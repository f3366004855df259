//! Defects in the number of variables, their kinds and their indices (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, INDEXED, ReplyData, Upstream, changed, group, is, offset, row, set_u32, text, u32_at,
};

const COUNT: &[Function] = &[Function::CountVariables];

/// The reply to a request with its index and kind changed by `other`.
fn indexed(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    other: impl FnOnce(u32, &[u8]) -> (u32, Vec<u8>),
) -> ReplyData {
    let (true, Some(index)) = (is(call, INDEXED), u32_at(call.data, 0)) else {
        return cnc.answer(call);
    };
    let (index, kind) = other(index, text(call.data.get(4..).unwrap_or_default()));
    cnc.with(call, &[&index.to_le_bytes(), kind.as_slice(), &[0]].concat())
}

/// The number of variables of a kind.
fn count(cnc: &Upstream<'_>, call: &Call<'_>, kind: &[u8]) -> u32 {
    let count = cnc.ask(group(call), 0x44, &[kind, &[0]].concat());
    count.ok().and_then(|count| u32_at(&count, 0)).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.sum-refused", &[VAR_1],
        "the CNC rejects the empty kind, which requests the number of variables of all kinds",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-of-external", &[VAR_1], "the CNC treats the empty kind as V.E",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            cnc.with(call, b"V.E\0")
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-without-axes", &[VAR_1],
        "the number of variables of all kinds does not count V.A",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            changed(cnc, call, |bytes| {
                let sum = count(cnc, call, b"V.E").wrapping_add(count(cnc, call, b"V.G"));
                set_u32(bytes, 0, sum);
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-0", &[VAR_1], "the number of variables of all kinds is 0",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            cnc.answer(call).map(|_| vec![0; 4])
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.index-8-bit", &[VAR_2],
        "the CNC uses only the lowest byte of the index in a request for a description",
        |cnc, call| indexed(cnc, call, |index, kind| (index & 0xFF, kind.to_vec()))),
    row("cnc.var.index-ignored", &[VAR_3],
        "a description by index is that of the first variable of the kind, whatever the index",
        |cnc, call| indexed(cnc, call, |index, kind| {
            (if index < count(cnc, call, kind) { 0 } else { index }, kind.to_vec())
        })),
    row("cnc.var.index-reversed", &[VAR_3, VAR_15],
        "extended descriptions are in reverse order: index 0 is the last variable",
        |cnc, call| match offset(call) {
            0x4B => indexed(cnc, call, |index, kind| {
                let last = count(cnc, call, kind).wrapping_sub(1);
                (last.checked_sub(index).unwrap_or(index), kind.to_vec())
            }),
            _ => cnc.answer(call),
        }),
];
