//! The result of a write to a program stream.

use std::fmt;

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::Ack;

use crate::evidence::Describe;
use crate::judge::Step;
use crate::suite::kit::{Probe, RawCall, with_reply};

/// The reply to a write. Which error numbers mean "busy" and "rejected" is not documented; their
/// meaning is assumed.
#[derive(Debug)]
pub(crate) struct StreamWrite {
    /// The error of the AMS header or of the service; `None` if the write was accepted.
    error: Option<AdsError>,
    answered: bool,
    shown: String,
}

impl StreamWrite {
    pub(crate) const fn is_taken(&self) -> bool {
        self.answered && self.error.is_none()
    }

    /// Whether the write was rejected with an error; a missing reply is not a rejection.
    pub(crate) const fn is_refused(&self) -> bool {
        self.answered && self.error.is_some()
    }

    /// The assumed meaning of the error number.
    pub(crate) fn assumed(&self) -> Ack {
        match self.error {
            Some(error) => Ack::from_result(error),
            None if self.answered => Ack::Accepted,
            None => Ack::Rejected,
        }
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

/// Sends bytes to the program stream, valid or not.
pub(crate) fn send(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<StreamWrite> {
    let lines = RawCall::new(WriteProgramStream::new(channel, b"\r\n"))?;
    let exchange = with_reply(probe.call(&lines.with(|call| call.data = data.to_vec()))?)?;
    let reply = exchange.reply();
    let errors = reply.map(|reply| [reply.ams_error, reply.result]);
    Ok(StreamWrite {
        error: errors.into_iter().flatten().find(|error| !error.is_ok()),
        answered: reply.is_some(),
        shown: exchange.result(),
    })
}
