//! What an ADS request is sent with and to: service and task.

use core::fmt;

use crate::ads::{AmsPort, Command};

/// An ADS service.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Service {
    /// ADS Read.
    Read,
    /// ADS Write.
    Write,
    /// ADS ReadWrite.
    ReadWrite,
}

impl Service {
    /// The AMS command that carries it.
    pub const fn command(self) -> Command {
        match self {
            Self::Read => Command::READ,
            Self::Write => Command::WRITE,
            Self::ReadWrite => Command::READ_WRITE,
        }
    }
}

impl fmt::Display for Service {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// A task of the CNC, each with its AMS port (GEN-4).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Task {
    /// Port 551.
    Geo,
    /// Port 552.
    Sda,
    /// Port 553.
    Com,
}

impl Task {
    /// The task's port.
    pub const fn port(self) -> AmsPort {
        match self {
            Self::Geo => AmsPort::GEO,
            Self::Sda => AmsPort::SDA,
            Self::Com => AmsPort::COM,
        }
    }

    /// The task behind a port.
    pub fn from_port(port: AmsPort) -> Option<Self> {
        [Self::Geo, Self::Sda, Self::Com].into_iter().find(|task| task.port() == port)
    }
}
