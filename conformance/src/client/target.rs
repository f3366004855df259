//! The address of a target, and the address requests come from.

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

/// The address of a target, and the address requests come from.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// TCP address.
    pub addr: SocketAddr,
    /// AMS NetId.
    pub net_id: AmsNetId,
    /// The NetId requests come from; a device replies only to those it has a route to. By default
    /// it is this machine's address towards the target with .1.1 appended, as is usual:
    /// 192.0.2.7.1.1 for 192.0.2.7.
    pub source: Option<AmsNetId>,
    /// How long to wait for a connection and for an answer.
    pub timeout: Duration,
    /// The minimum time between two requests.
    pub pace: Duration,
}

impl Target {
    /// A target on this machine.
    pub const fn local(addr: SocketAddr, net_id: AmsNetId) -> Self {
        let (timeout, pace) = (Duration::from_secs(2), Duration::ZERO);
        Self { addr, net_id, source: None, timeout, pace }
    }
}

/// The usual NetId for an IP address. For loopback it differs from the simulated CNC's.
pub(crate) const fn net_id_of(ip: IpAddr) -> AmsNetId {
    match ip {
        IpAddr::V4(ip) if !ip.is_loopback() => {
            let [a, b, c, d] = ip.octets();
            AmsNetId([a, b, c, d, 1, 1])
        }
        _ => AmsNetId([127, 0, 0, 1, 1, 2]),
    }
}
