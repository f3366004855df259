//! Defects in the names of variables, and in accesses by name (VAR).

use ads_cnc::ads::AdsError;
use ads_cnc::operation::Function;
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, NAMED, after_nul, at, changed, descriptions, dimensions, forgiven, function, group,
    is, is_at, is_lookup, name_in, of_decoder, on, reply, row, text, u32_at,
};
use crate::edition::Edition;

const BY_NAME: &[Function] = &[Function::ReadByName, Function::HandleByName];

/// A row whose defect is detectable in the German edition only.
const fn german(mut row: CncDefect) -> CncDefect {
    row.edition = Some(Edition::German);
    row
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    row("cnc.var.name-of-200", &[VAR_9],
        "the CNC rejects names of variables with more than 200 characters",
        |cnc, call| if is(call, NAMED) && text(call.data).len() > 200 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-of-254", &[VAR_9],
        "the CNC rejects names of variables with 255 characters, the maximum",
        |cnc, call| if is(call, NAMED) && text(call.data).len() > 254 {
            Err(AdsError::INVALID_SIZE)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-of-256", &[VAR_9],
        "the CNC cuts a name of more than 256 bytes including NULs, and looks it up",
        |cnc, call| if is_lookup(call) && call.data.len() > 256 {
            let name = text(call.data);
            cnc.with(call, &[name.get(..255).unwrap_or(name), &[0]].concat())
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.name-not-ended", &[VAR_9], "the CNC accepts a name in a query only without a NUL",
        |cnc, call| if !is_lookup(call) {
            cnc.answer(call)
        } else if call.data.contains(&0) {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.with(call, &[call.data, &[0]].concat())
        }),
    on("cnc.var.name-one-character", &[VAR_9],
        "an unknown name addresses the variable whose name lacks the last character",
        BY_NAME, |cnc, call| match cnc.answer(call) {
            Err(AdsError::SYMBOL_NOT_FOUND) => {
                let name = text(call.data);
                let name = name.split_last().map_or(name, |(_, name)| name);
                cnc.with(call, &[name, &[0]].concat())
            }
            answer => answer,
        }),
    on("cnc.var.name-unknown", &[VAR_9, VAR_20],
        "a request for the handle or the value of an unknown name returns four zero bytes",
        BY_NAME, |cnc, call| match cnc.answer(call) {
            Err(AdsError::SYMBOL_NOT_FOUND) => Ok(vec![0; 4]),
            answer => answer,
        }),
    on("cnc.var.name-unknown-nothing", &[VAR_9, VAR_20],
        "a request for the handle or the value of an unknown name succeeds without data",
        BY_NAME, |cnc, call| forgiven(cnc.answer(call), AdsError::SYMBOL_NOT_FOUND)),
    row("cnc.var.cycle-has-handle", &[VAR_18],
        "the CNC returns handles for V.CYC variables and reads the variables by them",
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
    row("cnc.var.cycle-refused", &[VAR_18],
        "the CNC rejects the names of V.CYC variables as unknown",
        |cnc, call| if is(call, NAMED) && text(call.data).starts_with(b"V.CYC.") {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    german(row("cnc.var.dynamic-has-handle", &[VAR_18],
        "the CNC returns handles for the names of V.P, V.L and V.S",
        |cnc, call| match (function(call), call.data) {
            (Some(Function::HandleByName), [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => {
                cnc.ask(group(call), 0x48, call.data)?;
                Ok(0x7D00_0001_u32.to_le_bytes().to_vec())
            }
            _ => cnc.answer(call),
        })),
    german(row("cnc.var.dynamic-refused", &[VAR_19],
        "the CNC rejects the names of V.P, V.L and V.S on the channel interface",
        |cnc, call| match (is_at(call, NAMED), call.data) {
            (true, [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => Err(AdsError::SYMBOL_NOT_FOUND),
            _ => cnc.answer(call),
        })),
    german(row("cnc.var.dynamic-4-bytes", &[VAR_19],
        "a read of V.P, V.L or V.S on the channel interface returns 4 bytes instead of 8",
        |cnc, call| match (of_decoder(call), call.data) {
            (Some(0x48), [b'V', b'.', b'P' | b'L' | b'S', b'.', ..]) => {
                changed(cnc, call, |bytes| bytes.truncate(4))
            }
            _ => cnc.answer(call),
        })),
    on("cnc.var.structure-answered", &[VAR_20],
        "the name of a structure addresses the first V.E variable in the structure",
        BY_NAME, |cnc, call| match cnc.answer(call) {
            Err(AdsError::SYMBOL_NOT_FOUND) => {
                let structure = [text(call.data), b"."].concat();
                let mut all = descriptions(cnc, group(call), b"V.E");
                let leaf = all.find(|found| name_in(found).starts_with(&structure));
                let name = leaf.as_deref().map_or(text(call.data), name_in);
                cnc.with(call, &[name, &[0]].concat())
            }
            answer => answer,
        }),
    on("cnc.var.path-index-ignored", &[VAR_20],
        "the CNC treats each index before a dot in a name as 0: V.G.NP[1].V is V.G.NP[0].V",
        BY_NAME, |cnc, call| {
            let name = text(call.data);
            let last_dot = name.iter().rposition(|&byte| byte == b'.').unwrap_or_default();
            let (path, element) = name.split_at_checked(last_dot).unwrap_or_default();
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
        "the CNC rejects names that end with the index of an element",
        |cnc, call| if is(call, NAMED) && text(call.data).ends_with(b"]") {
            Err(AdsError::SYMBOL_NOT_FOUND)
        } else {
            cnc.answer(call)
        }),
    row("cnc.var.leaves-without-structure", &[VAR_20, VAR_4],
        "names in descriptions lack structures: V.E.array_uns32 for V.E.struct.array_uns32",
        |cnc, call| reply(cnc, call, &[Function::DescribeByIndex], |bytes| {
            let (head, name) =
                bytes.split_at_checked(dimensions(bytes).1).unwrap_or_default();
            let name = text(name);
            let last = name.rsplit(|byte| *byte == b'.').next().unwrap_or_default();
            let kind = name.get(..4).unwrap_or_default();
            *bytes = [head, kind, last, &[0]].concat();
        })),
    on("cnc.var.name-dashes", &[VAR_9, VAR_20],
        "the CNC expects a colon instead of the dot after a structure: V.E.struct:array_uns32",
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
        "the CNC rejects requests for a description by name (0x4C), although its version has it",
        |cnc, call| match of_decoder(call) {
            Some(0x4C) => Err(AdsError::INVALID_OFFSET),
            _ => cnc.answer(call),
        }),
];
