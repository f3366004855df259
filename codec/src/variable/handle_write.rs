//! Writing by handle (VAR-12).

use super::{Handle, Numbers};
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_handle_write::{HANDLE, INDEX_COUNT};
use crate::limits::INDICES_MAX;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/variable-handle-write.md")]
///
/// No index writes the whole variable; otherwise there is one for each dimension.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.6.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`TooMany`](crate::ErrorKind::TooMany) or [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Encode, Handle, HandleWriteRef, Numbers};
///
/// let write = HandleWriteRef {
///     handle: Handle(0x2001234),
///     indices: Numbers::from(&[4]),
///     value: &123_i32.to_le_bytes(),
/// };
/// let mut buf = [0; 16];
/// assert_eq!(write.encode(&mut buf)?, b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HandleWriteRef<'a> {
    /// Handle of the variable.
    pub handle: Handle,
    /// Index in each dimension, from 0; none for the whole variable.
    pub indices: Numbers<'a>,
    /// The bytes of the value.
    pub value: &'a [u8],
}

impl<'a> Decode<'a> for HandleWriteRef<'a> {
    const STREAM: Stream = Stream::VariableHandleWrite;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let handle = Handle(input.u32(HANDLE)?);
        let count = input.u32(INDEX_COUNT)?;
        let indices = input.numbers(INDEX_COUNT, count, to_u32(INDICES_MAX))?;
        let value = input.take_all();
        Ok(Self { handle, indices: Numbers::from_wire(indices), value })
    }
}

impl Encode for HandleWriteRef<'_> {
    fn encoded_len(&self) -> usize {
        self.indices.encoded_len().saturating_add(8).saturating_add(self.value.len())
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let count = self.indices.check(INDEX_COUNT, 4, INDICES_MAX)?;
        let value_at = count.saturating_mul(4).saturating_add(8);
        Writer::run_behind(Self::STREAM, value_at, self.value.len(), buf, |out| {
            out.u32(self.handle.0);
            out.u32(to_u32(count));
            self.indices.write(out);
            out.put(self.value);
        })
    }
}

#[cfg(feature = "alloc")]
pub use owned::HandleWrite;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge;

    /// [`HandleWriteRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Encode, Handle, HandleWrite};
    ///
    /// let (handle, value) = (Handle(0x2001234), 123_i32.to_le_bytes().to_vec());
    /// let write = HandleWrite { handle, indices: vec![4], value };
    /// assert_eq!(write.to_vec()?, [0x34, 0x12, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0, 123, 0, 0, 0]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct HandleWrite {
        /// Handle of the variable.
        pub handle: Handle,
        /// Index in each dimension, from 0; none for the whole variable.
        pub indices: Vec<u32>,
        /// The bytes of the value.
        pub value: Vec<u8>,
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        handle: u32,
        #[br(temp)]
        index_count: u32,
        #[br(parse_with = bridge::numbers, args(index_count))]
        indices: Vec<u32>,
        #[br(parse_with = bridge::rest)]
        value: Vec<u8>,
    }

    impl<'a> Decode<'a> for HandleWrite {
        const STREAM: Stream = Stream::VariableHandleWrite;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            HandleWriteRef::decode(bytes)?;
            let Wire { handle, indices, value } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self { handle: Handle(handle), indices, value })
        }
    }

    impl HandleWrite {
        /// The request, borrowed.
        #[inline]
        pub fn as_ref(&self) -> HandleWriteRef<'_> {
            let indices = self.indices.as_slice().into();
            HandleWriteRef { handle: self.handle, indices, value: &self.value }
        }
    }

    crate::stream::encode_as_ref!(HandleWrite);
}
