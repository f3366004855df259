//! Cases of the attributes of elements. Each attribute has a separate index group.

use ads_cnc::address::Class;
use ads_cnc::operation::{
    ReadElement, ReadElementLength, ReadElementName, ReadElementType, ReadElementUnit,
};
use ads_cnc::sda::{ElementLength, ElementText};
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, Steady, attribute_reads, element_by_rank};
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step};
use crate::rules::element_type;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("adr-attributes", &[ADR_6], Needs::Queries, attributes,
        "The attribute groups return the type of an element and the length of its content"),
    case("adr-attributes-by-index", &[ADR_1, ADR_12], Needs::Queries, by_index,
        "An element has the same attributes by the channel's number and by its rank"),
];

fn text(text: &ElementText) -> String {
    text.text.text.to_string()
}

fn attributes(probe: &mut Probe<'_>) -> Step {
    for instance in probe.instances()? {
        for element in instance.elements() {
            let at = format!("element {} of {instance}", element.index_offset());
            let name: Option<ElementText> = probe.try_read(ReadElementName::new(element))?;
            let unit: Option<ElementText> = probe.try_read(ReadElementUnit::new(element))?;
            let of_type: Option<ElementText> = probe.try_read(ReadElementType::new(element))?;
            let Some(of_type) = of_type else { continue };
            let of_type = text(&of_type);
            for (attribute, group) in [(&name, "0x100"), (&unit, "0x400")] {
                let Some(other) = attribute.as_ref().map(text) else { continue };
                // An unknown type name is not a fault here, unless the name or the unit of the
                // element is the name of a known type.
                let is_type = |name| element_type(name).is_some();
                let swapped = is_type(&other) && !is_type(&of_type);
                let found = || format!("{other:?} at {group}, {of_type:?} at 0x200 for {at}");
                probe.check(ADR_6, !swapped, "the type at 0x200", found);
            }
            let length: Option<ElementLength> = probe.try_read(ReadElementLength::new(element))?;
            let Some(length) = length.map(ElementLength::get) else { continue };
            let Ok(content) = ReadElement::new(element, length) else { continue };
            // Another case judges whether the content can be read.
            let Some(content) = probe.try_ask(content)? else { continue };
            let same = u32::try_from(content.len()) == Ok(length);
            let found = || {
                format!(
                    "{length} at 0x300, but {} of content for {at}",
                    plural(content.len(), "byte")
                )
            };
            probe.check(ADR_6, same, "the length of the content at 0x300", found);
        }
    }
    Ok(())
}

fn by_index(probe: &mut Probe<'_>) -> Step {
    let mut steady = Steady::default();
    for instance in probe.instances()? {
        let rank = probe.rank_of(instance.channel).filter(|_| instance.class != Class::Spindle);
        let Some(rank) = rank else { continue };
        for element in std::iter::once(instance.first).chain(instance.elements()) {
            let by_rank = attribute_reads(element_by_rank(element, rank));
            for (one, other) in attribute_reads(element).into_iter().zip(by_rank) {
                let what = one.function().spec().name;
                let what = format!("{what} {} of {instance}", element.index_offset());
                steady.by_index(probe, ADR_1, what, one, other)?;
            }
        }
    }
    steady.finish()
}
