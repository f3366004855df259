//! The table of TCP connections: receives segments, emits frames with their location.

use std::collections::BTreeMap;

use ads_cnc::Error;

use super::endpoint::Endpoint;
use super::frames::{FramePiece, Frames, Span};
use super::link::TcpSegment;
use super::tcp::{DirectedSegment, DirectionState, Mark, ReassembledPiece};

/// Maximum number of connections that are followed at the same time; beyond that, the connection that
/// was idle for the longest time is ended.
pub(super) const CONNECTIONS_MAX: usize = 1024;

/// Maximum memory in bytes for incomplete frames and early segments of all connections.
pub(super) const BUFFERED_MAX: usize = 0x200_0000;

/// The TCP ports whose connections are judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ports {
    /// Connections from or to one of these ports.
    Of(Vec<u16>),
    /// All connections; those without an AMS frame are ignored.
    Any,
}

/// A direction of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct SegmentDirection {
    /// Number of the connection, from 1.
    pub(super) connection: u64,
    pub(super) from: Endpoint,
    pub(super) to: Endpoint,
}

#[derive(Debug)]
pub(super) enum ConnectionEvent {
    Frame(Vec<u8>, SegmentDirection, Span),
    Router,
    Broken(Error, Vec<u8>, SegmentDirection, Span),
    Cut(Vec<u8>, SegmentDirection, Span),
    /// Number of bytes that were not captured.
    Gap(u64, SegmentDirection, Mark),
    /// Number of bytes skipped to find the next frame.
    Skipped(usize),
    /// A connection whose beginning was not captured.
    Joined(u64),
    /// A conversation whose beginning was not captured, although every frame after the start of the
    /// capture was.
    Running(u64),
    /// A frame that was incomplete when the connection or the capture ended.
    Unfinished,
    /// The connection has ended.
    Ended(Ending),
}

/// The end of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ending {
    pub(super) connection: u64,
    pub(super) last: u64,
    /// The direction of which no segment was captured, not even an acknowledgement; `None` if the
    /// capture contains segments of both directions.
    pub(super) unseen: Option<SegmentDirection>,
}

#[derive(Debug)]
struct TcpConnection {
    number: u64,
    ends: [Endpoint; 2],
    halves: [DirectionState; 2],
    frames: [Frames; 2],
    /// Whether the connection is known to carry AMS: by its port, or because it contains a frame.
    is_ams: bool,
    /// Whether the beginning was captured.
    is_whole: bool,
    /// Whether [`ConnectionEvent::Joined`] must still be emitted.
    joined: bool,
    /// Number of the last segment of the connection, and number of its packet.
    last: u64,
    packet: u64,
}

#[derive(Debug)]
pub(super) struct ConnectionTable {
    ports: Ports,
    open: BTreeMap<(Endpoint, Endpoint), TcpConnection>,
    connections: u64,
    buffered: usize,
    segments: u64,
    pub(super) repeated: u64,
    pub(super) early: u64,
}

impl ConnectionTable {
    pub(super) const fn new(ports: Ports) -> Self {
        let open = BTreeMap::new();
        Self { ports, open, connections: 0, buffered: 0, segments: 0, repeated: 0, early: 0 }
    }

    pub(super) const fn connections(&self) -> u64 {
        self.connections
    }

    /// Whether early segments of the sender wait for missing bytes.
    pub(super) fn waits(&self, way: &SegmentDirection) -> bool {
        self.half(way).is_some_and(|half| half.memory_size() > 0)
    }

    /// Whether the bytes of the sender were captured up to this offset.
    pub(super) fn has(&self, way: &SegmentDirection, place: u64) -> bool {
        // Without TCP, the offset is always that of the last captured byte.
        matches!(way.from, Endpoint::Ams(..))
            || self.half(way).is_some_and(|half| half.is_seen() && half.offset() >= place)
    }

    fn half(&self, way: &SegmentDirection) -> Option<&DirectionState> {
        let connection = self.open.get(&key(way.from, way.to))?;
        connection.halves.get(connection.side(way.from))
    }

    /// Whether a segment is on one of the selected ports.
    pub(super) fn wants(&self, segment: &TcpSegment<'_>) -> bool {
        match &self.ports {
            Ports::Any => true,
            Ports::Of(ports) => {
                ports.contains(&segment.from.port()) || ports.contains(&segment.to.port())
            }
        }
    }

    pub(super) fn push(
        &mut self,
        segment: &TcpSegment<'_>,
        mark: Mark,
        out: &mut Vec<ConnectionEvent>,
    ) {
        self.segments = self.segments.saturating_add(1);
        let key = key(segment.from, segment.to);
        if segment.syn && self.open.get(&key).is_some_and(|known| !known.is_same(segment)) {
            self.end(key, out);
        }
        if !self.open.contains_key(&key) {
            // This is a FIN or an acknowledgement repeated after the end of the connection.
            if segment.payload.is_empty() && !segment.syn {
                return;
            }
            self.make_room(out);
            self.connections = self.connections.saturating_add(1);
            let ends = [segment.from, segment.to];
            let is_ams = self.ports != Ports::Any;
            self.open.insert(key, TcpConnection::new(self.connections, ends, is_ams));
        }
        let Some(connection) = self.open.get_mut(&key) else { return };
        connection.last = self.segments;
        let before = connection.memory_size();
        let events = out.len();
        connection.push(segment, mark, self.ports == Ports::Any, out);
        self.buffered =
            self.buffered.saturating_sub(before).saturating_add(connection.memory_size());
        let over = segment.rst || connection.halves.iter().all(DirectionState::is_over);
        if connection.is_ams && std::mem::take(&mut connection.joined) {
            out.insert(events, ConnectionEvent::Joined(connection.number));
        }
        // The acknowledgement of the last FIN arrives after the connection was removed.
        if over || self.buffered > BUFFERED_MAX {
            self.end(key, out);
        } else if !connection.is_ams {
            // Before the first AMS frame, emit no events and treat a gap as a missing beginning.
            let lost =
                out.iter().skip(events).any(|event| matches!(event, ConnectionEvent::Gap(..)));
            connection.joined |= lost && std::mem::take(&mut connection.is_whole);
            out.truncate(events);
        }
    }

    fn make_room(&mut self, out: &mut Vec<ConnectionEvent>) {
        if self.open.len() < CONNECTIONS_MAX {
            return;
        }
        let oldest = self.open.iter().min_by_key(|(_, one)| one.last).map(|(key, _)| *key);
        if let Some(key) = oldest {
            self.end(key, out);
        }
    }

    fn end(&mut self, key: (Endpoint, Endpoint), out: &mut Vec<ConnectionEvent>) {
        let Some(mut connection) = self.open.remove(&key) else { return };
        self.buffered = self.buffered.saturating_sub(connection.memory_size());
        let events = out.len();
        connection.finish(out);
        if !connection.is_ams {
            out.truncate(events);
        }
        for half in &connection.halves {
            self.repeated = self.repeated.saturating_add(half.repeated);
            self.early = self.early.saturating_add(half.early);
        }
    }

    /// Ends all connections.
    pub(super) fn finish(&mut self, out: &mut Vec<ConnectionEvent>) {
        while let Some((&key, _)) = self.open.first_key_value() {
            self.end(key, out);
        }
    }
}

fn key(one: Endpoint, other: Endpoint) -> (Endpoint, Endpoint) {
    if one <= other { (one, other) } else { (other, one) }
}

impl TcpConnection {
    fn new(number: u64, ends: [Endpoint; 2], is_ams: bool) -> Self {
        Self {
            number,
            ends,
            halves: Default::default(),
            frames: Default::default(),
            is_ams,
            is_whole: true,
            joined: false,
            last: 0,
            packet: 0,
        }
    }

    fn memory_size(&self) -> usize {
        let halves = self.halves.iter().map(DirectionState::memory_size);
        halves.chain(self.frames.iter().map(Frames::memory_size)).fold(0, usize::saturating_add)
    }

    fn side(&self, from: Endpoint) -> usize {
        usize::from(self.ends.first() != Some(&from))
    }

    /// Whether a SYN belongs to this connection: it is a retransmitted SYN, or the SYN of the other
    /// side.
    fn is_same(&self, segment: &TcpSegment<'_>) -> bool {
        let half = self.halves.get(self.side(segment.from));
        half.is_none_or(|half| half.is_new() || half.begins_with(segment.sequence))
    }

    fn push(
        &mut self,
        segment: &TcpSegment<'_>,
        mark: Mark,
        any: bool,
        out: &mut Vec<ConnectionEvent>,
    ) {
        let side = self.side(segment.from);
        let other = 1_usize.saturating_sub(side);
        self.packet = self.packet.max(mark.packet);
        let acknowledged = segment.acknowledged.filter(|_| !segment.rst);
        let place = self.halves.get(other).zip(acknowledged);
        let mark = Mark { acknowledged: place.and_then(|(half, at)| half.offset_of(at)), ..mark };
        let Some(half) = self.halves.get_mut(side) else { return };
        let Some(frames) = self.frames.get_mut(side) else { return };
        if half.is_new() && !segment.syn && !segment.payload.is_empty() {
            frames.begin_anywhere();
            self.joined |= std::mem::take(&mut self.is_whole);
        } else if !half.is_seen() && any {
            frames.begin_anywhere();
        }
        let way = SegmentDirection { connection: self.number, from: segment.from, to: segment.to };
        let part = DirectedSegment {
            sequence: segment.sequence,
            syn: segment.syn,
            payload: segment.payload,
            missing: segment.missing,
            mark,
        };
        let is_ams = &mut self.is_ams;
        half.push(part, &mut |piece| feed(frames, piece, way, is_ams, out));
        if segment.fin {
            let length = segment.payload.len().saturating_add(segment.missing);
            let length = u32::try_from(length).unwrap_or(u32::MAX);
            half.end_at(segment.sequence.wrapping_add(length), mark);
        }
        if let (Some(other), Some(number)) = (self.halves.get_mut(other), acknowledged) {
            if self.is_whole {
                other.begin_at(number);
            }
            other.acknowledge(number, mark);
        }
    }

    /// Emits the waiting segments.
    fn finish(&mut self, out: &mut Vec<ConnectionEvent>) {
        let [one, other] = self.ends;
        for (side, (from, to)) in [(one, other), (other, one)].into_iter().enumerate() {
            let way = SegmentDirection { connection: self.number, from, to };
            let (Some(half), Some(frames)) = (self.halves.get_mut(side), self.frames.get_mut(side))
            else {
                continue;
            };
            let is_ams = &mut self.is_ams;
            half.flush(&mut |piece| feed(frames, piece, way, is_ams, out));
            frames.end(&mut |found| push_event(found, way, is_ams, out));
        }
        let (connection, last) = (self.number, self.packet);
        let mut ways = [(one, other), (other, one)].into_iter().zip(&self.halves);
        let unseen = ways.find(|(_, half)| !half.is_seen());
        let unseen = unseen.map(|((from, to), _)| SegmentDirection { connection, from, to });
        out.push(ConnectionEvent::Ended(Ending { connection, last, unseen }));
    }
}

fn feed(
    frames: &mut Frames,
    piece: ReassembledPiece<'_>,
    way: SegmentDirection,
    is_ams: &mut bool,
    out: &mut Vec<ConnectionEvent>,
) {
    match piece {
        ReassembledPiece::Data(bytes, mark) => {
            frames.push(bytes, mark, &mut |found| push_event(found, way, is_ams, out));
        }
        ReassembledPiece::Gap(length, mark) => {
            frames.gap(length, &mut |found| push_event(found, way, is_ams, out));
            out.push(ConnectionEvent::Gap(length, way, mark));
        }
    }
}

fn push_event(
    found: FramePiece,
    way: SegmentDirection,
    is_ams: &mut bool,
    out: &mut Vec<ConnectionEvent>,
) {
    *is_ams |= matches!(found, FramePiece::Frame(..));
    out.push(match found {
        FramePiece::Frame(frame, span) => ConnectionEvent::Frame(frame, way, span),
        FramePiece::Router => ConnectionEvent::Router,
        FramePiece::Broken(error, bytes, span) => ConnectionEvent::Broken(error, bytes, way, span),
        FramePiece::Cut(bytes, span) => ConnectionEvent::Cut(bytes, way, span),
        FramePiece::Skipped(length) => ConnectionEvent::Skipped(length),
        FramePiece::Unfinished => ConnectionEvent::Unfinished,
    });
}
