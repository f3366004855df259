//! Whom a client asks, and as whom.

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

/// Whom to ask, and as whom.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Where it listens.
    pub addr: SocketAddr,
    /// Its AMS NetId.
    pub net_id: AmsNetId,
    /// The NetId to ask as; a device answers only those it has a route to. Without one it is made
    /// of this machine's address towards the target, as most are: 192.0.2.7 is 192.0.2.7.1.1.
    pub source: Option<AmsNetId>,
    /// How long to wait for a connection and for an answer.
    pub timeout: Duration,
    /// The least time from one request to the next.
    pub pace: Duration,
}

impl Target {
    /// A target on this machine.
    pub const fn local(addr: SocketAddr, net_id: AmsNetId) -> Self {
        let (timeout, pace) = (Duration::from_secs(2), Duration::ZERO);
        Self { addr, net_id, source: None, timeout, pace }
    }
}

/// The NetId that goes with an address; on this machine itself another than the simulated CNC's.
pub(crate) const fn net_id_of(ip: IpAddr) -> AmsNetId {
    match ip {
        IpAddr::V4(ip) if !ip.is_loopback() => {
            let [a, b, c, d] = ip.octets();
            AmsNetId([a, b, c, d, 1, 1])
        }
        _ => AmsNetId([127, 0, 0, 1, 1, 2]),
    }
}
