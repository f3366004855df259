//! Cases of the bytes of numbers: their order, and that nothing stands between them.

use ads_cnc::address::Channel;
use ads_cnc::dynamic::{DynamicCount, DynamicKind};
use ads_cnc::operation::{
    CountDynamic, CountElements, CountObjects, CountVariables, DescribeByIndex, DynamicNameByIndex,
    DynamicValueByIndex, DynamicValueByName, HandleByName, ObjectList, ReadByName, ReadDescriptors,
    ReadElementName, Request,
};
use ads_cnc::sda::ElementCount;
use ads_cnc::{
    Decode, Description, DescriptorRef, DescriptorsRef, Handle, Kind, ObjectCount, VariableCount,
};
use ads_cnc_vectors::Hex;

use super::case::{Case, Step, Stop};
use super::declare;
use super::described::kinds;
use super::inventory::{Instance, OBJECTS_MAX};
use super::probe::{Probe, harness};
use super::survey::VARIABLES_MAX;
use super::variable::name_of;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "gen-number-order",
            "Counts and handles come with their lowest byte first",
            ["GEN-1"],
            Queries,
            number_order
        ),
        declare!(
            "gen-value-order",
            "Values of variables and parameters come with their lowest byte first",
            ["GEN-1"],
            Embedded,
            value_order
        ),
        declare!(
            "gen-packed",
            "In descriptors and descriptions nothing stands between the fields",
            ["GEN-2"],
            Queries,
            packed
        ),
    ]
}

/// Something that is counted, and can be asked for by its number from 1.
#[derive(Clone, Debug)]
enum Counted {
    Objects(ObjectList),
    Variables(Channel, &'static str, Kind<'static>),
    Parameters(Channel, DynamicKind),
    Elements(Instance),
}

impl std::fmt::Display for Counted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Objects(list) => write!(f, "objects of {}", list.parts().index_group()),
            Self::Variables(channel, kind, _) => {
                write!(f, "{kind} of channel {}", channel.number())
            }
            Self::Parameters(channel, kind) => {
                write!(f, "{kind:?} of channel {}", channel.number())
            }
            Self::Elements(instance) => write!(f, "elements of {instance}"),
        }
    }
}

impl Counted {
    /// How many there are, as the target says.
    fn number(&self, probe: &mut Probe<'_>) -> Step<Option<u32>> {
        fn read<T: for<'b> Decode<'b>>(
            probe: &mut Probe<'_>,
            request: Request<'_>,
            get: fn(T) -> u32,
        ) -> Step<Option<u32>> {
            let data = probe.try_ask(request)?;
            Ok(data.and_then(|data| T::decode(&data).ok()).map(get))
        }
        match self {
            Self::Objects(list) => {
                read(probe, CountObjects::new(*list).into(), |count: ObjectCount| count.0)
            }
            Self::Variables(channel, _, kind) => {
                let request = CountVariables::new(*channel, *kind);
                read(probe, request.into(), |count: VariableCount| count.0)
            }
            Self::Parameters(channel, kind) => {
                let request = CountDynamic::new(*channel, *kind);
                read(probe, request.into(), |count: DynamicCount| count.0)
            }
            Self::Elements(instance) => match CountElements::new(instance.first) {
                Ok(request) => read(probe, request.into(), |count: ElementCount| count.0),
                Err(_) => Ok(None),
            },
        }
    }

    /// Whether there is one with this number.
    fn has(&self, probe: &mut Probe<'_>, number: u32) -> Step<bool> {
        let request: Option<Request<'_>> = match self {
            Self::Objects(list) => ReadDescriptors::new(*list, number, 1).ok().map(Into::into),
            Self::Variables(channel, _, kind) => {
                let index = number.checked_sub(1);
                index.map(|index| DescribeByIndex::new(*channel, index, *kind).into())
            }
            Self::Parameters(channel, kind) => {
                DynamicNameByIndex::new(*channel, *kind, number).ok().map(Into::into)
            }
            Self::Elements(instance) => {
                let element = instance.first.following(number).ok();
                element.map(|element| ReadElementName::new(element).into())
            }
        };
        let Some(request) = request else { return Ok(false) };
        Ok(probe.try_ask(request)?.is_some_and(|data| !data.is_empty()))
    }
}

/// Everything that is claimed to be counted.
fn counted(probe: &mut Probe<'_>) -> Step<Vec<Counted>> {
    let mut all: Vec<Counted> = probe.lists()?.into_iter().map(Counted::Objects).collect();
    for channel in probe.channels()? {
        let listed = kinds(probe).into_iter();
        all.extend(listed.map(|(name, kind)| Counted::Variables(channel, name, kind)));
        all.extend(DynamicKind::ALL.map(|kind| Counted::Parameters(channel, kind)));
    }
    match probe.instances() {
        Ok(instances) => all.extend(instances.into_iter().map(Counted::Elements)),
        Err(Stop::NotApplicable(_)) => {}
        Err(stop) => return Err(stop),
    }
    let mut claimed = Vec::new();
    for one in all {
        match one.number(probe) {
            Ok(_) => claimed.push(one),
            Err(Stop::NotApplicable(_)) => {}
            Err(stop) => return Err(stop),
        }
    }
    Ok(claimed)
}

/// A number that is not that of the last thing, but is from behind.
fn number_order(probe: &mut Probe<'_>) -> Step {
    for one in counted(probe)? {
        let Some(number) = one.number(probe)? else { continue };
        let from_behind = number.swap_bytes();
        if number == from_behind {
            continue;
        }
        let swapped = !one.has(probe, number)? && one.has(probe, from_behind)?;
        let found = format!("{number:#x}, where the last is number {from_behind:#x}");
        probe.check("GEN-1", !swapped, format!("the number of {one}"), found);
    }
    for channel in probe.channels()? {
        let variables = match probe.variables(channel) {
            Ok(variables) => variables,
            Err(Stop::NotApplicable(_) | Stop::Inconclusive(_)) => continue,
            Err(stop) => return Err(stop),
        };
        for variable in variables {
            let name = name_of(&variable);
            let Some(data) = probe.try_ask(HandleByName { channel, name })? else { continue };
            let Ok(handle) = Handle::decode(&data) else { continue };
            let known = variable.handle.0;
            let swapped = handle.0 != known && handle.0.swap_bytes() == known;
            let expected = format!("{:?} of {}", variable.handle, variable.name.text);
            probe.check("GEN-1", !swapped, expected, format!("{handle:?}"));
        }
    }
    Ok(())
}

/// The same bytes in another order.
pub(super) fn is_permuted(one: &[u8], other: &[u8]) -> bool {
    let sorted = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes.sort_unstable();
        bytes
    };
    one != other && sorted(one) == sorted(other)
}

/// Other bytes than those held are another matter.
fn order(probe: &mut Probe<'_>, what: &str, size: usize, held: &[u8], read: Option<Vec<u8>>) {
    let Some(read) = read.filter(|read| read.len() == held.len()) else { return };
    let mut pairs = held.chunks(size).zip(read.chunks(size));
    let permuted = pairs.any(|(one, other)| is_permuted(one, other));
    if held == read || permuted {
        let expected = format!("{} of {what}", Hex(held.to_vec()));
        probe.check("GEN-1", !permuted, expected, Hex(read));
    }
}

fn value_order(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let claimed = probe.channels()?;
    let of = |number: u8| claimed.iter().find(|channel| channel.number() == number).copied();
    for variable in cnc.held_variables() {
        let size = variable.var_type.element_size().and_then(|size| usize::try_from(size).ok());
        let (Some(channel), Some(size)) = (of(variable.channel), size) else { continue };
        let what = variable.name.to_string();
        let request = ReadByName { channel, name: variable.name.as_cnc_str().into() };
        if size > 1 && request.name.text().len() < ads_cnc::limits::TEXT_MAX {
            let read = probe.try_ask(request)?;
            order(probe, &what, size, &variable.value, read);
        }
    }
    let mut index = std::collections::HashMap::new();
    for parameter in cnc.held_parameters() {
        let Some(channel) = of(parameter.channel) else { continue };
        let (kind, name) = (parameter.kind, parameter.name.as_cnc_str().into());
        let index: &mut u32 = index.entry((parameter.channel, kind)).or_default();
        *index = index.saturating_add(1);
        let what = parameter.name.to_string();
        let held = parameter.value.to_le_bytes();
        let read = probe.try_ask(DynamicValueByName { channel, kind, name })?;
        order(probe, &what, held.len(), &held, read);
        let by_index = DynamicValueByIndex::new(channel, kind, *index).map_err(harness)?;
        let read = probe.try_ask(by_index)?;
        order(probe, &what, held.len(), &held, read);
    }
    Ok(())
}

/// Whether the type that a descriptor names is one of the manual's.
fn has_type(object: DescriptorRef<'_>) -> bool {
    object.type_size().is_some() || object.type_name() == "STRING"
}

/// The bytes with some more zeros, or fewer bytes, at a place.
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

/// By how much a field may be wider or narrower than printed: by little first.
const SHIFTS: [isize; 10] = [-1, 1, -2, 2, -4, 4, -6, 6, -8, 8];

fn packed(probe: &mut Probe<'_>) -> Step {
    let mut any = false;
    for list in probe.lists()? {
        let Ok(Some(number)) = Counted::Objects(list).number(probe) else { continue };
        for first in 1..=number.min(OBJECTS_MAX) {
            let one = ReadDescriptors::new(list, first, 1).map_err(harness)?;
            let Some(bytes) = probe.try_ask(one)? else { break };
            any = true;
            descriptor_is_packed(probe, &bytes);
        }
    }
    for channel in probe.channels()? {
        for (name, kind) in kinds(probe) {
            let counted = Counted::Variables(channel, name, kind);
            let Ok(Some(number)) = counted.number(probe) else { continue };
            for index in 0..number.min(VARIABLES_MAX) {
                let describe = DescribeByIndex::new(channel, index, kind);
                let Some(bytes) = probe.try_ask(describe)? else { break };
                any = true;
                description_is_packed(probe, &bytes, name);
            }
        }
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("nothing is described".to_owned())),
    }
}

fn descriptor_is_packed(probe: &mut Probe<'_>, bytes: &[u8]) {
    let object = |bytes: &[u8], judge: fn(DescriptorRef<'_>) -> bool| {
        DescriptorsRef::decode(bytes).ok().and_then(|list| list.get(0)).is_some_and(judge)
    };
    // An unknown type is none of the manual's, but a type.
    let shift = match object(bytes, |one| one.name().is_empty() && one.type_name().is_empty()) {
        true => unpacked(bytes, 52, |bytes| {
            let mut bytes = bytes.to_vec();
            bytes.resize(ads_cnc::limits::DESCRIPTOR_LEN, 0);
            object(&bytes, |one| has_type(one) && !one.name().is_empty())
        }),
        false => None,
    };
    let found = format!("{} bytes more in between", shift.unwrap_or_default());
    probe.check("GEN-2", shift.is_none(), "name and type at bytes 20 and 52", found);
}

fn description_is_packed(probe: &mut Probe<'_>, bytes: &[u8], kind: &str) {
    let of_kind = |one: &Description| {
        let name = one.name.text.to_string();
        name.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'))
    };
    let decoded = Description::decode(bytes);
    let shift = match decoded.is_ok_and(|one| of_kind(&one)) {
        true => None,
        false => unpacked(bytes, bytes.len(), |bytes| {
            Description::decode(bytes)
                .is_ok_and(|one| of_kind(&one) && one.var_type.name().is_some())
        }),
    };
    let found = format!("{} bytes more in between", shift.unwrap_or_default());
    probe.check("GEN-2", shift.is_none(), format!("a name of {kind} behind the dimensions"), found);
}

/// How many bytes too many stand somewhere before `end`, so that the stream makes sense without
/// them; too few, if it is less than 0.
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
    fn what_stands_between_fields_is_found() {
        for (at, by) in [(4, 4), (8, 2), (24, 4), (24, 1)] {
            let other = shifted(DESCRIPTION, at, by);
            assert_eq!(unpacked(&other, DESCRIPTION.len(), sense), Some(by), "{at} {by}");
        }
        let narrow = shifted(DESCRIPTION, 10, -2);
        assert!(unpacked(&narrow, DESCRIPTION.len(), sense).is_some());
        // Other nonsense is another matter.
        assert_eq!(unpacked(b"\x02\0\0\x02", 4, sense), None);
    }

    #[test]
    fn another_order_is_told_from_other_bytes() {
        assert!(is_permuted(&[1, 2, 3, 4], &[3, 4, 1, 2]));
        assert!(!is_permuted(&[1, 2], &[1, 2]));
        assert!(!is_permuted(&[1, 2], &[1, 3]));
    }
}
