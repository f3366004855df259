//! Elements of an instance of a class.

use super::{
    Addressing, Attribute, AxisStride, Channel, ChannelAxis, Class, ClassGroup, IndexGroup,
    IndexOffset, Spindle,
};
use crate::error::{Error, ErrorKind};
use crate::layout::index_offset::ELEMENT;

/// The largest element index with the stride 0x10000 (ADR-9).
const ELEMENT_MAX: u32 = AxisStride::X10000.element_max();

/// The address of an element of an instance of a class, for all attributes of the element. In a
/// request, the index group contains the attribute, and the index offset contains the element.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// ```
/// use ads_cnc::address::{Attribute, Channel, ChannelAxis, Class, ElementAddress};
///
/// let feedhold = ElementAddress::for_channel(Channel::new(1)?, Class::Hld, 1)?;
/// assert_eq!(feedhold.group(Attribute::Content).get(), 0x12_3301);
/// assert_eq!(feedhold.group(Attribute::WriteFlag).get(), 0x12_3801);
/// assert_eq!(feedhold.index_offset().get(), 1);
///
/// let axis = ElementAddress::for_axis(Channel::new(1)?, Class::Decoder, ChannelAxis::new(2)?, 0)?;
/// assert_eq!(axis.nth(3)?.index_offset().get(), 0x2_0003);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ElementAddress {
    group: ClassGroup,
    offset: IndexOffset,
}

impl ElementAddress {
    /// The address of the element at this group and offset, such as those that a query of an object
    /// address returns. The attribute of the group is ignored.
    pub const fn new(group: ClassGroup, offset: IndexOffset) -> Self {
        // Spindles have no logical address.
        let addressing = match group.class {
            Class::Spindle => Addressing::Index,
            _ => group.addressing,
        };
        let attribute = Attribute::Content;
        Self { group: ClassGroup { addressing, attribute, ..group }, offset }
    }

    /// The address of an element of a channel itself, not of one of its axes.
    ///
    /// Use it only for classes that belong to a channel. With [`Class::Spindle`], the channel number
    /// would be taken as the index of a spindle: use [`for_spindle`](Self::for_spindle).
    /// [`Class::PositionController`] has platform axes but no channels:
    /// [`FindInstance`](crate::operation::FindInstance) reads the addresses of these axes.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an element index of more than 16 bits (ADR-9).
    pub fn for_channel(channel: Channel, class: Class, element: u32) -> Result<Self, Error> {
        let offset = IndexOffset::for_axis(Default::default(), 0, element)?;
        Ok(Self::with_class(channel.addressing(), class, channel.number(), offset))
    }

    /// The address of an element of an axis of a channel, with a stride of 0x10000 between axes (ADR-7;
    /// assumed for all classes except the decoder).
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an element index of more than 16 bits (ADR-9).
    pub fn for_axis(
        channel: Channel,
        class: Class,
        axis: ChannelAxis,
        element: u32,
    ) -> Result<Self, Error> {
        let offset = axis.offset(element)?;
        Ok(Self::with_class(channel.addressing(), class, channel.number(), offset))
    }

    /// The address of an element of a spindle.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an element index of more than 16 bits (ADR-9).
    pub fn for_spindle(spindle: Spindle, element: u32) -> Result<Self, Error> {
        let offset = IndexOffset::for_axis(Default::default(), 0, element)?;
        Ok(Self::with_class(Addressing::Index, Class::Spindle, spindle.index(), offset))
    }

    const fn with_class(
        addressing: Addressing,
        class: Class,
        instance: u8,
        offset: IndexOffset,
    ) -> Self {
        let attribute = Attribute::Content;
        Self::new(ClassGroup { addressing, class, attribute, instance }, offset)
    }

    /// The element `count` indices after this one (SDA-4).
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] if the element index exceeds 16 bits and would overflow into the
    /// axis (ADR-9).
    pub fn nth(self, count: u32) -> Result<Self, Error> {
        let left = ELEMENT_MAX.saturating_sub(self.offset.get() & ELEMENT_MAX);
        match self.offset.get().checked_add(count) {
            Some(offset) if count <= left => Ok(Self { offset: IndexOffset::new(offset), ..self }),
            _ => Err(Error::new(ErrorKind::OutOfRange, ELEMENT, 0, left, count)),
        }
    }

    /// The addressing, class and instance of the element; the attribute is [`Attribute::Content`].
    pub const fn class_group(self) -> ClassGroup {
        self.group
    }

    /// The index group of this attribute of the element.
    pub const fn group(self, attribute: Attribute) -> IndexGroup {
        ClassGroup { attribute, ..self.group }.index_group()
    }

    /// The index offset of the element, which is the same for all attributes.
    pub const fn index_offset(self) -> IndexOffset {
        self.offset
    }
}
