//! What objects and elements have in common: a content of a type.

use std::collections::HashMap;

use ads_cnc::CncString;

/// An object or element.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cnc) struct Item {
    pub(in crate::cnc) name: CncString,
    pub(in crate::cnc) type_name: &'static str,
    pub(in crate::cnc) unit: CncString,
    pub(in crate::cnc) writable: bool,
    pub(in crate::cnc) meaning: Meaning,
    pub(in crate::cnc) initial: Initial,
}

impl Item {
    /// Whether a write may be shorter than the content.
    pub(in crate::cnc) fn is_text(&self) -> bool {
        self.type_name == "STRING"
    }
}

/// Where a content is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cnc) enum Meaning {
    /// It is what was written last.
    Value,
    /// The logical number of the axis at the place, 0 for none. Writing it exchanges axes.
    AxisNumber,
}

/// Values at the start.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::cnc) struct Initial {
    /// Bytes of each.
    pub(in crate::cnc) size: usize,
    pub(super) values: Values,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    /// One for all instances.
    Same(Vec<u8>),
    /// One for each; zeros for those behind.
    Each(Vec<Vec<u8>>),
}

impl Initial {
    /// The value of an instance, from 0.
    pub(in crate::cnc) fn of(&self, instance: usize) -> Vec<u8> {
        match &self.values {
            Values::Same(value) => value.clone(),
            Values::Each(values) => {
                values.get(instance).cloned().unwrap_or_else(|| vec![0; self.size])
            }
        }
    }
}

/// COM objects of a channel, of the platform, or of each axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::cnc) struct Objects {
    pub(in crate::cnc) items: Vec<Item>,
    /// Low part of the offset of each.
    pub(in crate::cnc) elements: Vec<u32>,
    pub(super) by_element: HashMap<u32, usize>,
}

impl Objects {
    /// The object at this element.
    pub(in crate::cnc) fn at(&self, element: u32) -> Option<usize> {
        self.by_element.get(&element).copied()
    }
}

/// The elements of each instance of a class.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::cnc) struct Elements {
    /// Name of an instance; `{}` in it stands for its number.
    pub(super) name: String,
    /// From element 1 on.
    pub(in crate::cnc) items: Vec<Item>,
}

impl Elements {
    /// The name of the instance with this number.
    pub(in crate::cnc) fn name(&self, number: impl ToString) -> String {
        self.name.replace("{}", &number.to_string())
    }
}

/// A class of SDA and GEO.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::cnc) struct ClassModel {
    /// Of each channel; of the spindles, of each spindle.
    pub(in crate::cnc) channel: Elements,
    /// Of each axis.
    pub(in crate::cnc) axis: Elements,
}
