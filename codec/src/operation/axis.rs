//! Variables over the axis interface (VAR-26): of the axis that is at a place of the channel now.

use super::request::sealed::Sealed;
use super::variable::{channel, operation};
use super::{Call, Function, Operation, Refusal, Request};
use crate::address::{Attribute, Channel, ChannelAxis, Class, IndexGroup, IndexOffset};
use crate::error::Error;
use crate::stream::{Decode, Encode, NoData};
use crate::text::{CncStr, TextRef};
use crate::variable::{Handle, NameWriteRef, ValueRef, VariableNameRef};

operation! {
    /// The handle of an axis variable: ReadWrite at offset 0x10000 × axis + 4, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.9.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, ChannelAxis};
    /// use ads_cnc::operation::{AxisHandleByName, Operation};
    ///
    /// let op = AxisHandleByName::new(Channel::new(1)?, ChannelAxis::new(2)?, "V.A.WCS")?;
    /// assert_eq!(op.index_offset().get(), 0x2_0004);
    /// assert_eq!(op.decode_reply(&[0x1B, 0, 2, 1])?.0, 0x0102_001B);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    AxisHandleByName {
        /// The variable's name, without that of the axis.
        name: TextRef<'a>,
    }
    as VariableNameRef, 4 of axis, reply Handle, at most 4
}

operation! {
    /// The value of an axis variable: ReadWrite at offset 0x10000 × axis + 5, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.10.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, ChannelAxis};
    /// use ads_cnc::operation::{AxisReadByName, Operation};
    ///
    /// let op = AxisReadByName::new(Channel::new(1)?, ChannelAxis::new(2)?, "V.A.WCS")?;
    /// assert_eq!(op.index_offset().get(), 0x2_0005);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    AxisReadByName {
        /// The variable's name, without that of the axis.
        name: TextRef<'a>,
    }
    as VariableNameRef, 5 of axis, reply ValueRef<'r>, at most 2048
}

operation! {
    /// Writes an axis variable: Write at offset 0x10000 × axis + 6, port 552.
    ///
    /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.11.
    ///
    /// ```
    /// use ads_cnc::address::{Channel, ChannelAxis};
    /// use ads_cnc::operation::{AxisWriteByName, Operation};
    ///
    /// let (channel, axis) = (Channel::new(1)?, ChannelAxis::new(2)?);
    /// let value = 123.456_f64.to_le_bytes();
    /// let op = AxisWriteByName::new(channel, axis, "V.A.WCS", &value)?;
    /// assert_eq!(op.index_offset().get(), 0x2_0006);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    AxisWriteByName {
        /// The variable's name, without that of the axis.
        name: CncStr<'a>,
        /// The bytes of the value.
        value: &'a [u8],
    }
    as NameWriteRef, 6 of axis, reply NoData, at most 0
}

impl<'a> AxisHandleByName<'a> {
    /// For a place of a channel and a name.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(channel: Channel, axis: ChannelAxis, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, axis, name: TextRef::new(name)? })
    }
}

impl<'a> AxisReadByName<'a> {
    /// For a place of a channel and a name.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(channel: Channel, axis: ChannelAxis, name: &'a str) -> Result<Self, Error> {
        Ok(Self { channel, axis, name: TextRef::new(name)? })
    }
}

impl<'a> AxisWriteByName<'a> {
    /// For a place of a channel, a name and a value.
    ///
    /// # Errors
    /// Those of [`CncStr::new`].
    pub fn new(
        channel: Channel,
        axis: ChannelAxis,
        name: &'a str,
        value: &'a [u8],
    ) -> Result<Self, Error> {
        Ok(Self { channel, axis, name: CncStr::new(name)?, value })
    }
}
