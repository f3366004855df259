//! Finds the request of each reply, even if the reply was captured first.

use ads_cnc_vectors::ids::*;

use super::super::connection_event::SegmentDirection;
use super::super::frames::is_cnc;
use super::super::observation::CapturedFrames;
use super::super::table::ConnectionTable;
use super::super::tally::{count, count_of};
use super::{CapturedFrame, EarlyReplies, TrafficJudge, location};
use crate::judge::Checks as _;
use crate::rules::{Topic, service_clause};

/// Maximum number of waiting requests of a connection, and maximum memory in bytes of the waiting
/// requests of all connections. If a request exceeds one of these limits, the oldest request of its
/// connection is dropped.
const WAITING_MAX: usize = 4096;
const WAITING_BYTES_MAX: usize = 0x100_0000;

/// Maximum number, and maximum memory in bytes, of the replies of all connections that wait for
/// their requests.
const EARLY_MAX: usize = 4096;
const EARLY_BYTES_MAX: usize = 0x100_0000;

/// Maximum number of packets by which a reply, or a gap that may contain a reply, may be captured
/// before its request.
pub(super) const REORDERED_MAX: u64 = 256;

/// Maximum number of requests or replies with the same invoke ID that are compared; more than
/// [`REORDERED_MAX`], the number of packets that may be out of order.
const ALIKE_MAX: usize = 512;

/// Maximum number of replies without a request that are shown for a connection, and maximum number
/// of bytes shown of each reply.
const SHOWN: usize = 4;
const SHOWN_BYTES: usize = 0x400;

impl EarlyReplies {
    fn push(&mut self, reply: CapturedFrame) {
        self.bytes = self.bytes.saturating_add(reply.frame.len());
        self.ids.insert((reply.header.invoke_id, reply.number));
        self.connections.insert((reply.direction.connection, reply.number));
        self.all.insert(reply.number, reply);
    }

    fn remove(&mut self, number: u64) -> Option<CapturedFrame> {
        let reply = self.all.remove(&number)?;
        self.bytes = self.bytes.saturating_sub(reply.frame.len());
        self.ids.remove(&(reply.header.invoke_id, number));
        self.connections.remove(&(reply.direction.connection, number));
        Some(reply)
    }

    /// The number of the first matching reply among the first `ALIKE_MAX` replies with this invoke
    /// ID.
    fn find(&self, id: u32, matches: impl Fn(&CapturedFrame) -> bool) -> Option<u64> {
        let alike = self.ids.range((id, 0)..=(id, u64::MAX)).take(ALIKE_MAX);
        let alike = alike.filter_map(|(_, number)| self.all.get(number));
        alike.into_iter().find(|reply| matches(reply)).map(|reply| reply.number)
    }

    fn first_of(&self, connection: u64) -> Option<u64> {
        let mut all = self.connections.range((connection, 0)..=(connection, u64::MAX));
        all.next().map(|(_, number)| *number)
    }

    fn is_full(&self) -> bool {
        self.all.len() > EARLY_MAX || self.bytes > EARLY_BYTES_MAX
    }
}

/// Memory in bytes that a waiting request needs in addition to its frame, estimated.
const WAITING_OVERHEAD: usize = 1280;

impl CapturedFrame {
    /// The memory of the frame in bytes while it waits.
    fn memory(&self) -> usize {
        self.frame.len().saturating_add(WAITING_OVERHEAD)
    }

    /// Whether the addresses of a reply are those of this request, swapped.
    fn mirrors(&self, reply: &Self) -> bool {
        self.header.source == reply.header.target && self.header.target == reply.header.source
    }

    /// Whether the client had received `reply` before it sent this request, so that `reply` belongs
    /// to an earlier request. The TCP acknowledgement of the request proves this, even if the
    /// packets were captured out of order.
    fn follows(&self, reply: &Self) -> bool {
        let got = self.span.last.acknowledged;
        self.direction.connection == reply.direction.connection
            && got.is_some_and(|index| index >= reply.span.end)
    }
}

impl TrafficJudge {
    /// Stores a request until its reply is captured, unless the reply was captured first.
    pub(super) fn wait(&mut self, captured: CapturedFrame) {
        let id = captured.header.invoke_id;
        let answered = self.early.find(id, |reply| {
            let last = reply.span.last.packet.saturating_add(REORDERED_MAX);
            reply.header.command == captured.header.command
                && captured.mirrors(reply)
                && !captured.follows(reply)
                && captured.span.last.packet <= last
        });
        if let Some(reply) = answered.and_then(|number| self.early.remove(number)) {
            self.exchange(&captured, &reply);
            return;
        }
        let connection = captured.direction.connection;
        let numbers = self.waiting_of.entry(connection).or_default();
        numbers.insert(captured.number, id);
        self.waiting_bytes = self.waiting_bytes.saturating_add(captured.memory());
        while let Some(oldest) = self.oldest_beyond(connection) {
            count(&mut self.tally.unanswered);
            count(&mut self.tally.forgotten);
            self.lost.entry(connection).or_default().joined = true;
            if self.forget((connection, oldest), 0).is_none() {
                // The new request itself is the oldest one of its connection, because the requests
                // of other connections use all the memory.
                self.waiting_bytes = self.waiting_bytes.saturating_sub(captured.memory());
                self.waiting_of.entry(connection).or_default().remove(&captured.number);
                return;
            }
        }
        self.waiting_ids.insert((id, connection));
        self.waiting.entry((connection, id)).or_default().push_back(captured);
    }

    /// The invoke ID of the oldest waiting request of a connection, if a limit of waiting requests
    /// is exceeded.
    fn oldest_beyond(&self, connection: u64) -> Option<u32> {
        let numbers = self.waiting_of.get(&connection)?;
        let is_full = numbers.len() > WAITING_MAX || self.waiting_bytes > WAITING_BYTES_MAX;
        numbers.first_key_value().map(|(_, id)| *id).filter(|_| is_full)
    }

    /// Removes and returns the waiting request with this key (connection and invoke ID) and this
    /// index among the requests with the same key.
    pub(super) fn forget(&mut self, key: (u64, u32), index: usize) -> Option<CapturedFrame> {
        let all = self.waiting.get_mut(&key)?;
        let one = all.remove(index)?;
        self.waiting_bytes = self.waiting_bytes.saturating_sub(one.memory());
        if all.is_empty() {
            self.waiting.remove(&key);
            self.waiting_ids.remove(&(key.1, key.0));
        }
        if let Some(numbers) = self.waiting_of.get_mut(&key.0) {
            numbers.remove(&one.number);
        }
        Some(one)
    }

    /// Whether an earlier request of this client with this invoke ID still waits for its reply;
    /// `None` if the capture may lack the reply to the earlier request.
    pub(super) fn is_repeated(
        &self,
        captured: &CapturedFrame,
        table: &ConnectionTable,
    ) -> Option<bool> {
        let lost = self.lost.get(&captured.direction.connection);
        let back = SegmentDirection {
            from: captured.direction.to,
            to: captured.direction.from,
            ..captured.direction
        };
        let got = captured.span.last.acknowledged?;
        let is_whole = lost.is_none_or(|lost| !lost.joined && lost.gap.is_none());
        let known = is_whole && table.has(&back, got);
        known.then(|| {
            // Several clients may share a connection between two routers.
            let alike =
                self.waiting.get(&(captured.direction.connection, captured.header.invoke_id));
            let mut alike = alike.into_iter().flatten().take(ALIKE_MAX);
            alike.any(|request_frame| request_frame.header.source == captured.header.source)
        })
    }

    pub(super) fn reply(&mut self, reply: CapturedFrame) {
        match self.request_of(&reply) {
            Some(request_frame) => self.exchange(&request_frame, &reply),
            None => self.early.push(reply),
        }
    }

    /// Removes and returns the request that a reply answers.
    fn request_of(&mut self, reply: &CapturedFrame) -> Option<CapturedFrame> {
        let key = (reply.direction.connection, reply.header.invoke_id);
        let lost = self.lost.get(&key.0).is_some_and(|lost| lost.gap.is_some());
        let matches = |request_frame: &CapturedFrame| {
            request_frame.mirrors(reply) && !request_frame.follows(reply)
        };
        let index = self.waiting.get(&key).and_then(|all| {
            // A client should reuse an invoke ID only after it has received the reply to the
            // earlier request. That reply is assumed to be lost in the gap, so this reply is taken
            // as that to the latest request.
            if lost {
                let latest = (0..all.len()).rev().take(ALIKE_MAX);
                latest.into_iter().find(|&index| all.get(index).is_some_and(matches))
            } else {
                let mut first = all.iter().take(ALIKE_MAX);
                let mirrored = || all.iter().take(ALIKE_MAX).position(|one| one.mirrors(reply));
                first.position(matches).or_else(mirrored)
            }
        });
        if let Some(index) = index {
            return self.forget(key, index);
        }
        // Two routers may send a request and its reply on different connections.
        let id = reply.header.invoke_id;
        let others = self.waiting_ids.range((id, 0)..=(id, u64::MAX)).take(ALIKE_MAX);
        let mut others = others.map(|(id, connection)| (*connection, *id));
        let (key, index) = others.find_map(|key| {
            let all = self.waiting.get(&key)?;
            Some((key, all.iter().take(ALIKE_MAX).position(matches)?))
        })?;
        self.forget(key, index)
    }

    /// Judges replies whose requests can no longer follow in the capture, and the oldest replies if
    /// too many replies wait for their requests.
    pub(super) fn judge_expired(&mut self, table: &ConnectionTable) {
        while let Some((&number, first)) = self.early.all.first_key_value() {
            let back = SegmentDirection {
                from: first.direction.to,
                to: first.direction.from,
                ..first.direction
            };
            let last = first.span.last.packet.saturating_add(REORDERED_MAX);
            let late = last < self.newest && !table.waits(&back);
            if !late && !self.early.is_full() {
                return;
            }
            let Some(reply) = self.early.remove(number) else { return };
            self.judge_unmatched(reply);
        }
    }

    /// Judges the replies of a connection that still wait for their requests.
    pub(super) fn judge_all_unmatched(&mut self, connection: u64) {
        while let Some(number) = self.early.first_of(connection) {
            let Some(reply) = self.early.remove(number) else { return };
            self.judge_unmatched(reply);
        }
    }

    /// Judges a reply for which no request with matching addresses was captured.
    fn judge_unmatched(&mut self, reply: CapturedFrame) {
        let header = reply.header;
        let connection = reply.direction.connection;
        let key = (connection, header.invoke_id);
        let is_whole = self.lost.get(&connection).is_none_or(|lost| lost.gap.is_none());
        // A reply with wrong addresses still belongs to a request with the same invoke ID and
        // command.
        let index = self.waiting.get(&key).filter(|_| is_whole).and_then(|all| {
            all.iter().take(ALIKE_MAX).position(|request_frame| {
                request_frame.header.command == header.command && !request_frame.follows(&reply)
            })
        });
        if let Some(request_frame) = index.and_then(|index| self.forget(key, index)) {
            self.exchange(&request_frame, &reply);
        } else if !is_cnc(header.source.port) {
            count_of(&mut self.tally.other_ports, header.source.port.0);
        } else if service_clause(header.command) == ADS_5 {
            count_of(&mut self.tally.commands, header.command.0);
        } else {
            count(&mut self.tally.unasked);
            let shown = &mut self.lost.entry(connection).or_default().unasked;
            if shown.len() < SHOWN {
                let mut reply = reply;
                reply.frame.truncate(SHOWN_BYTES);
                reply.frame.shrink_to_fit();
                shown.push(reply);
            }
        }
    }

    /// Judges a reply without a request, once its connection or the capture has ended.
    pub(super) fn unasked(&mut self, reply: &CapturedFrame, is_open: bool) {
        let observation =
            CapturedFrames::Bytes(&reply.frame, location(&reply.direction, None, Some(reply.span)));
        let mut record = self.rules.records.on(Topic::CncFrames, &observation);
        let found = || format!("an answer with the invoke ID {:#x}", reply.header.invoke_id);
        if is_open {
            let found = || format!("{}, whose request may not have been captured", found());
            record.open(ADS_5, found);
        } else {
            let expected = "an answer to a request that still waits for one";
            record.check(ADS_5, false, expected, found);
        }
    }
}
