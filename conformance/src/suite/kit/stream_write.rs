//! The result of a write to a program stream.

use std::fmt;

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::Ack;

use crate::evidence::Describe;
use crate::judge::Step;
use crate::suite::kit::{Probe, RawCall, with_reply};

/// The reply to a write to a program stream. No manual states which error numbers mean a temporary
/// and which a permanent rejection, so the meaning of the error numbers is assumed.
#[derive(Debug)]
pub(crate) struct StreamWrite {
    /// The error of the AMS header or of the service; `None` if the write was accepted.
    error: Option<AdsError>,
    shown: String,
}

impl StreamWrite {
    pub(crate) const fn is_taken(&self) -> bool {
        self.error.is_none()
    }

    /// Whether the write was rejected with an error.
    pub(crate) const fn is_rejected(&self) -> bool {
        self.error.is_some()
    }

    /// The assumed meaning of the error number.
    pub(crate) fn assumed(&self) -> Ack {
        self.error.map_or(Ack::Accepted, Ack::from_result)
    }
}

impl Describe for &StreamWrite {
    fn describe(self) -> String {
        self.to_string()
    }
}

impl fmt::Display for StreamWrite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.shown)
    }
}

/// Sends bytes to the program stream, valid or not. Without a valid reply, the case is
/// inconclusive.
pub(crate) fn send(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<StreamWrite> {
    let lines = RawCall::new(WriteProgramStream::new(channel, b"\r\n"))?;
    let exchange = with_reply(probe.call(&lines.with(|call| call.data = data.to_vec()))?)?;
    let errors = exchange.reply().map(|reply| [reply.ams_error, reply.result]);
    Ok(StreamWrite {
        error: errors.into_iter().flatten().find(|error| !error.is_ok()),
        shown: exchange.result(),
    })
}
