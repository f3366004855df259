//! Why the gate rejects a frame, and which entry would allow it.

use std::fmt;
use std::net::IpAddr;
use std::time::Duration;

use ads_cnc::address::IndexGroup;
use ads_cnc::ads::{AmsNetId, AmsPort, Command, StateFlags};
use ads_cnc::operation::{self, Function};
use ads_cnc::{CncString, Error};

use super::{Entry, Moment};

/// Maximum number of handles, names and addresses stored for a connection. Beyond it every write by
/// a handle or to a named object is rejected.
pub(super) const OBSERVATIONS_MAX: usize = 65_536;

/// A frame that the gate rejects.
#[derive(Clone, Debug)]
pub struct Refusal {
    pub reason: Reason,
    /// The entry that would allow it, if there is one.
    pub needed: Option<Entry>,
}

/// Why a frame is rejected.
#[derive(Clone, Debug)]
pub enum Reason {
    /// The bytes are not one complete frame.
    NoFrame,
    /// The lengths of the frame or of the service's data are inconsistent.
    Malformed(Error),
    /// The state flags are not those of a request.
    NoRequest(StateFlags),
    /// The port is not that of a task.
    NoTask(AmsPort),
    /// The command has no data, but data follows.
    Data(Command),
    /// The command is never sent.
    Never(Command),
    /// A sum command, which may contain writes.
    Sum(IndexGroup),
    /// The program stream, but not written to a channel's at the port of COM: the effect is not
    /// documented.
    Stream,
    /// No documented function: the effect is unknown.
    Unknown(operation::DispatchError),
    /// The function is documented for another port, or is a write to GEO, for which the file has no
    /// entries.
    Port(AmsPort, Function),
    /// The function is a write, and there is no file.
    NoFile(Function, AmsNetId),
    /// The function is a write to a name that is not in the file.
    NoEntry(Function),
    /// The file is for another target.
    OtherTarget { allowed: AmsNetId, target: AmsNetId },
    /// The file is for another IP address.
    OtherAddress {
        allowed: Option<IpAddr>,
        /// The address of the connection, if known.
        address: Option<IpAddr>,
    },
    /// The file is for 127.0.0.1.1.1, the local machine, but the connection is not to it.
    LocalNetId(Option<IpAddr>),
    /// The file has expired at this time.
    Expired(Moment),
    /// The name is in the file, but the handle or the address may belong to another name too.
    Ambiguous(Function, Ambiguity),
    /// The file does not permit malformed requests.
    NoMalformed(AmsNetId),
}

impl Reason {
    /// Whether a file of --allow-write would have to permit the request, or to be another one.
    pub(crate) const fn is_of_file(&self) -> bool {
        matches!(
            self,
            Self::NoFile(..)
                | Self::NoEntry(_)
                | Self::OtherTarget { .. }
                | Self::OtherAddress { .. }
                | Self::LocalNetId(_)
                | Self::Expired(_)
                | Self::Ambiguous(..)
                | Self::NoMalformed(_)
        )
    }
}

/// Why a handle or an address may belong to a name that is not in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ambiguity {
    /// The device gives it to this name too.
    Shared(CncString),
    /// The device gives several handles to this name.
    Several(CncString),
    /// Only one of HandleByName and a description gave it to this name.
    Unconfirmed(CncString),
    /// The address of the object with this name belongs to another channel or axis.
    Elsewhere(CncString),
    /// More names were returned than can be stored.
    TooMuch,
}

impl fmt::Display for Ambiguity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shared(name) => {
                write!(f, "the device gives it to {name} too, which the file does not name")
            }
            Self::Several(name) => write!(f, "the device gives several to {name}"),
            Self::Unconfirmed(name) => {
                write!(f, "the handle by name and the description of {name} have not both given it")
            }
            Self::Elsewhere(name) => {
                write!(f, "it is in another channel or axis than the list that has {name}")
            }
            Self::TooMuch => {
                write!(f, "the device has more names than the {OBSERVATIONS_MAX} that are compared")
            }
        }
    }
}

/// The end of the permission that an advice shows.
fn tomorrow() -> Moment {
    Moment::now().after(Duration::from_secs(24 * 3600))
}

impl Refusal {
    pub(super) const fn needing(reason: Reason, needed: Option<Entry>) -> Self {
        Self { reason, needed }
    }

    /// Advice over several lines; empty if there is none.
    pub fn advice(&self) -> String {
        match (&self.reason, &self.needed) {
            (Reason::NoFile(_, target), Some(entry)) => format!(
                "If nothing can come to harm, allow it in a file for --allow-write:\n\n\
                 target = \"{target}\"\n\
                 expires = {}  # nothing is written from then on\n\n{entry}",
                tomorrow()
            ),
            (Reason::NoEntry(_), Some(entry)) => {
                format!("If nothing can come to harm, add to the file of --allow-write:\n\n{entry}")
            }
            (Reason::NoFile(..) | Reason::NoEntry(_), None) => {
                "A handle can be written by after the device has given it, by HandleByName and in \
                 a description, to a name that the file of --allow-write has."
                    .to_owned()
            }
            (Reason::OtherTarget { .. }, _) => {
                "Write a file for this target; see that it is the right one.".to_owned()
            }
            (Reason::OtherAddress { .. }, _) => {
                "See whether it is the right device; the file says its address.".to_owned()
            }
            (Reason::LocalNetId(_), _) => {
                "Write a file for the NetId that the device's own router shows.".to_owned()
            }
            (Reason::NoMalformed(target), _) => format!(
                "If nothing can come to harm, permit it in a file for --allow-write:\n\n\
                 target = \"{target}\"\n\
                 expires = {}  # nothing is written from then on\n\
                 malformed = true",
                tomorrow()
            ),
            (Reason::Ambiguous(Function::WriteObject, Ambiguity::Shared(_)), _) => {
                "An object that shares its address with another one cannot be written.".to_owned()
            }
            (Reason::Ambiguous(Function::WriteObject, _), _) => {
                "An object can be written by its group and offset, if the file has them.".to_owned()
            }
            (Reason::Ambiguous(..), _) => "A variable can be written by its name.".to_owned(),
            (Reason::Expired(_), _) => {
                "See whether nothing can come to harm, and set another time.".to_owned()
            }
            _ => String::new(),
        }
    }
}

impl From<Reason> for Refusal {
    fn from(reason: Reason) -> Self {
        Self { reason, needed: None }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |function: &Function| function.spec().name;
        match &self.reason {
            Reason::NoFrame => f.write_str("not one whole frame"),
            Reason::Malformed(error) => write!(f, "malformed: {error}"),
            Reason::NoRequest(flags) => write!(f, "no request: state flags {:#06x}", flags.0),
            Reason::NoTask(port) => write!(f, "no task of a CNC has port {port}"),
            Reason::Data(command) => write!(f, "command {} has no data", command.0),
            Reason::Never(command) => write!(f, "command {} is never sent", command.0),
            Reason::Sum(group) => {
                write!(f, "index group {group} carries requests inside, which may write")
            }
            Reason::Stream => f.write_str("what this does to the program stream is not documented"),
            Reason::Unknown(refusal) => write!(f, "no documented query: {refusal}"),
            Reason::Port(port, function) => {
                write!(f, "\"{}\" is not sent to port {port}", name(function))
            }
            Reason::NoFile(function, _) => {
                write!(
                    f,
                    "\"{}\" is not a query, and nothing is allowed to be written",
                    name(function)
                )
            }
            Reason::NoEntry(function) => write!(
                f,
                "\"{}\" is not a query, and the file of --allow-write does not name this",
                name(function)
            ),
            Reason::OtherTarget { allowed, target } => {
                write!(f, "the file of --allow-write is for {allowed}, not for {target}")
            }
            Reason::OtherAddress { allowed, address } => write!(
                f,
                "the file of --allow-write is for the address {}, not for {}",
                address_text(allowed),
                address_text(address)
            ),
            Reason::LocalNetId(address) => write!(
                f,
                "the file of --allow-write is for 127.0.0.1.1.1, which is the NetId of whichever \
                 machine is asked, and {} is not this one",
                address_text(address)
            ),
            Reason::Ambiguous(function, ambiguity) => write!(
                f,
                "\"{}\" may reach what the file of --allow-write does not name: {ambiguity}",
                name(function)
            ),
            Reason::NoMalformed(target) => {
                write!(f, "no file permits malformed requests to {target}")
            }
            Reason::Expired(moment) => {
                // A write may be rejected before, if it could not be restored in time.
                let verb = if Moment::now() >= *moment { "expired" } else { "expires" };
                write!(f, "the file of --allow-write {verb} at {moment}")
            }
        }
    }
}

impl std::error::Error for Refusal {}

fn address_text(address: &Option<IpAddr>) -> String {
    address.map_or_else(|| "one that is not known".to_owned(), |address| address.to_string())
}
