//! Elements of the classes of SDA and GEO.

use ads_cnc::CncString;
use ads_cnc::address::{Channel, Class, ElementAddress};
use ads_cnc::operation::{
    CountElements, FindInstance, ReadElementLength, ReadElementName, ReadElementType,
    ReadElementUnit, ReadElementWriteFlag, Task,
};

use super::super::{Access, List, Object, Place};
use super::{NUMBER_MAX, Unanswered, Walk};
use crate::session::Trouble;
use crate::values::Type;

/// The most that an offset has room for.
const ELEMENTS_MAX: u32 = 0xFFFF;

/// The most names of one element of a class that are told apart.
const ALIKE_MAX: usize = 64;

/// What an element says of itself.
#[derive(Clone, Debug)]
pub(super) struct Attributes {
    name: CncString,
    ty: Type,
    unit: Option<CncString>,
    access: Access,
}

/// In this order they are listed.
const CLASSES: [Class; 6] = [
    Class::PositionController,
    Class::Interpolator,
    Class::Decoder,
    Class::PathPreparation,
    Class::Hld,
    Class::Spindle,
];

impl Walk<'_> {
    /// Which of SDA and GEO has a class no manual says: GEO is asked for what SDA does not have.
    pub(super) fn elements(&mut self, channels: &[Channel]) -> Result<(), Trouble> {
        for class in CLASSES {
            self.task = Task::Sda;
            self.class(class, channels)?;
            if !self.has(class) && self.geo.is_ok() {
                self.task = Task::Geo;
                self.class(class, channels)?;
            }
            let list = List::Class { class, channel: None, axis: None };
            match (self.has(class), &self.geo) {
                (true, _) if self.task == Task::Geo => self.note(list, "of the GEO task"),
                (true, _) => {}
                (false, Ok(())) => self.note(list, "none is there, as the SDA and GEO tasks say"),
                (false, Err(_)) => self.note(list, "none is there, as the SDA task says"),
            }
        }
        if let Err(why) = &self.geo {
            self.found.notes.push(format!("the GEO task cannot be asked: {why}"));
        }
        Ok(())
    }

    fn has(&self, class: Class) -> bool {
        self.instances.iter().any(|first| first.class_group().class == class)
    }

    fn class(&mut self, class: Class, channels: &[Channel]) -> Result<(), Trouble> {
        match class {
            Class::PositionController => self.platform_axes(class, None),
            Class::Hld => {
                for &channel in channels {
                    self.instance(class, Some(channel), 0)?;
                }
                self.platform_axes(class, channels.first().copied())
            }
            Class::Spindle => {
                for index in 0..=NUMBER_MAX {
                    let query = FindInstance::new(class, index, 0);
                    if !self.found_instance(&query, class, u8::try_from(index).ok(), None)? {
                        break;
                    }
                }
                Ok(())
            }
            Class::Interpolator | Class::Decoder | Class::PathPreparation => {
                for &channel in channels {
                    if self.instance(class, Some(channel), 0)? {
                        self.axes(class, Some(channel))?;
                    }
                }
                Ok(())
            }
        }
    }

    /// Axes of the platform, or those that a channel has of it.
    fn platform_axes(&mut self, class: Class, or: Option<Channel>) -> Result<(), Trouble> {
        match (self.axes(class, None)?, or) {
            (0, Some(channel)) => self.axes(class, Some(channel)).map(drop),
            _ => Ok(()),
        }
    }

    /// How many there are.
    fn axes(&mut self, class: Class, channel: Option<Channel>) -> Result<u32, Trouble> {
        for axis in 1..=NUMBER_MAX {
            if !self.instance(class, channel, axis)? {
                return Ok(axis.saturating_sub(1));
            }
        }
        Ok(NUMBER_MAX)
    }

    fn instance(
        &mut self,
        class: Class,
        channel: Option<Channel>,
        axis: u32,
    ) -> Result<bool, Trouble> {
        let number = channel.map(Channel::number);
        let query = FindInstance::new(class, number.map_or(0, u32::from), axis);
        let axis = u8::try_from(axis).ok().filter(|&axis| axis > 0);
        self.found_instance(&query, class, number, axis)
    }

    /// Whether there is such an instance; its elements.
    fn found_instance(
        &mut self,
        query: &FindInstance,
        class: Class,
        channel: Option<u8>,
        axis: Option<u8>,
    ) -> Result<bool, Trouble> {
        let list = List::Class { class, channel, axis };
        let first = match self.ask_task(query)?.map(|found| (found, found.first_element())) {
            Some((_, Ok(first))) => first,
            Some((found, Err(_))) => {
                let (group, offset) = (found.index_group, found.index_offset);
                self.note(list, format_args!("said to be at {group}, {offset}: no class is there"));
                None
            }
            None => None,
        };
        let Some(first) = first else { return Ok(false) };
        // Who says the same place of every axis would have no end of them.
        if self.instances.contains(&first) {
            self.note(list, "said to be where another instance is, and taken for none");
            return Ok(false);
        }
        self.instances.push(first);
        if self.enter(list) {
            self.of_instance(list, class, first)?;
        }
        Ok(true)
    }

    fn of_instance(
        &mut self,
        list: List,
        class: Class,
        first: ElementAddress,
    ) -> Result<(), Trouble> {
        // An instance may be said to begin where a function is.
        let count = match CountElements::new(first) {
            Ok(count) => self.ask_task(&count)?.map(|count| count.0),
            Err(_) => None,
        };
        let Some(count) = count else {
            self.note(list, "the number of its elements was refused");
            return Ok(());
        };
        let mut tally = Unanswered::new(count);
        for place in 1..=count.min(ELEMENTS_MAX) {
            let Ok(element) = first.nth(place) else { break };
            let name = self.ask_task(&ReadElementName::new(element))?;
            let Some(name) = name.map(|name| CncString::from(name.text.text())) else {
                if tally.refused(place.saturating_sub(1)) {
                    break;
                }
                continue;
            };
            tally.answered();
            if self.is_named(&name) {
                let of_axis = matches!(list, List::Class { axis: Some(_), .. });
                let one = self.attributes(class, of_axis, element, place, name)?;
                self.found(Object {
                    list,
                    name: one.name,
                    place: Place::Element { element, task: self.task },
                    ty: one.ty,
                    unit: one.unit,
                    access: one.access,
                    handle: None,
                })?;
            }
        }
        tally.note(list, self);
        Ok(())
    }

    fn attributes(
        &mut self,
        class: Class,
        of_axis: bool,
        address: ElementAddress,
        element: u32,
        name: CncString,
    ) -> Result<Attributes, Trouble> {
        let key = (class, of_axis, element);
        let alike = self.alike.get(&key).map(Vec::as_slice).unwrap_or_default();
        let known = alike.iter().find(|known| known.name == name);
        if let Some(known) = known.filter(|_| !self.options.exact) {
            return Ok(known.clone());
        }
        let ty = self.ask_task(&ReadElementType::new(address))?;
        let type_name = ty.map(|ty| CncString::from(ty.text.text())).unwrap_or_default();
        let length = self.ask_task(&ReadElementLength::new(address))?.map(|length| length.get());
        let ty = match length {
            Some(length) => Type::of_content(type_name.as_cnc_str(), length),
            None => Type { size: None, ..Type::of_content(type_name.as_cnc_str(), 0) },
        };
        let unit = self.ask_task(&ReadElementUnit::new(address))?;
        let unit = unit.map(|unit| CncString::from(unit.text.text()));
        let flag = self.ask_task(&ReadElementWriteFlag::new(address))?;
        let access = flag.map_or(Access::Unknown, |flag| Access::of_flag(flag.is_writable()));
        let known = Attributes { name, ty, unit, access };
        let alike = self.alike.entry(key).or_default();
        // Of instances that are not alike not all can be known.
        if alike.len() < ALIKE_MAX {
            alike.push(known.clone());
        }
        Ok(known)
    }
}
