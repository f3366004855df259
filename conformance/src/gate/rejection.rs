//! The reason why the gate rejects a frame, and the entry that would allow it.

use std::fmt;
use std::net::IpAddr;
use std::time::Duration;

use ads_cnc::address::IndexGroup;
use ads_cnc::ads::{AmsNetId, AmsPort, Command, StateFlags};
use ads_cnc::operation::{self, Function};
use ads_cnc::{CncString, Error};

use super::{Entry, Moment};

/// Maximum number of records of handles, names, addresses and list indices that the gate stores. If
/// replies contain more, the gate rejects every write by handle, and every write to an object that
/// the file allows only by name, also on later connections.
pub(super) const OBSERVATIONS_MAX: usize = 65_536;

/// The rejection of a frame.
#[derive(Clone, Debug)]
pub struct GateRejection {
    pub reason: Reason,
    /// The entry that would allow the frame, if there is no file or the file lacks the entry;
    /// `None` in any other case, and for a write by a handle.
    pub needed: Option<Entry>,
}

/// The reason why a frame is rejected.
#[derive(Clone, Debug)]
pub enum Reason {
    /// The bytes are not one complete frame.
    NoFrame,
    /// The headers of the frame, or the data of the service, are invalid: for example, their
    /// lengths are inconsistent.
    Malformed(Error),
    /// The state flags are not those of a request, or the error in the AMS header is not 0.
    NoRequest(StateFlags),
    /// ReadDeviceInfo or ReadState is for a port other than those of GEO, SDA and COM.
    NoTask(AmsPort),
    /// The command must not have data, but the frame contains data.
    Data(Command),
    /// This program never sends the command, or sends it only as a malformed request.
    Never(Command),
    /// The request is an ADS sum command, which may contain writes.
    Sum(IndexGroup),
    /// The request accesses a program stream in an undocumented way: the only documented access is
    /// a write to the stream of a channel at the port of COM.
    Stream,
    /// The request is not a well-formed request of a documented function, so its effect is unknown.
    Unknown(operation::DispatchError),
    /// The function is documented for another port; for the write of an element, no entry of a file
    /// can allow the port of GEO.
    Port(AmsPort, Function),
    /// The function is a write, and the user gave no file of `--allow-write`.
    NoFile(Function, AmsNetId),
    /// The function is a write that no entry of the file allows.
    NoEntry(Function),
    /// The file is for another target.
    OtherTarget { allowed: AmsNetId, target: AmsNetId },
    /// The file is for another IP address, or the address of the connection is unknown.
    OtherAddress {
        allowed: Option<IpAddr>,
        /// The address of the connection, if known.
        address: Option<IpAddr>,
    },
    /// The file is for 127.0.0.1.1.1, the local machine, but the connection is to another machine,
    /// or its address is unknown.
    LocalNetId(Option<IpAddr>),
    /// The file expires at this time, which has passed or is too near.
    Expired(Moment),
    /// The name or the address is in the file, but the handle or the address may also belong to
    /// another value.
    Ambiguous(Function, Ambiguity),
    /// No file permits malformed requests to this target.
    NoMalformed(AmsNetId),
}

impl Reason {
    /// Whether another file of `--allow-write` might allow the request.
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

/// The reason why a write by a handle or an address may affect a value other than the allowed one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ambiguity {
    /// The device also uses the handle or the address for this other name.
    Shared(CncString),
    /// The device has several handles or addresses for this name.
    Several(CncString),
    /// Only one of the two required replies, HandleByName and a description, contained the handle
    /// for this name.
    Unconfirmed(CncString),
    /// The object with this name has an address of another channel or axis than that of the list.
    Elsewhere(CncString),
    /// The device returned more names than the gate can store.
    TooMuch,
}

impl fmt::Display for Ambiguity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shared(name) => {
                write!(f, "the device also uses it for {name}")
            }
            Self::Several(name) => write!(f, "the device has several for {name}"),
            Self::Unconfirmed(name) => {
                write!(f, "HandleByName and the description of {name} have not both returned it")
            }
            Self::Elsewhere(name) => {
                write!(f, "it belongs to another channel or axis than the list of {name}")
            }
            Self::TooMuch => {
                write!(f, "the device has more than the maximum of {OBSERVATIONS_MAX} names")
            }
        }
    }
}

/// The expiry that advice suggests for a new file: 24 hours from now.
fn tomorrow() -> Moment {
    Moment::now().after(Duration::from_secs(24 * 3600))
}

impl GateRejection {
    pub(super) const fn needing(reason: Reason, needed: Option<Entry>) -> Self {
        Self { reason, needed }
    }

    /// Advice on how to allow the frame, in one or more lines; empty if no advice is known.
    pub fn advice(&self) -> String {
        match (&self.reason, &self.needed) {
            (Reason::NoFile(_, target), Some(entry)) => format!(
                "If this is safe, allow it in a file for --allow-write:\n\n\
                 target = \"{target}\"\n\
                 expires = {}  # no writes from then on\n\n{entry}",
                tomorrow()
            ),
            (Reason::NoEntry(_), Some(entry)) => {
                format!("If this is safe, add to the file of --allow-write:\n\n{entry}")
            }
            (Reason::NoFile(..) | Reason::NoEntry(_), None) => {
                "Before a write by handle, the device must return the handle, both by HandleByName \
                 and in a description, for a name in the file of --allow-write."
                    .to_owned()
            }
            (Reason::OtherTarget { .. }, _) => {
                "Check that this is the right target, and write a file for it.".to_owned()
            }
            (Reason::OtherAddress { .. }, _) => {
                "Check that this is the right device, and its address in the file.".to_owned()
            }
            (Reason::LocalNetId(_), _) => {
                "Use the NetId that the router of the device shows in the file.".to_owned()
            }
            (Reason::NoMalformed(target), _) => format!(
                "If this is safe, add malformed = true to the file of --allow-write, above its first \
                 table. A new file needs these lines:\n\n\
                 target = \"{target}\"\n\
                 expires = {}  # no writes from then on\n\
                 malformed = true",
                tomorrow()
            ),
            (Reason::Ambiguous(Function::WriteObject, Ambiguity::Shared(_)), _) => {
                "An object that shares its address with another one cannot be written.".to_owned()
            }
            (Reason::Ambiguous(Function::WriteObject, _), _) => {
                "Use the group and offset of the object, also in the file.".to_owned()
            }
            (Reason::Ambiguous(..), _) => "Write the variable by its name instead.".to_owned(),
            (Reason::Expired(_), _) => "If this is safe, set a later time.".to_owned(),
            _ => String::new(),
        }
    }
}

impl From<Reason> for GateRejection {
    fn from(reason: Reason) -> Self {
        Self { reason, needed: None }
    }
}

impl fmt::Display for GateRejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |function: &Function| function.spec().name;
        match &self.reason {
            Reason::NoFrame => f.write_str("not exactly one complete frame"),
            Reason::Malformed(error) => write!(f, "malformed: {error}"),
            Reason::NoRequest(flags) => write!(f, "not a request: state flags {:#06x}", flags.0),
            Reason::NoTask(port) => write!(f, "no task of a CNC has port {port}"),
            Reason::Data(command) => write!(f, "command {} has no data", command.0),
            Reason::Never(command) => write!(f, "command {} is never sent", command.0),
            Reason::Sum(group) => {
                write!(f, "index group {group} is for sum commands, which may contain writes")
            }
            Reason::Stream => f.write_str("the effect on the program stream is not documented"),
            Reason::Unknown(rejection) => write!(f, "not a documented query: {rejection}"),
            Reason::Port(port, function) => {
                write!(f, "\"{}\" is not sent to port {port}", name(function))
            }
            Reason::NoFile(function, _) => {
                write!(f, "\"{}\" is not a query, and no file allows writes", name(function))
            }
            Reason::NoEntry(function) => write!(
                f,
                "\"{}\" is not a query, and no entry in the file of --allow-write allows it",
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
                "the file of --allow-write is for 127.0.0.1.1.1, which always means the local \
                 machine, but {} is another machine",
                address_text(address)
            ),
            Reason::Ambiguous(function, ambiguity) => write!(
                f,
                "\"{}\" may write a value that is not in the file of --allow-write: {ambiguity}",
                name(function)
            ),
            Reason::NoMalformed(target) => {
                write!(
                    f,
                    "no file of --allow-write permits malformed requests to {target} by \
                     malformed = true"
                )
            }
            Reason::Expired(moment) => {
                // A write is rejected before the expiry if its value could not be restored in time.
                let verb = if Moment::now() >= *moment { "expired" } else { "expires" };
                write!(f, "the file of --allow-write {verb} at {moment}")
            }
        }
    }
}

impl std::error::Error for GateRejection {}

fn address_text(address: &Option<IpAddr>) -> String {
    address.map_or_else(|| "one that is not known".to_owned(), |address| address.to_string())
}
