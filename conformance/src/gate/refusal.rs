//! Why a frame does not pass, and what would let it.

use std::fmt;

use ads_cnc::Error;
use ads_cnc::address::IndexGroup;
use ads_cnc::ads::{AmsNetId, AmsPort, Command, StateFlags};
use ads_cnc::operation::{self, Function};

use super::{Entry, Moment};

/// A frame the gate did not let through.
#[derive(Clone, Debug)]
pub struct Refusal {
    /// Why.
    pub reason: Reason,
    /// The entry that would allow it, if there is one.
    pub needed: Option<Entry>,
}

/// Why a frame does not pass.
#[derive(Clone, Debug)]
pub enum Reason {
    /// Not one whole frame.
    NoFrame,
    /// The frame or the service's part of it does not hold together.
    Malformed(Error),
    /// No request, by its state flags.
    NoRequest(StateFlags),
    /// No task has this port.
    NoTask(AmsPort),
    /// Data behind a command that has none.
    Data(Command),
    /// A command that nothing here sends.
    Never(Command),
    /// Several requests in one, which may write.
    Sum(IndexGroup),
    /// The program stream, other than by a write to a channel's: what that does nobody documents.
    Stream,
    /// No function of the table takes this: it might be anything.
    Unknown(operation::Refusal),
    /// The function is documented for another port, or changes something at GEO, which no entry is
    /// about.
    Port(AmsPort, Function),
    /// The function changes something, and no file allows anything.
    NoFile(Function, AmsNetId),
    /// The function changes something that the file does not name.
    NoEntry(Function),
    /// The file is about another target.
    OtherTarget {
        /// The one it allows.
        allowed: AmsNetId,
        /// The one asked for.
        target: AmsNetId,
    },
    /// The file was good until then.
    Expired(Moment),
}

impl Refusal {
    pub(super) const fn needing(reason: Reason, needed: Option<Entry>) -> Self {
        Self { reason, needed }
    }

    /// What to do about it, over several lines; empty if nothing can be done.
    pub fn advice(&self) -> String {
        match (&self.reason, &self.needed) {
            (Reason::NoFile(_, target), Some(entry)) => format!(
                "If nothing can come to harm, allow it in a file for --allow-write:\n\n\
                 target = \"{target}\"\n\
                 expires = …  # a date and time such as 2026-05-04T17:30:00+02:00\n\n{entry}"
            ),
            (Reason::NoEntry(_), Some(entry)) => {
                format!("If nothing can come to harm, add to the file of --allow-write:\n\n{entry}")
            }
            (Reason::NoFile(..) | Reason::NoEntry(_), None) => {
                "A handle can be written after this session has asked for it by a name that the \
                 file of --allow-write has."
                    .to_owned()
            }
            (Reason::OtherTarget { .. }, _) => {
                "Write a file for this target; see that it is the right one.".to_owned()
            }
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
                    "\"{}\" is no query, and nothing is allowed to be written",
                    name(function)
                )
            }
            Reason::NoEntry(function) => write!(
                f,
                "\"{}\" is no query, and the file of --allow-write does not name this",
                name(function)
            ),
            Reason::OtherTarget { allowed, target } => {
                write!(f, "the file of --allow-write is for {allowed}, not for {target}")
            }
            Reason::Expired(moment) => {
                write!(f, "the file of --allow-write was good until {moment}")
            }
        }
    }
}

impl std::error::Error for Refusal {}
