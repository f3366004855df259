//! An object descriptor.

use core::fmt;

use zerocopy::IntoBytes as _;
use zerocopy::little_endian::{U16, U32};

use crate::address::{IndexGroup, IndexOffset};
use crate::bytes::{Reader, Writer, to_u32};
use crate::declare::stream;
use crate::error::{Error, ErrorKind};
use crate::layout::{Declared as _, Field, Stream};
use crate::limits::{DESCRIPTOR_LEN, DESCRIPTOR_TEXT_LEN};
use crate::number::code;
use crate::stream::{Decode, Encode};
use crate::text::CncStr;
use crate::value::DataType;

/// The field with the name of an object, for errors.
const NAME: Field = Field::of::<DescriptorLayout>("name");

/// The field with the name of the type of an object, for errors.
const TYPE: Field = Field::of::<DescriptorLayout>("type");

stream! {
    /// The 84 bytes of a descriptor.
    ObjectDescriptor "object-descriptor", "Object descriptor, reply", "COM-2", max 84;
    packed DescriptorLayout {
        @0  id: UNS32,                  "COM-2", "unique internal number of the object";
        @4  size: UNS32,                "COM-2", "bytes of the object's content";
        @8  write_access: UNS16,        "COM-2", "not 0: writable";
        @10 not_assigned: UNS16,        "COM-2", "kept as it is, written as 0";
        @12 index_group: UNS32,         "COM-5", "index group of the content";
        @16 index_offset: UNS32,        "COM-5", "index offset of the content";
        @20 name: PADDED(32),           "COM-2", "name of the object";
        @52 type_name "type": PADDED(32), "COM-2", "BOOL, BYTE, SINT, WORD, …";
    }
}

code! {
    /// Whether an object may be written. Any number but 0 is TRUE; the number is kept (E-08).
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
    ///
    /// ```
    /// use ads_cnc::WriteAccess;
    ///
    /// assert!(!WriteAccess::READ_ONLY.is_writable());
    /// assert!(WriteAccess(0xFFFF).is_writable());
    /// assert_ne!(WriteAccess(0xFFFF), WriteAccess::WRITABLE);
    /// ```
    #[derive(Default)]
    WriteAccess(u16) {
        /// FALSE: 0 when encoded.
        READ_ONLY = 0;
        /// TRUE: 1 when encoded.
        WRITABLE = 1;
    }
}

impl WriteAccess {
    /// Whether the object may be written: any number but 0.
    pub const fn is_writable(self) -> bool {
        self.0 != 0
    }
}

#[doc = include_str!("../../doc/object-descriptor.md")]
///
/// A text ends at its first NUL, or fills its 32 bytes. Bytes after the NUL are kept.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`Trailing`](crate::ErrorKind::Trailing).
///
/// ```
/// use ads_cnc::{Decode, DescriptorRef};
///
/// let mut bytes = [0; 84];
/// bytes[..4].copy_from_slice(&[82, 0, 0, 0]);
/// bytes[20..44].copy_from_slice(b"mc_active_single_block_r");
/// let object = DescriptorRef::decode(&bytes)?;
/// assert_eq!(object.id(), 82);
/// assert_eq!(object.name(), "mc_active_single_block_r");
/// assert!(!object.write_access().is_writable());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct DescriptorRef<'a>(pub(super) &'a DescriptorLayout);

/// An owned [`DescriptorRef`]: 84 bytes, without an allocation.
///
/// ```
/// use ads_cnc::address::{IndexGroup, IndexOffset};
/// use ads_cnc::{Descriptor, Encode, WriteAccess};
///
/// let object = Descriptor::new("mc_active_single_block_r", "BOOL")?
///     .with_id(82)
///     .with_size(1)
///     .with_write_access(WriteAccess::READ_ONLY)
///     .with_content(IndexGroup::new(0x12_0101), IndexOffset::new(3));
/// let mut buf = [0; 84];
/// assert_eq!(object.encode(&mut buf)?[..8], [82, 0, 0, 0, 1, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Descriptor(pub(super) DescriptorLayout);

/// Declares the accessors of [`DescriptorRef`] and [`Descriptor`].
macro_rules! accessors {
    ($lifetime:lifetime) => {
        /// Unique internal number of the object.
        pub const fn id(&self) -> u32 {
            self.0.id.get()
        }

        /// Length of the object's content in bytes.
        pub const fn size(&self) -> u32 {
            self.0.size.get()
        }

        /// Whether the content may be written.
        pub const fn write_access(&self) -> WriteAccess {
            WriteAccess(self.0.write_access.get())
        }

        /// The two unassigned bytes.
        pub const fn not_assigned(&self) -> u16 {
            self.0.not_assigned.get()
        }

        /// Index group of the content.
        pub const fn index_group(&self) -> IndexGroup {
            IndexGroup::new(self.0.index_group.get())
        }

        /// Index offset of the content.
        pub const fn index_offset(&self) -> IndexOffset {
            IndexOffset::new(self.0.index_offset.get())
        }

        /// Name of the object.
        pub fn name(&self) -> CncStr<$lifetime> {
            CncStr::until_nul(&self.0.name)
        }

        /// Name of the content's type: BOOL, BYTE, SINT, WORD, INT, DWORD, DINT, LWORD, LINT, REAL,
        /// LREAL, STRING, or any other.
        pub fn type_name(&self) -> CncStr<$lifetime> {
            CncStr::until_nul(&self.0.type_name)
        }

        /// Length of one value of the type in bytes (GEN-5); `None` for STRING and for unknown types.
        pub fn type_size(&self) -> Option<u32> {
            self.data_type().and_then(DataType::size)
        }
    };
}

impl<'a> DescriptorRef<'a> {
    accessors!('a);

    /// Copies the descriptor.
    pub const fn to_owned(self) -> Descriptor {
        Descriptor(*self.0)
    }
}

impl From<DescriptorRef<'_>> for Descriptor {
    fn from(view: DescriptorRef<'_>) -> Self {
        view.to_owned()
    }
}

impl Descriptor {
    accessors!('_);

    /// A descriptor with this name and type; the other fields are 0.
    ///
    /// # Errors
    /// Those of [`CncStr::new`], and [`ErrorKind::TooLong`] for more than 32 characters.
    pub fn new(name: &str, type_name: &str) -> Result<Self, Error> {
        Self::from_text(CncStr::new(name)?, CncStr::new(type_name)?)
    }

    /// Like [`new`](Self::new), but from CP1252 texts, such as those of another descriptor.
    ///
    /// # Errors
    /// [`ErrorKind::TooLong`] for more than 32 characters.
    pub fn from_text(name: CncStr<'_>, type_name: CncStr<'_>) -> Result<Self, Error> {
        let mut layout = DescriptorLayout {
            id: U32::ZERO,
            size: U32::ZERO,
            write_access: U16::ZERO,
            not_assigned: U16::ZERO,
            index_group: U32::ZERO,
            index_offset: U32::ZERO,
            name: [0; DESCRIPTOR_TEXT_LEN],
            type_name: [0; DESCRIPTOR_TEXT_LEN],
        };
        pad(name, NAME, const { DescriptorLayout::LAYOUT.offset("name") }, &mut layout.name)?;
        pad(
            type_name,
            TYPE,
            const { DescriptorLayout::LAYOUT.offset("type") },
            &mut layout.type_name,
        )?;
        Ok(Self(layout))
    }

    /// Sets the internal number of the object.
    #[must_use]
    pub fn with_id(mut self, id: u32) -> Self {
        self.0.id = id.into();
        self
    }

    /// Sets the length of the content in bytes.
    #[must_use]
    pub fn with_size(mut self, size: u32) -> Self {
        self.0.size = size.into();
        self
    }

    /// Sets the write access.
    #[must_use]
    pub fn with_write_access(mut self, access: WriteAccess) -> Self {
        self.0.write_access = access.0.into();
        self
    }

    /// Sets the two unassigned bytes.
    #[must_use]
    pub fn with_not_assigned(mut self, not_assigned: u16) -> Self {
        self.0.not_assigned = not_assigned.into();
        self
    }

    /// Sets the address of the content.
    #[must_use]
    pub fn with_content(mut self, group: IndexGroup, offset: IndexOffset) -> Self {
        self.0.index_group = group.get().into();
        self.0.index_offset = offset.get().into();
        self
    }

    /// The bytes of the stream.
    pub const fn to_bytes(&self) -> [u8; DESCRIPTOR_LEN] {
        zerocopy::transmute!(self.0)
    }

    /// The descriptor, borrowed.
    #[inline]
    pub const fn as_ref(&self) -> DescriptorRef<'_> {
        DescriptorRef(&self.0)
    }
}

impl<'d> From<&'d Descriptor> for DescriptorRef<'d> {
    fn from(descriptor: &'d Descriptor) -> Self {
        descriptor.as_ref()
    }
}

impl<'d> From<&DescriptorRef<'d>> for DescriptorRef<'d> {
    fn from(descriptor: &DescriptorRef<'d>) -> Self {
        *descriptor
    }
}

/// Writes a text into the 32 bytes of its field.
fn pad(text: CncStr<'_>, field: Field, at: u32, bytes: &mut [u8]) -> Result<(), Error> {
    let (len, max) = (text.len(), to_u32(bytes.len()));
    if to_u32(len) > max {
        return Err(Error::new(ErrorKind::TooLong, field, at, max, to_u32(len)));
    }
    text.bytes().zip(bytes).for_each(|(byte, slot)| *slot = byte);
    Ok(())
}

impl<'a> Decode<'a> for DescriptorRef<'a> {
    const STREAM: Stream = Stream::ObjectDescriptor;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        Reader::exact(Stream::ObjectDescriptor, bytes).map(Self)
    }
}

impl<'a> Decode<'a> for Descriptor {
    const STREAM: Stream = Stream::ObjectDescriptor;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        DescriptorRef::decode(bytes).map(DescriptorRef::to_owned)
    }
}

impl Encode for DescriptorRef<'_> {
    fn encoded_len(&self) -> usize {
        DESCRIPTOR_LEN
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Stream::ObjectDescriptor, self.0.as_bytes(), buf)
    }
}

crate::stream::encode_as_ref!(Descriptor);

impl fmt::Debug for DescriptorRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Descriptor")
            .field("id", &self.id())
            .field("size", &self.size())
            .field("write_access", &self.write_access())
            .field("not_assigned", &self.not_assigned())
            .field("index_group", &self.index_group())
            .field("index_offset", &self.index_offset())
            .field("name", &self.name())
            .field("type_name", &self.type_name())
            .finish()
    }
}

impl fmt::Debug for Descriptor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.as_ref(), f)
    }
}

#[cfg(feature = "arbitrary")]
impl<'a> arbitrary::Arbitrary<'a> for Descriptor {
    fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
        let bytes: [u8; DESCRIPTOR_LEN] = u.arbitrary()?;
        Ok(Self(zerocopy::transmute!(bytes)))
    }
}
