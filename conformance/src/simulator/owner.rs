//! What objects and elements belong to.

use ads_cnc::address::Class;

/// What an object or an element belongs to. Places are counted from 0 here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// COM: the platform.
    Platform,
    /// COM: a channel.
    Channel(usize),
    /// COM: a platform axis.
    Axis(usize),
    /// COM: whatever axis is at a place of a channel.
    Place { channel: usize, place: usize },
    /// A class: a channel.
    ClassChannel(Class, usize),
    /// A class: a platform axis.
    ClassAxis(Class, usize),
    /// A class: whatever axis is at a place of a channel.
    ClassPlace { class: Class, channel: usize, place: usize },
    /// A spindle.
    Spindle(usize),
}
