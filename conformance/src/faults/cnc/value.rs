//! Values and extended descriptions of variables (VAR).

use ads_cnc::address::Class;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::{Call, Function, GroupRule, OffsetRule};
use ads_cnc_vectors::ids::*;

use super::variable::{described, element, first_element};
use super::{
    CncSeed, VALUES, dimensions, function, functions, group, is, is_at, number, offset, on, reply,
    row, set_u32, text, u32_at, within_length,
};

const BY_NAME: &[Function] = &[Function::DescribeByName];
const EXTENDED: &[Function] = &[Function::DescribeExtended];
const CHANNEL: &[Function] = functions!(|spec| matches!(
    (spec.group, spec.offset),
    (GroupRule::ChannelOf(Class::Decoder), OffsetRule::At(_))
));

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    row("cnc.var.value-first", &[VAR_14], "a read by name without an index gives the first element",
        |cnc, call| match (is(call, &[Function::ReadByName]), text(call.data).ends_with(b"]")) {
            (true, false) => first_element(cnc, call),
            _ => cnc.answer(call),
        }),
    row("cnc.var.value-whole", &[VAR_14], "a read by name with an index gives the whole array",
        |cnc, call| if is(call, &[Function::ReadByName]) && text(call.data).ends_with(b"]") {
            let name = text(call.data);
            let whole =
                name.iter().rposition(|byte| *byte == b'[').and_then(|at| name.get(..at));
            cnc.answer(call)?;
            cnc.with(call, &[whole.unwrap_or(name), &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.value-last-missing", &[VAR_14], "a whole array is read without its last element",
        &[Function::ReadByName, Function::ReadByHandle], |cnc, call| {
            let found = described(cnc, call);
            let len = found.as_deref().map_or(0, element);
            let whole = found.as_deref().and_then(|found| u32_at(found, 12));
            cnc.answer(call).map(|mut bytes| {
                if u32::try_from(bytes.len()).ok() == whole && bytes.len() > len {
                    bytes.truncate(bytes.len().saturating_sub(len));
                }
                bytes
            })
        }),
    row("cnc.var.value-1024", &[VAR_14], "values are cut at 1024 bytes",
        |cnc, call| reply(cnc, call, VALUES, |mut bytes| {
            bytes.truncate(1024);
            bytes
        })),
    row("cnc.var.value-aligned", &[VAR_14], "values take 4 bytes at least",
        |cnc, call| if is(call, VALUES) && call.read_length >= 4 {
            cnc.answer(call).map(|mut bytes| {
                bytes.resize(bytes.len().max(4), 0);
                bytes
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.value-real", &[VAR_14, VAR_5], "integers of 4 bytes are read as REAL64",
        |cnc, call| if is(call, VALUES) && call.read_length >= 8 {
            cnc.answer(call).map(|bytes| match u32_at(&bytes, 0) {
                Some(number) if bytes.len() == 4 => f64::from(number).to_le_bytes().to_vec(),
                _ => bytes,
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.value-typed", &[VAR_14], "values come with the length in front",
        |cnc, call| reply(cnc, call, VALUES, |bytes| {
            let len = u32::try_from(bytes.len()).unwrap_or_default();
            [&len.to_le_bytes(), bytes.as_slice()].concat()
        })),
    row("cnc.var.value-2048", &[VAR_14], "values are padded to 2048 bytes",
        |cnc, call| reply(cnc, call, VALUES, |mut bytes| {
            bytes.resize(2048, 0);
            bytes
        })),
    row("cnc.var.value-by-handle-other", &[VAR_14, VAR_11],
        "a value read by handle is the one of before the last write by name",
        |cnc, call| {
            let key = |call: &Call<'_>| (group(call), 0, call.data.to_vec());
            match function(call) {
                Some(Function::ReadByHandle) => {
                    let kept = cnc.memory().get(&key(call));
                    match kept {
                        Some(kept) => within_length(call, Ok(kept)),
                        None => cnc.answer(call).inspect(|bytes| {
                            cnc.memory().store(key(call), bytes.clone());
                        }),
                    }
                }
                _ => cnc.answer(call),
            }
        }),
    row("cnc.var.arrays-reversed", &[VAR_14], "elements of a whole array come in reverse order by name",
        |cnc, call| if is(call, &[Function::ReadByName]) && !text(call.data).ends_with(b"]") {
            let len = described(cnc, call).map_or(0, |found| element(&found));
            cnc.answer(call).map(|bytes| match len {
                0 => bytes,
                len => bytes.rchunks(len).flatten().copied().collect(),
            })
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.extended-from-0", &[VAR_15], "synchronisation and validity are 0 or 1",
        |cnc, call| reply(cnc, call, EXTENDED, |mut bytes| {
            for place in [0, 4] {
                let code = u32_at(&bytes, place).unwrap_or_default();
                set_u32(&mut bytes, place, code.saturating_sub(1));
            }
            bytes
        })),
    row("cnc.var.extended-short", &[VAR_15], "the extended description is synchronisation alone",
        |cnc, call| reply(cnc, call, EXTENDED, |mut bytes| {
            bytes.truncate(4);
            bytes
        })),
    row("cnc.var.extended-bytes", &[VAR_15], "synchronisation and validity are one byte each",
        |cnc, call| reply(cnc, call, EXTENDED, |bytes| bytes.into_iter().step_by(4).collect())),
    row("cnc.var.extended-none", &[VAR_15], "V.E has no extended description",
        |cnc, call| reply(cnc, call, EXTENDED, |_| Vec::new())),
    on("cnc.var.extended-refused", &[VAR_15, VAR_16], "there is no extended description: it is refused",
        EXTENDED, |_, _| Err(AdsError::SERVICE_NOT_SUPPORTED)),
    row("cnc.var.extended-of-global", &[VAR_16], "V.G has an extended description",
        |cnc, call| if is(call, EXTENDED) && text(call.data.get(4..).unwrap_or_default()) == b"V.G" {
            within_length(call, cnc.answer(call).map(|_| vec![2, 0, 0, 0, 2, 0, 0, 0]))
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.extended-of-axis", &[VAR_16], "V.A has an extended description of zeros",
        |cnc, call| if is(call, EXTENDED) && text(call.data.get(4..).unwrap_or_default()) == b"V.A" {
            within_length(call, cnc.answer(call).map(|_| vec![0; 8]))
        } else {
            cnc.answer(call)
        }),
    on("cnc.var.string-cut", &[VAR_25], "a STRING is read as its first 8 bytes",
        VALUES, |cnc, call| {
            let is_text =
                described(cnc, call).is_some_and(|found| u32_at(&found, 4) == Some(9));
            cnc.answer(call).map(|mut bytes| {
                if is_text && bytes.len() >= 20 {
                    bytes.truncate(8);
                }
                bytes
            })
        }),
    on("cnc.var.by-name-with-name", &[VAR_28], "a description by name has the name behind it",
        BY_NAME, |cnc, call| within_length(
            call,
            cnc.whole(call).map(|bytes| [bytes.as_slice(), text(call.data), &[0]].concat()),
        )),
    on("cnc.var.by-name-handle-0", &[VAR_28], "a description by name has no handle: it is 0",
        BY_NAME, |cnc, call| number(cnc.answer(call), 0, |_| 0)),
    row("cnc.var.by-name-header", &[VAR_28], "a description by name ends behind the number of dimensions",
        |cnc, call| reply(cnc, call, BY_NAME, |mut bytes| {
            bytes.truncate(20);
            bytes
        })),
    on("cnc.var.by-name-of-first", &[VAR_28], "a description by name is that of the first variable of V.E",
        BY_NAME, |cnc, call| {
            cnc.answer(call)?;
            let mut first = cnc.ask(group(call), 0x45, b"\0\0\0\0V.E\0")?;
            first.truncate(dimensions(&first).1);
            within_length(call, Ok(first))
        }),
    row("cnc.var.channel-ignored", &[VAR_14, VAR_2],
        "variables are those of channel 1, whatever the channel",
        |cnc, call| if is_at(call, CHANNEL) {
            cnc.at(call, 0x12_2301, offset(call))
        } else {
            cnc.answer(call)
        }),
];
