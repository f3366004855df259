//! The permitted writes: entries, and the requests that each allows.

use std::fmt;
use std::net::IpAddr;

use ads_cnc::address::{Addressing, Channel, ChannelAxis, IndexGroup, IndexOffset, PlatformAxis};
use ads_cnc::ads::AmsNetId;
use ads_cnc::operation::{ObjectList, Operation as _, Request};
use ads_cnc::service::ServiceVariable;
use ads_cnc::{CncStr, CncString};

use super::{Doubt, Moment, NET_ID, Observed, Reason};

/// The permitted writes: target, values and expiry.
///
/// As a file. Every table may be repeated; channels and axes have the numbers of the CNC:
///
/// ```
/// let file = r#"
/// target = "192.0.2.7.1.1"             # the AMS NetId of the device
/// address = "192.0.2.7"                # its IP address; without it any that has the NetId
/// expires = 2026-05-04T17:30:00+02:00  # from then on nothing is written
/// malformed = false                    # whether run --malformed may send it malformed requests
///
/// [[variable]]                 # with its elements; "V.E.list[3]" is one element alone
/// channel = 1                  # or rank = 1, the first of the active channels
/// name = "V.E.list"
///
/// [[variable]]                 # over the axis interface
/// channel = 1
/// axis = 2
/// name = "V.A.WCS"
///
/// [[object]]                   # content of a COM object, by its address
/// group = 0x120101
/// offset = 0x1
///
/// [[object]]                   # or by its name: in the list of a channel (0 is the platform),
/// channel = 1                  # of a rank or of a platform axis
/// name = "mc_command_single_block_w"
///
/// [[element]]                  # content of an element of a class
/// group = 0x123301
/// offset = 1
///
/// [[stream]]                   # NC programs: this moves the machine
/// channel = 1
///
/// [[service]]                  # the answers of a Service Interface host
/// channel = 1
/// "#;
/// let allowed = ads_cnc_conformance::gate::Allowed::from_toml(file)?;
/// assert_eq!(allowed.entries.len(), 7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Allowed {
    /// The AMS NetId of the one target that it is for.
    pub target: AmsNetId,
    /// The IP address of the target, if the file binds it.
    pub address: Option<IpAddr>,
    /// Whether malformed requests may be sent to the target.
    pub malformed: bool,
    /// When it is over.
    pub expires: Moment,
    /// The permitted writes.
    pub entries: Vec<Entry>,
}

impl Allowed {
    /// Checks whether the file applies to this target now; `address` is that of the connection, if
    /// known.
    ///
    /// # Errors
    /// The first reason why it does not.
    pub(super) fn check_target(
        &self,
        target: AmsNetId,
        address: Option<IpAddr>,
        now: Moment,
    ) -> Result<(), Reason> {
        if self.target != target {
            return Err(Reason::OtherTarget { allowed: self.target, target });
        }
        if self.address.is_some() && self.address != address {
            return Err(Reason::OtherAddress { allowed: self.address, address });
        }
        // Routers know their own machine by this NetId: another machine's would take it for itself.
        if target == NET_ID && !address.is_some_and(|address| address.is_loopback()) {
            return Err(Reason::LocalNetId(address));
        }
        if now >= self.expires { Err(Reason::Expired(self.expires)) } else { Ok(()) }
    }
}

/// One thing that may be written. Shown as the table that allows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A variable by its name, or by a handle that was asked for by this name.
    Variable {
        channel: Channel,
        /// Which axis, over the axis interface.
        axis: Option<ChannelAxis>,
        /// The name. Without an index it includes the elements.
        name: CncString,
    },
    /// The content of a COM object or of an element, by its address.
    Content { group: IndexGroup, offset: IndexOffset },
    /// The content of the only COM object with this name in a list.
    Object { list: AllowedList, name: CncString },
    /// NC programs for a channel.
    Stream(Channel),
    /// The variables that a host of the Service Interface writes in a channel.
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
    /// The list with its addressing.
    pub fn list(self) -> ObjectList {
        match self {
            Self::Platform => ObjectList::PLATFORM,
            Self::Channel(channel) => channel.into(),
            Self::Axis(axis) => axis.into(),
        }
    }
}

impl Entry {
    /// The entry that would allow a request; `None` if no entry can.
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

    /// Checks whether the entry allows a request other than a query.
    ///
    /// # Errors
    /// Why the value written may be another than the entry names.
    pub(super) fn allows(&self, request: &Request<'_>, observed: &Observed) -> Result<bool, Doubt> {
        match (self, request) {
            (Self::Object { list, name }, Request::WriteObject(op)) => {
                observed.is_object(list.list(), name, (op.index_group(), op.index_offset()))
            }
            // `is_variable` checks every name of the handle, whichever entry allows it.
            (Self::Variable { .. } | Self::Service(_), Request::WriteByHandle(op)) => {
                observed.is_variable(op.channel, op.handle)
            }
            (_, Request::WriteByName(op)) => Ok(self.allows_variable(op.channel, None, op.name)),
            (_, Request::AxisWriteByName(op)) => {
                Ok(self.allows_variable(op.channel, Some(op.axis), op.name))
            }
            (Self::Content { group, offset }, Request::WriteObject(op)) => {
                if (op.index_group(), op.index_offset()) == (*group, *offset) {
                    observed.has_one_name((*group, *offset)).map(|()| true)
                } else {
                    Ok(false)
                }
            }
            (Self::Content { .. } | Self::Stream(_), _) => {
                Ok(Self::needed(request).as_ref() == Some(self))
            }
            _ => Ok(false),
        }
    }

    /// Whether the entry allows writes to a variable with this name.
    pub(super) fn allows_variable(
        &self,
        of: Channel,
        at: Option<ChannelAxis>,
        asked: CncStr<'_>,
    ) -> bool {
        match self {
            Self::Variable { channel, axis, name } => {
                (*channel, *axis) == (of, at) && is_or_is_in(asked, name)
            }
            Self::Service(channel) => *channel == of && at.is_none() && is_of_service(asked),
            _ => false,
        }
    }
}

/// The variables that a host writes; the NC program writes the others.
const SERVICE: [ServiceVariable; 3] =
    [ServiceVariable::RequestState, ServiceVariable::ResponseState, ServiceVariable::Response];

fn is_of_service(name: CncStr<'_>) -> bool {
    SERVICE.iter().any(|variable| name == *variable.name())
}

/// Whether a name is this one, or this one followed by indices.
fn is_or_is_in(asked: CncStr<'_>, name: &CncString) -> bool {
    let asked: Vec<u8> = asked.bytes().collect();
    let Some(rest) = asked.strip_prefix(name.as_bytes()) else { return false };
    let is_index = |part: &[u8]| match part {
        [b'[', digits @ ..] => !digits.is_empty() && digits.iter().all(u8::is_ascii_digit),
        _ => false,
    };
    match rest {
        [] => true,
        [indices @ .., b']'] => indices.split(|&byte| byte == b']').all(is_index),
        _ => false,
    }
}

/// As a TOML table of the file.
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

/// A basic string of TOML.
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
