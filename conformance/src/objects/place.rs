//! Where a value is, and how it is read and written.

use std::fmt;

use ads_cnc::address::{Attribute, Channel, ChannelAxis, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::operation::{
    AxisReadByName, AxisWriteByName, DynamicValueByName, ReadByName, ReadElement, ReadObject, Task,
    WriteByName, WriteElement, WriteObject,
};
use ads_cnc::value::EncodeValue as _;
use ads_cnc::{CncString, Error, ErrorKind, Handle, VariableAccess};

use super::List;
use crate::gate::Entry;
use crate::session::{Session, Trouble};
use crate::values::Type;

/// One thing that can be read.
#[derive(Clone, Debug)]
pub struct Object {
    pub list: List,
    pub name: CncString,
    /// Where its value is.
    pub place: Place,
    pub ty: Type,
    /// Its unit, if it has one.
    pub unit: Option<CncString>,
    /// Whether it may be written.
    pub access: Access,
    /// Its handle, if it is a variable.
    pub handle: Option<Handle>,
}

/// Whether something may be written, as the CNC says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// It may be read.
    Read,
    /// It may be read and written.
    ReadWrite,
    /// The CNC says this, which no manual has.
    Code(u32),
    /// The CNC does not say.
    Unknown,
}

impl Access {
    /// As a flag has it.
    pub const fn of_flag(writable: bool) -> Self {
        if writable { Self::ReadWrite } else { Self::Read }
    }

    /// As a description has it.
    pub const fn of_variable(access: VariableAccess) -> Self {
        match access {
            VariableAccess::READ_ONLY => Self::Read,
            VariableAccess::READ_WRITE => Self::ReadWrite,
            VariableAccess(code) => Self::Code(code),
        }
    }
}

impl fmt::Display for Access {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read => f.write_str("R"),
            Self::ReadWrite => f.write_str("RW"),
            Self::Code(code) => write!(f, "{code}"),
            Self::Unknown => Ok(()),
        }
    }
}

/// Where a value is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// The content of a COM object.
    Object { group: IndexGroup, offset: IndexOffset },
    /// The content of an element of a class.
    Element {
        element: ElementAddress,
        /// SDA or GEO.
        task: Task,
    },
    Variable {
        channel: Channel,
        /// Which place, over the axis interface.
        axis: Option<ChannelAxis>,
        /// The name, with indices for an element.
        name: CncString,
    },
    /// A dynamic parameter, by its name.
    Parameter { channel: Channel, kind: DynamicKind, name: CncString },
}

impl Place {
    /// Index group and offset of the content, if it has an address of its own.
    pub const fn address(&self) -> Option<(IndexGroup, IndexOffset)> {
        match self {
            Self::Object { group, offset } => Some((*group, *offset)),
            Self::Element { element, .. } => {
                Some((element.group(Attribute::Content), element.index_offset()))
            }
            _ => None,
        }
    }

    /// The AMS port of the task that has the content, if it has an address of its own.
    pub const fn port(&self) -> Option<AmsPort> {
        match self {
            Self::Object { .. } => Some(AmsPort::COM),
            Self::Element { task, .. } => Some(task.port()),
            _ => None,
        }
    }

    /// The entry that allows writing it, and nothing else.
    pub fn entry(&self) -> Entry {
        match self {
            Self::Object { group, offset } => Entry::Content { group: *group, offset: *offset },
            Self::Element { element, .. } => Entry::Content {
                group: element.group(Attribute::Content),
                offset: element.index_offset(),
            },
            Self::Variable { channel, axis, name } => {
                Entry::Variable { channel: *channel, axis: *axis, name: name.clone() }
            }
            Self::Parameter { channel, name, .. } => {
                Entry::Variable { channel: *channel, axis: None, name: name.clone() }
            }
        }
    }

    /// Reads the bytes of the value; `size` is that of a content.
    pub fn read(&self, session: &mut Session, size: u32) -> Result<Vec<u8>, Trouble> {
        match self {
            Self::Object { group, offset } => {
                let read = ReadObject::new(*group, *offset, size).map_err(no_object)?;
                session.call(&read).map(|content| content.bytes.to_vec())
            }
            Self::Element { element, task } => {
                let read = ReadElement::new(*element, size).map_err(no_element)?;
                session.call_at(*task, &read).map(|content| content.bytes.to_vec())
            }
            Self::Variable { channel, axis: None, name } => {
                let read = ReadByName { channel: *channel, name: name.as_cnc_str().into() };
                session.call(&read).map(|value| value.bytes.to_vec())
            }
            Self::Variable { channel, axis: Some(axis), name } => {
                let name = name.as_cnc_str().into();
                let read = AxisReadByName { channel: *channel, axis: *axis, name };
                session.call(&read).map(|value| value.bytes.to_vec())
            }
            Self::Parameter { channel, kind, name } => {
                let name = name.as_cnc_str().into();
                let read = DynamicValueByName { channel: *channel, kind: *kind, name };
                let value = session.call(&read)?.get();
                value.value_to_vec().map_err(Trouble::Reply)
            }
        }
    }

    /// Whether the gate lets it be written, so that nothing is asked in vain. Nothing is sent.
    ///
    /// # Errors
    /// That it does not.
    pub fn check(&self, session: &Session) -> Result<(), Trouble> {
        match self {
            Self::Object { group, offset } => {
                session.check(&WriteObject::new(*group, *offset, &[]).map_err(no_object)?)
            }
            Self::Element { element, task } => {
                let write = WriteElement::new(*element, &[]).map_err(no_element)?;
                session.check_at(*task, &write)
            }
            Self::Variable { channel, axis: Some(axis), name } => {
                let (channel, axis, name) = (*channel, *axis, name.as_cnc_str());
                session.check(&AxisWriteByName { channel, axis, name, value: (&[]).into() })
            }
            Self::Variable { channel, axis: None, name }
            | Self::Parameter { channel, name, .. } => {
                let (channel, name) = (*channel, name.as_cnc_str());
                session.check(&WriteByName { channel, name, value: (&[]).into() })
            }
        }
    }

    /// Writes the bytes of a value.
    ///
    /// # Errors
    /// That the gate does not let it through, or what came instead of success.
    pub fn write(&self, session: &mut Session, value: &[u8]) -> Result<(), Trouble> {
        let done = match self {
            Self::Object { group, offset } => {
                let write = WriteObject::new(*group, *offset, value);
                session.call(&write.map_err(no_object)?)
            }
            Self::Element { element, task } => {
                let write = WriteElement::new(*element, value);
                session.call_at(*task, &write.map_err(no_element)?)
            }
            Self::Variable { channel, axis: Some(axis), name } => {
                let name = name.as_cnc_str();
                session.call(&AxisWriteByName {
                    channel: *channel,
                    axis: *axis,
                    name,
                    value: value.into(),
                })
            }
            // Parameters have no function of their own to be written.
            Self::Variable { channel, axis: None, name }
            | Self::Parameter { channel, name, .. } => session.call(&WriteByName {
                channel: *channel,
                name: name.as_cnc_str(),
                value: value.into(),
            }),
        };
        done.map(drop)
    }
}

/// Of the functions of COM, one alone is where contents are.
fn no_object(error: Error) -> Trouble {
    let stream = "it is the program stream, which is written only: by ads-cnc stream";
    no_content_but(error, stream)
}

/// Where a function is, no content is (SDA-12).
fn no_element(error: Error) -> Trouble {
    no_content_but(error, "a function is at its address, no content")
}

fn no_content_but(error: Error, why: &str) -> Trouble {
    match error.kind() {
        ErrorKind::Function => Trouble::Unable(why.to_owned()),
        _ => Trouble::Unsendable(error),
    }
}
