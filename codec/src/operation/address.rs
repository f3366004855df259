//! The address of a call: built from the parts of an operation by the rules of its function, and parsed
//! into these parts.

use super::{GroupRule, OffsetRule};
use crate::address::{
    Access, Attribute, Channel, ChannelAxis, ClassGroup, ComGroup, ComTable, ElementAddress, Group,
    IndexGroup, IndexOffset, PlatformAxis,
};
use crate::dynamic::DynamicKind;

/// The parts of an operation that determine its address.
pub(super) trait Address: Copy {
    fn group(self, rule: GroupRule) -> IndexGroup;

    fn offset(self, rule: OffsetRule) -> IndexOffset {
        rule.first()
    }

    /// Parses an address that matches the rules of the function.
    fn from_call(group: Group, offset: IndexOffset, rule: OffsetRule) -> Option<Self>;
}

impl Address for (Channel,) {
    fn group(self, rule: GroupRule) -> IndexGroup {
        match rule {
            GroupRule::ChannelOf(class) => self.0.class(class, Attribute::Content),
            _ => self.0.com(Access::Element),
        }
    }

    fn from_call(group: Group, _: IndexOffset, _: OffsetRule) -> Option<Self> {
        Channel::from_group(group).map(|channel| (channel,))
    }
}

impl Address for (Channel, ChannelAxis) {
    fn group(self, rule: GroupRule) -> IndexGroup {
        (self.0,).group(rule)
    }

    fn offset(self, rule: OffsetRule) -> IndexOffset {
        // This cannot fail: the elements with `OffsetRule::OfAxis` in the table are 4, 5 and 6.
        self.1.offset(rule.first().get()).unwrap_or(rule.first())
    }

    fn from_call(group: Group, offset: IndexOffset, _: OffsetRule) -> Option<Self> {
        Some((Channel::from_group(group)?, ChannelAxis::from_offset(offset)?))
    }
}

impl Address for (Channel, DynamicKind) {
    fn group(self, rule: GroupRule) -> IndexGroup {
        (self.0,).group(rule)
    }

    fn offset(self, rule: OffsetRule) -> IndexOffset {
        match rule {
            OffsetRule::OfKind(offsets) => self.1.offset(offsets),
            _ => rule.first(),
        }
    }

    fn from_call(group: Group, offset: IndexOffset, rule: OffsetRule) -> Option<Self> {
        let OffsetRule::OfKind(offsets) = rule else { return None };
        Some((Channel::from_group(group)?, DynamicKind::from_offset(offsets, offset)?))
    }
}

impl Address for (ObjectList,) {
    fn group(self, _: GroupRule) -> IndexGroup {
        self.0.index_group()
    }

    fn from_call(group: Group, _: IndexOffset, _: OffsetRule) -> Option<Self> {
        let Group::Com(group) = group else { return None };
        Some((ObjectList(group),))
    }
}

/// A list of objects, and the number of an object in the list.
impl Address for (ObjectList, u32) {
    fn group(self, _: GroupRule) -> IndexGroup {
        self.0.index_group()
    }

    fn offset(self, _: OffsetRule) -> IndexOffset {
        IndexOffset::new(self.1)
    }

    fn from_call(group: Group, offset: IndexOffset, rule: OffsetRule) -> Option<Self> {
        let (list,) = Address::from_call(group, offset, rule)?;
        Some((list, offset.get()))
    }
}

/// The address of the content of a COM object.
impl Address for ((ComGroup, IndexOffset),) {
    fn group(self, _: GroupRule) -> IndexGroup {
        self.0.0.index_group()
    }

    fn offset(self, _: OffsetRule) -> IndexOffset {
        self.0.1
    }

    fn from_call(group: Group, offset: IndexOffset, _: OffsetRule) -> Option<Self> {
        let Group::Com(group) = group else { return None };
        Some(((group, offset),))
    }
}

/// The query of the object addresses of a class.
impl Address for (ClassGroup,) {
    fn group(self, _: GroupRule) -> IndexGroup {
        self.0.index_group()
    }

    fn from_call(group: Group, _: IndexOffset, _: OffsetRule) -> Option<Self> {
        let Group::Class(group) = group else { return None };
        Some((group,))
    }
}

impl Address for (ElementAddress,) {
    fn group(self, rule: GroupRule) -> IndexGroup {
        self.0.group(match rule {
            GroupRule::Elements(attribute) => attribute,
            _ => Attribute::Content,
        })
    }

    fn offset(self, _: OffsetRule) -> IndexOffset {
        self.0.index_offset()
    }

    fn from_call(group: Group, offset: IndexOffset, _: OffsetRule) -> Option<Self> {
        let Group::Class(group) = group else { return None };
        Some((ElementAddress::new(group, offset),))
    }
}

/// The list of objects of the platform, of a channel or of a platform axis.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1 and 2.1.1.
///
/// ```
/// use ads_cnc::address::{Channel, PlatformAxis};
/// use ads_cnc::operation::ObjectList;
///
/// assert_eq!(ObjectList::PLATFORM.index_group().get(), 0x13_0100);
/// assert_eq!(ObjectList::from(Channel::new(1)?).index_group().get(), 0x13_0101);
/// assert_eq!(ObjectList::from(PlatformAxis::new(2)?).index_group().get(), 0x13_0202);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ObjectList(ComGroup);

impl ObjectList {
    /// The list of the platform. The list of the first channel also contains the objects of the platform
    /// (COM-4).
    pub const PLATFORM: Self = Self(ComGroup::platform(Access::Object));

    /// The index group of the list.
    pub const fn index_group(self) -> IndexGroup {
        self.0.index_group()
    }

    /// The parts of the index group.
    pub const fn parts(self) -> ComGroup {
        self.0
    }
}

impl From<Channel> for ObjectList {
    fn from(channel: Channel) -> Self {
        Self(ComGroup {
            addressing: channel.addressing(),
            instance: channel.number(),
            ..Self::PLATFORM.0
        })
    }
}

impl From<PlatformAxis> for ObjectList {
    /// The index group for the descriptors of a platform axis is assumed (COM-7).
    fn from(axis: PlatformAxis) -> Self {
        Self(ComGroup { table: ComTable::Axis, instance: axis.index(), ..Self::PLATFORM.0 })
    }
}
