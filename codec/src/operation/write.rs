//! Writing variables over the channel interface (VAR-12, VAR-13).

use super::request::sealed::Sealed;
use super::variable::{channel, operation};
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Attribute, Channel, Class, IndexGroup, IndexOffset};
use crate::error::Error;
use crate::stream::{Decode, Encode, NoData};
use crate::text::CncStr;
use crate::variable::{Handle, HandleWriteRef, NameWriteRef, Numbers};

operation! {
    /// Writes a variable by its handle: Write at offset 0x49, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.6.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{Operation, WriteByHandle};
    /// use ads_cnc::{Handle, Numbers};
    ///
    /// let value = 123_i32.to_le_bytes();
    /// let channel = Channel::new(1)?;
    /// let op = WriteByHandle::new(channel, Handle(0x2001234), Numbers::from(&[4]), &value);
    /// assert_eq!(op.encode(&mut [0; 16])?, b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteByHandle {
        /// Handle of the variable.
        handle: Handle,
        /// Index in each dimension, from 0; none for the whole variable.
        indices: Numbers<'a>,
        /// The bytes of the value.
        value: &'a [u8],
    }
    as HandleWriteRef, 0x49, reply NoData, at most 0
}

operation! {
    /// Writes a variable by its name: Write at offset 0x4A, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.7.
    ///
    /// ```
    /// use ads_cnc::address::Channel;
    /// use ads_cnc::operation::{Operation, WriteByName};
    ///
    /// let value = 123_i32.to_le_bytes();
    /// let op = WriteByName::new(Channel::new(1)?, "V.E.test[4]", &value)?;
    /// assert_eq!(op.encode(&mut [0; 16])?, b"V.E.test[4]\0\x7b\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    WriteByName {
        /// The variable's name; with an index for one element of an array.
        name: CncStr<'a>,
        /// The bytes of the value.
        value: &'a [u8],
    }
    as NameWriteRef, 0x4A, reply NoData, at most 0
}

impl<'a> WriteByHandle<'a> {
    /// For a channel, a handle, indices and a value.
    pub const fn new(
        channel: Channel,
        handle: Handle,
        indices: Numbers<'a>,
        value: &'a [u8],
    ) -> Self {
        Self { channel, handle, indices, value }
    }
}

impl<'a> WriteByName<'a> {
    /// For a channel, a name and a value.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(channel: Channel, name: &'a str, value: &'a [u8]) -> Result<Self, Error> {
        Ok(Self { channel, name: CncStr::new(name)?, value })
    }
}
