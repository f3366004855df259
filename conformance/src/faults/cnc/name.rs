//! Defects in the names of variables (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::variable::without_indices;
use super::{
    CncDefect, NAMED, after_nul, at, function, group, is, is_at, is_lookup, of_decoder, on, row,
    text, u32_at,
};
use crate::edition::Edition;

/// A row whose defect is detectable in the German edition only.
const fn german(mut row: CncDefect) -> CncDefect {
    row.edition = Some(Edition::German);
    row
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.name-of-200", &[VAR_9], "names of more than 200 characters are rejected",
        |cnc, call| if is(call, NAMED) && text(call.data).len() > 200 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-of-254", &[VAR_9], "names take 254 characters at most",
        |cnc, call| if is(call, NAMED) && text(call.data).len() > 254 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-of-256", &[VAR_9], "names of more than 255 characters are cut and looked up",
        |cnc, call| if is_lookup(call) && call.data.len() > 256 {
            let name = text(call.data);
            cnc.with(call, &[name.get(..255).unwrap_or(name), &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-not-ended", &[VAR_9], "names with a NUL are rejected",
        |cnc, call| if !is_lookup(call) {
            cnc.answer(call)
        } else if call.data.contains(&0) {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.with(call, &[call.data, &[0]].concat())
        }),
    row("cnc.var.name-one-character", &[VAR_9],
        "an absent name is answered as the name with one character less",
        |cnc, call| match (
            is(call, &[Function::ReadByName, Function::HandleByName]),
            cnc.answer(call),
        ) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => {
                let name = text(call.data);
                let name = name.split_last().map_or(name, |(_, name)| name);
                cnc.with(call, &[name, &[0]].concat())
            }
            (_, answer) => answer,
        }),
    row("cnc.var.name-unknown", &[VAR_9, VAR_20],
        "a name that is not there has the handle 0 and the value 0",
        |cnc, call| match (
            is(call, &[Function::ReadByName, Function::HandleByName]),
            cnc.answer(call),
        ) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => Ok(vec![0; 4]),
            (_, answer) => answer,
        }),
    row("cnc.var.name-unknown-nothing", &[VAR_9, VAR_20],
        "a name that is not there is answered without an error and without data",
        |cnc, call| match (
            is(call, &[Function::ReadByName, Function::HandleByName]),
            cnc.answer(call),
        ) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => Ok(Vec::new()),
            (_, answer) => answer,
        }),
    row("cnc.var.cycle-has-handle", &[VAR_18], "V.CYC has handles, by which it is read",
        |cnc, call| match (function(call), u32_at(call.data, 0)) {
            (Some(Function::HandleByName), _) if text(call.data).starts_with(b"V.CYC.") => {
                cnc.answer(&at(call, group(call), 0x48))
                    .or_else(|_| cnc.ask(group(call), 0x48, call.data))?;
                cnc.memory().store((0x7C00_0001, 0, Vec::new()), call.data.to_vec());
                Ok(0x7C00_0001_u32.to_le_bytes().to_vec())
            }
            (Some(Function::ReadByHandle), Some(0x7C00_0001)) => {
                let name = cnc.memory().get(&(0x7C00_0001, 0, Vec::new()));
                cnc.ask(group(call), 0x48, &name.unwrap_or_default())
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.cycle-refused", &[VAR_18], "V.CYC is not there at all",
        |cnc, call| if is(call, NAMED) && text(call.data).starts_with(b"V.CYC.") {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    german(row("cnc.var.dynamic-has-handle", &[VAR_18], "V.P, V.L and V.S have handles",
        |cnc, call| match (function(call), call.data) {
            (Some(Function::HandleByName), [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => {
                cnc.ask(group(call), 0x48, call.data)?;
                Ok(0x7D00_0001_u32.to_le_bytes().to_vec())
            }
            _ => cnc.answer(call),
        })),
    german(row("cnc.var.dynamic-refused", &[VAR_19],
        "V.P, V.L and V.S are not reached through the channel interface",
        |cnc, call| match (is_at(call, NAMED), call.data) {
            (true, [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => Err(AdsError::SYMBOL_NOT_FOUND),
            _ => cnc.answer(call),
        })),
    german(row("cnc.var.dynamic-4-bytes", &[VAR_19],
        "V.P, V.L and V.S are 4 bytes through the channel interface",
        |cnc, call| match (of_decoder(call), call.data) {
            (Some(0x48), [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => {
                cnc.answer(call).map(|mut bytes| {
                    bytes.truncate(4);
                    bytes
                })
            }
            _ => cnc.answer(call),
        })),
    row("cnc.var.structure-answered", &[VAR_20], "the name of a structure is answered as its first element",
        |cnc, call| match (
            is(call, &[Function::ReadByName, Function::HandleByName]),
            cnc.answer(call),
        ) {
            (true, Err(AdsError::SYMBOL_NOT_FOUND)) => {
                let structure = [text(call.data), b"."].concat();
                let count = super::number::count(cnc, call, b"V.E");
                let leaf = (0..count).find_map(|index| {
                    let data = [&index.to_le_bytes(), b"V.E\0".as_slice()].concat();
                    let found = cnc.ask(group(call), 0x45, &data).ok()?;
                    let name = text(found.get(super::dimensions(&found).1..)?).to_vec();
                    name.starts_with(&structure).then_some(name)
                });
                cnc.with(call, &[leaf.as_deref().unwrap_or(text(call.data)), &[0]].concat())
            }
            (_, answer) => answer,
        }),
    on("cnc.var.path-index-ignored", &[VAR_20],
        "an index within a name is ignored: V.G.NP[1].V is V.G.NP[0].V",
        &[Function::ReadByName, Function::HandleByName], |cnc, call| {
            let name = text(call.data);
            let path = without_indices(name);
            let element = name.get(path.len()..).unwrap_or_default();
            let mut inside = false;
            let path = path.iter().filter_map(|&byte| {
                let digit = inside && byte.is_ascii_digit();
                inside = byte == b'[' || inside && byte != b']';
                (!digit).then_some(byte)
            });
            let path: Vec<u8> = path
                .flat_map(|byte| match byte {
                    b'[' => vec![b'[', b'0'],
                    byte => vec![byte],
                })
                .collect();
            cnc.with(call, &[path.as_slice(), element, &[0]].concat())
                .or_else(|_| cnc.answer(call))
        }),
    row("cnc.var.element-by-name-refused", &[VAR_20, VAR_14],
        "names with an index of an element are rejected",
        |cnc, call| if is(call, NAMED) && text(call.data).ends_with(b"]") {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.leaves-without-structure", &[VAR_20, VAR_4],
        "descriptions have the last part of a name alone: V.E.array_sgn32",
        |cnc, call| super::reply(cnc, call, &[Function::DescribeByIndex], |bytes| {
            let (head, name) =
                bytes.split_at_checked(super::dimensions(&bytes).1).unwrap_or_default();
            let name = text(name);
            let last = name.rsplit(|byte| *byte == b'.').next().unwrap_or_default();
            let kind = name.get(..4).unwrap_or_default();
            [head, kind, last, &[0]].concat()
        })),
    on("cnc.var.name-dashes", &[VAR_9, VAR_20],
        "structures are divided by a colon, V.E.struct:array_uns32, not by a dot",
        NAMED, |cnc, call| {
            let head = call.data.get(..4).unwrap_or_default();
            let name = text(call.data.get(4..).unwrap_or_default());
            if name.contains(&b'.') {
                return Err(AdsError::SYMBOL_NOT_FOUND);
            }
            let name: Vec<u8> =
                name.iter().map(|byte| if *byte == b':' { b'.' } else { *byte }).collect();
            cnc.with(call, &[head, &name, &[0], after_nul(call.data)].concat())
        }),
    row("cnc.var.by-name-unavailable", &[VAR_28],
        "there is no description by name, though the version has it",
        |cnc, call| match of_decoder(call) {
            Some(0x4C) => Err(AdsError::INVALID_OFFSET),
            _ => cnc.answer(call),
        }),
];
