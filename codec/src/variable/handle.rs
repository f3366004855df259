//! Handles, and reading by handle (VAR-10, VAR-11).

use core::fmt;

use super::Numbers;
use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::Stream;
use crate::layout::field::variable_handle::HANDLE as REPLY_HANDLE;
use crate::layout::field::variable_handle_read::{HANDLE, INDEX_COUNT};
use crate::limits::INDICES_MAX;
use crate::stream::{Decode, Encode};

crate::number::number_stream! {
    #[doc = include_str!("../../doc/variable-handle.md")]
    ///
    /// Valid until the controller restarts; that of an axis variable belongs to the axis's place.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.3.
    ///
    /// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated) or
    /// [`Trailing`](crate::ErrorKind::Trailing).
    ///
    /// ```
    /// use ads_cnc::{Decode, Handle};
    ///
    /// assert_eq!(Handle::decode(&[4, 0, 0, 2])?, Handle(0x2000004));
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    Handle, VariableHandle, REPLY_HANDLE
}

impl fmt::Debug for Handle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Handle({:#x})", self.0)
    }
}

#[doc = include_str!("../../doc/variable-handle-read.md")]
///
/// No index reads the whole variable; otherwise there is one for each dimension.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.4.
///
/// `decode` refuses with [`Truncated`](crate::ErrorKind::Truncated),
/// [`TooMany`](crate::ErrorKind::TooMany), [`Trailing`](crate::ErrorKind::Trailing) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Encode, Handle, HandleReadRef, Numbers};
///
/// let element = HandleReadRef { handle: Handle(0x20012341), indices: Numbers::from(&[4]) };
/// let mut buf = [0; 12];
/// assert_eq!(element.encode(&mut buf)?, [0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HandleReadRef<'a> {
    /// Handle of the variable.
    pub handle: Handle,
    /// Index in each dimension, from 0; none for the whole variable.
    pub indices: Numbers<'a>,
}

impl<'a> Decode<'a> for HandleReadRef<'a> {
    const STREAM: Stream = Stream::VariableHandleRead;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        let mut input = Reader::new(Self::STREAM, bytes)?;
        let handle = Handle(input.u32(HANDLE)?);
        let count = input.u32(INDEX_COUNT)?;
        let indices = input.numbers(INDEX_COUNT, count, to_u32(INDICES_MAX))?;
        input.finish()?;
        Ok(Self { handle, indices: Numbers::from_wire(indices) })
    }
}

impl Encode for HandleReadRef<'_> {
    fn encoded_len(&self) -> usize {
        self.indices.encoded_len().saturating_add(8)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        let count = self.indices.check(INDEX_COUNT, 4, INDICES_MAX)?;
        Writer::run(Self::STREAM, count.saturating_mul(4).saturating_add(8), buf, |out| {
            out.u32(self.handle.0);
            out.u32(to_u32(count));
            self.indices.write(out);
        })
    }
}

#[cfg(feature = "alloc")]
pub use owned::HandleRead;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::bridge;

    /// [`HandleReadRef`], owned.
    ///
    /// ```
    /// use ads_cnc::{Decode, Handle, HandleRead};
    ///
    /// let read = HandleRead::decode(&[0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0])?;
    /// assert_eq!(read, HandleRead { handle: Handle(0x20012341), indices: vec![4] });
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Debug, PartialEq, Eq, Hash)]
    pub struct HandleRead {
        /// Handle of the variable.
        pub handle: Handle,
        /// Index in each dimension, from 0; none for the whole variable.
        pub indices: Vec<u32>,
    }

    #[binrw::binread]
    #[br(little)]
    struct Wire {
        handle: u32,
        #[br(temp)]
        index_count: u32,
        #[br(parse_with = bridge::numbers, args(index_count))]
        indices: Vec<u32>,
    }

    impl<'a> Decode<'a> for HandleRead {
        const STREAM: Stream = Stream::VariableHandleRead;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            HandleReadRef::decode(bytes)?;
            let Wire { handle, indices } = bridge::read(Self::STREAM, bytes)?;
            Ok(Self { handle: Handle(handle), indices })
        }
    }

    impl HandleRead {
        /// The request, borrowed.
        #[inline]
        pub fn as_ref(&self) -> HandleReadRef<'_> {
            HandleReadRef { handle: self.handle, indices: self.indices.as_slice().into() }
        }
    }

    crate::stream::encode_as_ref!(HandleRead);
}
