//! Numbers, kinds and indices of variables (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncSeed, INDEXED, ReplyData, Upstream, group, is, number, of_decoder, offset, on, row, set_u32,
    text, u32_at,
};

const COUNT: &[Function] = &[Function::CountVariables];

/// Changes index and kind of a request.
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
pub(super) fn count(cnc: &Upstream<'_>, call: &Call<'_>, kind: &[u8]) -> u32 {
    let count = cnc.ask(group(call), 0x44, &[kind, &[0]].concat());
    count.ok().and_then(|count| u32_at(&count, 0)).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    row("cnc.var.sum-refused", &[VAR_1], "the empty kind is refused",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-of-external", &[VAR_1], "the empty kind asks for V.E",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            cnc.with(call, b"V.E\0")
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-without-axes", &[VAR_1], "the sum of all kinds leaves out V.A",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            cnc.answer(call).map(|mut bytes| {
                let sum = count(cnc, call, b"V.E").wrapping_add(count(cnc, call, b"V.G"));
                set_u32(&mut bytes, 0, sum);
                bytes
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.sum-0", &[VAR_1], "the sum of all kinds is 0",
        |cnc, call| if is(call, COUNT) && text(call.data).is_empty() {
            cnc.answer(call).map(|_| vec![0; 4])
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.kind-with-dot", &[VAR_1], "a kind ends with a dot: V.E. is taken, V.E refused",
        |cnc, call| {
            let head = if is(call, INDEXED) { 4 } else { 0 };
            let (head, kind) = call.data.split_at_checked(head).unwrap_or_default();
            match (of_decoder(call), text(kind)) {
                (Some(0x44 | 0x45 | 0x4B), b"V.E" | b"V.G" | b"V.A") => {
                    Err(AdsError::SYMBOL_NOT_FOUND)
                }
                (Some(0x44 | 0x45 | 0x4B), b"V.E." | b"V.G." | b"V.A.") => {
                    let kind = text(kind).split_last().map_or(kind, |(_, kind)| kind);
                    cnc.with(call, &[head, kind, &[0]].concat())
                }
                _ => cnc.answer(call),
            }
        }),
    on("cnc.var.count-one-more", &[VAR_2], "numbers of variables are one more",
        COUNT, |cnc, call| number(cnc.answer(call), 0, |count| count.wrapping_add(1))),
    on("cnc.var.count-highest-index", &[VAR_2], "numbers of variables are the highest index",
        COUNT, |cnc, call| number(cnc.answer(call), 0, |count| count.saturating_sub(1))),
    on("cnc.var.count-of-sum", &[VAR_2],
        "the number of variables is that of all kinds, whichever is asked for",
        COUNT, |cnc, call| cnc.with(call, &[0])),
    row("cnc.var.count-of-external", &[VAR_2],
        "the number of variables is that of V.E, whichever kind is asked for",
        |cnc, call| if is(call, COUNT) && !text(call.data).is_empty() {
            cnc.with(call, b"V.E\0")
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.count-of-channel-1", &[VAR_2], "the number of variables is that of channel 1",
        COUNT, |cnc, call| cnc.at(call, 0x12_2301, offset(call))),
    on("cnc.var.count-8-bit", &[VAR_2], "numbers of variables are one byte",
        COUNT, |cnc, call| cnc.answer(call).map(|mut bytes| {
            bytes.truncate(1);
            bytes
        })),
    row("cnc.var.index-from-1", &[VAR_2, VAR_3], "indices run from 1 to n",
        |cnc, call| indexed(cnc, call, |index, kind| (index.wrapping_sub(1), kind.to_vec()))),
    row("cnc.var.index-beyond", &[VAR_2], "an index behind the last is taken for the last",
        |cnc, call| indexed(cnc, call, |index, kind| {
            (index.min(count(cnc, call, kind).saturating_sub(1)), kind.to_vec())
        })),
    row("cnc.var.index-wraps", &[VAR_2], "behind the last index they begin anew",
        |cnc, call| indexed(cnc, call, |index, kind| {
            (index.checked_rem(count(cnc, call, kind)).unwrap_or(index), kind.to_vec())
        })),
    row("cnc.var.index-8-bit", &[VAR_2], "of an index the lowest byte counts",
        |cnc, call| indexed(cnc, call, |index, kind| (index & 0xFF, kind.to_vec()))),
    row("cnc.var.index-big-endian", &[GEN_1, VAR_3],
        "the index of a variable is read with the most significant byte first",
        |cnc, call| indexed(cnc, call, |index, kind| (index.swap_bytes(), kind.to_vec()))),
    row("cnc.var.index-ignored", &[VAR_3], "the variable described is the first, whatever the index",
        |cnc, call| indexed(cnc, call, |index, kind| {
            (if index < count(cnc, call, kind) { 0 } else { index }, kind.to_vec())
        })),
    row("cnc.var.index-reversed", &[VAR_3, VAR_15],
        "the extended description is that of the variable as far from the end",
        |cnc, call| match offset(call) {
            0x4B => indexed(cnc, call, |index, kind| {
                let last = count(cnc, call, kind).wrapping_sub(1);
                (last.checked_sub(index).unwrap_or(index), kind.to_vec())
            }),
            _ => cnc.answer(call),
        }),
    row("cnc.var.kind-ignored", &[VAR_3], "the variable described is one of V.E, whatever the kind",
        |cnc, call| indexed(cnc, call, |index, _| (index, b"V.E".to_vec()))),
    row("cnc.var.kind-before-index", &[VAR_3], "the kind is expected before the index",
        |cnc, call| match of_decoder(call) {
            Some(0x45 | 0x4B) => {
                let kind = text(call.data);
                let index = super::after_nul(call.data);
                match index.len() {
                    4 => cnc.with(call, &[index, kind, &[0]].concat()),
                    _ => Err(AdsError::INVALID_SIZE),
                }
            }
            _ => cnc.answer(call),
        }),
];
