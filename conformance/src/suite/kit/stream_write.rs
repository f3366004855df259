//! What came of a write to a stream.

use std::fmt;
use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::Ack;

use crate::judge::{Describe, Step};
use crate::suite::kit::{Probe, RawCall, with_reply};

/// The most bytes that the interface of a stream holds.
pub(crate) const HELD_MAX: usize = 4094;

/// How a write was answered. Which error number means that it is refused for now, and which that it
/// is for good, is documented nowhere: what they are taken for is assumed.
#[derive(Debug)]
pub(crate) struct StreamWrite {
    /// The error of either header; none if the write was taken.
    error: Option<AdsError>,
    answered: bool,
    shown: String,
}

impl StreamWrite {
    pub(crate) const fn is_taken(&self) -> bool {
        self.answered && self.error.is_none()
    }

    /// By an error: silence refuses nothing.
    pub(crate) const fn is_refused(&self) -> bool {
        self.answered && self.error.is_some()
    }

    /// What the error number is taken for.
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

/// How often what is refused is written again, where it has to be taken in the end.
const TRIES: usize = 8;

/// As [`send`], and again while it is refused: when a CNC is unable to accept new data is said
/// nowhere, so that room for them need not be all it takes. In silence nothing is repeated.
pub(crate) fn send_until_taken(
    probe: &mut Probe<'_>,
    channel: Channel,
    data: &[u8],
) -> Step<StreamWrite> {
    let mut sent = send(probe, channel, data)?;
    for _ in 1..TRIES {
        if !sent.is_refused() {
            break;
        }
        probe.target.client.wait(Duration::from_millis(1));
        sent = send(probe, channel, data)?;
    }
    Ok(sent)
}

/// Sends bytes to the stream as they are, whether a client may or not.
pub(crate) fn send(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<StreamWrite> {
    let lines = RawCall::new(WriteProgramStream::new(channel, b"\r\n"))?;
    let exchange = with_reply(probe.call(&lines.with(|call| call.data = data.to_vec()))?)?;
    let answer = exchange.answer();
    let errors = answer.map(|answer| [answer.ams_error, answer.result]);
    Ok(StreamWrite {
        error: errors.into_iter().flatten().find(|error| !error.is_ok()),
        answered: answer.is_some(),
        shown: exchange.result(),
    })
}
