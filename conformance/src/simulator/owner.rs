//! Owners of objects and elements.

use ads_cnc::address::Class;

/// The owner of an object or an element. Numbers are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// COM: the platform.
    Platform,
    /// COM: a channel.
    Channel(usize),
    /// COM: a platform axis.
    Axis(usize),
    /// COM: the axis at a place of a channel.
    Place { channel: usize, place: usize },
    /// A class: a channel.
    ClassChannel(Class, usize),
    /// A class: a platform axis.
    ClassAxis(Class, usize),
    /// A class: the axis at a place of a channel.
    ClassPlace { class: Class, channel: usize, place: usize },
    /// A spindle.
    Spindle(usize),
}
