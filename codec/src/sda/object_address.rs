//! Where the instances of a class are (SDA-1 … SDA-3).

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use crate::address::{ElementAddress, Group, IndexGroup, IndexOffset};
use crate::bytes::{Reader, Writer};
use crate::error::{Error, ErrorKind};
use crate::layout::Stream;
use crate::layout::field::object_address::INDEX_GROUP;
use crate::stream::{Decode, Encode};

/// Two numbers, which is what goes in and what comes out.
#[derive(Clone, Copy, FromBytes, IntoBytes, KnownLayout, Immutable, Unaligned)]
#[repr(C)]
struct Pair {
    first: U32,
    second: U32,
}

const _: () = assert!(size_of::<Pair>() == 8);

fn decode(stream: Stream, bytes: &[u8]) -> Result<(u32, u32), Error> {
    let pair: &Pair = Reader::all(stream, bytes)?;
    Ok((pair.first.get(), pair.second.get()))
}

fn encode(stream: Stream, first: u32, second: u32, buf: &mut [u8]) -> Result<&[u8], Error> {
    let pair = Pair { first: first.into(), second: second.into() };
    Writer::copy(stream, pair.as_bytes(), buf)
}

#[doc = include_str!("../../doc/object-address-query.md")]
///
/// Which numbers a class takes:
///
/// | class | channel | axis |
/// |---|---|---|
/// | position controller | 0 | from 1 to the configured axes |
/// | interpolator, decoder, path preparation | from 1 to the configured channels | from 0, the channel itself, to `BAHN_BAVO_AXMAX` |
/// | HLD | from 1 to the configured channels, 0 for platform axes (E-30) | none, or from 1 to the configured axes |
/// | spindle | index of the spindle, from 0 | 0 |
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The widths are assumed.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::Encode;
/// use ads_cnc::sda::ObjectAddressQuery;
///
/// // the first platform axis
/// let query = ObjectAddressQuery { channel: 0, axis: 1 };
/// assert_eq!(query.encode(&mut [0; 8])?, [0, 0, 0, 0, 1, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct ObjectAddressQuery {
    /// Channel, or index of a spindle; 0 for the platform.
    pub channel: u32,
    /// Axis; 0 for the channel itself.
    pub axis: u32,
}

impl<'a> Decode<'a> for ObjectAddressQuery {
    const STREAM: Stream = Stream::ObjectAddressQuery;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let (channel, axis) = decode(Self::STREAM, bytes)?;
        Ok(Self { channel, axis })
    }
}

impl Encode for ObjectAddressQuery {
    fn encoded_len(&self) -> usize {
        size_of::<Pair>()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        encode(Self::STREAM, self.channel, self.axis, buf)
    }
}

#[doc = include_str!("../../doc/object-address.md")]
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2. The widths are assumed.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "arbitrary", derive(arbitrary::Arbitrary))]
pub struct ObjectAddress {
    /// Index group of the content.
    pub index_group: IndexGroup,
    /// Index offset of the first element.
    pub index_offset: IndexOffset,
}

impl ObjectAddress {
    /// The answer that there is no such instance (SDA-2).
    pub const NONE: Self =
        Self { index_group: IndexGroup::new(0), index_offset: IndexOffset::new(0) };

    /// The instance's first element; none if there is no such instance.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that is not that of a class; the number is shown beside
    /// that of the CNC's base, 0x120300.
    pub fn first_element(&self) -> Result<Option<ElementAddress>, Error> {
        const BASE: u32 = 0x12_0300;
        match self.index_group.parts() {
            Some(Group::Class(group)) => Ok(Some(ElementAddress::new(group, self.index_offset))),
            _ if *self == Self::NONE => Ok(None),
            _ => {
                let found = self.index_group.get();
                Err(Error::new(ErrorKind::Mismatch, INDEX_GROUP, 0, BASE, found))
            }
        }
    }
}

impl From<ElementAddress> for ObjectAddress {
    fn from(element: ElementAddress) -> Self {
        Self {
            index_group: element.group(crate::address::Attribute::Content),
            index_offset: element.index_offset(),
        }
    }
}

impl<'a> Decode<'a> for ObjectAddress {
    const STREAM: Stream = Stream::ObjectAddress;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let (group, offset) = decode(Self::STREAM, bytes)?;
        Ok(Self { index_group: IndexGroup::new(group), index_offset: IndexOffset::new(offset) })
    }
}

impl Encode for ObjectAddress {
    fn encoded_len(&self) -> usize {
        size_of::<Pair>()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        encode(Self::STREAM, self.index_group.get(), self.index_offset.get(), buf)
    }
}
