//! The events of a captured connection: its frames, gaps and end.

use ads_cnc::Error;

use super::endpoint::Endpoint;
use super::tcp::CapturePosition;

/// A direction of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct SegmentDirection {
    /// Number of the connection: from 1 for TCP, much larger without TCP.
    pub(super) connection: u64,
    pub(super) from: Endpoint,
    pub(super) to: Endpoint,
}

/// The location of a frame in the capture: its first and last packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) first: CapturePosition,
    pub(super) last: CapturePosition,
    /// Offset of the byte after the frame, from the beginning of its direction of the connection.
    pub(super) end: u64,
}

#[derive(Debug)]
pub(super) enum ConnectionEvent {
    /// A whole frame.
    Frame(Vec<u8>, SegmentDirection, Span),
    /// Number of consecutive messages between a client and its local router.
    Router(u64),
    /// The first bytes of data that is not a frame, although a frame must begin there.
    Broken(Error, Vec<u8>, SegmentDirection, Span),
    /// The beginning of a frame whose rest was not captured.
    Cut(Vec<u8>, SegmentDirection, Span),
    /// Number of bytes that were not captured; 0 if unknown.
    Gap(u64, SegmentDirection, CapturePosition),
    /// Number of bytes that were skipped to find the next frame.
    Skipped(usize),
    /// The number of a connection whose beginning was not captured.
    Joined(u64),
    /// The number of a conversation without TCP. Frames before the start of the capture may be
    /// missing, but no later ones.
    Running(u64),
    /// A frame that was incomplete when the connection or the capture ended.
    Unfinished,
    /// The connection has ended.
    Ended(ConnectionEnd),
}

/// The end of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConnectionEnd {
    pub(super) connection: u64,
    /// Number of the last packet of the connection.
    pub(super) last: u64,
    /// The direction of which no segment was captured, not even an acknowledgement (without TCP, no
    /// frame); `None` if the capture contains both directions.
    pub(super) unseen: Option<SegmentDirection>,
}
