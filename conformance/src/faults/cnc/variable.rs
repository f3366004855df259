//! Defects in the descriptions of variables (VAR).

use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, DESCRIPTIONS, ReplyData, Upstream, changed, dimensions, function, group, lookup,
    reply, row, set_u32, text, u32_at,
};

/// The description of the variable that a request to read or write a value addresses by handle or
/// name.
pub(super) fn described(cnc: &Upstream<'_>, call: &Call<'_>) -> Option<Vec<u8>> {
    let handle = match function(call)? {
        Function::ReadByHandle | Function::WriteByHandle => u32_at(call.data, 0)?,
        Function::ReadByName | Function::WriteByName => {
            return lookup::described(cnc, group(call), text(call.data));
        }
        _ => return None,
    };
    let all = [b"V.E".as_slice(), b"V.G", b"V.A"];
    all.into_iter().find_map(|kind| lookup::with_handle(cnc, group(call), kind, handle))
}

/// The reply, truncated after the first element of the variable.
pub(super) fn first_element(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let len = described(cnc, call).map_or(usize::MAX, |found| element(&found));
    changed(cnc, call, |bytes| bytes.truncate(len.max(1)))
}

/// The size in bytes of one element of the variable with this description.
pub(super) fn element(description: &[u8]) -> usize {
    let count = dimensions(description).0.iter().fold(1_u32, |all, one| all.saturating_mul(*one));
    let size = u32_at(description, 12).unwrap_or_default().checked_div(count);
    size.and_then(|size| usize::try_from(size).ok()).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.description-dimensions-reversed", &[VAR_4],
        "the dimensions of a description come in reverse order",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |bytes| {
            let (numbers, _) = dimensions(bytes);
            let mut place = 20_usize;
            for number in numbers.iter().rev() {
                set_u32(bytes, place, *number);
                place = place.saturating_add(4);
            }
        })),
    row("cnc.var.description-largest-index", &[VAR_4, VAR_8],
        "each dimension in a description is the largest index instead of the number of elements",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |bytes| {
            let (numbers, _) = dimensions(bytes);
            let mut place = 20_usize;
            for number in numbers {
                set_u32(bytes, place, number.wrapping_sub(1));
                place = place.saturating_add(4);
            }
        })),
];
