//! The errors of tools, with advice.

use std::fmt;
use std::io;

use ads_cnc::Error;
use ads_cnc::ads::{AdsError, AmsPort};
use ads_cnc::operation::Function;

use crate::client::{Client, Target};
use crate::exchange::{ExchangeError, meaning};
use crate::gate::Refusal;
use crate::judge::Exit;

/// Why a tool fails. The text includes advice.
#[derive(Debug)]
#[non_exhaustive]
pub enum ToolError {
    /// An invalid argument or file.
    Usage(String),
    /// The CNC does not have the requested value or function.
    Unable(String),
    /// No list of the CNC has an object or element of this name.
    Absent(String),
    /// An error of the system that is not to be expected.
    Internal(String),
    /// The gate rejected the request.
    Refused(Box<Refusal>),
    /// The gate allows requests that must not be sent to this target.
    Unsafe(String),
    /// A dry run that would need a reply to continue.
    NotSent,
    /// A limit of this tool, or its deadline, was reached.
    Enough(String),
    /// The request cannot be encoded.
    Unsendable(Error),
    /// No connection, or no reply.
    NoAnswer(String),
    /// An AMS error: the request did not reach a CNC.
    Ams {
        error: AdsError,
        /// Advice.
        hint: String,
    },
    /// An ADS error of the CNC.
    Ads {
        /// The function that was called.
        function: Function,
        error: AdsError,
    },
    /// The device does not answer an inquiry.
    Device {
        /// The name of the command: ReadDeviceInfo or ReadState.
        command: &'static str,
        error: AdsError,
    },
    /// The reply cannot be decoded.
    Reply(Error),
    /// The frame of the reply breaks a rule of AMS/TCP.
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
            Self::NoAnswer(_) | Self::Ams { .. } | Self::Enough(_) => Exit::Nothing,
            Self::Refused(_) | Self::Unsafe(_) => Exit::Refused,
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
        Self::Internal(format!("signals cannot be caught: {error}"))
    }

    pub(super) fn unreachable(target: &Target, error: &io::Error) -> Self {
        let addr = target.addr;
        Self::NoAnswer(match error.kind() {
            io::ErrorKind::ConnectionRefused => format!(
                "{addr} refuses the connection: nothing listens there. Does the ADS router of the \
                 device run, is this its TCP port (48898 as a rule), and does its firewall let it \
                 through?"
            ),
            io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock => format!(
                "{addr} does not answer within {} ms. Is the device on, is this its address, and \
                 does no firewall drop TCP port {}?",
                target.timeout.as_millis(),
                addr.port()
            ),
            io::ErrorKind::PermissionDenied => return Self::Unsafe(error.to_string()),
            _ => format!(
                "no connection to {addr}: {error}. Is it reachable, and does it listen for AMS/TCP?"
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
        Self::NoAnswer(match fault {
            ExchangeError::Refused(refusal) => return Self::Refused(refusal),
            ExchangeError::NotSent | ExchangeError::Unseen => return Self::NotSent,
            ExchangeError::Unsendable(error) => return Self::Unsendable(error),
            ExchangeError::Malformed(error) if answered => return Self::Reply(error),
            ExchangeError::Malformed(error) => {
                format!("{addr} does not speak AMS/TCP: {error}. Is this the port of ADS?")
            }
            ExchangeError::Closed | ExchangeError::Io(_) if answered => format!(
                "{addr} ended the connection: {fault}. Was the device restarted, or does another \
                 client use the AMS NetId {source}? Whether the last request was carried out is \
                 not known."
            ),
            ExchangeError::Closed | ExchangeError::Io(_) => format!(
                "{addr} closed the connection without an answer. A device does so with who has no \
                 route: add {route}. If there is one, end other ADS connections of this machine to \
                 it: some devices keep one for an address."
            ),
            ExchangeError::Silence(timeout) if answered => format!(
                "{addr} has stopped answering: nothing within {} ms. If it is busy, give it more \
                 with --timeout.",
                timeout.as_millis()
            ),
            ExchangeError::Silence(timeout) => format!(
                "{addr} takes the connection and does not answer within {} ms. Is {net_id} its AMS \
                 NetId, and is there {route}?",
                timeout.as_millis()
            ),
            ExchangeError::Disconnected(error) => {
                format!("no connection to {addr} any more: {error}.")
            }
        })
    }

    pub(super) fn ams(target: &Target, port: AmsPort, error: AdsError) -> Self {
        let Target { addr, net_id, .. } = target;
        let hint = match error {
            AdsError::TARGET_PORT_NOT_FOUND => format!(
                "Nothing runs at the AMS port {port} of {net_id}: is a CNC configured there, and in \
                 RUN?"
            ),
            AdsError::TARGET_MACHINE_NOT_FOUND => {
                format!("{addr} knows no AMS NetId {net_id}: is it the device's (--net-id)?")
            }
            _ => format!("{addr} did not hand the request on to the AMS port {port} of {net_id}."),
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
            | Self::NoAnswer(why) => f.write_str(why),
            Self::Refused(refusal) => {
                write!(f, "not sent, rejected for safety: {refusal}")?;
                match refusal.advice() {
                    advice if advice.is_empty() => Ok(()),
                    advice => write!(f, "\n{advice}"),
                }
            }
            Self::NotSent => f.write_str("a dry run: what follows would depend on the answer"),
            Self::Unsendable(error) => write!(f, "cannot be sent: {error}"),
            Self::Ams { error, hint } => write!(f, "AMS error {error:#x}. {hint}"),
            Self::Ads { function, error } => {
                write!(f, "the CNC refuses \"{}\" with {error:#x}", function.spec().name)?;
                match meaning(*error) {
                    Some(meaning) => write!(f, ": {meaning}"),
                    None => Ok(()),
                }
            }
            Self::Device { command, error } => {
                write!(f, "the device refuses {command} with {error:#x}")
            }
            Self::Reply(error) => does_not_match(f, error),
            Self::Frame(what) => does_not_match(f, what),
        }
    }
}

fn does_not_match(f: &mut fmt::Formatter<'_>, what: &dyn fmt::Display) -> fmt::Result {
    write!(f, "the reply does not match the manuals: {what}. ads-cnc run judges the device")
}

impl std::error::Error for ToolError {}
