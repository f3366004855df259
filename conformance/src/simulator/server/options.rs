//! How a server of the simulated CNC is set up.

use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use crate::gate::NET_ID;

#[derive(Clone, Copy, Debug)]
pub struct ServerOptions {
    pub net_id: AmsNetId,
    /// Time without a complete request after which a connection is closed; `None` for no limit.
    /// Otherwise vanished clients would block connections.
    pub idle: Option<Duration>,
    /// Time without the first complete request, or with an incomplete request, after which a
    /// connection is closed; `None` for no limit. Clients that only connect, or send half a
    /// request, do not block others for longer. Clients that have sent a request are subject to
    /// `idle`, and those that read slowly may do so.
    pub frame: Option<Duration>,
}

impl ServerOptions {
    /// Ten minutes: long enough for a user who enters requests by hand.
    pub const IDLE: Duration = Duration::from_secs(600);

    /// Ten seconds: a client writes a frame at once.
    pub const FRAME: Duration = Duration::from_secs(10);
}

impl Default for ServerOptions {
    fn default() -> Self {
        Self { net_id: NET_ID, idle: Some(Self::IDLE), frame: Some(Self::FRAME) }
    }
}
