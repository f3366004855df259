//! The options of a server.

use std::time::Duration;

use ads_cnc::ads::AmsNetId;

use crate::gate::NET_ID;

#[derive(Clone, Copy, Debug)]
pub struct ServerOptions {
    pub net_id: AmsNetId,
    /// A connection is closed after this time without bytes that follow a complete request; `None`
    /// for no limit. If this time is shorter than `frame`, it replaces `frame`. Without a limit,
    /// vanished clients occupy connections.
    pub idle: Option<Duration>,
    /// A connection is closed if its first request, or a request that has begun, is not complete
    /// after this time; with `None`, `idle` is the limit. So clients that only connect, or send a
    /// part of a request, occupy a connection only for this time. Between complete requests, only
    /// `idle` applies.
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
