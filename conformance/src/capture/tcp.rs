//! TCP reassembly of one direction of a connection, which receives segments and emits bytes in
//! order.

use std::collections::BTreeMap;
use std::ops::Bound;

use super::link::TcpSegment;
use super::time::Time;
use crate::number::to_usize;

/// Maximum number of bytes of one direction that wait for earlier bytes. If more bytes wait, the
/// missing bytes count as a gap.
pub(super) const AHEAD_MAX: usize = 0x10_0000;

/// Maximum number of segments of one direction that wait for earlier bytes, with the same effect.
const SEGMENTS_MAX: usize = 4096;

/// Sequence numbers must be closer than this to the expected one. Otherwise, a segment is taken as
/// part of another connection with the same ends, and an acknowledgement is ignored.
const WINDOW: u32 = 0x4000_0000;

/// Number of segments after a gap until acknowledged bytes count as missing; packets that are
/// captured on several processors may be out of order.
const REORDERED_SEGMENTS_MAX: u32 = 64;

/// Fewer than this number of bytes of a direction may be captured before its SYN; a SYN at a larger
/// distance opens another connection.
const BEFORE_SYN: u32 = 0x1_0000;

/// The location of bytes in the capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CapturePosition {
    pub(super) packet: u64,
    pub(super) time: Option<Time>,
    /// Offset up to which the sender of the bytes had received the other direction; `None` if
    /// unknown.
    pub(super) acknowledged: Option<u64>,
}

#[derive(Debug, PartialEq, Eq)]
pub(super) enum ReassembledPiece<'a> {
    /// The next bytes.
    Data(&'a [u8], CapturePosition),
    /// The number of bytes that were not captured; 0 if unknown.
    Gap(u64, CapturePosition),
}

/// The state of one direction of a connection.
#[derive(Debug, Default)]
pub(super) struct DirectionState {
    /// Sequence number of the next byte, if known.
    next: Option<u32>,
    /// Sequence number of the SYN.
    begin: Option<u32>,
    /// Whether any segment of this direction was captured.
    seen: bool,
    /// Offset of the FIN.
    end: Option<u64>,
    /// Offset of the next byte, that is, the number of bytes emitted so far, including those of
    /// gaps; it does not wrap around.
    offset: u64,
    /// Segments that wait for earlier bytes, by offset.
    ahead: BTreeMap<u64, EarlySegment>,
    buffered: usize,
    /// Offset acknowledged by the other side.
    acknowledged: u64,
    /// The location of the segment with this acknowledgement or, without an acknowledgement, of the
    /// segment with the FIN.
    acknowledged_by: Option<CapturePosition>,
    waiting: u32,
    /// Segments that begin with bytes that were already captured or counted as a gap, such as
    /// retransmitted segments.
    pub(super) repeated: u64,
    /// Segments that were captured while earlier bytes were missing.
    pub(super) early: u64,
}

#[derive(Debug)]
struct EarlySegment {
    bytes: Vec<u8>,
    missing: usize,
    mark: CapturePosition,
}

impl DirectionState {
    /// Whether no sequence number is known yet.
    pub(super) const fn is_new(&self) -> bool {
        self.next.is_none()
    }

    /// Whether any segment was captured.
    pub(super) const fn is_seen(&self) -> bool {
        self.seen
    }

    /// Whether `sequence` may be the sequence number of the SYN of this direction, which may be a
    /// retransmitted SYN or a SYN captured late.
    pub(super) fn begins_with(&self, sequence: u32) -> bool {
        match (self.begin, self.next) {
            (Some(begin), _) => begin == sequence,
            (None, None) => true,
            (None, Some(next)) => {
                let sent = next.wrapping_sub(sequence.wrapping_add(1));
                sent < BEFORE_SYN && u64::from(sent) >= self.offset
            }
        }
    }

    /// The offset of a sequence number, if any sequence number of this direction is known.
    pub(super) fn offset_of(&self, sequence: u32) -> Option<u64> {
        let next = self.next?;
        let (after, before) = (sequence.wrapping_sub(next), next.wrapping_sub(sequence));
        Some(if after < before {
            self.offset.saturating_add(after.into())
        } else {
            self.offset.saturating_sub(before.into())
        })
    }

    /// Sets the sequence number of the next byte, known from an acknowledgement or a FIN, unless
    /// this number is already known.
    pub(super) fn begin_at(&mut self, sequence: u32) {
        self.next.get_or_insert(sequence);
    }

    /// The offset up to which bytes and gaps were emitted.
    pub(super) const fn offset(&self) -> u64 {
        self.offset
    }

    /// Whether all bytes and gaps up to the FIN were emitted.
    pub(super) fn is_over(&self) -> bool {
        self.end.is_some_and(|end| self.offset >= end)
    }

    /// Memory of the waiting segments in bytes; for many small segments, the map needs more memory
    /// than their bytes.
    pub(super) fn memory_size(&self) -> usize {
        let each = size_of::<(u64, EarlySegment)>();
        self.buffered.saturating_add(self.ahead.len().saturating_mul(each))
    }

    /// Adds a segment of this direction and emits the bytes that are now in order.
    pub(super) fn push(
        &mut self,
        segment: &TcpSegment<'_>,
        mark: CapturePosition,
        out: &mut impl FnMut(ReassembledPiece<'_>),
    ) {
        self.seen = true;
        let sequence =
            if segment.syn { segment.sequence.wrapping_add(1) } else { segment.sequence };
        if segment.payload.is_empty() && segment.missing == 0 {
            if segment.syn {
                self.next.get_or_insert(sequence);
                self.begin = Some(segment.sequence);
            }
            return;
        }
        let next = *self.next.get_or_insert(sequence);
        let (after, before) = (sequence.wrapping_sub(next), next.wrapping_sub(sequence));
        if before == 0 || after == 0 {
            self.take(segment.payload, segment.missing, mark, out);
        } else if after < WINDOW {
            self.early = self.early.saturating_add(1);
            let offset = self.offset.saturating_add(after.into());
            self.hold(offset, segment, mark);
        } else if before < WINDOW {
            self.repeated = self.repeated.saturating_add(1);
            let known = to_usize(before);
            let fresh = segment.payload.get(known..).unwrap_or_default();
            let missing =
                segment.missing.saturating_sub(known.saturating_sub(segment.payload.len()));
            self.take(fresh, missing, mark, out);
        } else {
            // The distance is too large for this connection: the waiting segments will never match.
            self.flush(out);
            out(ReassembledPiece::Gap(0, mark));
            self.next = Some(sequence);
            self.take(segment.payload, segment.missing, mark, out);
        }
        self.follow(out);
        if !self.ahead.is_empty() {
            self.give_up_gap(out);
        }
    }

    /// Sets the sequence number of the FIN.
    pub(super) fn end_at(&mut self, sequence: u32, mark: CapturePosition) {
        self.begin_at(sequence);
        self.end = self.offset_of(sequence);
        self.acknowledged_by.get_or_insert(mark);
    }

    /// Notes that the other side has received all bytes before `sequence`.
    pub(super) fn acknowledge(&mut self, sequence: u32, mark: CapturePosition) {
        let Some(next) = self.next else { return };
        let after = sequence.wrapping_sub(next);
        let offset = self.offset.saturating_add(after.into());
        if after < WINDOW && offset > self.acknowledged {
            self.acknowledged = offset;
            self.acknowledged_by = Some(mark);
        }
    }

    /// Emits the waiting segments, and the gaps before and after them: at the end of the direction,
    /// or before a segment that is taken as part of another connection.
    pub(super) fn flush(&mut self, out: &mut impl FnMut(ReassembledPiece<'_>)) {
        while !self.ahead.is_empty() {
            self.skip_gap(out);
        }
        // The acknowledgement may include a FIN that was not captured, which counts as one byte.
        let got = self.acknowledged.saturating_sub(1);
        let missing = self.end.unwrap_or(got).saturating_sub(self.offset);
        if let (true, Some(mark)) = (missing > 0 && self.seen, self.acknowledged_by) {
            out(ReassembledPiece::Gap(missing, mark));
            self.advance(to_usize(missing));
        }
    }

    fn take(
        &mut self,
        bytes: &[u8],
        missing: usize,
        mark: CapturePosition,
        out: &mut impl FnMut(ReassembledPiece<'_>),
    ) {
        if !bytes.is_empty() {
            out(ReassembledPiece::Data(bytes, mark));
            self.advance(bytes.len());
        }
        if missing > 0 {
            out(ReassembledPiece::Gap(u64::try_from(missing).unwrap_or(u64::MAX), mark));
            self.advance(missing);
        }
    }

    fn advance(&mut self, length: usize) {
        let length = u64::try_from(length).unwrap_or(u64::MAX);
        self.offset = self.offset.saturating_add(length);
        // Sequence numbers are modulo 2^32, so the low 32 bits of the length are sufficient.
        let low = u32::try_from(length & u64::from(u32::MAX)).unwrap_or(0);
        self.next = self.next.map(|next| next.wrapping_add(low));
    }

    fn hold(&mut self, offset: u64, segment: &TcpSegment<'_>, mark: CapturePosition) {
        let known = self.ahead.get(&offset).map_or(0, |early| early.bytes.len());
        if self.ahead.contains_key(&offset) && known >= segment.payload.len() {
            return;
        }
        let bytes = segment.payload.to_vec();
        self.buffered = self.buffered.saturating_sub(known).saturating_add(bytes.len());
        self.ahead.insert(offset, EarlySegment { bytes, missing: segment.missing, mark });
    }

    /// Emits waiting segments that are now in order.
    fn follow(&mut self, out: &mut impl FnMut(ReassembledPiece<'_>)) {
        while let Some((&offset, _)) = self.ahead.first_key_value() {
            let Some(overlap) = self.offset.checked_sub(offset) else { return };
            let Some(early) = self.ahead.remove(&offset) else { return };
            self.buffered = self.buffered.saturating_sub(early.bytes.len());
            let overlap = to_usize(overlap);
            let fresh = early.bytes.get(overlap..).unwrap_or_default();
            let missing = early.missing.saturating_sub(overlap.saturating_sub(early.bytes.len()));
            self.take(fresh, missing, early.mark, out);
            self.waiting = 0;
        }
    }

    /// Stops waiting for missing bytes if the other side has acknowledged them and
    /// `REORDERED_SEGMENTS_MAX` more segments have been captured, or if too many bytes or segments
    /// wait.
    fn give_up_gap(&mut self, out: &mut impl FnMut(ReassembledPiece<'_>)) {
        self.waiting = self.waiting.saturating_add(1);
        let too_much = self.buffered > AHEAD_MAX || self.ahead.len() > SEGMENTS_MAX;
        let first = self.ahead.first_key_value().map_or(u64::MAX, |(&offset, _)| offset);
        if too_much || (self.acknowledged >= first && self.waiting > REORDERED_SEGMENTS_MAX) {
            self.skip_gap(out);
        }
    }

    /// Emits the gap before the first waiting segment, and continues after the gap.
    fn skip_gap(&mut self, out: &mut impl FnMut(ReassembledPiece<'_>)) {
        let from = Bound::Included(self.offset);
        let first = self.ahead.range((from, Bound::Unbounded)).next();
        if let Some((&offset, early)) = first {
            let gap = offset.saturating_sub(self.offset);
            out(ReassembledPiece::Gap(gap, early.mark));
            self.advance(to_usize(gap));
        }
        self.waiting = 0;
        self.follow(out);
    }
}

#[cfg(test)]
mod tests;
