//! The address of a value, with which it is read and written.

#![cfg_attr(
    not(test),
    deny(clippy::arithmetic_side_effects, clippy::as_conversions, clippy::indexing_slicing),
    deny(clippy::expect_used, clippy::panic, clippy::string_slice, clippy::unreachable),
    deny(clippy::unwrap_used)
)]

use ads_cnc::address::{Attribute, Channel, ChannelAxis, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    AxisReadByName, AxisWriteByName, DynamicValueByName, ReadByHandle, ReadByName, ReadElement,
    ReadObject, Request, Task, WriteByHandle, WriteByName, WriteElement, WriteObject,
};
use ads_cnc::{CncString, Error, ErrorKind, Handle};

use crate::session::{Session, ToolError};

/// The address of a value. A variable may have several addresses: its handle and its name, for
/// example.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValueAddress {
    /// A variable, addressed by its handle; if there are indices, the element with these indices.
    Handle { channel: Channel, handle: Handle, indices: Vec<u32> },
    /// A variable, addressed by its name; the name of an element ends with its indices.
    Name { channel: Channel, name: CncString },
    /// A variable of an axis, addressed by its name on the axis interface.
    Axis { channel: Channel, axis: ChannelAxis, name: CncString },
    /// A dynamic parameter, addressed by its name.
    Parameter { channel: Channel, kind: DynamicKind, name: CncString },
    /// The content of a COM object.
    Object { group: IndexGroup, offset: IndexOffset, size: u32 },
    /// The content of an element of a class, at the task SDA or GEO.
    Element { element: ElementAddress, length: u32, task: Task },
}

impl ValueAddress {
    /// The address of the whole variable with a handle.
    pub const fn of_handle(channel: Channel, handle: Handle) -> Self {
        Self::Handle { channel, handle, indices: Vec::new() }
    }

    /// The address of the content of an element at the task SDA.
    pub const fn of_element(element: ElementAddress, length: u32) -> Self {
        Self::Element { element, length, task: Task::Sda }
    }

    /// The request that reads the value.
    ///
    /// # Errors
    /// If no request can read the content.
    pub fn read(&self) -> Result<Request<'_>, Error> {
        Ok(match self {
            Self::Handle { channel, handle, indices } => {
                ReadByHandle::new(*channel, *handle, indices).into()
            }
            Self::Name { channel, name } => {
                ReadByName { channel: *channel, name: name.as_cnc_str().into() }.into()
            }
            Self::Axis { channel, axis, name } => {
                let name = name.as_cnc_str().into();
                AxisReadByName { channel: *channel, axis: *axis, name }.into()
            }
            Self::Parameter { channel, kind, name } => {
                let name = name.as_cnc_str().into();
                DynamicValueByName { channel: *channel, kind: *kind, name }.into()
            }
            Self::Object { group, offset, size } => ReadObject::new(*group, *offset, *size)?.into(),
            Self::Element { element, length, .. } => ReadElement::new(*element, *length)?.into(),
        })
    }

    /// The request that writes a value.
    ///
    /// # Errors
    /// If no request can write the content.
    pub fn write<'v>(&'v self, value: &'v [u8]) -> Result<Request<'v>, Error> {
        Ok(match self {
            Self::Handle { channel, handle, indices } => {
                WriteByHandle::new(*channel, *handle, indices, value).into()
            }
            // No function for parameters writes one, but V.L, V.P and V.S may also be variables.
            Self::Name { channel, name } | Self::Parameter { channel, name, .. } => {
                WriteByName { channel: *channel, name: name.as_cnc_str(), value: value.into() }
                    .into()
            }
            Self::Axis { channel, axis, name } => {
                let name = name.as_cnc_str();
                AxisWriteByName { channel: *channel, axis: *axis, name, value: value.into() }.into()
            }
            Self::Object { group, offset, .. } => WriteObject::new(*group, *offset, value)?.into(),
            Self::Element { element, .. } => WriteElement::new(*element, value)?.into(),
        })
    }

    /// Index group and offset of a content; `None` for a variable or a parameter.
    pub const fn content(&self) -> Option<(IndexGroup, IndexOffset)> {
        match self {
            Self::Object { group, offset, .. } => Some((*group, *offset)),
            Self::Element { element, .. } => {
                Some((element.group(Attribute::Content), element.index_offset()))
            }
            _ => None,
        }
    }

    /// The task that serves the address.
    pub const fn task(&self) -> Task {
        match self {
            Self::Object { .. } => Task::Com,
            Self::Element { task, .. } => *task,
            _ => Task::Sda,
        }
    }

    /// The error if no request can be encoded for this address.
    fn no_request(&self, error: Error) -> ToolError {
        match (self, error.kind()) {
            // The program stream is the only function of COM in an index group for contents.
            (Self::Object { .. }, ErrorKind::Function) => {
                ToolError::Unable("use ads-cnc stream for the program stream".to_owned())
            }
            // The offset of a function has no content (SDA-12).
            (_, ErrorKind::Function) => {
                ToolError::Unable("it is a function and has no content".to_owned())
            }
            _ => ToolError::Unsendable(error),
        }
    }
}

impl Session {
    /// Reads the bytes of a value.
    ///
    /// # Errors
    /// [`ToolError::Unable`] or [`ToolError::Unsendable`] if no request can read the address, those
    /// of [`request`](Self::request), and [`ToolError::Reply`] if the reply does not decode to a
    /// value.
    pub fn read(&mut self, address: &ValueAddress) -> Result<Vec<u8>, ToolError> {
        let read = address.read().map_err(|error| address.no_request(error))?;
        let data = self.request(address.task(), read)?;
        read.decode_reply(&data).map_err(ToolError::Reply)?;
        Ok(data)
    }

    /// Writes the bytes of a value.
    ///
    /// # Errors
    /// [`ToolError::Unable`] or [`ToolError::Unsendable`] if no request can write the address,
    /// those of [`request`](Self::request), and [`ToolError::Reply`] if the reply cannot be
    /// decoded.
    pub fn write(&mut self, address: &ValueAddress, value: &[u8]) -> Result<(), ToolError> {
        let write = address.write(value).map_err(|error| address.no_request(error))?;
        let data = self.request(address.task(), write)?;
        write.decode_reply(&data).map(drop).map_err(ToolError::Reply)
    }

    /// Checks whether the gate allows a write of the value. Nothing is sent.
    ///
    /// # Errors
    /// If the gate rejects the write, or no request can write the address.
    pub fn check_write(&self, address: &ValueAddress) -> Result<(), ToolError> {
        let write = address.write(&[]).map_err(|error| address.no_request(error))?;
        self.check(address.task(), write)
    }
}
