//! Looks up descriptors, descriptions, types, names and handles in the CNC without the defect.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::operation::{AdsService, Call};

use super::{Key, Upstream, dimensions, group, offset, records, text, u32_at};

/// The number in the low byte of the index group, such as that of a channel, axis or spindle.
pub(super) const fn instance(call: &Call<'_>) -> u32 {
    group(call) & 0xFF
}

/// A key of the defect's memory that is the same for all addresses and names.
pub(super) const fn one(number: u32) -> Key {
    (number, 0, Vec::new())
}

/// The text `old`, with its first bytes overwritten by `new`.
pub(super) fn over(new: &[u8], old: &[u8]) -> Vec<u8> {
    [new, old.get(new.len()..).unwrap_or_default()].concat()
}

/// The descriptor of the object whose content is addressed.
pub(super) fn descriptor(cnc: &Upstream<'_>, call: &Call<'_>) -> Option<[u8; 84]> {
    let all = cnc.answer(&Call {
        port: call.port,
        service: AdsService::Read,
        index_group: IndexGroup::new(group(call) | 0x01_0000),
        index_offset: IndexOffset::new(1),
        read_length: 84 * 512,
        data: &[],
    });
    records(&all.ok()?).into_iter().find(|record| u32_at(record, 16) == Some(offset(call)))
}

/// Whether the object whose content is addressed has this type.
pub(super) fn object_is(cnc: &Upstream<'_>, call: &Call<'_>, name: &[u8]) -> bool {
    let record = descriptor(cnc, call);
    record.is_some_and(|record| text(record.get(52..).unwrap_or_default()) == name)
}

/// Whether the element whose content or attribute is addressed has this type.
pub(super) fn element_is(cnc: &Upstream<'_>, call: &Call<'_>, name: &[u8]) -> bool {
    let at = group(call) & !0xF00 | 0x500;
    cnc.read(call.port, at, offset(call)).is_ok_and(|bytes| text(&bytes) == name)
}

/// Splits the name of an element into the name of the variable and the indices.
pub(in crate::faults) fn indexed(name: &[u8]) -> (&[u8], Vec<u32>) {
    let (mut name, mut indices) = (name, Vec::new());
    while let Some(open) = name.strip_suffix(b"]") {
        let Some(at) = open.iter().rposition(|&byte| byte == b'[') else { break };
        let digits = open.get(at.saturating_add(1)..).and_then(|all| std::str::from_utf8(all).ok());
        let Some(index) = digits.and_then(|digits| digits.parse().ok()) else { break };
        indices.insert(0, index);
        name = open.get(..at).unwrap_or_default();
    }
    (name, indices)
}

/// A name, followed by the indices in brackets and a NUL.
pub(in crate::faults) fn with_indices(name: &[u8], indices: &[u32]) -> Vec<u8> {
    let indices: String = indices.iter().map(|index| format!("[{index}]")).collect();
    [name, indices.as_bytes(), &[0]].concat()
}

/// The description of the variable with this name; indices at the end of the name are ignored.
pub(super) fn described(cnc: &Upstream<'_>, group: u32, name: &[u8]) -> Option<Vec<u8>> {
    cnc.ask(group, 0x4C, &[indexed(name).0, &[0]].concat()).ok()
}

/// The descriptions of the variables of a kind, in the order of their indices.
pub(in crate::faults) fn descriptions(
    cnc: &Upstream<'_>,
    group: u32,
    kind: &[u8],
) -> impl Iterator<Item = Vec<u8>> {
    (0_u32..).map_while(move |index| {
        cnc.ask(group, 0x45, &[&index.to_le_bytes(), kind, &[0]].concat()).ok()
    })
}

/// The name in a description by index.
pub(in crate::faults) fn name_in(description: &[u8]) -> &[u8] {
    text(description.get(dimensions(description).1..).unwrap_or_default())
}

/// The name of the variable of V.E or V.G with this handle.
pub(super) fn name_of(cnc: &Upstream<'_>, group: u32, handle: u32) -> Option<Vec<u8>> {
    [&b"V.E"[..], b"V.G"].into_iter().find_map(|kind| {
        let found = with_handle(cnc, group, kind, handle)?;
        Some(name_in(&found).to_vec())
    })
}

/// The description of the variable of a kind with this handle.
pub(super) fn with_handle(
    cnc: &Upstream<'_>,
    group: u32,
    kind: &[u8],
    handle: u32,
) -> Option<Vec<u8>> {
    descriptions(cnc, group, kind).find(|found| u32_at(found, 0) == Some(handle))
}

/// The handle of the variable with this name.
pub(super) fn handle_of(cnc: &Upstream<'_>, group: u32, name: &str) -> Option<u32> {
    u32_at(&cnc.ask(group, 0x46, &[name.as_bytes(), &[0]].concat()).ok()?, 0)
}

/// Whether the type in a description is 9, STRING.
pub(super) fn is_string(description: &[u8]) -> bool {
    u32_at(description, 4) == Some(9)
}
