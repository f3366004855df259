//! The sender or receiver of captured bytes.

use std::fmt;
use std::net::SocketAddr;

use ads_cnc::ads::{AmsAddr, AmsNetId, AmsPort};

/// One end of a conversation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Endpoint {
    /// An end of a TCP connection.
    Tcp(SocketAddr),
    /// A sender or receiver of AMS frames that were captured without TCP, in EtherCAT frames.
    Ams(AmsNetId, u16),
}

impl Endpoint {
    /// The TCP port, or the AMS port.
    pub const fn port(&self) -> u16 {
        match self {
            Self::Tcp(addr) => addr.port(),
            Self::Ams(_, port) => *port,
        }
    }
}

impl From<AmsAddr> for Endpoint {
    fn from(addr: AmsAddr) -> Self {
        Self::Ams(addr.net_id, addr.port.0)
    }
}

impl fmt::Display for Endpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Tcp(addr) => addr.fmt(f),
            Self::Ams(net_id, port) => AmsAddr { net_id, port: AmsPort(port) }.fmt(f),
        }
    }
}
