//! Defects in the handles and indices of requests by handle (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::handle::{joined, parts};
use super::variable::described;
use super::{CncDefect, forgiven, is, of_decoder, on, row, u32_at, within_length};

const READ: &[Function] = &[Function::ReadByHandle];

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.handle-unknown", &[VAR_11],
        "a read with an unknown handle returns four zero bytes instead of an error",
        |cnc, call| match (is(call, READ), cnc.answer(call)) {
            (true, Err(_)) if described(cnc, call).is_none() => within_length(call, Ok(vec![0; 4])),
            (_, answer) => answer,
        }),
    row("cnc.var.indices-more", &[VAR_11],
        "the CNC ignores bytes after the indices in a read by handle",
        |cnc, call| match (of_decoder(call), parts(call.data)) {
            (Some(0x47), Some((handle, at, _))) => cnc.with(call, &joined(handle, &at, &[])),
            _ => cnc.answer(call),
        }),
    row("cnc.var.indices-fewer", &[VAR_11],
        "the CNC treats indices that are missing at the end of a read by handle as 0",
        |cnc, call| match (of_decoder(call), u32_at(call.data, 4)) {
            (Some(0x47), Some(count @ 1..=8)) if call.data.len() >= 8 => {
                let mut data = call.data.to_vec();
                let len = usize::try_from(count).unwrap_or_default().saturating_mul(4);
                data.resize(len.saturating_add(8).max(data.len()), 0);
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    on("cnc.var.write-indices-beyond", &[VAR_12],
        "a write with an unknown handle or an index out of bounds succeeds and changes nothing",
        &[Function::WriteByHandle],
        |cnc, call| forgiven(cnc.answer(call), AdsError::INVALID_DATA)),
];
