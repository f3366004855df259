//! Indices of elements, in requests by handle (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function, Service};
use ads_cnc_vectors::ids::*;

use super::handle::{joined, parts};
use super::variable::{described, element, first_element};
use super::{
    CncSeed, ReplyData, Upstream, dimensions, is, of_decoder, row, set_u32, u32_at, within_length,
};

const READ: &[Function] = &[Function::ReadByHandle];
const WRITE: &[Function] = &[Function::WriteByHandle];

/// Changes the indices of a request by handle.
fn indices(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    of: &[Function],
    other: impl FnOnce(Vec<u32>) -> Vec<u32>,
) -> ReplyData {
    match (is(call, of), parts(call.data)) {
        (true, Some((handle, indices, value))) => {
            cnc.with(call, &joined(handle, &other(indices), value))
        }
        _ => cnc.answer(call),
    }
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    row("cnc.var.handle-unknown", &[VAR_11], "a handle of no variable reads as 0",
        |cnc, call| match (is(call, READ), cnc.answer(call)) {
            (true, Err(_)) if described(cnc, call).is_none() => within_length(call, Ok(vec![0; 4])),
            (_, answer) => answer,
        }),
    row("cnc.var.whole-by-handle-first", &[VAR_11, VAR_14], "n = 0 reads the first element of an array",
        |cnc, call| match (is(call, READ), u32_at(call.data, 4)) {
            (true, Some(0)) => first_element(cnc, call),
            _ => cnc.answer(call),
        }),
    row("cnc.var.whole-by-handle-refused", &[VAR_11], "n = 0 is refused for an array",
        |cnc, call| match (is(call, READ), u32_at(call.data, 4)) {
            (true, Some(0))
                if described(cnc, call).is_some_and(|found| !dimensions(&found).0.is_empty()) =>
            {
                Err(AdsError::INVALID_DATA)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.indices-ignored", &[VAR_11], "indices are ignored: the whole array is read",
        |cnc, call| indices(cnc, call, READ, |_| Vec::new())),
    row("cnc.var.indices-0", &[VAR_11, VAR_14], "whatever the indices, the first element is read",
        |cnc, call| match cnc.answer(call) {
            Ok(_) => indices(cnc, call, READ, |at| vec![0; at.len()]),
            refused => refused,
        }),
    row("cnc.var.indices-from-1", &[VAR_11, VAR_2], "indices of elements are counted from 1",
        |cnc, call| indices(cnc, call, READ, |at| {
            at.into_iter().map(|index| index.wrapping_sub(1)).collect()
        })),
    row("cnc.var.indices-reversed", &[VAR_11], "the indices of an element are read in reverse order",
        |cnc, call| indices(cnc, call, READ, |at| at.into_iter().rev().collect())),
    row("cnc.var.indices-clamped", &[VAR_11], "an index that is out of bounds gives the last element",
        |cnc, call| match (is(call, READ), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_DATA)) => {
                let bounds =
                    described(cnc, call).map(|found| dimensions(&found).0).unwrap_or_default();
                indices(cnc, call, READ, |at| {
                    let bound = |(index, count): (u32, &u32)| index.min(count.saturating_sub(1));
                    if at.len() == bounds.len() {
                        at.into_iter().zip(&bounds).map(bound).collect()
                    } else {
                        at
                    }
                })
            }
            (_, answer) => answer,
        }),
    row("cnc.var.indices-beyond", &[VAR_11], "an index that is out of bounds reads as 0",
        |cnc, call| match (is(call, READ), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_DATA)) => match described(cnc, call) {
                Some(found) => within_length(call, Ok(vec![0; element(&found)])),
                None => Err(AdsError::INVALID_DATA),
            },
            (_, answer) => answer,
        }),
    row("cnc.var.indices-big-endian", &[GEN_1, VAR_11],
        "indices of elements are read with the most significant byte first",
        |cnc, call| indices(cnc, call, READ, |at| at.into_iter().map(u32::swap_bytes).collect())),
    row("cnc.var.indices-8-bit", &[VAR_11], "of an index of an element the lowest byte counts",
        |cnc, call| indices(cnc, call, READ, |at| at.into_iter().map(|index| index & 0xFF).collect())),
    row("cnc.var.indices-more", &[VAR_11], "bytes behind the indices are ignored",
        |cnc, call| match (of_decoder(call), parts(call.data)) {
            (Some(0x47), Some((handle, at, _))) => cnc.with(call, &joined(handle, &at, &[])),
            _ => cnc.answer(call),
        }),
    row("cnc.var.indices-fewer", &[VAR_11], "indices that are missing behind their number are taken for 0",
        |cnc, call| match (of_decoder(call), u32_at(call.data, 4)) {
            (Some(0x47), Some(count @ 1..=8)) if call.data.len() >= 8 => {
                let mut data = call.data.to_vec();
                let len = usize::try_from(count).unwrap_or_default().saturating_mul(4);
                data.resize(len.saturating_add(8).max(data.len()), 0);
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.count-in-bytes", &[VAR_11], "the number of indices is a number of bytes",
        |cnc, call| match of_decoder(call) {
            Some(0x47) => {
                let mut data = call.data.to_vec();
                let bytes = u32_at(&data, 4).unwrap_or_default();
                set_u32(&mut data, 4, bytes >> 2);
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.handle-behind-count", &[VAR_11], "the number of indices stands before the handle",
        |cnc, call| match of_decoder(call) {
            Some(0x47) if call.data.len() >= 8 => {
                let mut data = call.data.to_vec();
                data.get_mut(..8).unwrap_or_default().rotate_left(4);
                cnc.with(call, &data)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.write-indices-ignored", &[VAR_12],
        "a write by handle ignores the indices: it is to the first element",
        |cnc, call| if is(call, WRITE) && parts(call.data).is_some_and(|parts| !parts.1.is_empty()) {
            indices(cnc, call, WRITE, |at| vec![0; at.len()])
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.write-indices-reversed", &[VAR_12], "a write by handle has the indices in reverse order",
        |cnc, call| indices(cnc, call, WRITE, |at| at.into_iter().rev().collect())),
    row("cnc.var.write-indices-from-1", &[VAR_12], "a write by handle counts indices from 1",
        |cnc, call| indices(cnc, call, WRITE, |at| {
            at.into_iter().map(|index| index.wrapping_sub(1)).collect()
        })),
    row("cnc.var.write-indices-beyond", &[VAR_12],
        "a write by handle out of bounds succeeds and changes nothing",
        |cnc, call| match (is(call, WRITE), cnc.answer(call)) {
            (true, Err(AdsError::INVALID_DATA)) => Ok(Vec::new()),
            (_, answer) => answer,
        }),
    row("cnc.var.write-by-handle-at-read", &[VAR_12], "a write by handle takes a ReadWrite, not a Write",
        |cnc, call| match (of_decoder(call), call.service) {
            (Some(0x49), Service::Write) => Err(AdsError::SERVICE_NOT_SUPPORTED),
            (Some(0x49), Service::ReadWrite) => {
                cnc.answer(&Call { service: Service::Write, read_length: 0, ..*call })
            }
            _ => cnc.answer(call),
        }),
];
