//! Cases of the attributes of elements: each in the group of its own.

use ads_cnc::Decode;
use ads_cnc::operation::{
    ReadElement, ReadElementLength, ReadElementName, ReadElementType, ReadElementUnit,
    ReadElementWriteFlag, Request,
};
use ads_cnc::sda::{ElementLength, ElementText, ElementWriteFlag};

use super::addresses::Addresses;
use super::case::{Case, Step, Stop};
use super::declare;
use super::probe::Probe;

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "adr-attributes",
            "Type, length and write flag of an element are what their groups say",
            ["ADR-6"],
            Queries,
            attributes
        ),
        declare!(
            "adr-attributes-within",
            "Each group has the attribute that the CNC has within",
            ["ADR-6"],
            Embedded,
            within
        ),
    ]
}

/// The manual's names of types.
fn is_type(name: &str) -> bool {
    let types =
        ["BOOLEAN", "UNS08", "SGN08", "UNS16", "SGN16", "UNS32", "SGN32", "REAL32", "REAL64"];
    types.contains(&name) || name == "STRING"
}

/// An attribute, if it is answered with what it is made of.
fn read<T: for<'b> Decode<'b>>(
    probe: &mut Probe<'_>,
    request: impl Into<Request<'static>>,
) -> Step<Option<T>> {
    let data = probe.try_ask(request)?;
    Ok(data.and_then(|data| T::decode(&data).ok()))
}

fn text(text: &ElementText) -> String {
    text.text.text.to_string()
}

fn attributes(probe: &mut Probe<'_>) -> Step {
    for instance in probe.instances()? {
        for element in instance.elements() {
            let at = format!("element {} of {instance}", element.index_offset());
            let name: Option<ElementText> = read(probe, ReadElementName::new(element))?;
            let unit: Option<ElementText> = read(probe, ReadElementUnit::new(element))?;
            let of_type: Option<ElementText> = read(probe, ReadElementType::new(element))?;
            let Some(of_type) = of_type else { continue };
            let of_type = text(&of_type);
            for (attribute, group) in [(&name, "0x100"), (&unit, "0x400")] {
                let Some(other) = attribute.as_ref().map(text) else { continue };
                // Types may have other names than the manual's, but names are no types.
                let swapped = is_type(&other) && !is_type(&of_type);
                let found = format!("{other:?} at {group}, {of_type:?} at 0x200 for {at}");
                probe.check("ADR-6", !swapped, "the type at 0x200", found);
            }
            let length: Option<ElementLength> = read(probe, ReadElementLength::new(element))?;
            let Some(length) = length.map(ElementLength::get) else { continue };
            let Ok(content) = ReadElement::new(element, length) else { continue };
            // That it is read at all is judged elsewhere.
            let Some(content) = probe.try_ask(content)? else { continue };
            let same = u32::try_from(content.len()) == Ok(length);
            let found = format!("{length} at 0x300, a content of {} bytes for {at}", content.len());
            probe.check("ADR-6", same, "the length of the content at 0x300", found);
        }
    }
    Ok(())
}

fn within(probe: &mut Probe<'_>) -> Step {
    let cnc = probe.cnc()?;
    let addresses = Addresses::new(probe)?;
    let mut any = false;
    for held in cnc.held() {
        let Some(element) = addresses.element(&held)? else { continue };
        any = true;
        let at = format!("{} ({:?})", held.name, held.holder);
        let texts: [(Option<ElementText>, String, &str); 3] = [
            (read(probe, ReadElementName::new(element))?, held.name.to_string(), "name"),
            (read(probe, ReadElementType::new(element))?, held.type_name.to_owned(), "type"),
            (read(probe, ReadElementUnit::new(element))?, held.unit.to_string(), "unit"),
        ];
        for (read, held, what) in texts {
            // Its characters are another matter.
            let read = read.map(|one| text(&one));
            // That everything has a unit nobody says.
            let none = what == "unit" && read.as_deref() == Some("");
            let same = none || read.as_ref() == Some(&held) || !held.is_ascii();
            let found = format!("{read:?} for {at}");
            probe.check("ADR-6", same, format!("the {what} {held:?}"), found);
        }
        let length: Option<ElementLength> = read(probe, ReadElementLength::new(element))?;
        let length = length.map(ElementLength::get).and_then(|length| usize::try_from(length).ok());
        let (expected, found) =
            (format!("a length of {}", held.value.len()), format!("{length:?} for {at}"));
        probe.check("ADR-6", length == Some(held.value.len()), expected, found);
        let flag: Option<ElementWriteFlag> = read(probe, ReadElementWriteFlag::new(element))?;
        let flag = flag.map(ElementWriteFlag::is_writable);
        let (expected, found) =
            (format!("write access {}", held.writable), format!("{flag:?} for {at}"));
        probe.check("ADR-6", flag == Some(held.writable), expected, found);
    }
    match any {
        true => Ok(()),
        false => Err(Stop::NotApplicable("the CNC has no element".to_owned())),
    }
}
