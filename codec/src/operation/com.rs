//! Operations of the COM task (COM-1 … COM-4, COM-7).

use super::request::sealed::Sealed;
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Access, Channel, ComGroup, IndexGroup, IndexOffset, OfCom, PlatformAxis};
use crate::bytes::to_u32;
use crate::com::{DescriptorLayout, DescriptorsRef, ObjectCount};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::limits::DESCRIPTOR_LEN;

/// Whose objects: the platform's, a channel's, a platform axis's.
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
pub struct ObjectList(OfCom);

impl ObjectList {
    /// The platform's; the first channel lists them too (COM-4).
    pub const PLATFORM: Self = Self(OfCom::new(ComGroup::platform(Access::Object)));

    /// The list's index group.
    pub const fn index_group(self) -> IndexGroup {
        self.0.group()
    }

    /// What the group is made of.
    pub const fn parts(self) -> ComGroup {
        self.0.parts()
    }

    /// The dispatcher has found the group to be one of COM with object access.
    fn dispatched(call: &Call<'_>) -> Self {
        Self(OfCom::known(call.index_group))
    }
}

impl From<Channel> for ObjectList {
    fn from(channel: Channel) -> Self {
        Self(OfCom::known(channel.com(Access::Object)))
    }
}

impl From<PlatformAxis> for ObjectList {
    /// The group of platform axes' descriptors is assumed (COM-7).
    fn from(axis: PlatformAxis) -> Self {
        Self(OfCom::known(axis.com(Access::Object)))
    }
}

/// How many objects a list has: Read at offset 0, port 553.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{CountObjects, Operation};
///
/// let op = CountObjects::new(Channel::new(1)?);
/// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x13_0101, 0));
/// assert_eq!(op.decode_reply(&[16, 0, 0, 0])?.0, 16);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CountObjects {
    /// Which list.
    pub list: ObjectList,
}

impl CountObjects {
    /// For a channel, a platform axis or [`ObjectList::PLATFORM`].
    pub fn new(list: impl Into<ObjectList>) -> Self {
        Self { list: list.into() }
    }

    pub(super) fn dispatched<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
        Ok(Request::CountObjects(Self { list: ObjectList::dispatched(call) }))
    }
}

impl Sealed for CountObjects {}

impl Operation for CountObjects {
    const FUNCTION: Function = Function::CountObjects;

    type Reply<'r> = ObjectCount;

    fn index_group(&self) -> IndexGroup {
        self.list.index_group()
    }

    fn index_offset(&self) -> IndexOffset {
        IndexOffset::new(0)
    }

    fn read_length(&self) -> u32 {
        4
    }

    fn encoded_len(&self) -> usize {
        0
    }

    fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Ok(&[])
    }
}

/// Descriptors of a list's objects: Read at the first object's index, port 553.
///
/// The read length asks for their number: a multiple of 84 for as many, anything else over 84
/// for one (the latter assumed, COM-3).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{Operation, ReadDescriptors};
///
/// let op = ReadDescriptors::new(Channel::new(1)?, 0x10, 2)?;
/// assert_eq!((op.index_offset().get(), op.read_length()), (0x10, 168));
/// assert_eq!(op.decode_reply(&[0; 84])?.len(), 1);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ReadDescriptors {
    list: ObjectList,
    first: u32,
    read_length: u32,
}

impl ReadDescriptors {
    /// The most descriptors of one read.
    pub const COUNT_MAX: u32 = 49_932;

    /// `count` descriptors from object `first` on; objects are counted from 1.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for object 0, [`ErrorKind::TooMany`] for a count that is 0 or
    /// over [`COUNT_MAX`](Self::COUNT_MAX).
    pub fn new(list: impl Into<ObjectList>, first: u32, count: u32) -> Result<Self, Error> {
        if first == 0 {
            let id = const { Field::of::<DescriptorLayout>("id") };
            return Err(Error::new(ErrorKind::OutOfRange, id, 0, 1, first));
        }
        if count == 0 {
            return Err(Error::new(ErrorKind::OutOfRange, whole(), 0, 1, count));
        }
        if count > Self::COUNT_MAX {
            return Err(Error::new(ErrorKind::TooMany, whole(), 0, Self::COUNT_MAX, count));
        }
        let read_length = count.saturating_mul(to_u32(DESCRIPTOR_LEN));
        Ok(Self { list: list.into(), first, read_length })
    }

    /// Which list.
    pub const fn list(&self) -> ObjectList {
        self.list
    }

    /// The first object, from 1.
    pub const fn first(&self) -> u32 {
        self.first
    }

    /// How many descriptors are asked for; never more than [`COUNT_MAX`](Self::COUNT_MAX).
    pub fn count(&self) -> u32 {
        let len = to_u32(DESCRIPTOR_LEN);
        match self.read_length.checked_rem(len) {
            Some(0) => self.read_length.checked_div(len).unwrap_or(1).min(Self::COUNT_MAX),
            _ => 1,
        }
    }

    pub(super) fn dispatched<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
        let least = to_u32(DESCRIPTOR_LEN);
        if call.read_length < least {
            let found = call.read_length;
            let error = Error::new(ErrorKind::BufferTooSmall, whole(), 0, least, found);
            return Err(Refusal::Stream(error));
        }
        let (list, first) = (ObjectList::dispatched(call), call.index_offset.get());
        Ok(Request::ReadDescriptors(Self { list, first, read_length: call.read_length }))
    }
}

fn whole() -> Field {
    Field::whole(Stream::ObjectDescriptors)
}

impl Sealed for ReadDescriptors {}

impl Operation for ReadDescriptors {
    const FUNCTION: Function = Function::ReadDescriptors;

    type Reply<'r> = DescriptorsRef<'r>;

    fn index_group(&self) -> IndexGroup {
        self.list.index_group()
    }

    fn index_offset(&self) -> IndexOffset {
        IndexOffset::new(self.first)
    }

    fn read_length(&self) -> u32 {
        self.read_length
    }

    fn encoded_len(&self) -> usize {
        0
    }

    fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Ok(&[])
    }

    fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<DescriptorsRef<'r>, Error> {
        use crate::stream::Decode as _;
        let descriptors = DescriptorsRef::decode(data)?;
        let (asked, given) = (self.count(), to_u32(descriptors.len()));
        if given > asked {
            return Err(Error::new(ErrorKind::TooMany, whole(), 0, asked, given));
        }
        Ok(descriptors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limits::ADS_DATA_MAX;

    #[test]
    fn the_most_descriptors_are_the_most_data() {
        assert_eq!(ReadDescriptors::COUNT_MAX as usize, ADS_DATA_MAX / DESCRIPTOR_LEN);
    }
}
