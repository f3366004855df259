//! Operations on instances and on the attributes of their elements (SDA-1 … SDA-10).

use super::request::sealed::Sealed;
use super::{Call, Function, Operation, Refusal, Request, Task};
use crate::address::{
    Addressing, Attribute, Class, ClassGroup, ElementAddress, IndexGroup, IndexOffset, OfClass,
};
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::field::index_offset::ELEMENT;
use crate::limits::TEXT_MAX;
use crate::sda::{
    ElementCount, ElementLength, ElementTextRef, ElementWriteFlag, ObjectAddress,
    ObjectAddressQuery,
};
use crate::stream::{Decode, Encode};

/// The dispatcher has found the group to be one of a class.
pub(super) fn dispatched(call: &Call<'_>) -> ElementAddress {
    ElementAddress::known(OfClass::known(call.index_group), call.index_offset)
}

/// Where an instance of a class is: ReadWrite at offset 0 of the class's object address, ports 551
/// and 552.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
///
/// ```
/// use ads_cnc::address::Class;
/// use ads_cnc::operation::{FindInstance, Operation};
///
/// // the second axis of the decoder of channel 1
/// let op = FindInstance::new(Class::Decoder, 1, 2);
/// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_2900, 0));
/// assert_eq!(op.encode(&mut [0; 8])?, [1, 0, 0, 0, 2, 0, 0, 0]);
/// let found = op.decode_reply(&[0x01, 0x23, 0x12, 0, 0, 0, 0x02, 0])?;
/// assert_eq!((found.index_group.get(), found.index_offset.get()), (0x12_2301, 0x2_0000));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FindInstance {
    group: OfClass,
    query: ObjectAddressQuery,
}

impl FindInstance {
    /// For a class, a channel (or the index of a spindle, or 0 for the platform) and an axis (or 0
    /// for the channel itself). See [`ObjectAddressQuery`] for which numbers a class takes.
    pub const fn new(class: Class, channel: u32, axis: u32) -> Self {
        let group = OfClass::new(ClassGroup::object_address(class));
        Self { group, query: ObjectAddressQuery { channel, axis } }
    }

    /// The same by index: channels and spindles are counted among the active ones.
    #[must_use]
    pub const fn by_index(mut self) -> Self {
        let by_index = ClassGroup { addressing: Addressing::Index, ..self.group.parts() };
        self.group = OfClass::new(by_index);
        self
    }

    /// Which class, and whether by number or by rank.
    pub const fn class_group(&self) -> ClassGroup {
        self.group.parts()
    }

    /// Which of its instances.
    pub const fn query(&self) -> ObjectAddressQuery {
        self.query
    }

    pub(super) fn dispatched<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
        let query = ObjectAddressQuery::decode(call.data).map_err(Refusal::Stream)?;
        Ok(Request::FindInstance(Self { group: OfClass::known(call.index_group), query }))
    }
}

impl Sealed for FindInstance {}

impl Operation for FindInstance {
    const FUNCTION: Function = Function::FindInstance;

    type Reply<'r> = ObjectAddress;

    fn index_group(&self) -> IndexGroup {
        self.group.group()
    }

    fn index_offset(&self) -> IndexOffset {
        IndexOffset::new(0)
    }

    fn read_length(&self) -> u32 {
        8
    }

    fn encoded_len(&self) -> usize {
        self.query.encoded_len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        self.query.encode(buf)
    }
}

/// Declares an operation that reads one attribute of an element.
macro_rules! attribute {
    (
        $(#[$doc:meta])*
        $name:ident by $vis:vis $new:ident: $attribute:ident, $reply:ty, at most $most:expr
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $name {
            /// Which element.
            $vis element: ElementAddress,
        }

        impl $name {
            /// For an element.
            $vis const fn $new(element: ElementAddress) -> Self {
                Self { element }
            }

            pub(super) fn dispatched<'a>(call: &Call<'a>) -> Result<Request<'a>, Refusal> {
                Ok(Request::$name(Self { element: dispatched(call) }))
            }
        }

        impl Sealed for $name {}

        impl Operation for $name {
            const FUNCTION: Function = Function::$name;

            type Reply<'r> = $reply;

            fn index_group(&self) -> IndexGroup {
                self.element.group(Attribute::$attribute)
            }

            fn index_offset(&self) -> IndexOffset {
                self.element.index_offset()
            }

            fn read_length(&self) -> u32 {
                $most
            }

            fn encoded_len(&self) -> usize {
                0
            }

            fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Error> {
                Ok(&[])
            }
        }
    };
}

attribute! {
    /// How many element types an instance has: Read of the content of its first element, ports 551
    /// and 552.
    ///
    /// At an offset that is the first element's under the stride 0x1000 alone (the HLD's platform
    /// axes, E-01), a server cannot tell this from [`ReadElement`](super::ReadElement) of four
    /// bytes, and takes it for that.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{CountElements, Operation};
    ///
    /// let first = ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 0)?;
    /// let op = CountElements::new(first)?;
    /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3301, 0));
    /// assert_eq!(op.decode_reply(&[9, 0, 0, 0])?.0, 9);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    CountElements by unchecked: Content, ElementCount, at most 4
}

impl CountElements {
    /// For the first element of an instance.
    ///
    /// # Errors
    /// [`ErrorKind::Function`](crate::ErrorKind::Function) for an element of the decoder that is
    /// another function (SDA-12).
    pub fn new(first: ElementAddress) -> Result<Self, Error> {
        let (group, offset) = (first.group(Attribute::Content), first.index_offset());
        match Function::at(Task::Sda, group, offset) {
            None | Some(Function::CountElements) => Ok(Self::unchecked(first)),
            Some(_) => Err(Error::new(ErrorKind::Function, ELEMENT, 0, 0, offset.get())),
        }
    }

    /// The first element.
    pub const fn element(&self) -> ElementAddress {
        self.element
    }
}

attribute! {
    /// The name of an element: Read, ports 551 and 552. That of the first element names the
    /// instance.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElementName};
    ///
    /// let op = ReadElementName::new(ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?);
    /// assert_eq!((op.index_group().get(), op.index_offset().get()), (0x12_3401, 1));
    /// assert_eq!(op.decode_reply(b"feedhold.enable\0")?.text.text(), "feedhold.enable");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElementName by pub new: Name, ElementTextRef<'r>, at most to_u32(TEXT_MAX)
}

attribute! {
    /// The type of an element: Read, ports 551 and 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElementType};
    ///
    /// let op = ReadElementType::new(ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?);
    /// assert_eq!(op.index_group().get(), 0x12_3501);
    /// assert_eq!(op.decode_reply(b"BOOLEAN\0")?.text.text(), "BOOLEAN");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElementType by pub new: Type, ElementTextRef<'r>, at most to_u32(TEXT_MAX)
}

attribute! {
    /// The length of an element's content in bytes: Read, ports 551 and 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElementLength};
    ///
    /// let op = ReadElementLength::new(ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?);
    /// assert_eq!(op.index_group().get(), 0x12_3601);
    /// assert_eq!(op.decode_reply(&[1, 0, 0, 0])?.get(), 1);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElementLength by pub new: Length, ElementLength, at most 4
}

attribute! {
    /// The unit of an element: Read, ports 551 and 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElementUnit};
    ///
    /// let op = ReadElementUnit::new(ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?);
    /// assert_eq!(op.index_group().get(), 0x12_3701);
    /// assert_eq!(op.decode_reply(b"-\0")?.text.text(), "-");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElementUnit by pub new: Unit, ElementTextRef<'r>, at most to_u32(TEXT_MAX)
}

attribute! {
    /// Whether an element may be written: Read, ports 551 and 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 2.2.1 and 2.2.2.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, Class, ElementAddress};
    /// use ads_cnc::operation::{Operation, ReadElementWriteFlag};
    ///
    /// let feedhold = ElementAddress::of_channel(Channel::new(1)?, Class::Hld, 1)?;
    /// let op = ReadElementWriteFlag::new(feedhold);
    /// assert_eq!(op.index_group().get(), 0x12_3801);
    /// assert!(!op.decode_reply(&[0])?.is_writable());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ReadElementWriteFlag by pub new: WriteFlag, ElementWriteFlag, at most 1
}
