//! Defects of handles of variables (VAR).

use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::ids::*;

use super::{
    CncDefect, after_nul, first, fours, function, group, number, on, row, set_u32, text, u32_at,
};

/// The parts of a request by handle: handle, indices, value.
pub(in crate::faults) fn parts(data: &[u8]) -> Option<(u32, Vec<u32>, &[u8])> {
    let count = usize::try_from(u32_at(data, 4)?).ok()?;
    let end = count.checked_mul(4)?.checked_add(8)?;
    let indices = fours(data.get(8..end)?);
    Some((u32_at(data, 0)?, indices, data.get(end..)?))
}

/// The offset of the value in the data of a write.
pub(in crate::faults) fn value_at(call: &Call<'_>) -> usize {
    let value = match function(call).map_or(&b""[..], |function| first(function.spec().request)) {
        b"name" => after_nul(call.data),
        b"handle" => parts(call.data).map_or(&[][..], |(_, _, value)| value),
        _ => call.data,
    };
    call.data.len().saturating_sub(value.len())
}

pub(in crate::faults) fn joined(handle: u32, indices: &[u32], value: &[u8]) -> Vec<u8> {
    let count = u32::try_from(indices.len()).unwrap_or_default();
    let numbers = [handle, count].into_iter().chain(indices.iter().copied());
    numbers.flat_map(u32::to_le_bytes).chain(value.iter().copied()).collect()
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    on("cnc.var.handle-not-understood", &[VAR_10],
        "the handle that the CNC returns for a name is one that it does not accept",
        &[Function::HandleByName, Function::AxisHandleByName],
        |cnc, call| number(cnc.answer(call), 0, |handle| handle ^ 0x5A00_0000)),
    row("cnc.var.handle-changes", &[VAR_10],
        "each request for a handle by name returns another handle; all of them are valid",
        |cnc, call| match (function(call), parts(call.data)) {
            (Some(Function::HandleByName), _) => {
                let mut answer = cnc.answer(call)?;
                let mut memory = cnc.memory();
                memory.count = memory.count.wrapping_add(1);
                let made = memory.count | 0x7000_0000;
                memory.store((made, 0, Vec::new()), answer.clone());
                set_u32(&mut answer, 0, made);
                Ok(answer)
            }
            (Some(Function::ReadByHandle | Function::WriteByHandle), Some((handle, at, value))) => {
                let kept = cnc.memory().get(&(handle, 0, Vec::new()));
                let handle = kept.and_then(|kept| u32_at(&kept, 0)).unwrap_or(handle);
                cnc.with(call, &joined(handle, &at, value))
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.handle-used-up", &[VAR_10], "a handle is valid for one read",
        |cnc, call| match (function(call), u32_at(call.data, 0)) {
            (Some(Function::ReadByHandle), Some(handle)) => {
                let key = (handle, group(call), b"used".to_vec());
                let used = cnc.memory().get(&key).is_some();
                let answer = if used { Err(AdsError::INVALID_DATA) } else { cnc.answer(call) };
                if answer.is_ok() {
                    cnc.memory().store(key, Vec::new());
                }
                answer
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.handle-last-only", &[VAR_10],
        "a request for a handle by name makes all other handles invalid",
        |cnc, call| match (function(call), u32_at(call.data, 0)) {
            (Some(Function::HandleByName), _) => cnc.answer(call).inspect(|bytes| {
                cnc.memory().count = u32_at(bytes, 0).unwrap_or_default();
            }),
            (Some(Function::ReadByHandle | Function::WriteByHandle), Some(handle))
                if cnc.memory().count != 0 && cnc.memory().count != handle =>
            {
                Err(AdsError::INVALID_DATA)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.handle-needs-name", &[VAR_10],
        "a handle is valid only after it was requested by name, even if a description states it",
        |cnc, call| match (function(call), u32_at(call.data, 0)) {
            (Some(Function::HandleByName), _) => cnc.answer(call).inspect(|bytes| {
                let handle = u32_at(bytes, 0).unwrap_or_default();
                cnc.memory().store((handle, 0, Vec::new()), Vec::new());
            }),
            (Some(Function::ReadByHandle | Function::WriteByHandle), Some(handle))
                if cnc.memory().get(&(handle, 0, Vec::new())).is_none() =>
            {
                Err(AdsError::INVALID_DATA)
            }
            _ => cnc.answer(call),
        }),
    row("cnc.var.handle-shared", &[VAR_10],
        "the handle by name of every V.G variable is that of the V.G variable requested first",
        |cnc, call| match function(call) {
            Some(Function::HandleByName) if text(call.data).starts_with(b"V.G.") => {
                let own = cnc.answer(call)?;
                let key = (group(call), 0, b"shared".to_vec());
                let kept = cnc.memory().get(&key);
                Ok(kept.unwrap_or_else(|| {
                    cnc.memory().store(key, own.clone());
                    own
                }))
            }
            _ => cnc.answer(call),
        }),
    on("cnc.var.handle-0-in-description", &[VAR_4], "the handle in every description by index is 0",
        &[Function::DescribeByIndex], |cnc, call| number(cnc.answer(call), 0, |_| 0)),
    row("cnc.var.handle-of-axis", &[VAR_10],
        "the handle of an axis variable belongs to the axis instead of the axis index",
        |cnc, call| {
            // The logical number of the axis at an axis index of channel 1. Bits 16 to 23 of the
            // handle of an axis variable are the axis index; this defect replaces them by the axis
            // number.
            let axis = |place: u32| {
                let number = cnc.read(AmsPort::COM, 0x12_0101, place << 16 | 3);
                number.ok().and_then(|bytes| bytes.first().copied()).map(u32::from)
            };
            let is_axis = |handle: u32| handle & 0xFF00_FF00 == 0x0100_0000;
            match (function(call), parts(call.data)) {
                (Some(Function::HandleByName | Function::AxisHandleByName), _) => {
                    let mut bytes = cnc.answer(call)?;
                    let handle = u32_at(&bytes, 0).filter(|handle| is_axis(*handle));
                    if let Some(handle) = handle
                        && let Some(number) = axis(handle >> 16 & 0xFF).filter(|one| *one != 0)
                    {
                        set_u32(&mut bytes, 0, handle & 0xFF00_FFFF | number << 16);
                    }
                    Ok(bytes)
                }
                (Some(Function::ReadByHandle), Some((handle, at, value))) if is_axis(handle) => {
                    let place = (1..=3).find(|place| axis(*place) == Some(handle >> 16 & 0xFF));
                    let place = place.ok_or(AdsError::INVALID_DATA)?;
                    cnc.with(call, &joined(handle & 0xFF00_FFFF | place << 16, &at, value))
                }
                _ => cnc.answer(call),
            }
        }),
];
