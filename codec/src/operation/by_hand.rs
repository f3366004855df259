//! The parts of operations that the table cannot express:
//!
//! - `ReadDescriptors`, `ReadElement`, `ReadObject`: the arguments of the constructor determine the
//!   read length, which limits the reply.
//! - `ReadElement`, `WriteElement`, `ReadObject`, `WriteObject`, `CountElements`: the constructors
//!   reject addresses of other functions (SDA-12).
//! - `FindInstance`: [`by_index`](FindInstance::by_index) changes the addressing of the class.

use super::{
    CountElements, FindInstance, Function, ObjectList, ReadDescriptors, ReadElement, ReadObject,
    Task, WriteElement, WriteObject, WriteValue,
};
use crate::address::{
    Access, Addressing, Attribute, Class, ClassGroup, ComGroup, ElementAddress, Group, IndexGroup,
    IndexOffset,
};
use crate::bytes::to_u32;
use crate::com::{DescriptorRef, DescriptorsRef, ObjectCount};
use crate::content::ContentRef;
use crate::error::{Error, ErrorKind};
use crate::layout::index_group::INSTANCE;
use crate::layout::index_offset::{ELEMENT, OBJECT};
use crate::layout::{ADS_DATA, Field, Stream};
use crate::sda::ObjectAddressQuery;

/// The number of bytes of one descriptor.
const RECORD: u32 = Stream::ObjectDescriptor.layout().max;
const COUNT: Field = Field::of::<ObjectCount>("count");
const DESCRIPTORS: Field = Field::whole(Stream::ObjectDescriptors);
const CONTENT: Field = Field::of::<ContentRef<'static>>("content");

impl ReadDescriptors {
    /// The maximum number of descriptors in one read.
    pub const COUNT_MAX: u32 = match Stream::ObjectDescriptors.layout().max.checked_div(RECORD) {
        Some(count) => count,
        None => 0,
    };

    /// Reads up to `count` descriptors, starting at object `first`; objects are counted from 1.
    ///
    /// If [`CountObjects`](super::CountObjects) returns 0, the list is empty: do not send a request.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] with the field `element` of the index offset for object 0;
    /// [`ErrorKind::OutOfRange`] with the field `count` for a count of 0; [`ErrorKind::TooMany`] with
    /// the field `count` for a count greater than [`COUNT_MAX`](Self::COUNT_MAX).
    pub fn new(list: impl Into<ObjectList>, first: u32, count: u32) -> Result<Self, Error> {
        if first == 0 {
            return Err(Error::new(ErrorKind::OutOfRange, OBJECT, 0, 1, first));
        }
        if count == 0 {
            return Err(Error::new(ErrorKind::OutOfRange, COUNT, 0, 1, count));
        }
        if count > Self::COUNT_MAX {
            return Err(Error::new(ErrorKind::TooMany, COUNT, 0, Self::COUNT_MAX, count));
        }
        let length = count.saturating_mul(RECORD);
        Ok(Self { list: list.into(), first, length })
    }

    /// The list.
    pub const fn list(&self) -> ObjectList {
        self.list
    }

    /// The first object, from 1.
    pub const fn first(&self) -> u32 {
        self.first
    }

    /// The number of descriptors requested, at most [`COUNT_MAX`](Self::COUNT_MAX); 1 for a read
    /// length that is not a multiple of 84 (assumed, COM-3).
    pub fn count(&self) -> u32 {
        match self.length.checked_rem(RECORD) {
            Some(0) => self.length.checked_div(RECORD).unwrap_or(1).min(Self::COUNT_MAX),
            _ => 1,
        }
    }

    pub(super) fn check_length(length: u32) -> Result<u32, Error> {
        if length < RECORD {
            Err(Error::new(ErrorKind::BufferTooSmall, DESCRIPTORS, 0, RECORD, length))
        } else {
            Ok(length)
        }
    }

    pub(super) fn check_reply(&self, reply: &DescriptorsRef<'_>, _: u32) -> Result<(), Error> {
        let (requested, found) = (self.count(), to_u32(reply.len()));
        if found > requested {
            Err(Error::new(ErrorKind::TooMany, DESCRIPTORS, 0, requested, found))
        } else {
            Ok(())
        }
    }
}

/// Rejects an address that belongs to a function other than access to content, because it cannot be
/// the address of content (SDA-12).
fn content(task: Task, group: IndexGroup, offset: IndexOffset) -> Result<(), Error> {
    match Function::at(task, group, offset) {
        Some(_) => Err(Error::new(ErrorKind::Function, ELEMENT, 0, 0, offset.get())),
        None => Ok(()),
    }
}

/// Checks the address of the content of a COM object, and parses its index group (COM-5).
fn object(group: IndexGroup, offset: IndexOffset) -> Result<(ComGroup, IndexOffset), Error> {
    const PLATFORM: ComGroup = ComGroup::platform(Access::Element);
    let (wanted, com) = match group.parts() {
        Some(Group::Com(com)) => (ComGroup { access: Access::Element, ..com }, com),
        _ => (PLATFORM, ComGroup { access: Access::Object, ..PLATFORM }),
    };
    if com != wanted {
        let wanted = wanted.index_group().get();
        return Err(Error::new(ErrorKind::Mismatch, INSTANCE, 0, wanted, group.get()));
    }
    content(Task::Com, group, offset)?;
    Ok((com, offset))
}

/// Rejects an element whose address belongs to a function other than access to content. An offset
/// that is a multiple of 0x10000 belongs to [`CountElements`](super::CountElements).
fn element(element: ElementAddress) -> Result<ElementAddress, Error> {
    content(Task::Sda, element.group(Attribute::Content), element.index_offset())?;
    Ok(element)
}

fn length(length: u32) -> Result<u32, Error> {
    if length > ADS_DATA {
        Err(Error::new(ErrorKind::TooLong, CONTENT, 0, ADS_DATA, length))
    } else {
        Ok(length)
    }
}

/// Reads of content: any read length of a received request is valid and limits the reply.
macro_rules! reads_content {
    ($( $operation:ident )+) => { $(
        impl $operation {
            pub(super) const fn check_length(length: u32) -> Result<u32, Error> {
                Ok(length)
            }

            pub(super) fn check_reply(
                &self,
                reply: &ContentRef<'_>,
                length: u32,
            ) -> Result<(), Error> {
                let found = to_u32(reply.bytes.len());
                if found > length {
                    Err(Error::new(ErrorKind::TooLong, CONTENT, length, length, found))
                } else {
                    Ok(())
                }
            }
        }
    )+ };
}

reads_content! { ReadElement ReadObject }

impl ReadObject {
    /// Reads the content of an object, by its [`Descriptor`](crate::Descriptor) or
    /// [`DescriptorRef`].
    ///
    /// ```
    /// use ads_cnc::Descriptor;
    /// use ads_cnc::address::{Channel, IndexGroup, IndexOffset};
    /// use ads_cnc::operation::{Operation, ReadDescriptors, ReadObject};
    ///
    /// # use ads_cnc::Encode;
    /// # let object = Descriptor::new("mc_active_single_block_r", "BOOL")?
    /// #     .with_size(1)
    /// #     .with_content(IndexGroup::new(0x12_0101), IndexOffset::new(3));
    /// # let (mut data, n) = ([0; 84], 1);
    /// # let data = object.encode(&mut data)?;
    /// let list = Channel::new(1)?;
    /// for object in ReadDescriptors::new(list, 1, n)?.decode_reply(data)? {
    ///     let op = ReadObject::of(&object)?;
    ///     assert_eq!((op.index_offset().get(), op.read_length()), (3, 1));
    /// }
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn of<'d>(object: impl Into<DescriptorRef<'d>>) -> Result<Self, Error> {
        let object = object.into();
        Self::new(object.index_group(), object.index_offset(), object.size())
    }

    /// Reads the content of the object with this group, offset and size in bytes, as in its
    /// descriptor.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that does not address COM content; [`ErrorKind::Function`]
    /// for the program stream, because only writing it is documented (STM-1);
    /// [`ErrorKind::TooLong`] for a size greater than [`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX).
    pub fn new(group: IndexGroup, offset: IndexOffset, size: u32) -> Result<Self, Error> {
        Ok(Self { object: object(group, offset)?, length: length(size)? })
    }

    /// The parts of the index group of the object, and its index offset.
    pub const fn address(&self) -> (ComGroup, IndexOffset) {
        self.object
    }
}

impl<'a> WriteObject<'a> {
    /// Writes this content to an object, by its [`Descriptor`](crate::Descriptor) or
    /// [`DescriptorRef`].
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn of<'d>(
        object: impl Into<DescriptorRef<'d>>,
        content: impl Into<WriteValue<'a>>,
    ) -> Result<Self, Error> {
        let object = object.into();
        Self::new(object.index_group(), object.index_offset(), content)
    }

    /// Writes this content to the object with this group and offset, as in its descriptor.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that does not address COM content; [`ErrorKind::Function`]
    /// for the program stream, which [`WriteProgramStream`](super::WriteProgramStream) writes.
    pub fn new(
        group: IndexGroup,
        offset: IndexOffset,
        content: impl Into<WriteValue<'a>>,
    ) -> Result<Self, Error> {
        Ok(Self { object: object(group, offset)?, content: content.into() })
    }

    /// The parts of the index group of the object, and its index offset.
    pub const fn address(&self) -> (ComGroup, IndexOffset) {
        self.object
    }

    /// The bytes to write.
    pub fn content(&self) -> ContentRef<'_> {
        ContentRef { bytes: self.content.as_bytes() }
    }
}

impl ReadElement {
    /// Reads the content of an element; `size` is the length of the content in bytes.
    ///
    /// # Errors
    /// [`ErrorKind::Function`] for an element of the decoder whose index offset is that of a
    /// function, and for any multiple of 0x10000 as the index offset: there, [`CountElements`]
    /// reads the first element of an instance. [`ErrorKind::TooLong`] for a size greater than
    /// [`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX).
    pub fn new(address: ElementAddress, size: u32) -> Result<Self, Error> {
        Ok(Self { element: element(address)?, length: length(size)? })
    }

    /// The element.
    pub const fn element(&self) -> ElementAddress {
        self.element
    }
}

impl<'a> WriteElement<'a> {
    /// Writes this content to an element.
    ///
    /// # Errors
    /// [`ErrorKind::Function`] for an element of the decoder whose index offset is that of a
    /// function, and for a multiple of 0x10000 as the index offset, which is that of the first
    /// element of an instance.
    pub fn new(address: ElementAddress, content: impl Into<WriteValue<'a>>) -> Result<Self, Error> {
        Ok(Self { element: element(address)?, content: content.into() })
    }

    /// The element.
    pub const fn element(&self) -> ElementAddress {
        self.element
    }

    /// The bytes to write.
    pub fn content(&self) -> ContentRef<'_> {
        ContentRef { bytes: self.content.as_bytes() }
    }
}

impl CountElements {
    /// Reads the first element of an instance, such as
    /// [`ObjectAddress::first_element`](crate::sda::ObjectAddress::first_element) returns. The
    /// constructor does not check that the element is the first.
    ///
    /// # Errors
    /// [`ErrorKind::Function`] for an element of the decoder whose index offset is that of another
    /// function (SDA-12).
    pub fn new(first: ElementAddress) -> Result<Self, Error> {
        let (group, offset) = (first.group(Attribute::Content), first.index_offset());
        match Function::at(Task::Sda, group, offset) {
            None | Some(Function::CountElements) => Ok(Self { element: first }),
            Some(_) => Err(Error::new(ErrorKind::Function, ELEMENT, 0, 0, offset.get())),
        }
    }

    /// The first element.
    pub const fn element(&self) -> ElementAddress {
        self.element
    }
}

impl FindInstance {
    /// Queries an instance by class, channel (or index of a spindle, or 0 for the platform) and axis
    /// (or 0 for the channel itself). [`ObjectAddressQuery`] lists the valid numbers of each class.
    pub const fn new(class: Class, channel: u32, axis: u32) -> Self {
        Self { class: ClassGroup::object_address(class), channel, axis }
    }

    /// Changes the query to addressing by index, which counts only the active channels (ADR-11).
    #[must_use]
    pub const fn by_index(mut self) -> Self {
        self.class.addressing = Addressing::Index;
        self
    }

    /// The class, and whether it is addressed by number or by index.
    pub const fn class_group(&self) -> ClassGroup {
        self.class
    }

    /// The channel and the axis of the query.
    pub const fn query(&self) -> ObjectAddressQuery {
        ObjectAddressQuery { channel: self.channel, axis: self.axis }
    }
}
