//! The options of a server.

use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use crate::gate::NET_ID;

#[derive(Clone, Copy, Debug)]
pub struct ServerOptions {
    pub net_id: AmsNetId,
    /// Time without bytes, after a complete request, after which a connection is closed; `None` for
    /// no limit. If this time is shorter than `frame`, it replaces `frame`. Without a limit,
    /// vanished clients occupy connections.
    pub idle: Option<Duration>,
    /// Time without the first complete request, or with an incomplete request, after which a
    /// connection is closed; with `None`, `idle` is the limit. This limits the time for which
    /// clients that only connect, or send a part of a request, occupy connections. Between complete
    /// requests, only `idle` applies.
    pub frame: Option<Duration>,
}

impl ServerOptions {
    /// The default of `idle`: ten minutes, long enough for a user who enters requests by hand.
    pub const IDLE: Duration = Duration::from_secs(600);

    /// The default of `frame`: ten seconds, because clients usually send a whole frame at once.
    pub const FRAME: Duration = Duration::from_secs(10);
}

impl Default for ServerOptions {
    fn default() -> Self {
        Self { net_id: NET_ID, idle: Some(Self::IDLE), frame: Some(Self::FRAME) }
    }
}
