//! The table of TCP connections, which receives segments, and emits frames with their location in
//! the capture.

use std::collections::BTreeMap;

use super::connection_event::{ConnectionEnd, ConnectionEvent, SegmentDirection};
use super::endpoint::Endpoint;
use super::frames::Frames;
use super::link::TcpSegment;
use super::tcp::{CapturePosition, DirectionState, ReassembledPiece};
use crate::number::to_u32;

/// Maximum number of TCP connections, and of conversations without TCP, that are followed at the
/// same time; beyond that, the one that was idle for the longest time is ended.
pub(super) const CONNECTIONS_MAX: usize = 1024;

/// Maximum memory in bytes for incomplete frames and early segments of all TCP connections; beyond
/// that, the connection of the current segment is ended.
pub(super) const BUFFERED_MAX: usize = 0x200_0000;

/// The TCP ports whose connections are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ports {
    /// Connections from or to one of these ports.
    Of(Vec<u16>),
    /// All connections; those without an AMS frame are only counted.
    Any,
}

#[derive(Debug)]
struct TcpConnection {
    number: u64,
    ends: [Endpoint; 2],
    direction_states: [DirectionState; 2],
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
    /// The keys of `open` by the number of the last segment of the connection.
    idle: BTreeMap<u64, (Endpoint, Endpoint)>,
    connections: u64,
    buffered: usize,
    segments: u64,
    pub(super) repeated: u64,
    pub(super) early: u64,
}

impl ConnectionTable {
    pub(super) const fn new(ports: Ports) -> Self {
        Self {
            ports,
            open: BTreeMap::new(),
            idle: BTreeMap::new(),
            connections: 0,
            buffered: 0,
            segments: 0,
            repeated: 0,
            early: 0,
        }
    }

    pub(super) const fn connections(&self) -> u64 {
        self.connections
    }

    /// Whether early segments of the sender wait for missing bytes.
    pub(super) fn waits(&self, direction: &SegmentDirection) -> bool {
        self.direction_state(direction)
            .is_some_and(|direction_state| direction_state.memory_size() > 0)
    }

    /// Whether the bytes of the sender were emitted, or counted as gaps, up to this offset.
    pub(super) fn has(&self, direction: &SegmentDirection, place: u64) -> bool {
        // Without TCP, the offset is always that of the last captured byte.
        matches!(direction.from, Endpoint::Ams(..))
            || self.direction_state(direction).is_some_and(|direction_state| {
                direction_state.is_seen() && direction_state.offset() >= place
            })
    }

    fn direction_state(&self, direction: &SegmentDirection) -> Option<&DirectionState> {
        let connection = self.open.get(&key(direction.from, direction.to))?;
        connection.direction_states.get(connection.side(direction.from))
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
        mark: CapturePosition,
        out: &mut Vec<ConnectionEvent>,
    ) {
        self.segments = self.segments.saturating_add(1);
        let key = key(segment.from, segment.to);
        if segment.syn && self.open.get(&key).is_some_and(|known| !known.is_same(segment)) {
            self.end(key, out);
        }
        if !self.open.contains_key(&key) {
            // A segment without data and without SYN does not open a connection: it may be an
            // acknowledgement or a FIN that follows the end of a connection.
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
        self.idle.remove(&connection.last);
        connection.last = self.segments;
        self.idle.insert(connection.last, key);
        let before = connection.memory_size();
        let events = out.len();
        connection.push(segment, mark, self.ports == Ports::Any, out);
        connection.is_ams |= out.iter().skip(events).any(is_frame);
        self.buffered =
            self.buffered.saturating_sub(before).saturating_add(connection.memory_size());
        let over = segment.rst || connection.direction_states.iter().all(DirectionState::is_over);
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
        if let Some((_, &key)) = self.idle.first_key_value() {
            self.end(key, out);
        }
    }

    fn end(&mut self, key: (Endpoint, Endpoint), out: &mut Vec<ConnectionEvent>) {
        let Some(mut connection) = self.open.remove(&key) else { return };
        self.idle.remove(&connection.last);
        self.buffered = self.buffered.saturating_sub(connection.memory_size());
        let events = out.len();
        connection.finish(out);
        if !connection.is_ams && !out.iter().skip(events).any(is_frame) {
            out.truncate(events);
        }
        for direction_state in &connection.direction_states {
            self.repeated = self.repeated.saturating_add(direction_state.repeated);
            self.early = self.early.saturating_add(direction_state.early);
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

const fn is_frame(event: &ConnectionEvent) -> bool {
    matches!(event, ConnectionEvent::Frame(..))
}

impl TcpConnection {
    fn new(number: u64, ends: [Endpoint; 2], is_ams: bool) -> Self {
        Self {
            number,
            ends,
            direction_states: Default::default(),
            frames: Default::default(),
            is_ams,
            is_whole: true,
            joined: false,
            last: 0,
            packet: 0,
        }
    }

    fn memory_size(&self) -> usize {
        let direction_states = self.direction_states.iter().map(DirectionState::memory_size);
        direction_states
            .chain(self.frames.iter().map(Frames::memory_size))
            .fold(0, usize::saturating_add)
    }

    fn side(&self, from: Endpoint) -> usize {
        usize::from(self.ends.first() != Some(&from))
    }

    /// Whether a SYN belongs to this connection: it is a retransmitted SYN, or the SYN of the other
    /// side.
    fn is_same(&self, segment: &TcpSegment<'_>) -> bool {
        let direction_state = self.direction_states.get(self.side(segment.from));
        direction_state.is_none_or(|direction_state| {
            direction_state.is_new() || direction_state.begins_with(segment.sequence)
        })
    }

    fn push(
        &mut self,
        segment: &TcpSegment<'_>,
        mark: CapturePosition,
        any: bool,
        out: &mut Vec<ConnectionEvent>,
    ) {
        let side = self.side(segment.from);
        let other = 1_usize.saturating_sub(side);
        self.packet = self.packet.max(mark.packet);
        let acknowledged = segment.acknowledged.filter(|_| !segment.rst);
        let place = self.direction_states.get(other).zip(acknowledged);
        let mark = CapturePosition {
            acknowledged: place.and_then(|(direction_state, at)| direction_state.offset_of(at)),
            ..mark
        };
        let Some(direction_state) = self.direction_states.get_mut(side) else { return };
        let Some(frames) = self.frames.get_mut(side) else { return };
        if direction_state.is_new() && !segment.syn && !segment.payload.is_empty() {
            frames.begin_anywhere();
            self.joined |= std::mem::take(&mut self.is_whole);
        } else if !direction_state.is_seen() && any {
            frames.begin_anywhere();
        }
        let direction =
            SegmentDirection { connection: self.number, from: segment.from, to: segment.to };
        direction_state.push(segment, mark, &mut |piece| feed(frames, piece, direction, out));
        if segment.fin {
            let length = segment.payload.len().saturating_add(segment.missing);
            let length = to_u32(length);
            direction_state.end_at(segment.sequence.wrapping_add(length), mark);
        }
        if let (Some(other), Some(number)) = (self.direction_states.get_mut(other), acknowledged) {
            if self.is_whole {
                other.begin_at(number);
            }
            other.acknowledge(number, mark);
        }
    }

    /// Emits the waiting segments, and then the end of the connection.
    fn finish(&mut self, out: &mut Vec<ConnectionEvent>) {
        let [one, other] = self.ends;
        for (side, (from, to)) in [(one, other), (other, one)].into_iter().enumerate() {
            let direction = SegmentDirection { connection: self.number, from, to };
            let (Some(direction_state), Some(frames)) =
                (self.direction_states.get_mut(side), self.frames.get_mut(side))
            else {
                continue;
            };
            direction_state.flush(&mut |piece| feed(frames, piece, direction, out));
            frames.end(out);
        }
        let (connection, last) = (self.number, self.packet);
        let mut directions = [(one, other), (other, one)].into_iter().zip(&self.direction_states);
        let unseen = directions.find(|(_, direction_state)| !direction_state.is_seen());
        let unseen = unseen.map(|((from, to), _)| SegmentDirection { connection, from, to });
        out.push(ConnectionEvent::Ended(ConnectionEnd { connection, last, unseen }));
    }
}

fn feed(
    frames: &mut Frames,
    piece: ReassembledPiece<'_>,
    direction: SegmentDirection,
    out: &mut Vec<ConnectionEvent>,
) {
    match piece {
        ReassembledPiece::Data(bytes, mark) => frames.push(bytes, direction, mark, out),
        ReassembledPiece::Gap(length, mark) => {
            frames.gap(length, direction, out);
            out.push(ConnectionEvent::Gap(length, direction, mark));
        }
    }
}
