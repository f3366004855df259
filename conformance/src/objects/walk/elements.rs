//! Elements of the classes of SDA and GEO.

use ads_cnc::CncString;
use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::operation::{
    FindInstance, ReadElementLength, ReadElementName, ReadElementType, ReadElementUnit,
    ReadElementWriteFlag, Task,
};
use ads_cnc::sda::{ElementLength, ElementText, ElementWriteFlag, ObjectAddress};

use super::super::{ListedValue, ReportedAccess, ValueAddress, ValueList};
use super::{Attributes, CLASSES, Walk, Walker as _};
use crate::session::ToolError;
use crate::values::Type;

/// Maximum element number that fits into an index offset together with an axis.
const ELEMENTS_MAX: u32 = 0xFFFF;

/// Maximum number of elements with different names whose attributes are stored for the same element
/// number, separately for the channels and for the axes of a class.
const ALIKE_MAX: usize = 64;

impl Walk<'_> {
    /// Adds the elements of all classes. The manuals do not specify whether SDA or GEO serves a
    /// class, so GEO is queried for the classes that SDA does not have.
    pub(super) fn elements(&mut self, channels: &[Channel]) -> Result<(), ToolError> {
        for class in CLASSES {
            self.task = Task::Sda;
            self.class(class, channels)?;
            if !self.has(class) && self.geo.is_ok() {
                self.task = Task::Geo;
                self.class(class, channels)?;
            }
            let list = ValueList::Class { class, channel: None, axis: None };
            match (self.has(class), &self.geo) {
                (true, _) if self.task == Task::Geo => self.note(list, "served by the GEO task"),
                (true, _) => {}
                (false, Ok(())) => {
                    self.note(list, "neither the SDA nor the GEO task has an instance")
                }
                (false, Err(_)) => self.note(list, "the SDA task has no instance"),
            }
        }
        if let Err(why) = &self.geo {
            self.found.notes.push(format!("the GEO task could not be queried: {why}"));
        }
        Ok(())
    }

    fn has(&self, class: Class) -> bool {
        self.instances.iter().any(|first| first.class_group().class == class)
    }

    fn class(&mut self, class: Class, channels: &[Channel]) -> Result<(), ToolError> {
        self.instances_of(class, channels, false, &mut |walk, channel, axis| {
            walk.instance(class, channel, axis)
        })
    }

    /// Adds the elements of an instance. Returns whether the target has the instance.
    fn instance(&mut self, class: Class, channel: u32, axis: u32) -> Result<bool, ToolError> {
        let query = FindInstance::new(class, channel, axis);
        let list = ValueList::of_instance(class, channel, axis);
        let found: Option<ObjectAddress> = self.decoded(query)?;
        let first = match found.map(|found| (found, found.first_element())) {
            Some((_, Ok(first))) => first,
            Some((found, Err(_))) => {
                let (group, offset) = (found.index_group, found.index_offset);
                self.note(
                    list,
                    format_args!("ignored: its address {group}, {offset} belongs to no class"),
                );
                None
            }
            None => None,
        };
        let Some(first) = first else { return Ok(false) };
        // A target that returns the same address for every axis would seem to have 255 axes.
        if self.instances.contains(&first) {
            self.note(list, "ignored: its address is that of another instance");
            return Ok(false);
        }
        self.instances.push(first);
        if self.enter(list) {
            self.elements_of(list, class, first)?;
        }
        Ok(true)
    }

    fn elements_of(
        &mut self,
        list: ValueList,
        class: Class,
        first: ElementAddress,
    ) -> Result<(), ToolError> {
        let Some(count) = self.count_elements(first)? else {
            self.note(list, "the CNC rejects the request for the number of elements");
            return Ok(());
        };
        let most = count.min(ELEMENTS_MAX);
        let requested = self.each(1..=most, |walk, number| {
            let Ok(element) = first.nth(number) else { return Ok(false) };
            let name: Option<ElementText> = walk.decoded(ReadElementName::new(element))?;
            let Some(name) = name.map(|name| name.text.text) else { return Ok(false) };
            if walk.is_named(&name) {
                let object = walk.element(list, class, element, number, name)?;
                walk.add(object)?;
            }
            Ok(true)
        })?;
        self.note_missing(list, count, most, requested);
        Ok(())
    }

    fn element(
        &mut self,
        list: ValueList,
        class: Class,
        element: ElementAddress,
        number: u32,
        name: CncString,
    ) -> Result<ListedValue, ToolError> {
        let key = (class, matches!(list, ValueList::Class { axis: Some(_), .. }), number);
        let alike = self.alike.get(&key).map(Vec::as_slice).unwrap_or_default();
        let known = alike.iter().find(|known| known.name == name && !self.options.exact);
        let attributes = match known {
            Some(known) => known.clone(),
            None => {
                let read = self.attributes(element, name)?;
                let alike = self.alike.entry(key).or_default();
                // Attributes that are not stored because of `ALIKE_MAX` are read again for each
                // instance.
                if alike.len() < ALIKE_MAX {
                    alike.push(read.clone());
                }
                read
            }
        };
        let Attributes { name, ty, unit, access } = attributes;
        let length = ty.size.unwrap_or(0);
        let address = ValueAddress::Element { element, length, task: self.task };
        Ok(ListedValue { list, name, address, ty, unit, access, handle: None })
    }

    fn attributes(
        &mut self,
        element: ElementAddress,
        name: CncString,
    ) -> Result<Attributes, ToolError> {
        let ty: Option<ElementText> = self.decoded(ReadElementType::new(element))?;
        let type_name = ty.map(|ty| ty.text.text).unwrap_or_default();
        let length: Option<ElementLength> = self.decoded(ReadElementLength::new(element))?;
        let ty = match length {
            Some(length) => Type::of_content(type_name.as_cnc_str(), length.get()),
            None => Type { size: None, ..Type::of_content(type_name.as_cnc_str(), 0) },
        };
        let unit: Option<ElementText> = self.decoded(ReadElementUnit::new(element))?;
        let unit = unit.map(|unit| unit.text.text);
        let flag: Option<ElementWriteFlag> = self.decoded(ReadElementWriteFlag::new(element))?;
        let access = flag
            .map_or(ReportedAccess::Unknown, |flag| ReportedAccess::of_flag(flag.is_writable()));
        Ok(Attributes { name, ty, unit, access })
    }
}
