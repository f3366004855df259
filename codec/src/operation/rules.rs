//! The index groups and index offsets of a function.

use crate::address::{
    Access, Addressing, Attribute, AxisStride, Class, ClassGroup, ComGroup, ComTable, Group,
    IndexGroup, IndexOffset,
};

/// The index groups of a function.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1, 2.2.1 and 4.2.
///
/// ```
/// use ads_cnc::address::IndexGroup;
/// use ads_cnc::operation::Function;
///
/// let rule = Function::HandleByName.spec().group;
/// assert_eq!(rule.example().get(), 0x12_2301);
/// // The decoder of channel 2, but not its interpolator.
/// assert!(rule.contains(IndexGroup::new(0x12_2302).parts().unwrap()));
/// assert!(!rule.contains(IndexGroup::new(0x12_1302).parts().unwrap()));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GroupRule {
    /// Groups of COM with object access: of the platform, a channel or a platform axis.
    ComObjects,
    /// Groups of COM with element access: of the platform, a channel or a platform axis.
    ComContent,
    /// Groups of COM with element access: of a channel.
    ComChannel,
    /// Groups of a channel with the content of this class.
    ChannelOf(Class),
    /// Groups of this attribute, of any class and instance.
    Elements(Attribute),
    /// Groups of the object address of any class; their instance is 0.
    Instances,
}

impl GroupRule {
    /// Whether this group is one of the groups of the rule.
    pub const fn contains(self, group: Group) -> bool {
        match (self, group) {
            // Platform axes are counted from 1; channel 0 is the platform.
            (Self::ComObjects, Group::Com(com)) => {
                matches!(com.access, Access::Object)
                    && (matches!(com.table, ComTable::Channel) || com.instance > 0)
            }
            // The number of the axis may be in the offset instead of the group (E-04).
            (Self::ComContent, Group::Com(com)) => matches!(com.access, Access::Element),
            (Self::ComChannel, Group::Com(com)) => {
                matches!((com.access, com.table), (Access::Element, ComTable::Channel))
                    && com.instance > 0
            }
            (Self::ChannelOf(class), Group::Class(parts)) => {
                parts.class.is(class)
                    && parts.attribute.is(Attribute::Content)
                    && parts.instance > 0
            }
            (Self::Elements(attribute), Group::Class(parts)) => parts.attribute.is(attribute),
            (Self::Instances, Group::Class(parts)) => {
                parts.attribute.is(Attribute::ObjectAddress) && parts.instance == 0
            }
            _ => false,
        }
    }

    /// An index group that the rule contains, as an example. Its instance is 0 for
    /// [`Instances`](Self::Instances), otherwise 1.
    pub const fn example(self) -> IndexGroup {
        match self {
            Self::ComObjects => com_group(Access::Object),
            Self::ComContent | Self::ComChannel => com_group(Access::Element),
            Self::ChannelOf(class) => class_group(class, Attribute::Content, 1),
            Self::Elements(attribute) => class_group(Class::Hld, attribute, 1),
            Self::Instances => class_group(Class::Hld, Attribute::ObjectAddress, 0),
        }
    }
}

const fn com_group(access: Access) -> IndexGroup {
    ComGroup { instance: 1, ..ComGroup::platform(access) }.index_group()
}

const fn class_group(class: Class, attribute: Attribute, instance: u8) -> IndexGroup {
    // For a spindle, `index_group` ignores the addressing.
    let addressing = Addressing::Logical;
    ClassGroup { addressing, class, attribute, instance }.index_group()
}

/// The index offsets of a function.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.1.1, 2.2.2, 3.1 … 3.4 and 4.2.
///
/// ```
/// use ads_cnc::address::IndexOffset;
/// use ads_cnc::operation::{Function, OffsetRule};
///
/// assert_eq!(Function::HandleByName.spec().offset, OffsetRule::At(0x46));
/// let of_axis = Function::AxisHandleByName.spec().offset;
/// assert!(of_axis.contains(IndexOffset::new(0x1_0004)));
/// assert!(of_axis.contains(IndexOffset::new(0x2_0004)));
/// assert!(!of_axis.contains(IndexOffset::new(4)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OffsetRule {
    /// Only this offset.
    At(u32),
    /// Four offsets, one for each kind of dynamic parameters.
    OfKind([u32; 4]),
    /// This offset and all greater offsets.
    AtLeast(u32),
    /// `axis * 0x10000` plus this element, for every axis from 1 on (VAR-26).
    OfAxis(u32),
    /// All multiples of 0x10000: the offsets of the first elements of instances, including axes
    /// with the stride 0x10000, and every sixteenth axis with the stride 0x1000.
    FirstElement,
}

impl OffsetRule {
    /// The first offset of the rule; for [`OfAxis`](Self::OfAxis), the element.
    pub(crate) const fn first(self) -> IndexOffset {
        IndexOffset::new(match self {
            Self::At(first) | Self::OfKind([first, ..]) | Self::AtLeast(first) => first,
            Self::OfAxis(element) => element,
            Self::FirstElement => 0,
        })
    }

    /// Whether this offset is one of the offsets of the rule.
    pub const fn contains(self, offset: IndexOffset) -> bool {
        match self {
            Self::At(at) => offset.get() == at,
            Self::OfKind([one, two, three, four]) => {
                let offset = offset.get();
                offset == one || offset == two || offset == three || offset == four
            }
            Self::AtLeast(first) => offset.get() >= first,
            Self::OfAxis(element) => match offset.axis_and_element(AxisStride::X10000) {
                Ok((axis, found)) => axis > 0 && found == element,
                Err(_) => false,
            },
            Self::FirstElement => matches!(offset.axis_and_element(AxisStride::X10000), Ok((_, 0))),
        }
    }
}
