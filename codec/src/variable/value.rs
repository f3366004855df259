//! Values (VAR-14). What their bytes mean is in the variable's description.

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_value::VALUE;
use crate::limits::VARIABLE_MAX;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/variable-value.md")]
///
/// One element, or the whole array if no index was given.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.4 and 4.3.5.
///
/// `decode` refuses with [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, ValueRef};
///
/// assert_eq!(ValueRef::decode(&[77, 1, 0, 0])?.bytes, 333_i32.to_le_bytes());
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ValueRef<'a> {
    /// The bytes.
    pub bytes: &'a [u8],
}

impl<'a> Decode<'a> for ValueRef<'a> {
    const STREAM: Stream = Stream::VariableValue;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let bytes = input.rest(VALUE, 0, to_u32(VARIABLE_MAX))?;
        Ok(Self { bytes })
    }
}

impl Encode for ValueRef<'_> {
    fn encoded_len(&self) -> usize {
        self.bytes.len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Writer::copy(Self::STREAM, self.bytes, buf)
    }
}

#[cfg(feature = "alloc")]
pub use owned::Value;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge;

    /// [`ValueRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, Value};
    ///
    /// assert_eq!(Value::decode(&[123, 0, 0, 0])?.bytes, 123_i32.to_le_bytes());
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct Value {
        /// The bytes.
        pub bytes: Vec<u8>,
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        #[br(parse_with = bridge::rest)]
        bytes: Vec<u8>,
    }

    impl<'a> Decode<'a> for Value {
        const STREAM: Stream = Stream::VariableValue;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            ValueRef::decode(bytes)?;
            let Wire { bytes } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self { bytes })
        }
    }

    impl Value {
        /// The value, borrowed.
        #[inline]
        pub fn as_ref(&self) -> ValueRef<'_> {
            ValueRef { bytes: &self.bytes }
        }
    }

    crate::stream::encode_as_ref!(Value);
}
