//! Lists of objects, elements, variables and parameters.

use std::fmt;

use ads_cnc::address::{Class, ComTable};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::ObjectList;

/// A list of objects, elements, variables or parameters. `Display` formats the name of the list, as
/// the tools show it.
///
/// ```
/// use ads_cnc::address::Class;
/// use ads_cnc_conformance::objects::ValueList;
///
/// let decoder = ValueList::Class { class: Class::Decoder, channel: Some(1), axis: Some(2) };
/// assert_eq!(decoder.to_string(), "decoder channel 1 axis 2");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ValueList {
    /// The objects of the platform (COM task).
    Platform,
    /// The objects of the channel with this number (COM task).
    Channel(u8),
    /// The objects of the platform axis with this index (COM task).
    Axis(u8),
    /// The elements of an instance of a class of SDA and GEO.
    Class {
        class: Class,
        /// The channel number, or the index of a spindle; `None` for the platform.
        channel: Option<u8>,
        /// The index of the axis on the platform or in the channel; `None` for the channel itself,
        /// and for a spindle.
        axis: Option<u8>,
    },
    /// Variables of a kind such as `V.E`.
    Variables {
        kind: &'static str,
        channel: u8,
        /// The index of the axis in the channel, for the axis interface; `None` for the channel
        /// interface.
        axis: Option<u16>,
    },
    /// Dynamic parameters of a kind.
    Parameters { kind: DynamicKind, channel: u8 },
}

impl ValueList {
    /// The number of the channel to which the list, or its axis, belongs; `None` for a list of the
    /// platform or of a spindle.
    pub(crate) fn channel(&self) -> Option<u8> {
        match *self {
            // For a spindle, the field `channel` is the index of the spindle.
            Self::Platform | Self::Axis(_) | Self::Class { class: Class::Spindle, .. } => None,
            Self::Class { channel, .. } => channel,
            Self::Channel(channel)
            | Self::Variables { channel, .. }
            | Self::Parameters { channel, .. } => Some(channel),
        }
    }

    /// The list of the elements of an instance; `channel` and `axis` are those of the request for
    /// the instance.
    pub(crate) fn of_instance(class: Class, channel: u32, axis: u32) -> Self {
        let is_of_channel = class == Class::Spindle || channel > 0;
        let channel = u8::try_from(channel).ok().filter(|_| is_of_channel);
        let axis = u8::try_from(axis).ok().filter(|&axis| axis > 0);
        Self::Class { class, channel, axis }
    }
}

impl From<ObjectList> for ValueList {
    fn from(list: ObjectList) -> Self {
        let parts = list.parts();
        match (parts.table, parts.instance) {
            (ComTable::Axis, axis) => Self::Axis(axis),
            (ComTable::Channel, 0) => Self::Platform,
            (ComTable::Channel, number) => Self::Channel(number),
        }
    }
}

impl fmt::Display for ValueList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Platform => f.write_str("COM platform"),
            Self::Channel(number) => write!(f, "COM channel {number}"),
            Self::Axis(place) => write!(f, "COM axis {place}"),
            Self::Class { class, channel, axis } => {
                class.fmt(f)?;
                match channel {
                    Some(index) if class == Class::Spindle => write!(f, " {index}")?,
                    Some(number) => write!(f, " channel {number}")?,
                    None => {}
                }
                axis.map_or(Ok(()), |axis| write!(f, " axis {axis}"))
            }
            Self::Variables { kind, channel, axis } => {
                write!(f, "{kind} channel {channel}")?;
                axis.map_or(Ok(()), |axis| write!(f, " axis {axis}"))
            }
            Self::Parameters { kind, channel } => write!(f, "{kind} channel {channel}"),
        }
    }
}
