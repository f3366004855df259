//! The service and the task of an ADS request.

use core::fmt;

use crate::ads::{AmsPort, Command};

/// One of the three ADS services with which the functions of a CNC are called.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 5.
///
/// ```
/// use ads_cnc::ads::Command;
/// use ads_cnc::operation::{AdsService, Function};
///
/// assert_eq!(Function::CountObjects.spec().service, AdsService::Read);
/// assert_eq!(Function::WriteByName.spec().service.command(), Command::WRITE);
/// assert_eq!(AdsService::ReadWrite.to_string(), "ReadWrite");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum AdsService {
    /// ADS Read.
    Read,
    /// ADS Write.
    Write,
    /// ADS ReadWrite.
    ReadWrite,
}

impl AdsService {
    /// The AMS command of the service.
    pub const fn command(self) -> Command {
        match self {
            Self::Read => Command::READ,
            Self::Write => Command::WRITE,
            Self::ReadWrite => Command::READ_WRITE,
        }
    }
}

impl fmt::Display for AdsService {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self, f)
    }
}

/// A task of the CNC. Each task has its own AMS port (GEN-4).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 1.
///
/// ```
/// use ads_cnc::ads::AmsPort;
/// use ads_cnc::operation::Task;
///
/// assert_eq!(Task::Com.port(), AmsPort(553));
/// assert_eq!(Task::from_port(AmsPort(552)), Some(Task::Sda));
/// assert_eq!(Task::from_port(AmsPort(851)), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Task {
    /// Port 551.
    Geo,
    /// Port 552.
    Sda,
    /// Port 553.
    Com,
}

/// Displays the name of the task in the manual: `GEO`, `SDA` or `COM`.
impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Geo => "GEO",
            Self::Sda => "SDA",
            Self::Com => "COM",
        })
    }
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

    /// The task with this port; `None` if no task has this port.
    #[inline]
    pub fn from_port(port: AmsPort) -> Option<Self> {
        match port {
            AmsPort::GEO => Some(Self::Geo),
            AmsPort::SDA => Some(Self::Sda),
            AmsPort::COM => Some(Self::Com),
            _ => None,
        }
    }
}
