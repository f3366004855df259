//! The errors of commands, some with advice for the user.

use std::fmt;
use std::io;

use ads_cnc::Error;
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::Function;

use crate::client::{Client, Target};
use crate::exchange::{ExchangeError, meaning};
use crate::exit::Exit;
use crate::gate::GateRejection;

/// The error that ends a command. Some of the texts include advice for the user.
#[derive(Debug)]
#[non_exhaustive]
pub enum ToolError {
    /// Wrong usage, for example an invalid argument or file, or an ambiguous name.
    Usage(String),
    /// The command cannot read or write this value, for example because the CNC describes it as
    /// read-only.
    Unable(String),
    /// None of the searched lists has an object or element of this name.
    Absent(String),
    /// An unexpected error of the system.
    Internal(String),
    /// The gate rejected the request.
    NotPermitted(Box<GateRejection>),
    /// The gate allows requests that must not be sent to this target, or the system denied the
    /// connection.
    Unsafe(String),
    /// A dry run cannot continue without a reply.
    NotSent,
    /// A limit of the command, or its deadline, was reached.
    Enough(String),
    /// The request cannot be encoded.
    Unsendable(Error),
    /// No connection, or no reply over AMS/TCP.
    NoReply(String),
    /// An error in the AMS header, for example because the request did not reach a CNC.
    Ams {
        error: AdsError,
        /// The likely cause, with advice if possible.
        hint: String,
    },
    /// An ADS error of the CNC.
    Ads {
        /// The function that was called.
        function: Function,
        error: AdsError,
    },
    /// The device rejects ReadDeviceInfo or ReadState.
    Device {
        /// The name of the command: ReadDeviceInfo or ReadState.
        command: &'static str,
        error: AdsError,
    },
    /// The reply cannot be decoded.
    Reply(Error),
    /// The reply has another invoke ID than the request.
    Frame(String),
}

impl ToolError {
    /// The exit code.
    pub const fn exit(&self) -> Exit {
        match self {
            Self::NotSent => Exit::Success,
            Self::Ads { .. }
            | Self::Device { .. }
            | Self::Reply(_)
            | Self::Frame(_)
            | Self::Unable(_)
            | Self::Absent(_) => Exit::Failure,
            Self::Usage(_) | Self::Unsendable(_) => Exit::Usage,
            Self::NoReply(_) | Self::Ams { .. } | Self::Enough(_) => Exit::Nothing,
            Self::NotPermitted(_) | Self::Unsafe(_) => Exit::NotPermitted,
            Self::Internal(_) => Exit::Internal,
        }
    }

    /// The ADS error number, if the CNC returned one.
    pub const fn ads_error(&self) -> Option<AdsError> {
        match self {
            Self::Ads { error, .. } | Self::Device { error, .. } => Some(*error),
            _ => None,
        }
    }

    /// The error for signals that cannot be caught.
    pub(crate) fn uncaught(error: &io::Error) -> Self {
        Self::Internal(format!("cannot catch signals: {error}"))
    }

    pub(super) fn unreachable(target: &Target, error: &io::Error) -> Self {
        let addr = target.addr;
        Self::NoReply(match error.kind() {
            io::ErrorKind::ConnectionRefused => format!(
                "{addr} refuses the connection: no program is listening. Check that the ADS router \
                 of the device is running, that the TCP port is right (usually 48898), and that the \
                 firewall allows it"
            ),
            io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock => format!(
                "no reply from {addr} within {} ms. Check that the device is on, that the address \
                 is right, and that no firewall drops TCP port {}",
                target.timeout.as_millis(),
                addr.port()
            ),
            io::ErrorKind::PermissionDenied => return Self::Unsafe(error.to_string()),
            _ => format!(
                "no connection to {addr}: {error}. Check that the device is reachable and listens \
                 for AMS/TCP"
            ),
        })
    }

    pub(super) fn fault(client: &Client, fault: ExchangeError, answered: bool) -> Self {
        let Target { addr, net_id, .. } = client.target();
        let source = client.source();
        let route = format!(
            "a route on the device to the AMS NetId {source} (--source-net-id), at the address of \
             this machine, by TCP/IP"
        );
        Self::NoReply(match fault {
            ExchangeError::NotPermitted(rejection) => return Self::NotPermitted(rejection),
            ExchangeError::NotSent | ExchangeError::Unseen => return Self::NotSent,
            ExchangeError::Unsendable(error) => return Self::Unsendable(error),
            ExchangeError::Malformed(error) if answered => return Self::Reply(error),
            ExchangeError::Malformed(error) => {
                format!("{addr} does not use AMS/TCP: {error}. Check that this is the ADS port")
            }
            ExchangeError::Closed | ExchangeError::Io(_) if answered => format!(
                "{addr} ended the connection: {fault}. Check whether the device was restarted, or \
                 another client uses the AMS NetId {source}. It is unknown whether the last request \
                 was executed."
            ),
            ExchangeError::Closed | ExchangeError::Io(_) => format!(
                "{addr} closed the connection without a reply, as a device does if a client has no \
                 route: add {route}. If the route exists, end other ADS connections of this machine \
                 to the device: some devices allow only one per address."
            ),
            ExchangeError::Silence(timeout) if answered => format!(
                "{addr} has stopped replying: nothing within {} ms. If the device is busy, increase \
                 --timeout.",
                timeout.as_millis()
            ),
            ExchangeError::Silence(timeout) => format!(
                "{addr} accepts the connection but does not reply within {} ms. Check that {net_id} \
                 is its AMS NetId, and that there is {route}",
                timeout.as_millis()
            ),
            ExchangeError::Disconnected(error) => {
                format!("lost the connection to {addr}: {error}.")
            }
        })
    }

    pub(super) fn ams(target: &Target, port: AmsPort, error: AdsError) -> Self {
        let Target { addr, net_id, .. } = target;
        let hint = match error {
            AdsError::TARGET_PORT_NOT_FOUND => format!(
                "The AMS port {port} of {net_id} does not exist: check that a CNC is configured and \
                 in the state RUN."
            ),
            AdsError::TARGET_MACHINE_NOT_FOUND => {
                format!("{addr} does not know the AMS NetId {net_id}: check --net-id.")
            }
            _ => format!("{addr} did not forward the request to the AMS port {port} of {net_id}."),
        };
        Self::Ams { error, hint }
    }
}

impl fmt::Display for ToolError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(why)
            | Self::Unsafe(why)
            | Self::Unable(why)
            | Self::Absent(why)
            | Self::Internal(why)
            | Self::Enough(why)
            | Self::NoReply(why) => f.write_str(why),
            Self::NotPermitted(rejection) => {
                write!(f, "not sent, rejected for safety: {rejection}")?;
                match rejection.advice() {
                    advice if advice.is_empty() => Ok(()),
                    advice => write!(f, "\n{advice}"),
                }
            }
            Self::NotSent => f.write_str("dry run: the next requests depend on this reply"),
            Self::Unsendable(error) => write!(f, "cannot be sent: {error}"),
            Self::Ams { error, hint } => write!(f, "AMS error {error:#x}. {hint}"),
            Self::Ads { function, error } => {
                write!(f, "the CNC rejects \"{}\" with {error:#x}", function.spec().name)?;
                match meaning(*error) {
                    Some(meaning) => write!(f, ": {meaning}"),
                    None => Ok(()),
                }
            }
            Self::Device { command, error } => {
                write!(f, "the device rejects {command} with {error:#x}")
            }
            Self::Reply(error) => does_not_match(f, error),
            Self::Frame(what) => does_not_match(f, what),
        }
    }
}

fn does_not_match(f: &mut fmt::Formatter<'_>, what: &dyn fmt::Display) -> fmt::Result {
    write!(f, "the reply does not match the manuals: {what}. Use ads-cnc run to judge the device")
}

impl std::error::Error for ToolError {}
