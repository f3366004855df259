//! What a request asks.

use ads_cnc::address::{ClassGroup, ComGroup, Group, IndexGroup, IndexOffset};
use ads_cnc::operation::{Call, Function};

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

/// The bit of logical addressing.
pub(in crate::faults) const LOGICAL: u32 = 0x10_0000;

/// Which function is asked, if any is.
pub(in crate::faults) fn function(call: &Call<'_>) -> Option<Function> {
    call.dispatch().ok().map(|request| request.function())
}

pub(in crate::faults) fn is(call: &Call<'_>, functions: &[Function]) -> bool {
    function(call).is_some_and(|function| functions.contains(&function))
}

/// The group, if it is one of SDA and GEO.
pub(in crate::faults) fn class(call: &Call<'_>) -> Option<ClassGroup> {
    match call.index_group.parts() {
        Some(Group::Class(class)) => Some(class),
        _ => None,
    }
}

/// The group, if it is one of COM.
pub(in crate::faults) fn com_group(call: &Call<'_>) -> Option<ComGroup> {
    match call.index_group.parts() {
        Some(Group::Com(com)) => Some(com),
        _ => None,
    }
}

/// The number of a function of the decoder, whatever channel and way of addressing; none for
/// another group.
pub(in crate::faults) fn of_decoder(call: &Call<'_>) -> Option<u32> {
    (group(call) & 0xFFEF_FF00 == 0x02_2300).then(|| offset(call))
}

/// Whether it is a request of the channel interface that begins with a name.
pub(in crate::faults) fn named(call: &Call<'_>) -> bool {
    matches!(of_decoder(call), Some(0x46 | 0x48 | 0x4A | 0x4C))
}
