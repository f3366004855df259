//! Captured frames as evidence of checks.

use std::fmt::{self, Display};
use std::time::Duration;

use super::connection_event::Span;
use super::endpoint::Endpoint;
use super::time::Time;
use crate::evidence::Evidence;
use crate::exchange::Exchange;
use crate::rules::Observation;

/// The location of frames in a capture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Location {
    pub(super) from: Endpoint,
    pub(super) to: Endpoint,
    pub(super) request: Option<Span>,
    pub(super) reply: Option<Span>,
}

impl Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let packets = |f: &mut fmt::Formatter<'_>, span: Span| {
            match (span.first.packet, span.last.packet) {
                (first, last) if first == last => write!(f, "packet {first}")?,
                (first, last) => write!(f, "packets {first} to {last}")?,
            }
            span.last.time.map_or(Ok(()), |time| write!(f, " at {time}"))
        };
        if let Some(request) = self.request {
            packets(f, request)?;
        }
        if let Some(reply) = self.reply {
            f.write_str(if self.request.is_some() { ", answered in " } else { "" })?;
            packets(f, reply)?;
        }
        let is_known = self.request.or(self.reply).is_some();
        write!(f, "{}{} to {}", if is_known { ", " } else { "" }, self.from, self.to)
    }
}

/// The frames to which a check applies.
#[derive(Debug)]
pub(super) enum CapturedFrames<'e> {
    /// A request of a Read, Write or ReadWrite, with its reply or alone.
    Exchange(&'e Exchange, Location),
    /// Any other bytes: one frame that is not judged as an exchange, bytes that are not a whole
    /// frame, or no bytes for a gap or a direction that was not captured.
    Bytes(&'e [u8], Location),
}

impl Observation for CapturedFrames<'_> {
    fn time(&self) -> Option<Duration> {
        let (Self::Exchange(_, location) | Self::Bytes(_, location)) = self;
        location.request?.last.time.map(Time::since_1970)
    }

    fn evidence(&self) -> Evidence {
        match self {
            Self::Exchange(exchange, location) => {
                let evidence = Evidence::from(*exchange);
                // In `evidence.result`, a note about a truncation may follow the result.
                let words = exchange.result_in_words();
                let result = evidence.result.replacen(&exchange.result(), &words, 1);
                let call = format!("{}\n            {location}", evidence.call);
                Evidence { call, result, ..evidence }
            }
            Self::Bytes(bytes, location) => {
                Evidence { call: location.to_string(), sent: bytes.to_vec(), ..Evidence::default() }
            }
        }
    }
}
