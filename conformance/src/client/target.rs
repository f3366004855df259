//! The address of a target, the NetId from which requests are sent, the timeout and the pace.

use std::net::{IpAddr, SocketAddr};
use std::time::Duration;

use ads_cnc::ads::AmsNetId;

/// The address of a target, the NetId from which requests are sent, the timeout and the pace.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The IP address and TCP port of the target.
    pub addr: SocketAddr,
    /// The AMS NetId of the target.
    pub net_id: AmsNetId,
    /// The NetId from which requests are sent; a device replies only to a NetId for which it has a
    /// route. The default is the IPv4 address of this machine's interface to the target, with .1.1
    /// appended: 192.0.2.7.1.1 for 192.0.2.7. On loopback and over IPv6, it is 127.0.0.1.1.2. In a
    /// dry run, which has no connection, it is made from the address of the target.
    pub source: Option<AmsNetId>,
    /// How long to wait for a connection, and for each reply.
    pub timeout: Duration,
    /// The minimum time between the starts of two requests.
    pub pace: Duration,
}

impl Target {
    /// A target on this machine, with a timeout of 2 s and no minimum time between requests.
    pub const fn local(addr: SocketAddr, net_id: AmsNetId) -> Self {
        let (timeout, pace) = (Duration::from_secs(2), Duration::ZERO);
        Self { addr, net_id, source: None, timeout, pace }
    }
}

/// The usual NetId for an IP address: an IPv4 address with .1.1 appended. For loopback and IPv6, it
/// is 127.0.0.1.1.2; 127.0.0.1.1.1 is the NetId of the simulated CNC.
pub(crate) const fn net_id_of(ip: IpAddr) -> AmsNetId {
    match ip {
        IpAddr::V4(ip) if !ip.is_loopback() => {
            let [a, b, c, d] = ip.octets();
            AmsNetId([a, b, c, d, 1, 1])
        }
        _ => AmsNetId([127, 0, 0, 1, 1, 2]),
    }
}
