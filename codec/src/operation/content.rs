//! Operations on content: of COM objects and of elements (COM-5, SDA-4).

use super::request::sealed::Sealed;
use super::{Call, Function, Operation, Refusal, Request, Task};
use crate::address::{
    Access, Attribute, ComGroup, ElementAddress, Group, IndexGroup, IndexOffset, OfCom,
};
use crate::bytes::to_u32;
use crate::content::ContentRef;
use crate::error::{Error, ErrorKind};
use crate::layout::Field;
use crate::layout::field::index_group::INSTANCE;
use crate::layout::field::index_offset::ELEMENT;
use crate::limits::ADS_DATA_MAX;
use crate::stream::{Decode, Encode, NoData};

/// The whole of a content.
const CONTENT: Field = Field::of::<ContentRef<'static>>("content");

/// Where a COM object's content is; a descriptor says it (COM-5).
fn object(group: IndexGroup, offset: IndexOffset) -> Result<(OfCom, IndexOffset), Error> {
    let Some(Group::Com(com)) = group.parts() else {
        let found = group.get();
        return Err(Error::new(ErrorKind::Mismatch, INSTANCE, 0, PLATFORM.get(), found));
    };
    if com.access == Access::Object {
        let wanted = ComGroup { access: Access::Element, ..com }.index_group().get();
        return Err(Error::new(ErrorKind::Mismatch, INSTANCE, 0, wanted, group.get()));
    }
    content(Task::Com, group, offset)?;
    Ok((OfCom::known(group), offset))
}

/// Dispatch has seen that no function is there.
fn dispatched_object(call: &Call<'_>) -> (OfCom, IndexOffset) {
    (OfCom::known(call.index_group), call.index_offset)
}

const PLATFORM: IndexGroup = ComGroup::platform(Access::Element).index_group();

const fn object_parts((group, offset): (OfCom, IndexOffset)) -> (ComGroup, IndexOffset) {
    (group.parts(), offset)
}

/// No content is where a function is (SDA-12).
fn content(task: Task, group: IndexGroup, offset: IndexOffset) -> Result<(), Error> {
    match Function::at(task, group, offset) {
        Some(_) => Err(Error::new(ErrorKind::Function, ELEMENT, 0, 0, offset.get())),
        None => Ok(()),
    }
}

/// An element's content that is no function; the first element counts the others.
fn element(element: ElementAddress) -> Result<ElementAddress, Error> {
    content(Task::Sda, element.group(Attribute::Content), element.index_offset())?;
    Ok(element)
}

fn check_length(length: u32) -> Result<u32, Error> {
    let max = to_u32(ADS_DATA_MAX);
    if length > max {
        return Err(Error::new(ErrorKind::TooLong, CONTENT, 0, max, length));
    }
    Ok(length)
}

/// Content no longer than was asked for.
fn reply(data: &[u8], length: u32) -> Result<ContentRef<'_>, Error> {
    let content = ContentRef::decode(data)?;
    let given = to_u32(data.len());
    if given > length {
        return Err(Error::new(ErrorKind::TooLong, CONTENT, length, length, given));
    }
    Ok(content)
}

/// Declares the operations that read and write one sort of content.
macro_rules! content_operations {
    (
        $(#[$read_doc:meta])* $read:ident,
        $(#[$write_doc:meta])* $write:ident,
        $(#[$place_doc:meta])* $place:ident: $held:ty, as $ty:ty, by $shown:expr,
        $dispatched:expr, $group:expr, $offset:expr
    ) => {
        $(#[$read_doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $read {
            $place: $held,
            length: u32,
        }

        impl $read {
            $(#[$place_doc])*
            pub const fn $place(&self) -> $ty {
                $shown(self.$place)
            }

            pub(super) fn dispatched<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
                let $place = $dispatched(call);
                Ok(Request::$read(Self { $place, length: call.read_length }))
            }
        }

        impl Sealed for $read {}

        impl Operation for $read {
            const FUNCTION: Function = Function::$read;

            type Reply<'r> = ContentRef<'r>;

            fn index_group(&self) -> IndexGroup {
                $group(self.$place)
            }

            fn index_offset(&self) -> IndexOffset {
                $offset(self.$place)
            }

            fn read_length(&self) -> u32 {
                self.length
            }

            fn encoded_len(&self) -> usize {
                0
            }

            fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
                Ok(&[])
            }

            fn decode_reply<'r>(&self, data: &'r [u8]) -> Result<ContentRef<'r>, Error> {
                reply(data, self.length)
            }
        }

        $(#[$write_doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $write<'a> {
            $place: $held,
            content: ContentRef<'a>,
        }

        impl<'a> $write<'a> {
            $(#[$place_doc])*
            pub const fn $place(&self) -> $ty {
                $shown(self.$place)
            }

            /// The bytes to write.
            pub const fn content(&self) -> ContentRef<'a> {
                self.content
            }

            pub(super) fn dispatched(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
                let content = ContentRef::decode(call.data).map_err(Refusal::Stream)?;
                Ok(Request::$write(Self { $place: $dispatched(call), content }))
            }
        }

        impl Sealed for $write<'_> {}

        impl Operation for $write<'_> {
            const FUNCTION: Function = Function::$write;

            type Reply<'r> = NoData;

            fn index_group(&self) -> IndexGroup {
                $group(self.$place)
            }

            fn index_offset(&self) -> IndexOffset {
                $offset(self.$place)
            }

            fn read_length(&self) -> u32 {
                0
            }

            fn encoded_len(&self) -> usize {
                self.content.encoded_len()
            }

            fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                self.content.encode(buf)
            }
        }
    };
}

content_operations! {
    /// The content of a COM object: Read at the group and offset in its descriptor, port 553.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.2.
    ///
    /// ```
    /// use ads_cnc::Descriptor;
    /// use ads_cnc::address::{IndexGroup, IndexOffset};
    /// use ads_cnc::operation::{Operation, ReadObject};
    ///
    /// let object = Descriptor::new("mc_active_single_block_r", "BOOL")?
    ///     .with_size(1)
    ///     .with_content(IndexGroup::new(0x12_0101), IndexOffset::new(3));
    /// let op = ReadObject::new(object.index_group(), object.index_offset(), object.size())?;
    /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_0101, 3));
    /// assert_eq!(op.decode_reply(&[1])?.bytes, [1]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadObject,
    /// Writes the content of a COM object: Write at the group and offset in its descriptor, port
    /// 553. It may set the machine in motion.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.2.
    ///
    /// ```
    /// use ads_cnc::address::{IndexGroup, IndexOffset};
    /// use ads_cnc::operation::{Operation, WriteObject};
    ///
    /// // mc_command_single_block_w
    /// let op = WriteObject::new(IndexGroup::new(0x12_0101), IndexOffset::new(1), &[1])?;
    /// assert_eq!(op.encode(&mut [0; 1])?, [1]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteObject,
    /// Where the object is: group and offset.
    place: (OfCom, IndexOffset), as (ComGroup, IndexOffset), by object_parts,
    dispatched_object,
    |(group, _): (OfCom, IndexOffset)| group.group(),
    |(_, offset): (OfCom, IndexOffset)| offset
}

content_operations! {
    /// The content of an element: Read at its group and offset, ports 551 and 552.
    ///
    /// How long it is, the length attribute says.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElement};
    /// use ads_cnc::ErrorKind;
    ///
    /// let feedhold = ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?;
    /// let op = ReadElement::new(feedhold, 1)?;
    /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3301, 1));
    ///
    /// // On the decoder the functions for variables are among the elements (SDA-12).
    /// let function = ElementAddress::of_channel(Channel::new(1)?, Class::Decoder, 0x44)?;
    /// assert_eq!(ReadElement::new(function, 4).unwrap_err().kind(), ErrorKind::Function);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElement,
    /// Writes the content of an element: Write at its group and offset, ports 551 and 552. It may
    /// set the machine in motion.
    ///
    /// Whether the element may be written, the write flag says.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, WriteElement};
    ///
    /// let feedhold = ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?;
    /// let op = WriteElement::new(feedhold, &[1])?;
    /// assert_eq!(op.encode(&mut [0; 1])?, [1]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteElement,
    /// Which element.
    element: ElementAddress, as ElementAddress, by core::convert::identity,
    super::element::dispatched,
    |element: ElementAddress| element.group(Attribute::Content),
    |element: ElementAddress| element.index_offset()
}

impl ReadObject {
    /// For the group, the offset and the size in an object's descriptor.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that is none of COM's content, [`ErrorKind::Function`]
    /// for the program stream, whose reading is not documented (STM-1), [`ErrorKind::TooLong`] for
    /// more than ADS carries.
    pub fn new(group: IndexGroup, offset: IndexOffset, size: u32) -> Result<Self, Error> {
        Ok(Self { place: object(group, offset)?, length: check_length(size)? })
    }
}

impl<'a> WriteObject<'a> {
    /// For the group and the offset in an object's descriptor.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a group that is none of COM's content, [`ErrorKind::Function`]
    /// for the program stream, which [`WriteProgramStream`](super::WriteProgramStream) writes.
    pub fn new(group: IndexGroup, offset: IndexOffset, content: &'a [u8]) -> Result<Self, Error> {
        Ok(Self { place: object(group, offset)?, content: ContentRef { bytes: content } })
    }
}

impl ReadElement {
    /// For an element and the length of its content.
    ///
    /// # Errors
    /// [`ErrorKind::Function`] for an element of the decoder that is a function, and for the first
    /// element of an instance, which [`CountElements`](super::CountElements) reads;
    /// [`ErrorKind::TooLong`] for more than ADS carries.
    pub fn new(address: ElementAddress, length: u32) -> Result<Self, Error> {
        Ok(Self { element: element(address)?, length: check_length(length)? })
    }
}

impl<'a> WriteElement<'a> {
    /// For an element and its new content.
    ///
    /// # Errors
    /// [`ErrorKind::Function`] for an element of the decoder that is a function, and for the first
    /// element of an instance.
    pub fn new(address: ElementAddress, content: &'a [u8]) -> Result<Self, Error> {
        Ok(Self { element: element(address)?, content: ContentRef { bytes: content } })
    }
}
