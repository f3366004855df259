//! Owners of objects and elements.

use ads_cnc::address::Class;

/// The owner of an object or an element. All numbers are indices that count from 0; that of a place
/// is the axis index in the channel, which counts from 1, less 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// The platform, as the owner of COM objects.
    Platform,
    /// A channel, as the owner of COM objects.
    Channel(usize),
    /// A platform axis, as the owner of COM objects.
    Axis(usize),
    /// The axis at a place of a channel, as the owner of COM objects.
    Place { channel: usize, place: usize },
    /// A channel, as the owner of the elements of a class.
    ClassChannel(Class, usize),
    /// A platform axis, as the owner of the elements of a class.
    ClassAxis(Class, usize),
    /// The axis at a place of a channel, as the owner of the elements of a class.
    ClassPlace { class: Class, channel: usize, place: usize },
    /// A spindle.
    Spindle(usize),
}
