//! The data model.

use std::collections::HashMap;

use ads_cnc::address::Class;
use ads_cnc::{CncString, Descriptors};

use super::{ClassModel, Objects, Parameter, VariableRef, Variables};
use crate::edition::{CncVersion, Edition};
use crate::simulator::program::{ProgramConfig, ScriptConfig};

/// A checked data model.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    pub(in crate::simulator) edition: Edition,
    pub(in crate::simulator) version: Option<CncVersion>,
    /// The channels in the order of their numbers.
    pub(in crate::simulator) channels: Vec<ChannelModel>,
    /// The axes in the configured order, which is also the order of the platform axes.
    pub(in crate::simulator) axes: Vec<AxisModel>,
    pub(in crate::simulator) spindles: usize,
    pub(in crate::simulator) platform: Objects,
    /// Objects of each platform axis.
    pub(in crate::simulator) platform_axis: Objects,
    /// Objects of each axis of a channel.
    pub(in crate::simulator) channel_axis: Objects,
    /// The variables of V.A.
    pub(in crate::simulator) axis_variables: Variables,
    pub(in crate::simulator) classes: [ClassModel; 6],
    pub(in crate::simulator) platform_list: Descriptors,
    pub(in crate::simulator) axis_lists: Vec<Descriptors>,
}

#[derive(Clone, Debug, PartialEq)]
pub(in crate::simulator) struct ChannelModel {
    /// Logical number, from 1.
    pub(in crate::simulator) number: u8,
    /// Whether the channel is initially active.
    pub(in crate::simulator) active: bool,
    /// The initial axis at each place (axis index) of the channel, as its index in the model;
    /// `None` without an axis.
    pub(in crate::simulator) places: Vec<Option<usize>>,
    pub(in crate::simulator) objects: Objects,
    pub(in crate::simulator) variables: Variables,
    /// The positions of the V.E variables in `variables`, in the order of their indices.
    pub(in crate::simulator) external: Vec<usize>,
    /// The positions of the V.G variables in `variables`, in the order of their indices.
    pub(in crate::simulator) global: Vec<usize>,
    pub(in crate::simulator) by_handle: HashMap<u32, VariableRef>,
    pub(in crate::simulator) parameters: Vec<Parameter>,
    pub(in crate::simulator) program: ProgramConfig,
    /// The NC program that sends requests to services, if any.
    pub(in crate::simulator) script: Option<ScriptConfig>,
    /// The descriptors of the channel's objects, and of the objects at each of its places.
    pub(in crate::simulator) list: Descriptors,
    /// The same list, followed by the descriptors of the platform's objects (COM-4).
    pub(in crate::simulator) list_of_first: Descriptors,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::simulator) struct AxisModel {
    /// The name of the axis in names of V.A on the channel interface.
    pub(in crate::simulator) name: CncString,
    /// Logical axis number, not 0.
    pub(in crate::simulator) number: u32,
}

/// Settings that override those of a file; `None` keeps the setting of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Settings {
    /// The edition of the manual that the CNC follows.
    pub edition: Option<Edition>,
    /// The version of the CNC, which determines its features.
    pub version: Option<CncVersion>,
}

/// The index of a class in an array with one item per class.
pub(in crate::simulator) const fn class_place(class: Class) -> usize {
    match class {
        Class::PositionController => 0,
        Class::Interpolator => 1,
        Class::Decoder => 2,
        Class::Hld => 3,
        Class::PathPreparation => 4,
        Class::Spindle => 5,
    }
}
