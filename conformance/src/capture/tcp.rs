//! One direction of a TCP connection: segments in, bytes in their order out.

use std::collections::BTreeMap;
use std::ops::Bound;

use super::time::Time;

/// Bytes of one direction that are held back until what is before them comes.
pub(super) const AHEAD_MAX: usize = 0x10_0000;

/// Segments of one direction that are held back.
const SEGMENTS_MAX: usize = 4096;

/// What may be between a segment and what is expected; more is another connection.
const WINDOW: u32 = 0x4000_0000;

/// Segments that may come behind a hole after the other side has acknowledged what is in it.
const PATIENCE: u32 = 3;

/// Where bytes were captured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mark {
    pub(super) packet: u64,
    pub(super) time: Option<Time>,
}

/// What comes out.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Piece<'a> {
    /// The next bytes.
    Data(&'a [u8], Mark),
    /// Bytes that were not captured.
    Gap(u64, Mark),
}

/// A segment of this direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a> {
    pub(super) sequence: u32,
    pub(super) syn: bool,
    pub(super) payload: &'a [u8],
    /// Bytes behind the payload that were not captured.
    pub(super) missing: usize,
    pub(super) mark: Mark,
}

/// One direction.
#[derive(Debug, Default)]
pub(super) struct Half {
    /// Sequence number of the next byte, once one is known.
    next: Option<u32>,
    /// That of its SYN.
    begin: Option<u32>,
    /// Bytes handed over, so that places do not wrap around.
    place: u64,
    /// What came too early, by its place.
    ahead: BTreeMap<u64, Held>,
    held: usize,
    /// How far the other side has acknowledged.
    acknowledged: u64,
    waiting: u32,
    /// Segments that came once more.
    pub(super) repeated: u64,
    /// Segments that came too early.
    pub(super) early: u64,
}

#[derive(Debug)]
struct Held {
    bytes: Vec<u8>,
    missing: usize,
    mark: Mark,
}

impl Half {
    /// Whether nothing is known of it.
    pub(super) const fn is_new(&self) -> bool {
        self.next.is_none()
    }

    /// Whether this was the number of its SYN.
    pub(super) fn begins_with(&self, sequence: u32) -> bool {
        self.begin == Some(sequence)
    }

    /// Bytes held back.
    pub(super) const fn held(&self) -> usize {
        self.held
    }

    /// Takes a segment and hands over what is in order.
    pub(super) fn push(&mut self, part: Part<'_>, out: &mut impl FnMut(Piece<'_>)) {
        let sequence = match part.syn {
            true => part.sequence.wrapping_add(1),
            false => part.sequence,
        };
        if part.payload.is_empty() && part.missing == 0 {
            if part.syn {
                self.next.get_or_insert(sequence);
                self.begin = Some(part.sequence);
            }
            return;
        }
        let next = *self.next.get_or_insert(sequence);
        let (after, before) = (sequence.wrapping_sub(next), next.wrapping_sub(sequence));
        if before == 0 || after == 0 {
            self.take(part.payload, part.missing, part.mark, out);
        } else if after < WINDOW {
            self.early = self.early.saturating_add(1);
            let place = self.place.saturating_add(after.into());
            self.hold(place, part);
        } else if before < WINDOW {
            self.repeated = self.repeated.saturating_add(1);
            let known = usize::try_from(before).unwrap_or(usize::MAX);
            let fresh = part.payload.get(known..).unwrap_or_default();
            let missing = match known.checked_sub(part.payload.len()) {
                Some(more) => part.missing.saturating_sub(more),
                None => part.missing,
            };
            if !fresh.is_empty() || missing > 0 {
                self.take(fresh, missing, part.mark, out);
            }
        } else {
            // So far off that it is no part of what was; what is held back will not be joined.
            self.flush(out);
            out(Piece::Gap(0, part.mark));
            self.next = Some(sequence);
            self.take(part.payload, part.missing, part.mark, out);
        }
        self.follow(out);
        if !self.ahead.is_empty() {
            self.lose_patience(out);
        }
    }

    /// The other side has got everything up to here.
    pub(super) fn acknowledge(&mut self, sequence: u32) {
        let Some(next) = self.next else { return };
        let after = sequence.wrapping_sub(next);
        if after < WINDOW {
            self.acknowledged = self.acknowledged.max(self.place.saturating_add(after.into()));
        }
    }

    /// Nothing more comes: what is held back comes out, with gaps.
    pub(super) fn flush(&mut self, out: &mut impl FnMut(Piece<'_>)) {
        while !self.ahead.is_empty() {
            self.leap(out);
        }
    }

    fn take(&mut self, bytes: &[u8], missing: usize, mark: Mark, out: &mut impl FnMut(Piece<'_>)) {
        if !bytes.is_empty() {
            out(Piece::Data(bytes, mark));
            self.advance(bytes.len());
        }
        if missing > 0 {
            out(Piece::Gap(u64::try_from(missing).unwrap_or(u64::MAX), mark));
            self.advance(missing);
        }
    }

    fn advance(&mut self, length: usize) {
        let length = u64::try_from(length).unwrap_or(u64::MAX);
        self.place = self.place.saturating_add(length);
        // Sequence numbers are modulo 2^32: so is what is added.
        let low = u32::try_from(length & u64::from(u32::MAX)).unwrap_or(0);
        self.next = self.next.map(|next| next.wrapping_add(low));
    }

    fn hold(&mut self, place: u64, part: Part<'_>) {
        let known = self.ahead.get(&place).map_or(0, |held| held.bytes.len());
        if self.ahead.contains_key(&place) && known >= part.payload.len() {
            return;
        }
        let bytes = part.payload.to_vec();
        self.held = self.held.saturating_sub(known).saturating_add(bytes.len());
        self.ahead.insert(place, Held { bytes, missing: part.missing, mark: part.mark });
    }

    /// Hands over what was held back and is next now.
    fn follow(&mut self, out: &mut impl FnMut(Piece<'_>)) {
        while let Some((&place, _)) = self.ahead.first_key_value() {
            let Some(overlap) = self.place.checked_sub(place) else { return };
            let Some(held) = self.ahead.remove(&place) else { return };
            self.held = self.held.saturating_sub(held.bytes.len());
            let overlap = usize::try_from(overlap).unwrap_or(usize::MAX);
            let fresh = held.bytes.get(overlap..).unwrap_or_default();
            let missing = match overlap.checked_sub(held.bytes.len()) {
                Some(more) => held.missing.saturating_sub(more),
                None => held.missing,
            };
            self.take(fresh, missing, held.mark, out);
            self.waiting = 0;
        }
    }

    /// Gives up what is missing if the other side has it, or if too much is held back.
    fn lose_patience(&mut self, out: &mut impl FnMut(Piece<'_>)) {
        self.waiting = self.waiting.saturating_add(1);
        let too_much = self.held > AHEAD_MAX || self.ahead.len() > SEGMENTS_MAX;
        let first = self.ahead.first_key_value().map_or(u64::MAX, |(&place, _)| place);
        if too_much || (self.acknowledged >= first && self.waiting > PATIENCE) {
            self.leap(out);
        }
    }

    /// Goes on behind the hole.
    fn leap(&mut self, out: &mut impl FnMut(Piece<'_>)) {
        let from = Bound::Included(self.place);
        let first = self.ahead.range((from, Bound::Unbounded)).next();
        if let Some((&place, held)) = first {
            let gap = place.saturating_sub(self.place);
            out(Piece::Gap(gap, held.mark));
            self.advance(usize::try_from(gap).unwrap_or(usize::MAX));
        }
        self.waiting = 0;
        self.follow(out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARK: Mark = Mark { packet: 1, time: None };

    /// What comes out of segments: bytes, and `_` for each byte of a gap.
    fn joined(half: &mut Half, parts: &[(u32, &[u8])], end: bool) -> String {
        let mut all = String::new();
        let mut out = |piece: Piece<'_>| match piece {
            Piece::Data(bytes, _) => all.push_str(std::str::from_utf8(bytes).unwrap()),
            Piece::Gap(length, _) => all.extend((0..length).map(|_| '_')),
        };
        for &(sequence, payload) in parts {
            half.push(Part { sequence, syn: false, payload, missing: 0, mark: MARK }, &mut out);
        }
        if end {
            half.flush(&mut out);
        }
        all
    }

    #[test]
    fn segments_come_in_any_order() {
        for start in [0_u32, 100, u32::MAX, u32::MAX - 3, u32::MAX - 6, 0x7FFF_FFFE] {
            let at = |offset: u32| start.wrapping_add(offset);
            let begun = || {
                let mut half = Half::default();
                let syn = Part {
                    sequence: at(u32::MAX),
                    syn: true,
                    payload: &[],
                    missing: 0,
                    mark: MARK,
                };
                half.push(syn, &mut |_| panic!("there is nothing in it"));
                half
            };
            let parts: [(u32, &[u8]); 4] =
                [(at(0), b"abc"), (at(3), b"de"), (at(5), b"f"), (at(6), b"ghi")];
            for order in [[0, 1, 2, 3], [3, 2, 1, 0], [1, 0, 3, 2], [2, 3, 0, 1]] {
                let parts = order.map(|place: usize| parts[place]);
                assert_eq!(joined(&mut begun(), &parts, false), "abcdefghi", "{start} {order:?}");
            }
            // Once more, in other pieces, and over one another.
            let parts: [(u32, &[u8]); 7] = [
                (at(0), b"abc"),
                (at(0), b"abc"),
                (at(5), b"fgh"),
                (at(1), b"bcde"),
                (at(4), b"efghi"),
                (at(0), b"abcdefghi"),
                (at(9), b"j"),
            ];
            assert_eq!(joined(&mut begun(), &parts, false), "abcdefghij");
        }
    }

    #[test]
    fn what_never_came_is_a_gap() {
        let mut half = Half::default();
        assert_eq!(joined(&mut half, &[(10, b"ab"), (15, b"fg")], false), "ab");
        assert_eq!((half.held(), half.early), (2, 1));
        assert_eq!(joined(&mut half, &[], true), "___fg");
        assert_eq!(half.held(), 0);
    }

    /// The other side has it: it was sent, and not captured.
    #[test]
    fn what_is_acknowledged_is_not_waited_for() {
        let mut half = Half::default();
        assert_eq!(joined(&mut half, &[(10, b"ab"), (15, b"f"), (16, b"g")], false), "ab");
        half.acknowledge(17);
        let more: [(u32, &[u8]); 3] = [(17, b"h"), (18, b"i"), (19, b"j")];
        assert_eq!(joined(&mut half, &more, false), "___fghij");
    }

    #[test]
    fn no_more_is_held_back_than_a_limit() {
        let mut half = Half::default();
        let payload = vec![b'x'; 60_000];
        let mut out = |_: Piece<'_>| {};
        for place in 0..200_u32 {
            let sequence = 10_u32.wrapping_add(place.wrapping_mul(70_000));
            half.push(
                Part { sequence, syn: false, payload: &payload, missing: 0, mark: MARK },
                &mut out,
            );
            assert!(half.held() <= AHEAD_MAX + 60_000);
        }
    }

    #[test]
    fn what_was_cut_off_is_a_gap() {
        let mut half = Half::default();
        let mut all = Vec::new();
        let mut out = |piece: Piece<'_>| all.push(format!("{piece:?}"));
        let part = Part { sequence: 5, syn: false, payload: b"ab", missing: 3, mark: MARK };
        half.push(part, &mut out);
        half.push(Part { sequence: 10, payload: b"f", missing: 0, ..part }, &mut out);
        half.push(Part { sequence: 8, payload: b"d", missing: 3, ..part }, &mut out);
        let mark = "Mark { packet: 1, time: None }";
        let gap = |length: u64| format!("Gap({length}, {mark})");
        let data = |bytes: &[u8]| format!("Data({bytes:?}, {mark})");
        assert_eq!(all, [data(b"ab"), gap(3), data(b"f"), gap(1)]);
    }
}
