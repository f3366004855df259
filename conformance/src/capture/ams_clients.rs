//! Follows conversations of AMS frames that were captured without TCP.

use std::collections::BTreeMap;

use ads_cnc::ads::AmsNetId;

use super::connection_event::{ConnectionEnd, ConnectionEvent, SegmentDirection, Span};
use super::frames::is_reply;
use super::link::AmsFrame;
use super::table::CONNECTIONS_MAX;
use super::tcp::CapturePosition;
use crate::number::to_u32;

/// Added to the number of a conversation without TCP, so that it differs from the number of each
/// TCP connection. The TCP connections are numbered from 1.
const NUMBERS: u64 = 1 << 63;

/// The conversation of all clients on one machine (one AMS NetId) with all other machines.
#[derive(Debug)]
struct AmsClient {
    /// Number of the last frame of the conversation among all frames without TCP, and number of its
    /// packet.
    last: u64,
    packet: u64,
    /// Number of bytes sent by the machine (index 0) and to the machine (index 1).
    sent: [u64; 2],
    /// The direction of requests, from the client to the other party of the first frame.
    direction: SegmentDirection,
}

/// The clients of all AMS frames that were captured without TCP.
#[derive(Debug, Default)]
pub(super) struct AmsClients {
    all: BTreeMap<AmsNetId, AmsClient>,
    /// The keys of `all` by the number of the last frame of the conversation.
    idle: BTreeMap<u64, AmsNetId>,
    frames: u64,
    /// Number of clients, including those that are no longer followed.
    clients: u64,
}

impl AmsClients {
    pub(super) fn push(
        &mut self,
        frame: AmsFrame<'_>,
        mark: CapturePosition,
        out: &mut Vec<ConnectionEvent>,
    ) {
        self.frames = self.frames.saturating_add(1);
        let (from, to) = (frame.header.source, frame.header.target);
        let is_reply = is_reply(&frame.header);
        let (client, other) = if is_reply { (to, from) } else { (from, to) };
        if !self.all.contains_key(&client.net_id) {
            if self.all.len() >= CONNECTIONS_MAX {
                self.end_oldest(out);
            }
            self.clients = self.clients.saturating_add(1);
            let connection = NUMBERS | self.clients;
            let direction = SegmentDirection { connection, from: client.into(), to: other.into() };
            self.all
                .insert(client.net_id, AmsClient { last: 0, packet: 0, sent: [0; 2], direction });
            out.push(ConnectionEvent::Running(connection));
        }
        let Some(known) = self.all.get_mut(&client.net_id) else { return };
        self.idle.remove(&known.last);
        known.last = self.frames;
        self.idle.insert(known.last, client.net_id);
        known.packet = mark.packet;
        let [asked, replied] = &mut known.sent;
        let (sent, received) = if is_reply { (replied, asked) } else { (asked, replied) };
        // Add an AMS/TCP header, as over TCP. Its length is that of the captured bytes.
        let length = to_u32(frame.bytes.len());
        let bytes = [&[0, 0], &length.to_le_bytes()[..], frame.bytes].concat();
        *sent = sent.saturating_add(u64::try_from(bytes.len()).unwrap_or(u64::MAX));
        let mark = CapturePosition { acknowledged: Some(*received), ..mark };
        let span = Span { first: mark, last: mark, end: *sent };
        let connection = known.direction.connection;
        let direction = SegmentDirection { connection, from: from.into(), to: to.into() };
        out.push(match frame.is_cut {
            true => ConnectionEvent::Cut(bytes, direction, span),
            false => ConnectionEvent::Frame(bytes, direction, span),
        });
    }

    fn end_oldest(&mut self, out: &mut Vec<ConnectionEvent>) {
        let oldest = self.idle.pop_first().map(|(_, net_id)| net_id);
        if let Some(client) = oldest.and_then(|net_id| self.all.remove(&net_id)) {
            out.push(ConnectionEvent::Ended(client.ending()));
        }
    }

    /// Ends all conversations.
    pub(super) fn finish(&mut self, out: &mut Vec<ConnectionEvent>) {
        let ended = std::mem::take(&mut self.all).into_values();
        out.extend(ended.map(|client| ConnectionEvent::Ended(client.ending())));
    }
}

impl AmsClient {
    fn ending(&self) -> ConnectionEnd {
        let direction = self.direction;
        let back = SegmentDirection { from: direction.to, to: direction.from, ..direction };
        let unseen = self.sent.iter().zip([direction, back]).find(|(sent, _)| **sent == 0);
        let unseen = unseen.map(|(_, direction)| direction);
        ConnectionEnd { connection: direction.connection, last: self.packet, unseen }
    }
}
