//! An entry of a file of `--allow-write`.

use std::fmt;

use ads_cnc::address::{Addressing, Channel, ChannelAxis, IndexGroup, IndexOffset, PlatformAxis};
use ads_cnc::operation::{ObjectList, Operation as _, Request};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncStr, CncString};

/// A permission to write a value or to stream NC programs. `Display` formats the entry as a TOML
/// table of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A variable by its name. If the entry has no axis and its name no indices at the end, it also
    /// allows writes by a handle that replies contained for this variable, unless there is an
    /// [`Ambiguity`](super::Ambiguity).
    Variable {
        channel: Channel,
        /// The axis, if the write uses the axis interface.
        axis: Option<ChannelAxis>,
        /// The name of the variable. A name without an index allows writes to all elements.
        name: CncString,
    },
    /// The content of a COM object or of an element, by its address.
    Content { group: IndexGroup, offset: IndexOffset },
    /// The content of the only COM object with this name in a list.
    Object { list: AllowedList, name: CncString },
    /// NC programs for a channel.
    Stream(Channel),
    /// The variables of the Service Interface that a service writes in a channel.
    Service(Channel),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AllowedList {
    /// The list of the platform.
    Platform,
    /// The list of a channel.
    Channel(Channel),
    /// The list of a platform axis.
    Axis(PlatformAxis),
}

impl AllowedList {
    /// The list of objects for a request. A channel is addressed by number or by rank, as in the
    /// entry.
    pub fn list(self) -> ObjectList {
        match self {
            Self::Platform => ObjectList::PLATFORM,
            Self::Channel(channel) => channel.into(),
            Self::Axis(axis) => axis.into(),
        }
    }
}

impl Entry {
    /// The entry that would allow a write; `None` for a query, and for a write by a handle, because
    /// the name of the variable is unknown.
    pub fn needed(request: &Request<'_>) -> Option<Self> {
        Some(match request {
            Request::WriteByName(op) if is_of_service(op.name) => Self::Service(op.channel),
            Request::WriteByName(op) => {
                Self::Variable { channel: op.channel, axis: None, name: op.name.into() }
            }
            Request::AxisWriteByName(op) => {
                Self::Variable { channel: op.channel, axis: Some(op.axis), name: op.name.into() }
            }
            Request::WriteProgramStream(op) => Self::Stream(op.channel),
            Request::WriteObject(op) => {
                Self::Content { group: op.index_group(), offset: op.index_offset() }
            }
            Request::WriteElement(op) => {
                Self::Content { group: op.index_group(), offset: op.index_offset() }
            }
            _ => return None,
        })
    }

    /// Whether the entry allows writes to a variable with this name.
    pub(super) fn allows_variable(
        &self,
        of: Channel,
        at: Option<ChannelAxis>,
        requested_name: CncStr<'_>,
    ) -> bool {
        match self {
            Self::Variable { channel, axis, name } => {
                (*channel, *axis) == (of, at) && is_or_is_in(requested_name, name)
            }
            Self::Service(channel) => {
                *channel == of && at.is_none() && is_of_service(requested_name)
            }
            _ => false,
        }
    }
}

/// The variables of the Service Interface that a service writes; the NC program writes the others.
const SERVICE: [ServiceVariable; 3] =
    [ServiceVariable::RequestState, ServiceVariable::ResponseState, ServiceVariable::Response];

fn is_of_service(name: CncStr<'_>) -> bool {
    SERVICE.iter().any(|variable| name == *variable.name())
}

/// Whether `requested_name` is `name`, optionally followed by indices.
fn is_or_is_in(requested_name: CncStr<'_>, name: &CncString) -> bool {
    let mut rest = requested_name.bytes();
    if !name.as_bytes().iter().all(|&byte| rest.next() == Some(byte)) {
        return false;
    }
    let rest: Vec<u8> = rest.collect();
    let is_index = |part: &[u8]| match part {
        [b'[', digits @ ..] => !digits.is_empty() && digits.iter().all(u8::is_ascii_digit),
        _ => false,
    };
    match rest.as_slice() {
        [] => true,
        [indices @ .., b']'] => indices.split(|&byte| byte == b']').all(is_index),
        _ => false,
    }
}

/// Formats the entry as a TOML table of the file.
impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variable { channel, axis, name } => {
                writeln!(f, "[[variable]]\n{}", at(*channel))?;
                if let Some(axis) = axis {
                    writeln!(f, "axis = {}", axis.index())?;
                }
                write!(f, "name = {}", quoted(name))
            }
            Self::Content { group, offset } => {
                let is_com = group.get() & 0xFFFF < 0x300;
                let table = if is_com { "object" } else { "element" };
                write!(f, "[[{table}]]\ngroup = {group}\noffset = {offset}")
            }
            Self::Object { list, name } => {
                let list = match list {
                    AllowedList::Platform => "channel = 0".to_owned(),
                    AllowedList::Channel(channel) => at(*channel),
                    AllowedList::Axis(axis) => format!("axis = {}", axis.index()),
                };
                write!(f, "[[object]]\n{list}\nname = {}", quoted(name))
            }
            Self::Stream(channel) => write!(f, "[[stream]]\n{}", at(*channel)),
            Self::Service(channel) => write!(f, "[[service]]\n{}", at(*channel)),
        }
    }
}

fn at(channel: Channel) -> String {
    let key = match channel.addressing() {
        Addressing::Logical => "channel",
        Addressing::Index => "rank",
    };
    format!("{key} = {}", channel.number())
}

/// The name as a basic string of TOML, in quotes and escaped.
fn quoted(name: &CncString) -> String {
    let escaped = name.as_cnc_str().chars().flat_map(|character| match character {
        '"' | '\\' => vec!['\\', character],
        character if character.is_control() => {
            format!("\\u{:04x}", u32::from(character)).chars().collect()
        }
        character => vec![character],
    });
    format!("\"{}\"", escaped.collect::<String>())
}
