//! The description of a variable that was asked for by name (VAR-28).

use zerocopy::IntoBytes as _;

use super::description::Head;
use super::{DescriptionRef, Handle, Numbers, VariableAccess, VariableType};
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_description_by_name::DIMENSION_COUNT;
use crate::limits::NAMELESS_DIMENSIONS_MAX;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/variable-description-by-name.md")]
///
/// As [`DescriptionRef`](crate::DescriptionRef), without the name that was asked for.
///
/// Documented online only, for CNC versions from V3.1.3132.0 and V4.29.0 on; `ads-en` 1.05 and
/// `ads-de` 1.051 reserve the offset in section 4.2.1.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`TooMany`](crate::ErrorKind::TooMany), [`Trailing`](crate::ErrorKind::Trailing) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, DescriptionByNameRef, VariableType};
///
/// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
/// let variable = DescriptionByNameRef::decode(bytes)?;
/// assert_eq!(variable.var_type, VariableType::BOOLEAN);
/// assert_eq!(variable.dimensions.get(0), Some(2));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DescriptionByNameRef<'a> {
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
}

impl<'a> Decode<'a> for DescriptionByNameRef<'a> {
    const STREAM: Stream = Stream::VariableDescriptionByName;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let head: &Head = input.fixed()?;
        let (count, max) = (head.dimension_count.get(), to_u32(NAMELESS_DIMENSIONS_MAX));
        let dimensions = input.numbers(DIMENSION_COUNT, count, max)?;
        input.finish()?;
        Ok(Self {
            handle: Handle(head.handle.get()),
            var_type: VariableType(head.var_type.get()),
            access: VariableAccess(head.access.get()),
            size: head.size.get(),
            dimensions: Numbers::from_wire(dimensions),
        })
    }
}

impl<'a> DescriptionRef<'a> {
    /// The same without the name, as 0x4C gives it.
    pub const fn without_name(&self) -> DescriptionByNameRef<'a> {
        DescriptionByNameRef {
            handle: self.handle,
            var_type: self.var_type,
            access: self.access,
            size: self.size,
            dimensions: self.dimensions,
        }
    }
}

impl Encode for DescriptionByNameRef<'_> {
    fn encoded_len(&self) -> usize {
        self.dimensions.encoded_len().saturating_add(Head::LEN)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let count = self.dimensions.check(DIMENSION_COUNT, 16, NAMELESS_DIMENSIONS_MAX)?;
        let len = Head::LEN.saturating_add(count.saturating_mul(4));
        Writer::run(Self::STREAM, len, buf, |out| self.write(count, out))
    }
}

impl DescriptionByNameRef<'_> {
    /// The fields that the description by index has too, of so many dimensions.
    pub(super) fn write(&self, count: usize, out: &mut Writer<'_>) {
        let head = Head {
            handle: self.handle.0.into(),
            var_type: self.var_type.0.into(),
            access: self.access.0.into(),
            size: self.size.into(),
            dimension_count: to_u32(count).into(),
        };
        out.put(head.as_bytes());
        self.dimensions.write(out);
    }
}

#[cfg(feature = "alloc")]
pub use owned::DescriptionByName;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge::{self, Fixed};

    /// [`DescriptionByNameRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, DescriptionByName};
    ///
    /// let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0";
    /// assert_eq!(DescriptionByName::decode(bytes)?.dimensions, [2]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct DescriptionByName {
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
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        head: Fixed<Head>,
        #[br(parse_with = bridge::numbers, args(head.0.dimension_count.get()))]
        dimensions: Vec<u32>,
    }

    impl<'a> Decode<'a> for DescriptionByName {
        const STREAM: Stream = Stream::VariableDescriptionByName;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            DescriptionByNameRef::decode(bytes)?;
            let Wire { head: Fixed(head), dimensions } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self {
                handle: Handle(head.handle.get()),
                var_type: VariableType(head.var_type.get()),
                access: VariableAccess(head.access.get()),
                size: head.size.get(),
                dimensions,
            })
        }
    }

    impl DescriptionByNameRef<'_> {
        /// A copy that lives on its own.
        pub fn to_owned(&self) -> DescriptionByName {
            DescriptionByName {
                handle: self.handle,
                var_type: self.var_type,
                access: self.access,
                size: self.size,
                dimensions: self.dimensions.iter().collect(),
            }
        }
    }

    impl DescriptionByName {
        /// The description, borrowed.
        #[inline]
        pub fn as_ref(&self) -> DescriptionByNameRef<'_> {
            DescriptionByNameRef {
                handle: self.handle,
                var_type: self.var_type,
                access: self.access,
                size: self.size,
                dimensions: self.dimensions.as_slice().into(),
            }
        }
    }

    crate::stream::encode_as_ref!(DescriptionByName);
}
