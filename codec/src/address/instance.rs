//! The channel, platform axis or spindle in the low bits of an index group, and the channel axis in
//! the high bits of an index offset.

use core::fmt;

use super::offset::AXIS_MAX;
use super::{Addressing, AxisStride, Group, IndexOffset};
use crate::error::{Error, ErrorKind};
use crate::layout::Field;
use crate::layout::index_group::{CHANNEL, PLATFORM_AXIS, SPINDLE};
use crate::layout::index_offset::CHANNEL_AXIS;

/// Checks that a number is within the [`range`] of this field, and converts it (ADR-9).
fn check<N: TryFrom<u32>>(field: Field, number: u32) -> Result<N, Error> {
    let nearest = range(field).map_or(number, |(_, least, most)| number.max(least).min(most));
    match N::try_from(number) {
        Ok(fits) if nearest == number => Ok(fits),
        _ => Err(Error::new(ErrorKind::OutOfRange, field, 0, nearest, number)),
    }
}

/// The largest instance number: an index group has 8 bits for it (ADR-9).
const INSTANCE_MAX: u32 = 0xFF;

/// The name, minimum and maximum of the constructor argument that `field` identifies in an error;
/// `None` for any other field.
pub(crate) fn range(field: Field) -> Option<(&'static str, u32, u32)> {
    match field {
        CHANNEL => Some(("channel", 1, INSTANCE_MAX)),
        PLATFORM_AXIS => Some(("platform axis", 1, INSTANCE_MAX)),
        SPINDLE => Some(("spindle", 0, INSTANCE_MAX)),
        CHANNEL_AXIS => Some(("channel axis", 1, AXIS_MAX)),
        _ => None,
    }
}

/// A channel, counted from 1 (GEN-6): by its logical number, or by its index among the active channels.
///
/// The index of a channel changes when a channel before it is deactivated (ADR-11). The manuals
/// therefore recommend addressing by the number, which they call logical addressing.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.
///
/// ```
/// use ads_cnc::address::{Attribute, Channel, Class};
///
/// assert_eq!(Channel::new(6)?.class(Class::Interpolator, Attribute::Content).get(), 0x12_1306);
/// assert_eq!(Channel::by_index(2)?.class(Class::Interpolator, Attribute::Content).get(), 0x2_1302);
/// assert!(Channel::new(0).is_err() && Channel::new(256).is_err());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Channel {
    number: u8,
    addressing: Addressing,
}

impl Channel {
    /// The channel with this logical number.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for 0 and for a number of more than 8 bits.
    pub fn new(number: u32) -> Result<Self, Error> {
        Self::with_addressing(number, Addressing::Logical)
    }

    /// The channel with this index among the active channels.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for 0 and for a number of more than 8 bits.
    pub fn by_index(rank: u32) -> Result<Self, Error> {
        Self::with_addressing(rank, Addressing::Index)
    }

    /// The low bits of an index group as a channel; `None` if they are 0. The group must belong to
    /// a channel, which is not checked.
    pub(crate) fn from_group(group: Group) -> Option<Self> {
        let (instance, addressing) = match group {
            Group::Com(com) => (com.instance, com.addressing),
            Group::Class(class) => (class.instance, class.addressing),
        };
        (instance > 0).then_some(Self { number: instance, addressing })
    }

    fn with_addressing(number: u32, addressing: Addressing) -> Result<Self, Error> {
        Ok(Self { number: check(CHANNEL, number)?, addressing })
    }

    /// The logical number, or the index.
    pub const fn number(self) -> u8 {
        self.number
    }

    /// Whether [`number`](Self::number) is a logical number or an index.
    pub const fn addressing(self) -> Addressing {
        self.addressing
    }
}

/// A platform axis, counted from 1 in the order of the configuration. Its index does not change
/// (ADR-13).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 1 and 2.1.
///
/// ```
/// use ads_cnc::address::{Access, PlatformAxis};
///
/// assert_eq!(PlatformAxis::new(3)?.com(Access::Element).get(), 0x12_0203);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct PlatformAxis(u8);

impl PlatformAxis {
    /// The axis with this index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for 0 and for a number of more than 8 bits.
    pub fn new(index: u32) -> Result<Self, Error> {
        check(PLATFORM_AXIS, index).map(Self)
    }

    /// The index, from 1.
    pub const fn index(self) -> u8 {
        self.0
    }
}

/// The index of an axis in a channel, counted from 1. An axis exchange can change which axis has
/// which index (ADR-13).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 1 and 4.2.2.
///
/// ```
/// use ads_cnc::address::ChannelAxis;
///
/// assert_eq!(ChannelAxis::new(2)?.offset(4)?.get(), 0x2_0004);
/// // With axis 0, the offset would be 4, which is that of another function (VAR-26, DYN-1).
/// assert!(ChannelAxis::new(0).is_err());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ChannelAxis(u16);

impl ChannelAxis {
    /// The axis with this index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for 0 and for a number of more than 16 bits.
    pub fn new(index: u32) -> Result<Self, Error> {
        check(CHANNEL_AXIS, index).map(Self)
    }

    /// The axis in the high 16 bits of an index offset; `None` if they are 0.
    pub(crate) fn from_offset(offset: IndexOffset) -> Option<Self> {
        let [_, _, low, high] = offset.get().to_le_bytes();
        let axis = u16::from_le_bytes([low, high]);
        (axis > 0).then_some(Self(axis))
    }

    /// The index, from 1.
    pub const fn index(self) -> u16 {
        self.0
    }

    /// The index offset of an element of this axis, with a stride of 0x10000 between axes.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an element index of more than 16 bits.
    pub fn offset(self, element: u32) -> Result<IndexOffset, Error> {
        IndexOffset::for_axis(AxisStride::X10000, self.0.into(), element)
    }
}

/// A spindle, counted from 0 (GEN-6) and addressed by index only (ADR-2).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.
///
/// ```
/// use ads_cnc::address::{Attribute, Spindle};
///
/// // The third spindle.
/// assert_eq!(Spindle::new(2)?.class(Attribute::Content).get(), 0x2_5302);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Spindle(u8);

impl Spindle {
    /// The spindle with this index.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for a number of more than 8 bits.
    pub fn new(index: u32) -> Result<Self, Error> {
        check(SPINDLE, index).map(Self)
    }

    /// The index, from 0.
    pub const fn index(self) -> u8 {
        self.0
    }
}

/// Displays the logical number, or the index.
impl fmt::Display for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.number().fmt(f)
    }
}

/// Displays the index, which counts from 1.
impl fmt::Display for PlatformAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.index().fmt(f)
    }
}

/// Displays the index, which counts from 1.
impl fmt::Display for ChannelAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.index().fmt(f)
    }
}

/// Displays the index, which counts from 0.
impl fmt::Display for Spindle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.index().fmt(f)
    }
}
