//! Cases of writes to COM objects and to elements of SDA and GEO, also to read-only ones.

use ads_cnc::address::{Class, Group};
use ads_cnc::operation::{AdsService, CountElements};
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::content::at;
use super::kit::{
    NOTHING_WRITABLE, Probe, RawCall, WritableElement, WriteCheck, elements_with_flag,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Rule, Step, applicable, assumed};
use crate::objects::{ListedValue, ValueAddress};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-objects", &[COM_2, COM_5, ADR_3], Needs::Writes, objects,
        "A value written to an object with write access is read back"),
    case("write-read-only-objects", &[COM_2], Needs::Writes, read_only_objects,
        "A write to an object without write access is rejected"),
    case("write-elements", &[SDA_1, SDA_9, ADR_2], Needs::Writes, elements,
        "A value written to an element with its write flag set is read back from it alone"),
    case("write-read-only-elements", &[SDA_9], Needs::Writes, read_only_elements,
        "A write to an element without its write flag set is rejected"),
    case("write-elements-of-wrong-size", &[SDA_8], Needs::MalformedWrites, wrong_size,
        "A write with a length other than the element's returns an error"),
    case("write-number-of-elements", &[SDA_4], Needs::MalformedWrites, number_of_elements,
        "A write to the element count of an instance is rejected"),
];

/// Of the objects that the cases read, those with or without write access according to their
/// descriptors that the [gate](crate::gate) and the profile permit to write. Objects at axis
/// indices that have no axis, or may have none, are left out.
fn writable(probe: &mut Probe<'_>, is_writable: bool) -> Step<Vec<ListedValue>> {
    let mut all = Vec::new();
    for object in probe.objects()? {
        if object.is_writable() == is_writable
            && !probe.is_blank(&object)
            && object.address.read().is_ok()
            && probe.may_write(&object.address, &object.name.to_string())?
        {
            all.push(object);
        }
    }
    Ok(all)
}

fn objects(probe: &mut Probe<'_>) -> Step {
    let all = writable(probe, true)?;
    for object in &all {
        let what = object.name.to_string();
        let is_text = object.is_text();
        let rules = [COM_5, COM_2].map(Rule::from);
        let write_check = WriteCheck { what: &what, rules: &rules, is_text, name: None };
        let siblings = of_other_instances(probe, object)?;
        probe.try_write(&write_check, &object.address, |probe, _, new| {
            for (other, before) in &siblings {
                let after = probe.value_at(&other.address)?.unwrap_or_default();
                let passed =
                    after != new || after == *before || probe.moves(&other.address, false)?;
                let expected = || format!("{what} changed in its own group only");
                let found = || format!("also changed at {}", at(other));
                probe.check([COM_5, ADR_3], passed, expected, found);
            }
            Ok(())
        })?;
    }
    applicable(!all.is_empty(), NOTHING_WRITABLE)
}

/// The objects of other channels or platform axes with the same offset and name, and their values.
fn of_other_instances(
    probe: &mut Probe<'_>,
    object: &ListedValue,
) -> Step<Vec<(ListedValue, Vec<u8>)>> {
    let mut all = Vec::new();
    for other in probe.objects()? {
        if other.name == object.name && is_elsewhere(object, &other) {
            let value = probe.value_at(&other.address)?;
            all.extend(value.map(|value| (other, value)));
        }
    }
    Ok(all)
}

/// Whether an object has the same offset in the group of another channel or platform axis. Objects
/// in channel 0 are excluded, because channel 1 addresses the same objects of the platform.
fn is_elsewhere(object: &ListedValue, other: &ListedValue) -> bool {
    let parts = |object: &ListedValue| {
        let (group, offset) = object.address.content()?;
        let Group::Com(com) = group.parts()? else { return None };
        Some((com, offset))
    };
    let Some(((one, at), (two, same))) = parts(object).zip(parts(other)) else { return false };
    (one.table, at) == (two.table, same)
        && one.instance > 0
        && two.instance > 0
        && one.instance != two.instance
}

fn read_only_objects(probe: &mut Probe<'_>) -> Step {
    let known = writable(probe, true)?.into_iter().find(|one| !one.is_text());
    let known = known.map(|object| object.address);
    let all = writable(probe, false)?;
    for object in &all {
        let what = object.name.to_string();
        let rules = [COM_2.into()];
        let write_check = WriteCheck { what: &what, rules: &rules, is_text: false, name: None };
        probe.write_rejected(&write_check, &object.address, known.as_ref())?;
    }
    applicable(!all.is_empty(), NOTHING_WRITABLE)
}

fn elements(probe: &mut Probe<'_>) -> Step {
    let all = elements_with_flag(probe, true)?;
    for one in &all {
        let siblings = siblings(probe, one)?;
        let rules = [SDA_9.into()];
        let write_check =
            WriteCheck { what: &one.what, rules: &rules, is_text: one.is_text, name: None };
        let mut taken = Vec::new();
        probe.try_write(&write_check, &one.address, |probe, _, new| {
            for (rules, sibling, address, before) in &siblings {
                let after = probe.value_at(address)?.unwrap_or_default();
                if after == new && after != *before {
                    taken.push((rules, sibling, address, before, probe.evidence()));
                }
            }
            Ok(())
        })?;
        // A sibling that had the new value after the write, and has its old value again after the
        // original value was restored, was changed by both writes.
        let is_own = taken.is_empty();
        for (rules, sibling, address, before, evidence) in taken {
            let again = probe.value_at(address)?;
            probe.set_evidence(evidence);
            let passed = again.as_ref() != Some(before);
            let expected = || format!("{} changed at its own address only", one.what);
            probe.check(&rules[..], passed, expected, || format!("also changed at {sibling}"));
        }
        if is_own && !siblings.is_empty() {
            probe.pass(SDA_1);
            let has_spindle = |rules: &[Rule]| rules.iter().any(|rule| rule.id == ADR_2.as_str());
            if siblings.iter().any(|(rules, ..)| has_spindle(rules)) {
                probe.pass(ADR_2);
            }
        }
    }
    applicable(!all.is_empty(), NOTHING_WRITABLE)
}

/// Another value that a faulty write might change: rules, name, address, current value.
type Sibling = (Vec<Rule>, String, ValueAddress, Vec<u8>);

/// Elements of the same length: those with the same number in the other instances of the class, and
/// the others that the cases read of the instance. For an axis of an HLD, the same axis in other
/// HLDs is left out. The elements of one instance may depend on each other, so their rule is
/// assumed.
fn siblings(probe: &mut Probe<'_>, one: &WritableElement) -> Step<Vec<Sibling>> {
    let ValueAddress::Element { length, .. } = one.address else { return Ok(Vec::new()) };
    let (at, start) = (one.element.index_offset().get(), one.instance.first.index_offset().get());
    let number = at.saturating_sub(start);
    let mut others = Vec::new();
    for element in one.instance.elements().filter(|element| *element != one.element) {
        let what = format!("element {} of {}", element.index_offset(), one.instance);
        others.push((vec![assumed(SDA_9)], what, element));
    }
    for other in probe.instances()? {
        // The HLDs of several channels may have the same platform axes, so the same axis in another
        // HLD is not a sibling.
        let is_same = other.first == one.instance.first
            || other.class == Class::Hld && other.axis > 0 && other.axis == one.instance.axis;
        let is_sibling = other.class == one.instance.class && !is_same && number <= other.count;
        if let (true, 1.., Ok(element)) = (is_sibling, number, other.first.nth(number)) {
            let own = if other.class == Class::Spindle { ADR_2 } else { SDA_9 };
            others.push((vec![SDA_1.into(), own.into()], other.to_string(), element));
        }
    }
    let mut all = Vec::new();
    for (rules, what, element) in others {
        if probe.length_of(element)? != Some(length) {
            continue;
        }
        let address = ValueAddress::of_element(element, length);
        if let Some(before) = probe.value_at(&address)? {
            all.push((rules, what, address, before));
        }
    }
    Ok(all)
}

/// Writes values that are one byte too long or too short to elements that are not texts, and checks
/// that these writes are rejected (assumed), and that a rejected write has no effect.
fn wrong_size(probe: &mut Probe<'_>) -> Step {
    let all = elements_with_flag(probe, true)?;
    for WritableElement { address, what, .. } in all.iter().filter(|one| !one.is_text) {
        let Some(value) = probe.filled_value_at(address)? else {
            continue;
        };
        let longer = [&value[..], &[0]].concat();
        for other in [&longer[..], value.get(1..).unwrap_or_default()] {
            let Ok(write) = address.write(other) else { continue };
            let exchange = probe.send(write)?;
            let rejected = exchange.is_error();
            let expected = || format!("an error for {} of {what}", plural(other.len(), "byte"));
            probe.check(assumed(SDA_8), rejected, expected, &exchange);
            let after = probe.value_at(address)?.unwrap_or_default();
            let passed = !rejected || after == value;
            let expected = || format!("{} of {what}, unchanged", Hex(value.clone()));
            probe.check(SDA_8, passed, expected, || Hex(after));
            probe.send(address.write(&value)?)?;
        }
    }
    applicable(!all.is_empty(), NOTHING_WRITABLE)
}

fn read_only_elements(probe: &mut Probe<'_>) -> Step {
    let known = elements_with_flag(probe, true)?.into_iter().find(|one| !one.is_text);
    let known = known.map(|known| known.address);
    let all = elements_with_flag(probe, false)?;
    for WritableElement { address, what, .. } in &all {
        let rules = [SDA_9.into()];
        let write_check = WriteCheck { what, rules: &rules, is_text: false, name: None };
        probe.write_rejected(&write_check, address, known.as_ref())?;
    }
    applicable(!all.is_empty(), NOTHING_WRITABLE)
}

/// Writes the number of elements after element 0 to element 0 of each instance, which must reject
/// the write.
fn number_of_elements(probe: &mut Probe<'_>) -> Step {
    for instance in probe.instances()? {
        let write = RawCall::new(CountElements::new(instance.first)?)?.with(|call| {
            (call.service, call.read_length) = (AdsService::Write, 0);
            call.data = instance.count.to_le_bytes().to_vec();
        });
        let exchange = probe.call(&write)?;
        let rejected = exchange.is_error();
        let expected = || format!("an error number for a write of the number of {instance}");
        probe.check(SDA_4, rejected, expected, &exchange);
    }
    Ok(())
}
