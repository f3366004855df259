//! Classifies requests.

use ads_cnc::address::{ClassGroup, ComGroup, Group, IndexGroup, IndexOffset};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Call, Effect, Function, OffsetRule};

/// A constant list of the functions whose row in the function table has a property.
macro_rules! functions {
    (|$spec:ident| $has:expr) => {{
        const FOUND: ([Function; Function::ALL.len()], usize) = {
            let mut found = [Function::CountObjects; Function::ALL.len()];
            let (mut rest, mut len) = (Function::ALL, 0_usize);
            while let [function, others @ ..] = rest {
                let $spec = function.spec();
                if $has && let Some(free) = found.split_at_mut(len).1.first_mut() {
                    *free = *function;
                    len = len.saturating_add(1);
                }
                rest = others;
            }
            (found, len)
        };
        FOUND.0.split_at(FOUND.1).0
    }};
}
pub(in crate::faults) use functions;

/// The name of the first field of a stream.
pub(in crate::faults) const fn first(stream: Option<Stream>) -> &'static [u8] {
    let Some(stream) = stream else { return &[] };
    let [field, ..] = stream.layout().fields else { return &[] };
    field.name.as_bytes()
}

/// Functions of the channel interface whose request begins with a name.
pub(in crate::faults) const NAMED: &[Function] =
    functions!(|spec| matches!((spec.offset, first(spec.request)), (OffsetRule::At(_), b"name")));

/// Functions that write a variable.
pub(in crate::faults) const WRITES: &[Function] =
    functions!(|spec| matches!(spec.effect, Effect::Write));

/// Functions whose reply is the value of a variable.
pub(in crate::faults) const VALUES: &[Function] =
    functions!(|spec| matches!(spec.reply, Some(Stream::VariableValue)));

/// Functions whose reply is a description of a variable that starts with its handle.
pub(in crate::faults) const DESCRIPTIONS: &[Function] =
    functions!(|spec| matches!(first(spec.reply), b"handle")
        && !matches!(spec.reply, Some(Stream::VariableHandle)));

/// Functions whose request is the index and the kind of a variable.
pub(in crate::faults) const INDEXED: &[Function] =
    functions!(|spec| matches!(spec.request, Some(Stream::VariableIndexKind)));

/// Functions whose reply is the name, the type or the unit of an element.
pub(in crate::faults) const ELEMENT_TEXTS: &[Function] =
    functions!(|spec| matches!(spec.reply, Some(Stream::ElementText)));

/// The same request at another address.
pub(in crate::faults) fn at<'c>(call: &Call<'c>, group: u32, offset: u32) -> Call<'c> {
    let (index_group, index_offset) = (IndexGroup::new(group), IndexOffset::new(offset));
    Call { index_group, index_offset, ..*call }
}

pub(in crate::faults) const fn group(call: &Call<'_>) -> u32 {
    call.index_group.get()
}

pub(in crate::faults) const fn offset(call: &Call<'_>) -> u32 {
    call.index_offset.get()
}

/// The bit of the index group that is set in logical addressing and clear in addressing by index.
pub(in crate::faults) const LOGICAL: u32 = 0x10_0000;

/// The function that a call requests; `None` if the call is not a valid request for a function.
pub(in crate::faults) fn function(call: &Call<'_>) -> Option<Function> {
    call.dispatch().ok().map(|request| request.function())
}

pub(in crate::faults) fn is(call: &Call<'_>, functions: &[Function]) -> bool {
    function(call).is_some_and(|function| functions.contains(&function))
}

/// The parts of an index group of SDA or GEO; `None` for other groups.
pub(in crate::faults) fn class(call: &Call<'_>) -> Option<ClassGroup> {
    match call.index_group.parts() {
        Some(Group::Class(class)) => Some(class),
        _ => None,
    }
}

/// The parts of an index group of COM; `None` for other groups.
pub(in crate::faults) fn com_group(call: &Call<'_>) -> Option<ComGroup> {
    match call.index_group.parts() {
        Some(Group::Com(com)) => Some(com),
        _ => None,
    }
}

/// The index offset of a call to the contents of the decoder of any channel, in logical addressing
/// or addressing by index; `None` for other groups.
pub(in crate::faults) fn of_decoder(call: &Call<'_>) -> Option<u32> {
    (group(call) & 0xFFEF_FF00 == 0x02_2300).then(|| offset(call))
}

/// Whether a call addresses the contents of the decoder of any channel, in logical addressing or
/// addressing by index, at the offset of one of these functions.
pub(in crate::faults) fn is_at(call: &Call<'_>, functions: &[Function]) -> bool {
    let mut offsets = functions.iter().map(|function| function.spec().offset);
    of_decoder(call).is_some() && offsets.any(|rule| rule.contains(call.index_offset))
}

/// Whether a call looks up a name on the channel interface: a ReadWrite at the offset of a function
/// in `NAMED`.
pub(in crate::faults) fn is_lookup(call: &Call<'_>) -> bool {
    is_at(call, NAMED) && call.service == AdsService::ReadWrite
}
