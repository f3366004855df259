//! The description of a variable (VAR-4 … VAR-8).

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use super::{Handle, Numbers, VariableAccess, VariableType};
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::Stream;
use crate::layout::field::variable_description::{DIMENSION_COUNT, NAME};
use crate::limits::{DIMENSIONS_MAX, TEXT_MAX};
use crate::stream::{Decode, Encode};
use crate::text::TextRef;

/// The five numbers at the front, once for all readings.
#[derive(Clone, Copy, FromBytes, IntoBytes, KnownLayout, Immutable, Unaligned)]
#[repr(C)]
pub(super) struct Head {
    pub(super) handle: U32,
    pub(super) var_type: U32,
    pub(super) access: U32,
    pub(super) size: U32,
    pub(super) dimension_count: U32,
}

const _: () = assert!(size_of::<Head>() == 20);

#[doc = include_str!("../../doc/variable-description.md")]
///
/// The end of the name is not documented (E-17): a NUL, NULs up to 256 bytes, or the end of the
/// stream; one NUL is written. What follows the NUL is kept, and a name field has at least one
/// byte.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`TooMany`](crate::ErrorKind::TooMany) or [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, DescriptionRef, VariableType};
///
/// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";
/// let variable = DescriptionRef::decode(bytes)?;
/// assert_eq!(variable.handle.0, 0x2000002);
/// assert_eq!(variable.var_type, VariableType::BOOLEAN);
/// assert_eq!(variable.dimensions.get(0), Some(2));
/// assert_eq!(variable.name.text(), "V.E.Variable_3");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DescriptionRef<'a> {
    /// Handle of the variable.
    pub handle: Handle,
    /// Type of the variable or of its elements.
    pub var_type: VariableType,
    /// Whether the variable may be written.
    pub access: VariableAccess,
    /// Bytes of the whole variable.
    pub size: u32,
    /// Elements in each dimension; none for an elementary variable.
    pub dimensions: Numbers<'a>,
    /// Name of the variable.
    pub name: TextRef<'a>,
}

impl<'a> Decode<'a> for DescriptionRef<'a> {
    const STREAM: Stream = Stream::VariableDescription;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let head: &Head = input.fixed()?;
        let (count, max) = (head.dimension_count.get(), to_u32(DIMENSIONS_MAX));
        let dimensions = input.numbers(DIMENSION_COUNT, count, max)?;
        let name = input.rest(NAME, 1, to_u32(TEXT_MAX))?;
        Ok(Self {
            handle: Handle(head.handle.get()),
            var_type: VariableType(head.var_type.get()),
            access: VariableAccess(head.access.get()),
            size: head.size.get(),
            dimensions: Numbers::from_wire(dimensions),
            name: TextRef::split(name),
        })
    }
}

impl DescriptionRef<'_> {
    /// Refuses what no decoder would accept.
    fn check(&self) -> Result<(), Error> {
        let (count, max) = (to_u32(self.dimensions.len()), to_u32(DIMENSIONS_MAX));
        if count > max {
            return Err(Error::new(ErrorKind::TooMany, DIMENSION_COUNT, 16, max, count));
        }
        let at = to_u32(self.dimensions.encoded_len().saturating_add(size_of::<Head>()));
        self.name.check_open(NAME, at, 1, to_u32(TEXT_MAX))
    }
}

impl Encode for DescriptionRef<'_> {
    fn encoded_len(&self) -> usize {
        let numbers = self.dimensions.encoded_len().saturating_add(size_of::<Head>());
        numbers.saturating_add(self.name.field_len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        self.check()?;
        Writer::run(Self::STREAM, self.encoded_len(), buf, |out| {
            let head = Head {
                handle: self.handle.0.into(),
                var_type: self.var_type.0.into(),
                access: self.access.0.into(),
                size: self.size.into(),
                dimension_count: to_u32(self.dimensions.len()).into(),
            };
            out.put(head.as_bytes());
            self.dimensions.write(out);
            self.name.write(out);
        })
    }
}

#[cfg(feature = "alloc")]
pub use owned::Description;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge::{self, Fixed};
    use crate::text::Text;

    /// [`DescriptionRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, Description, VariableAccess};
    ///
    /// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";
    /// let variable = Description::decode(bytes)?;
    /// assert_eq!((variable.access, variable.size), (VariableAccess::READ_ONLY, 2));
    /// assert_eq!(variable.dimensions, [2]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct Description {
        /// Handle of the variable.
        pub handle: Handle,
        /// Type of the variable or of its elements.
        pub var_type: VariableType,
        /// Whether the variable may be written.
        pub access: VariableAccess,
        /// Bytes of the whole variable.
        pub size: u32,
        /// Elements in each dimension; none for an elementary variable.
        pub dimensions: Vec<u32>,
        /// Name of the variable.
        pub name: Text,
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        head: Fixed<Head>,
        #[br(parse_with = bridge::numbers, args(head.0.dimension_count.get()))]
        dimensions: Vec<u32>,
        #[br(parse_with = bridge::text)]
        name: Text,
    }

    impl<'a> Decode<'a> for Description {
        const STREAM: Stream = Stream::VariableDescription;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            DescriptionRef::decode(bytes)?;
            let Wire { head: Fixed(head), dimensions, name } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self {
                handle: Handle(head.handle.get()),
                var_type: VariableType(head.var_type.get()),
                access: VariableAccess(head.access.get()),
                size: head.size.get(),
                dimensions,
                name,
            })
        }
    }

    impl Description {
        /// The description, borrowed.
        pub fn as_ref(&self) -> DescriptionRef<'_> {
            DescriptionRef {
                handle: self.handle,
                var_type: self.var_type,
                access: self.access,
                size: self.size,
                dimensions: self.dimensions.as_slice().into(),
                name: self.name.as_ref(),
            }
        }
    }

    crate::stream::encode_as_ref!(Description);
}
