//! Builds the replies of generated defects, such as the reply to a request with another argument.

use ads_cnc::address::{Class, IndexOffset};
use ads_cnc::operation::{AdsService, Call, Function, OffsetRule};

use self::Argument::{Axis, Channel, Index};
use super::super::cnc::{
    ReplyData, Upstream, after_nul, class, first, function, group, indexed, joined, offset, parts,
    set_u32, text, u32_at, value_at, with_indices,
};

/// A number in a request that a defect can replace.
#[derive(Clone, Copy)]
pub(super) enum Argument {
    Channel,
    Axis,
    Index,
}

/// The reply to the request with another value of an argument; `None` if the call is not a valid
/// request for a function or lacks the argument, or if `other` does not change the value. Also
/// `None` for an argument of 0 in the index group or offset, and for the channel or axis of a
/// spindle.
pub(super) fn asked(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    argument: Argument,
    other: impl Fn(u32) -> u32,
) -> Option<ReplyData> {
    let spec = function(call)?.spec();
    let field = |at| u32_at(call.data, at).map(|number| (number, other(number)));
    let data = |at| {
        field(at).filter(|(old, new)| old != new).map(|(_, new)| {
            let mut data = call.data.to_vec();
            set_u32(&mut data, at, new);
            cnc.with(call, &data)
        })
    };
    let part = |number: u32, shift: u32, mask: u32| {
        let old = number >> shift & mask;
        let new = other(old) & mask;
        (old != 0 && old != new).then(|| number & !(mask << shift) | new << shift)
    };
    match (argument, spec.offset, first(spec.request)) {
        (Channel | Axis, ..) if class(call).is_some_and(|class| class.class == Class::Spindle) => {
            None
        }
        (Channel, _, b"channel") => data(0),
        (Axis, _, b"channel") => data(4),
        (Channel, ..) => part(group(call), 0, 0xFF).map(|group| cnc.at(call, group, offset(call))),
        (Axis, ..) => {
            part(offset(call), 16, 0xFFFF).map(|offset| cnc.at(call, group(call), offset))
        }
        (Index, OffsetRule::AtLeast(_), _) => {
            part(offset(call), 0, 0xFFFF).map(|offset| cnc.at(call, group(call), offset))
        }
        (Index, _, b"index") => data(0),
        (Index, _, b"handle") => {
            let (handle, mut indices, value) = parts(call.data)?;
            let last = indices.last_mut()?;
            let old = std::mem::replace(last, other(*last));
            (indices.last() != Some(&old)).then(|| cnc.with(call, &joined(handle, &indices, value)))
        }
        (Index, _, b"name") => {
            let (name, mut indices) = indexed(text(call.data));
            let last = indices.last_mut()?;
            let old = std::mem::replace(last, other(*last));
            let data = [&with_indices(name, &indices), after_nul(call.data)].concat();
            (indices.last() != Some(&old)).then(|| cnc.with(call, &data))
        }
        _ => None,
    }
}

/// The reply to the request with another value of an argument, if the CNC accepts the changed
/// request. Unless the service is Write, it must also accept the original request. Otherwise the
/// correct reply.
pub(super) fn mistaken(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    argument: Argument,
    other: impl Fn(u32) -> u32,
) -> ReplyData {
    if call.service != AdsService::Write {
        cnc.answer(call)?;
    }
    asked(cnc, call, argument, other).filter(Result::is_ok).unwrap_or_else(|| cnc.answer(call))
}

/// The correct reply; if the CNC rejects the request, the reply to the request with another value
/// of an argument, or the error if `asked` returns `None`.
pub(super) fn instead(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    argument: Argument,
    other: impl Fn(u32) -> u32,
) -> ReplyData {
    cnc.answer(call).or_else(|error| asked(cnc, call, argument, other).unwrap_or(Err(error)))
}

/// The index of the first variable, array element, parameter, object or element in a request for
/// the function: 0 for variables and their array elements, otherwise 1.
pub(super) fn least(call: &Call<'_>) -> u32 {
    // The indices of variables and of array elements start at 0 (VAR-2, VAR-20). Element 0 of an
    // instance is the number of its elements (SDA-4).
    u32::from(!function(call).is_some_and(|function| function.spec().clause.starts_with("VAR")))
}

/// Reads the old value and executes the write. If both succeed, also writes the result of `other`
/// for the new and the old value to the same address. Returns the reply to the first write, or an
/// error if the old value could not be read.
pub(super) fn rewritten(
    cnc: &Upstream<'_>,
    call: &Call<'_>,
    other: impl Fn(&[u8], &[u8]) -> Vec<u8>,
) -> ReplyData {
    let (head, new) = call.data.split_at_checked(value_at(call)).unwrap_or_default();
    let (service, back) = match function(call) {
        Some(Function::WriteByHandle | Function::WriteByName) => (AdsService::ReadWrite, 2),
        Some(Function::AxisWriteByName) => (AdsService::ReadWrite, 1),
        _ => (AdsService::Read, 0),
    };
    let index_offset = IndexOffset::new(offset(call).wrapping_sub(back));
    let old = cnc.whole(&Call { service, index_offset, data: head, ..*call });
    let reply = cnc.answer(call)?;
    let _ = cnc.with(call, &[head, &other(new, &old?)].concat());
    Ok(reply)
}

/// The key under which an operator stores a reply in the memory of the defect.
pub(super) fn kept() -> (u32, u32, Vec<u8>) {
    (0, 0, b"kept".to_vec())
}

/// The reply to the request for the first kind of variables (V.E) or dynamic parameters (P).
pub(super) fn of_first_kind(cnc: &Upstream<'_>, call: &Call<'_>) -> ReplyData {
    match function(call).map(|function| (function.spec().offset, first(function.spec().request))) {
        Some((OffsetRule::OfKind([least, ..]), _)) => cnc.at(call, group(call), least),
        Some((_, b"index")) => {
            cnc.with(call, &[call.data.get(..4).unwrap_or_default(), b"V.E\0"].concat())
        }
        _ => cnc.with(call, b"V.E\0"),
    }
}
