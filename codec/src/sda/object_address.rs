//! The addresses of the instances of a class.

use crate::address::{
    Addressing, Attribute, Class, ClassGroup, ElementAddress, Group, IndexGroup, IndexOffset,
};
use crate::declare::stream;
use crate::error::{Error, ErrorKind};
use crate::layout::Field;

stream! {
    /// The query of the address of an instance of a class.
    ///
    /// Valid numbers for each class:
    ///
    /// | class | channel | axis |
    /// |---|---|---|
    /// | position controller | 0 | from 1 to the number of configured axes |
    /// | interpolator, decoder, path preparation | from 1 to the number of configured channels | from 0 (the channel itself) to `BAHN_BAVO_AXMAX` |
    /// | HLD | from 1 to the number of configured channels, 0 for platform axes (E-30) | 0, or from 1 to the number of configured axes |
    /// | spindle | index of the spindle, from 0 | 0 |
    ///
    /// `BAHN_BAVO_AXMAX` is a constant of the CNC, whose value the manuals do not print (E-84).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The widths of the numbers are assumed.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Encode;
    /// use ads_cnc::sda::ObjectAddressQuery;
    ///
    /// // The first platform axis.
    /// let query = ObjectAddressQuery { channel: 0, axis: 1 };
    /// assert_eq!(query.encode(&mut [0; 8])?, [0, 0, 0, 0, 1, 0, 0, 0]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ObjectAddressQuery "object-address-query", "Object address, request", "SDA-1", max 8;
    struct ObjectAddressQuery {
        @0 channel: UNS32, "SDA-5", "channel, or index of a spindle; 0 for the platform";
        @4 axis: UNS32,    "SDA-5", "axis; 0 for the channel itself";
    }
}

stream! {
    /// The address of an instance of a class.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The widths of the numbers are assumed.
    ///
    /// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::Decode;
    /// use ads_cnc::sda::ObjectAddress;
    ///
    /// let second_axis_of_channel_1 = ObjectAddress::decode(&[0x01, 0x23, 0x12, 0, 0, 0, 0x02, 0])?;
    /// assert_eq!(second_axis_of_channel_1.index_group.get(), 0x12_2301);
    /// assert_eq!(second_axis_of_channel_1.index_offset.get(), 0x2_0000);
    /// assert_eq!(ObjectAddress::decode(&[0; 8])?, ObjectAddress::NONE);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ObjectAddress "object-address", "Object address, reply", "SDA-1", max 8;
    struct ObjectAddress {
        @0 index_group: UNS32 as IndexGroup,   "SDA-2", "index group of the content; 0 for no such instance";
        @4 index_offset: UNS32 as IndexOffset, "SDA-2", "index offset of the first element";
    }
}

impl ObjectAddress {
    /// The reply for an instance that does not exist (SDA-2).
    pub const NONE: Self =
        Self { index_group: IndexGroup::new(0), index_offset: IndexOffset::new(0) };

    /// The first element of the instance; `None` if the instance does not exist.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that does not belong to a class; [`Error::expected`] is an
    /// example of a valid group, 0x120300.
    pub fn first_element(&self) -> Result<Option<ElementAddress>, Error> {
        const EXPECTED: IndexGroup = ClassGroup {
            addressing: Addressing::Logical,
            class: Class::PositionController,
            attribute: Attribute::Content,
            instance: 0,
        }
        .index_group();
        match self.index_group.parts() {
            Some(Group::Class(group)) => Ok(Some(ElementAddress::new(group, self.index_offset))),
            _ if *self == Self::NONE => Ok(None),
            _ => {
                let found = self.index_group.get();
                const GROUP: Field = Field::of::<ObjectAddress>("index_group");
                Err(Error::new(ErrorKind::Mismatch, GROUP, 0, EXPECTED.get(), found))
            }
        }
    }
}

impl From<ElementAddress> for ObjectAddress {
    fn from(element: ElementAddress) -> Self {
        Self {
            index_group: element.group(Attribute::Content),
            index_offset: element.index_offset(),
        }
    }
}
