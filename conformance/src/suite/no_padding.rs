//! Cases of padding: fields of descriptors and descriptions must follow each other without gaps.

use ads_cnc::operation::{DescribeByIndex, ReadDescriptors};
use ads_cnc::{Decode as _, Description, DescriptorRef, DescriptorsRef};
use ads_cnc_vectors::ids::*;

use super::kit::{Counted, ItemKind, Probe};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step};
use crate::rules::element_count;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("gen-packed", &[GEN_2], Needs::Queries, packed,
        "Descriptors and descriptions have no padding between the fields"),
];

/// Whether the type in a descriptor is STRING or a type with a known size.
fn has_type(object: DescriptorRef<'_>) -> bool {
    object.type_size().is_some() || object.type_name() == "STRING"
}

/// The bytes with `by` zeros inserted at the offset `at`, or, if `by` is negative, with that number
/// of bytes removed there.
fn shifted(bytes: &[u8], at: usize, by: isize) -> Vec<u8> {
    let (head, tail) = bytes.split_at_checked(at).unwrap_or((bytes, &[]));
    let count = by.unsigned_abs();
    let mut all = head.to_vec();
    if by > 0 {
        all.resize(head.len().saturating_add(count), 0);
        all.extend_from_slice(tail);
    } else {
        all.extend(tail.iter().skip(count));
    }
    all
}

/// The numbers of bytes that are removed (negative) or inserted (positive) to find padding,
/// smallest first.
const SHIFTS: [isize; 10] = [-1, 1, -2, 2, -4, 4, -6, 6, -8, 8];

fn packed(probe: &mut Probe<'_>) -> Step {
    for list in probe.lists()? {
        let Ok(Some(number)) = Counted::Objects(list).number(probe) else { continue };
        for first in probe.object_numbers(number) {
            let one = ReadDescriptors::new(list, first, 1)?;
            let Some(bytes) = probe.try_ask(one)? else { break };
            descriptor_is_packed(probe, &bytes);
        }
    }
    for channel in probe.channels()? {
        for (name, kind) in probe.kinds() {
            let counted = Counted::Variables(channel, name, kind);
            let Ok(Some(number)) = counted.number(probe) else { continue };
            for index in probe.sample(ItemKind::Variable, 0..number) {
                let describe = DescribeByIndex::new(channel, index, kind);
                let Some(bytes) = probe.try_ask(describe)? else { break };
                description_is_packed(probe, &bytes, name);
            }
        }
    }
    probe.finish("the target has no descriptor and no description")
}

fn descriptor_is_packed(probe: &mut Probe<'_>, bytes: &[u8]) {
    let object = |bytes: &[u8], judge: fn(DescriptorRef<'_>) -> bool| {
        DescriptorsRef::decode(bytes).ok().and_then(|list| list.get(0)).is_some_and(judge)
    };
    // Padding is searched for only if the name and the type name are empty: an unknown type name
    // does not show padding.
    let is_unpacked = object(bytes, |one| one.name().is_empty() && one.type_name().is_empty());
    let makes_sense = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes.resize(ads_cnc::limits::DESCRIPTOR_LEN, 0);
        object(&bytes, |one| has_type(one) && !one.name().is_empty())
    };
    let shift = if is_unpacked { unpacked(bytes, 52, makes_sense) } else { None };
    let found = || {
        format!("{} more before the name or the type", plural(shift.unwrap_or_default(), "byte"))
    };
    probe.check(GEN_2, shift.is_none(), "name at byte 20, type at byte 52", found);
}

/// Whether the size is that of the type times the number of elements. False for a type without a
/// fixed size, such as STRING, because wrong dimensions of such a variable would look like padding.
fn has_size(variable: &Description) -> bool {
    let element = variable.var_type.element_size();
    let count = element_count(&variable.dimensions);
    element.is_some_and(|size| size.saturating_mul(count) == variable.size)
}

fn description_is_packed(probe: &mut Probe<'_>, bytes: &[u8], kind: &str) {
    let of_kind = |one: &Description| {
        let name = one.name.text.to_string();
        name.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'))
    };
    let makes_sense =
        |bytes: &[u8]| Description::decode(bytes).is_ok_and(|one| of_kind(&one) && has_size(&one));
    let is_of_kind = Description::decode(bytes).is_ok_and(|one| of_kind(&one));
    let shift = if is_of_kind { None } else { unpacked(bytes, bytes.len(), makes_sense) };
    let found = || format!("{} more between the fields", plural(shift.unwrap_or_default(), "byte"));
    probe.check(GEN_2, shift.is_none(), || format!("a name of {kind} after the dimensions"), found);
}

/// The number of padding bytes before `end` whose removal makes the stream plausible (according to
/// `makes_sense`); negative if bytes are missing; `None` if no shift in [`SHIFTS`] does.
fn unpacked(bytes: &[u8], end: usize, makes_sense: impl Fn(&[u8]) -> bool) -> Option<isize> {
    let makes_sense = |by: isize| (0..end).any(|at| makes_sense(&shifted(bytes, at, by)));
    SHIFTS.into_iter().find(|by| makes_sense(*by)).map(isize::saturating_neg)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DESCRIPTION: &[u8] =
        b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

    fn sense(bytes: &[u8]) -> bool {
        Description::decode(bytes)
            .is_ok_and(|one| one.name.text.to_string().starts_with("V.E.") && one.var_type.0 == 1)
    }

    #[test]
    fn padding_between_fields_is_detected() {
        for (at, by) in [(4, 4), (8, 2), (24, 4), (24, 1)] {
            let other = shifted(DESCRIPTION, at, by);
            assert_eq!(unpacked(&other, DESCRIPTION.len(), sense), Some(by), "{at} {by}");
        }
        let narrow = shifted(DESCRIPTION, 10, -2);
        assert!(unpacked(&narrow, DESCRIPTION.len(), sense).is_some());
        // Other cases judge bytes that are implausible for another reason than padding.
        assert_eq!(unpacked(b"\x02\0\0\x02", 4, sense), None);
    }
}
