//! Index groups.

use core::fmt;

use super::{Attribute, Channel, Class, ClassGroup, PlatformAxis};

const LOGICAL: u32 = 0x10_0000;
pub(super) const ELEMENT: u32 = 0x02_0000;
const OBJECT: u32 = 0x03_0000;
const COM_CHANNEL: u32 = 0x100;
const COM_AXIS: u32 = 0x200;

/// An index group: any number of 32 bits.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.
///
/// ```
/// use ads_cnc::address::{Addressing, Attribute, Class, ClassGroup, Group, IndexGroup};
///
/// let group = IndexGroup::new(0x12_3801);
/// assert_eq!(
///     group.parts(),
///     Some(Group::Class(ClassGroup {
///         addressing: Addressing::Logical,
///         class: Class::Hld,
///         attribute: Attribute::WriteFlag,
///         instance: 1,
///     }))
/// );
/// // An unknown group is only a number.
/// assert_eq!(IndexGroup::new(0xF005).parts(), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IndexGroup(u32);

impl IndexGroup {
    /// The index group with this number; any number is valid.
    pub const fn new(number: u32) -> Self {
        Self(number)
    }

    /// The number.
    pub const fn get(self) -> u32 {
        self.0
    }

    /// The parts of the group; `None` for a number that cannot be divided into the parts of a
    /// [`Group`]. [`Group::index_group`] is the inverse.
    pub const fn parts(self) -> Option<Group> {
        let [instance, table, ..] = self.0.to_le_bytes();
        let addressing = match self.0 & LOGICAL {
            0 => Addressing::Index,
            _ => Addressing::Logical,
        };
        match (self.0 & !(LOGICAL | 0xFFFF), table >> 4, table & 0x0F) {
            (access @ (ELEMENT | OBJECT), 0, table @ (1 | 2)) => {
                let access = match access {
                    OBJECT => Access::Object,
                    _ => Access::Element,
                };
                let table = match table {
                    1 => ComTable::Channel,
                    _ => ComTable::Axis,
                };
                Some(Group::Com(ComGroup { addressing, access, table, instance }))
            }
            (ELEMENT, class, attribute) => {
                match (Class::from_number(class), Attribute::from_number(attribute), addressing) {
                    // Spindles have no logical address.
                    (Some(Class::Spindle), _, Addressing::Logical) => None,
                    (Some(class), Some(attribute), _) => {
                        Some(Group::Class(ClassGroup { addressing, class, attribute, instance }))
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

impl fmt::Debug for IndexGroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

impl fmt::Display for IndexGroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#x}", self.0)
    }
}

/// The parts of an index group.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1 and 2.2.1.
///
/// ```
/// use ads_cnc::address::{Class, Group, IndexGroup};
///
/// assert!(matches!(IndexGroup::new(0x13_0101).parts(), Some(Group::Com(_))));
/// let Some(Group::Class(parts)) = IndexGroup::new(0x12_2301).parts() else { panic!() };
/// assert_eq!((parts.class, parts.instance), (Class::Decoder, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Group {
    /// The COM task, AMS port 553.
    Com(ComGroup),
    /// The SDA and GEO tasks, AMS ports 552 and 551. SDA serves the decoder; which task serves the other
    /// classes is not documented (ADR-10).
    Class(ClassGroup),
}

impl Group {
    /// The index group with these parts.
    pub const fn index_group(self) -> IndexGroup {
        match self {
            Self::Com(com) => com.index_group(),
            Self::Class(class) => class.index_group(),
        }
    }
}

/// Logical addressing, or addressing by index (ADR-1).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.
///
/// ```
/// use ads_cnc::address::{Attribute, Channel, Class};
///
/// // Channel 6, which is the second active channel.
/// let interpolator = |channel: Channel| channel.class(Class::Interpolator, Attribute::Content);
/// assert_eq!(interpolator(Channel::new(6)?).get(), 0x12_1306);
/// assert_eq!(interpolator(Channel::by_index(2)?).get(), 0x2_1302);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Addressing {
    /// Addressing by the configured number: bit 0x100000 of the index group is set.
    Logical,
    /// Addressing by the position among the active instances: bit 0x100000 is not set.
    Index,
}

impl Addressing {
    pub(super) const fn bits(self) -> u32 {
        match self {
            Self::Logical => LOGICAL,
            Self::Index => 0,
        }
    }
}

/// Whether an index group of COM addresses the content of objects, or their number and descriptors
/// (ADR-4). Groups of SDA and GEO always have element access.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1 and 2.1.2.
///
/// ```
/// use ads_cnc::address::{Access, Channel};
///
/// assert_eq!(Channel::new(1)?.com(Access::Object).get(), 0x13_0101);
/// assert_eq!(Channel::new(1)?.com(Access::Element).get(), 0x12_0101);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Access {
    /// Element access, 0x20000: to the content of objects.
    Element,
    /// Object access, 0x30000: to the number and the descriptors of objects.
    Object,
}

/// One of the two tables of the COM task (ADR-3).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 1 and 2.1.
///
/// ```
/// use ads_cnc::address::{Access, ComGroup, ComTable};
///
/// let platform = ComGroup::platform(Access::Element);
/// let first_axis = ComGroup { table: ComTable::Axis, instance: 1, ..platform };
/// assert_eq!(first_axis.index_group().get(), 0x12_0201);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ComTable {
    /// 0x100: the channels, and the platform (instance 0, or 1 because channel 1 drives the platform).
    Channel,
    /// 0x200: platform axes.
    Axis,
}

/// The parts of a group of the COM task.
///
/// `0x120101` is channel 1 and also the platform, because channel 1 drives the platform (E-04).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1, 2.1.1 and 2.1.2.
///
/// ```
/// use ads_cnc::address::{Access, Addressing, ComGroup, ComTable};
///
/// let list = ComGroup {
///     addressing: Addressing::Logical,
///     access: Access::Object,
///     table: ComTable::Channel,
///     instance: 1,
/// };
/// assert_eq!(list.index_group().get(), 0x13_0101);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ComGroup {
    /// Logical addressing, or addressing by index.
    pub addressing: Addressing,
    /// Access to the content of objects, or to their number and descriptors.
    pub access: Access,
    /// The table of channels, or of platform axes.
    pub table: ComTable,
    /// The logical number or the index of the channel (0 for the platform) or platform axis.
    pub instance: u8,
}

impl ComGroup {
    /// The group of the platform, as channel 0.
    pub const fn platform(access: Access) -> Self {
        Self { addressing: Addressing::Logical, access, table: ComTable::Channel, instance: 0 }
    }

    /// The index group with these parts.
    pub const fn index_group(self) -> IndexGroup {
        let access = match self.access {
            Access::Element => ELEMENT,
            Access::Object => OBJECT,
        };
        let table = match self.table {
            ComTable::Channel => COM_CHANNEL,
            ComTable::Axis => COM_AXIS,
        };
        IndexGroup(self.addressing.bits() | access | table | low(self.instance))
    }
}

impl Channel {
    /// The group of this channel in the COM task.
    pub const fn com(self, access: Access) -> IndexGroup {
        let (addressing, instance) = (self.addressing(), self.number());
        ComGroup { addressing, access, table: ComTable::Channel, instance }.index_group()
    }
}

impl PlatformAxis {
    /// The group of this axis in the COM task.
    pub const fn com(self, access: Access) -> IndexGroup {
        let addressing = Addressing::Logical;
        ComGroup { addressing, access, table: ComTable::Axis, instance: self.index() }.index_group()
    }
}

pub(super) const fn low(instance: u8) -> u32 {
    u32::from_le_bytes([instance, 0, 0, 0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every documented group parses, and for every 24-bit number that parses, the group built from
    /// its parts is the same number (ADR-10).
    #[test]
    #[cfg_attr(miri, ignore = "too many numbers for an interpreter")]
    fn parts_add_up_to_the_group() {
        let mut known = 0;
        for number in 0..=0xFF_FFFF {
            if let Some(parts) = IndexGroup(number).parts() {
                assert_eq!(parts.index_group(), IndexGroup(number));
                known += 1;
            }
        }
        // COM: 2 addressings × 2 accesses × 2 tables. 5 classes × 7 attributes × 2 addressings. Spindle: 7.
        assert_eq!(known, 256 * (8 + 70 + 7));
        assert_eq!(IndexGroup(0x0112_0301).parts(), None);
    }
}

crate::number::from_number!(IndexGroup);
