//! Cases of writes after a rejected write, of writes of a wrong size to objects, and of writes at
//! axis indices without an axis.

use ads_cnc::operation::{ReadElementType, WriteByName};
use ads_cnc::sda::ElementText;
use ads_cnc_vectors::Hex;
use ads_cnc_vectors::ids::*;

use super::kit::{
    NOTHING_WRITABLE, OF_PLACES, Probe, WritableNumber, changed_value, is_sendable,
    writable_numbers,
};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, applicable};
use crate::objects::{ValueAddress, ValueList};
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("write-after-refusal", &[ADS_2, ADS_4, VAR_12, VAR_13],
        Needs::MalformedWrites, after_rejection,
        "A write after a rejected write is executed and returns its own result"),
    case("write-objects-of-wrong-size", &[COM_5], Needs::MalformedWrites, objects_of_wrong_size,
        "A rejected write with a wrong size does not change the object"),
    case("write-empty-places", &[SDA_11], Needs::MalformedWrites, empty_places,
        "An axis index without an axis has blank content, also after a write"),
];

fn after_rejection(probe: &mut Probe<'_>) -> Step {
    for known in writable_numbers(probe)? {
        let WritableNumber { channel, variable, value } = &known;
        let unknown = WriteByName::new(*channel, "V.E.no such variable", value)?;
        let handle = ValueAddress::of_handle(*channel, variable.handle);
        for (id, address) in [(VAR_13, known.address()), (VAR_12, handle)] {
            let other = changed_value(value, false);
            let (valid, back) = (address.write(&other), address.write(value));
            let (valid, back) = (valid?, back?);
            // `accepted` sends a write and returns whether the target accepts it. An address is
            // judged only if the target accepts two consecutive writes of the current value.
            let accepted = |probe: &mut Probe<'_>, request| -> Step<bool> {
                Ok(probe.try_ask(request)?.is_some())
            };
            if !probe.may(back)? || !accepted(probe, back)? || !accepted(probe, back)? {
                continue;
            }
            // An address is judged only if the write to the unknown name is rejected.
            if probe.try_ask(unknown)?.is_some() {
                continue;
            }
            let exchange = probe.send(valid)?;
            let done = exchange.success().is_some();
            let name = &variable.name.text;
            let expected = || format!("{name} written after a rejected write");
            probe.check([id, ADS_2, ADS_4], done, expected, &exchange);
            let after = probe.value_at(&address)?.unwrap_or_default();
            // The value is judged only if the written value is read back after a second write.
            // Another case judges values that cannot be changed.
            let (again, read) = (accepted(probe, valid)?, probe.value_at(&address)?);
            if again && read.as_ref() == Some(&other) {
                let expected = || format!("{} of {name}, as written", Hex(other.clone()));
                probe.check([id, ADS_2], after == other, expected, || Hex(after.clone()));
            }
            accepted(probe, back)?;
        }
    }
    Ok(())
}

/// Writes values of a wrong size to objects, and checks that after a rejected write the object does
/// not begin with the data of the write. The manuals do not state that a write of a wrong size must
/// be rejected.
fn objects_of_wrong_size(probe: &mut Probe<'_>) -> Step {
    let mut any = false;
    for object in probe.objects()? {
        let name = object.name.to_string();
        let is_tried = object.is_writable() && !object.is_text() && !probe.is_blank(&object);
        let address = object.address;
        if !is_tried || address.read().is_err() || !probe.may_write(&address, &name)? {
            continue;
        }
        let Some(value) = probe.filled_value_at(&address)? else {
            continue;
        };
        let other = changed_value(&value, false);
        let longer = [&other[..], &[1]].concat();
        let shorter = (1..other.len()).filter_map(|len| other.get(..len));
        for data in shorter.chain([&longer[..]]) {
            let Some(invalid) = address.write(data).ok().filter(is_sendable) else { continue };
            any = true;
            let exchange = probe.send(invalid)?;
            if exchange.is_error() {
                let after = probe.value_at(&address)?.unwrap_or_default();
                let there = data.get(..after.len()).unwrap_or(data);
                let passed = after == value || !after.starts_with(there);
                let expected = || {
                    format!(
                        "{} of {name}, because the CNC rejected {}",
                        Hex(value.clone()),
                        plural(data.len(), "byte"),
                    )
                };
                probe.check(COM_5, passed, expected, || Hex(after));
            }
            probe.send(address.write(&value)?)?;
        }
    }
    applicable(any, NOTHING_WRITABLE)
}

/// Whether a value of this type may be the logical number of the axis at its axis index; such
/// values are not written, because the write may exchange axes.
fn may_be_a_number(type_name: &str) -> bool {
    !matches!(type_name, "BOOLEAN" | "BOOL" | "REAL32" | "REAL64" | "REAL" | "LREAL")
}

/// Writes at axis indices without an axis. Whether such a write is rejected is not specified, but
/// the content must not become the written value.
fn empty_places(probe: &mut Probe<'_>) -> Step {
    let mut all: Vec<(ValueAddress, String)> = Vec::new();
    let empty = probe.target.profile.empty_places.clone();
    for instance in probe.instances()? {
        let is_empty = empty.contains(&(instance.channel, instance.axis));
        if !is_empty || !OF_PLACES.contains(&instance.class) {
            continue;
        }
        for element in instance.elements() {
            let ty: Option<ElementText> = probe.try_read(ReadElementType::new(element))?;
            let ty = ty.map(|ty| ty.text.text.to_string());
            if !may_be_a_number(&ty.unwrap_or_default())
                && let Some(length) = probe.length_of(element)?
            {
                let what = format!("element {} of {instance}", element.index_offset());
                all.push((ValueAddress::of_element(element, length), what));
            }
        }
    }
    for object in probe.objects()? {
        let content = object.address.content();
        let is_of_channel = !matches!(object.list, ValueList::Axis(_))
            && content.is_some_and(|(group, _)| group.get() & 0xFF00 == 0x0100);
        let number = may_be_a_number(&object.ty.name);
        if object.is_writable() && is_of_channel && !number && probe.is_blank(&object) {
            all.push((object.address, object.name.to_string()));
        }
    }
    for (address, what) in all {
        if address.read().is_err() || !probe.may_write(&address, &what)? {
            continue;
        }
        let Some(blank) = probe.filled_value_at(&address)? else {
            continue;
        };
        let other = changed_value(&blank, false);
        probe.send(address.write(&other)?)?;
        let evidence = probe.evidence();
        let after = probe.value_at(&address)?.unwrap_or_default();
        probe.set_evidence(evidence);
        let passed = after != other;
        let expected = || format!("{} of {what}, blank as before", Hex(blank.clone()));
        probe.check(SDA_11, passed, expected, || Hex(after));
        if !passed {
            probe.send(address.write(&blank)?)?;
        }
    }
    probe.finish("no axis index without an axis is known")
}
