//! The description of a variable (VAR-4 … VAR-8).

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout, Unaligned};

use super::{Handle, Numbers, VariableAccess, VariableType};
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
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

impl Head {
    pub(super) const LEN: usize = 20;
}

const _: () = assert!(size_of::<Head>() == Head::LEN);

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
        let name = input.open(NAME, 1, to_u32(TEXT_MAX))?;
        Ok(Self {
            handle: Handle(head.handle.get()),
            var_type: VariableType(head.var_type.get()),
            access: VariableAccess(head.access.get()),
            size: head.size.get(),
            dimensions: Numbers::from_wire(dimensions),
            name,
        })
    }
}

impl Encode for DescriptionRef<'_> {
    fn encoded_len(&self) -> usize {
        let numbers = self.dimensions.encoded_len().saturating_add(Head::LEN);
        numbers.saturating_add(self.name.field_len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let count = self.dimensions.check(DIMENSION_COUNT, 16, DIMENSIONS_MAX)?;
        let name_at = Head::LEN.saturating_add(count.saturating_mul(4));
        let name_len = self.name.check_open(NAME, to_u32(name_at), 1, to_u32(TEXT_MAX))?;
        Writer::run(Self::STREAM, name_at.saturating_add(name_len), buf, |out| {
            self.without_name().write(count, out);
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
    use crate::bridge::{self, Fixed, TextLen};
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
    #[br(little, import(name_len: TextLen))]
    struct Wire {
        head: Fixed<Head>,
        #[br(parse_with = bridge::numbers, args(head.0.dimension_count.get()))]
        dimensions: Vec<u32>,
        #[br(parse_with = bridge::text, args(name_len))]
        name: Text,
    }

    impl<'a> Decode<'a> for Description {
        const STREAM: Stream = Stream::VariableDescription;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            let name_len: TextLen = DescriptionRef::decode(bytes)?.name.into();
            let Wire { head: Fixed(head), dimensions, name } =
                bridge::read_with(Self::STREAM, bytes, (name_len,))?;
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
        #[inline]
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
