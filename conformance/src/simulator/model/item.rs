//! Objects and elements: contents with types.

use std::collections::HashMap;

use ads_cnc::CncString;

/// An object or element.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct Item {
    pub(in crate::simulator) name: CncString,
    pub(in crate::simulator) type_name: &'static str,
    pub(in crate::simulator) unit: CncString,
    pub(in crate::simulator) writable: bool,
    pub(in crate::simulator) meaning: ContentSource,
    pub(in crate::simulator) initial: Initial,
}

impl Item {
    /// Whether the item is a STRING, so that a written text may be shorter than the content.
    pub(in crate::simulator) fn is_text(&self) -> bool {
        self.type_name == "STRING"
    }
}

/// The source of a content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::simulator) enum ContentSource {
    /// The initial value or, after a write, the last written value.
    Value,
    /// The logical number of the axis that owns the content; 0 at a place (axis index of a channel)
    /// without an axis. If the content is writable, a write at a place exchanges axes.
    AxisNumber,
}

/// The initial values of an object, element or variable.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct Initial {
    /// Size in bytes of the value of an instance; for an array, of the whole array.
    pub(in crate::simulator) size: usize,
    pub(super) values: InitialValues,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum InitialValues {
    /// The same value for all instances.
    Same(Vec<u8>),
    /// One value for each of the first instances; zeros for further instances.
    Each(Vec<Vec<u8>>),
}

impl Initial {
    /// The value of an instance, such as an axis, a channel or a spindle, counted from 0.
    pub(in crate::simulator) fn of(&self, instance: usize) -> Vec<u8> {
        match &self.values {
            InitialValues::Same(value) => value.clone(),
            InitialValues::Each(values) => {
                values.get(instance).cloned().unwrap_or_else(|| vec![0; self.size])
            }
        }
    }
}

/// COM objects of a channel, of the platform, or of each axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::simulator) struct Objects {
    pub(in crate::simulator) items: Vec<Item>,
    /// The index offset of each object without the axis, in the order of `items`.
    pub(in crate::simulator) elements: Vec<u32>,
    pub(super) by_element: HashMap<u32, usize>,
}

impl Objects {
    /// The index in `items` of the object with this value in `elements`.
    pub(in crate::simulator) fn at(&self, element: u32) -> Option<usize> {
        self.by_element.get(&element).copied()
    }
}

/// The elements of each instance of a class.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::simulator) struct Elements {
    /// Name of an instance; `{}` stands for the number of the channel, or the index of the axis or
    /// spindle.
    pub(super) name: String,
    /// The elements from element 1 on.
    pub(in crate::simulator) items: Vec<Item>,
}

impl Elements {
    /// The name of the instance with this number or index.
    pub(in crate::simulator) fn name(&self, number: impl ToString) -> String {
        self.name.replace("{}", &number.to_string())
    }
}

/// A class of SDA and GEO.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::simulator) struct ClassModel {
    /// Elements of each channel; in the class of spindles, of each spindle.
    pub(in crate::simulator) channel: Elements,
    /// Elements of each axis.
    pub(in crate::simulator) axis: Elements,
}
