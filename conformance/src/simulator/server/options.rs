//! How a server of the simulated CNC is set up.

use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use crate::gate::NET_ID;

#[derive(Clone, Copy, Debug)]
pub struct ServerOptions {
    /// The AMS NetId it answers for.
    pub net_id: AmsNetId,
    /// How long a connection may be without a whole request before it is ended; for ever if none.
    /// Clients that are gone without a word would take the places of others.
    pub idle: Option<Duration>,
    /// How long a new connection may be without its first whole request, and any connection with a
    /// part of one; for ever if none. Clients that open connections only, or leave requests half
    /// sent, lock others out no longer than that. Clients that have sent a request may, for `idle`,
    /// and those that read slowly, for as long as they read.
    pub frame: Option<Duration>,
}

impl ServerOptions {
    /// Ten minutes without a request: people who wait for the next have come back by then.
    pub const IDLE: Duration = Duration::from_secs(600);

    /// Ten seconds for a frame, and for the first: a frame is one write of its client.
    pub const FRAME: Duration = Duration::from_secs(10);
}

impl Default for ServerOptions {
    fn default() -> Self {
        Self { net_id: NET_ID, idle: Some(Self::IDLE), frame: Some(Self::FRAME) }
    }
}
