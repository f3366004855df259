//! Descriptions of variables (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::number::count;
use super::{
    CncSeed, DESCRIPTIONS, ReplyData, Upstream, dimensions, function, group, on, reply, row,
    set_u32, text, u32_at, within_length,
};

const DESCRIBE: &[Function] = &[Function::DescribeByIndex];

/// The description of the variable with the handle or name of the request.
pub(super) fn described(cnc: &Upstream<'_>, call: &Call<'_>) -> Option<Vec<u8>> {
    let handle = match function(call)? {
        Function::ReadByHandle | Function::WriteByHandle => u32_at(call.data, 0)?,
        Function::ReadByName | Function::WriteByName => {
            let name = text(call.data);
            let whole = without_indices(name);
            let found = cnc.ask(group(call), 0x4C, &[whole, &[0]].concat()).ok()?;
            return Some(found);
        }
        _ => return None,
    };
    let all = [b"V.E".as_slice(), b"V.G", b"V.A"];
    all.into_iter().find_map(|kind| {
        (0..count(cnc, call, kind)).find_map(|index| {
            let data = [&index.to_le_bytes(), kind, &[0]].concat();
            let found = cnc.ask(group(call), 0x45, &data).ok()?;
            (u32_at(&found, 0) == Some(handle)).then_some(found)
        })
    })
}

/// A name without the indices of an element.
pub(super) fn without_indices(mut name: &[u8]) -> &[u8] {
    while name.ends_with(b"]") {
        let Some(at) = name.iter().rposition(|byte| *byte == b'[') else { break };
        name = name.get(..at).unwrap_or_default();
    }
    name
}

/// The answer truncated after the first element of the variable.
pub(super) fn first_element(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    let len = described(cnc, call).map_or(usize::MAX, |found| element(&found));
    cnc.answer(call).map(|mut bytes| {
        bytes.truncate(len.max(1));
        bytes
    })
}

/// Size of one element in bytes.
pub(super) fn element(description: &[u8]) -> usize {
    let count = dimensions(description).0.iter().fold(1_u32, |all, one| all.saturating_mul(*one));
    let size = u32_at(description, 12).unwrap_or_default().checked_div(count);
    size.and_then(|size| usize::try_from(size).ok()).unwrap_or_default()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    on("cnc.var.description-of-next", &[VAR_4], "the name in a description is that of the variable behind",
        DESCRIBE, |cnc, call| {
            let own = cnc.answer(call)?;
            let next = u32_at(call.data, 0).unwrap_or_default().wrapping_add(1);
            let kind = call.data.get(4..).unwrap_or_default();
            let next = cnc.ask(group(call), 0x45, &[&next.to_le_bytes(), kind].concat());
            let Ok(next) = next else { return Ok(own) };
            let head = own.get(..dimensions(&own).1).unwrap_or_default();
            let name = next.get(dimensions(&next).1..).unwrap_or_default();
            within_length(call, Ok([head, name].concat()))
        }),
    row("cnc.var.description-name-short", &[VAR_4], "the name in a description lacks its kind and the dot",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            bytes.drain(name..name.saturating_add(4).min(bytes.len()));
            bytes
        })),
    row("cnc.var.description-name-upper-case", &[VAR_4],
        "the name in a description is in upper case, and not found so",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            bytes.get_mut(name..).unwrap_or_default().make_ascii_uppercase();
            bytes
        })),
    row("cnc.var.description-name-32", &[VAR_4], "the name in a description has 31 characters at most",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            let room = name.saturating_add(31);
            if bytes.len() > room.saturating_add(1) {
                bytes.truncate(room);
                bytes.push(0);
            }
            bytes
        })),
    row("cnc.var.description-name-missing", &[VAR_4], "a description ends without a name",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            bytes.truncate(name);
            bytes
        })),
    row("cnc.var.description-name-first", &[VAR_4], "the name stands at the start of a description",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            let place = name.min(bytes.len());
            bytes.rotate_left(place);
            bytes
        })),
    row("cnc.var.description-dimensions-behind", &[VAR_4],
        "the elements in each dimension stand behind the name",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            if let Some(rest) = bytes.get_mut(20..) {
                rest.rotate_left(name.saturating_sub(20).min(rest.len()));
            }
            bytes
        })),
    row("cnc.var.description-dimensions-missing", &[VAR_4],
        "a description has no dimensions: m is 0 for arrays too",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            bytes.drain(20.min(bytes.len())..name);
            set_u32(&mut bytes, 16, 0);
            bytes
        })),
    row("cnc.var.description-dimensions-reversed", &[VAR_4],
        "the dimensions of a description come in reverse order",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |mut bytes| {
            let (numbers, _) = dimensions(&bytes);
            let mut place = 20_usize;
            for number in numbers.iter().rev() {
                set_u32(&mut bytes, place, *number);
                place = place.saturating_add(4);
            }
            bytes
        })),
    row("cnc.var.description-largest-index", &[VAR_4, VAR_8],
        "a description has the largest index of each dimension, not the number of elements",
        |cnc, call| reply(cnc, call, DESCRIPTIONS, |mut bytes| {
            let (numbers, _) = dimensions(&bytes);
            let mut place = 20_usize;
            for number in numbers {
                set_u32(&mut bytes, place, number.wrapping_sub(1));
                place = place.saturating_add(4);
            }
            bytes
        })),
    row("cnc.var.description-two-dimensions", &[VAR_4],
        "a description has the numbers of two dimensions, whatever m is",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (numbers, name) = dimensions(&bytes);
            if numbers.len() < 2 && name <= bytes.len() {
                let missing = 2_usize.saturating_sub(numbers.len()).saturating_mul(4);
                bytes.splice(name..name, vec![0; missing]);
            }
            bytes
        })),
    row("cnc.var.description-dimensions-16-bit", &[VAR_4, GEN_2],
        "the elements in each dimension are UNS16",
        |cnc, call| reply(cnc, call, DESCRIBE, |bytes| {
            let (numbers, name) = dimensions(&bytes);
            let narrow = |number: &u32| number.to_le_bytes().into_iter().take(2);
            let numbers: Vec<u8> = numbers.iter().flat_map(narrow).collect();
            let (head, name) = (bytes.get(..20), bytes.get(name..));
            [head.unwrap_or_default(), &numbers, name.unwrap_or_default()].concat()
        })),
    row("cnc.var.description-type-access-swapped", &[VAR_4], "a description has access before type",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (one, other) = (u32_at(&bytes, 4), u32_at(&bytes, 8));
            set_u32(&mut bytes, 4, other.unwrap_or_default());
            set_u32(&mut bytes, 8, one.unwrap_or_default());
            bytes
        })),
    row("cnc.var.description-2100-bytes", &[VAR_4], "the name field of a description takes 2048 bytes",
        |cnc, call| reply(cnc, call, DESCRIBE, |mut bytes| {
            let (_, name) = dimensions(&bytes);
            bytes.resize(name.saturating_add(2048), 0);
            bytes
        })),
    row("cnc.var.description-at-4d", &[VAR_4], "variables are described at 0x4D, and not at 0x45",
        |cnc, call| match super::of_decoder(call) {
            Some(0x45) => Err(AdsError::INVALID_OFFSET),
            Some(0x4D) => cnc.at(call, group(call), 0x45),
            _ => cnc.answer(call),
        }),
];
