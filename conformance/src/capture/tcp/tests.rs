//! Tests the reassembly of segments in any order, and with gaps.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use super::*;
use crate::capture::endpoint::Endpoint;

const MARK: CapturePosition = CapturePosition { packet: 1, time: None, acknowledged: None };

const END: Endpoint = Endpoint::Tcp(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 1));

const SEGMENT: TcpSegment<'_> = TcpSegment {
    from: END,
    to: END,
    sequence: 0,
    acknowledged: None,
    syn: false,
    fin: false,
    rst: false,
    payload: &[],
    missing: 0,
};

/// The bytes emitted for segments, with `_` for each byte of a gap.
fn joined(half: &mut DirectionState, parts: &[(u32, &[u8])], end: bool) -> String {
    let mut all = String::new();
    let mut out = |piece: ReassembledPiece<'_>| match piece {
        ReassembledPiece::Data(bytes, _) => all.push_str(std::str::from_utf8(bytes).unwrap()),
        ReassembledPiece::Gap(length, _) => all.extend((0..length).map(|_| '_')),
    };
    for &(sequence, payload) in parts {
        half.push(&TcpSegment { sequence, payload, ..SEGMENT }, MARK, &mut out);
    }
    if end {
        half.flush(&mut out);
    }
    all
}

#[test]
fn segments_are_reassembled_in_any_order() {
    for start in [0_u32, 100, u32::MAX, u32::MAX - 3, u32::MAX - 6, 0x7FFF_FFFE] {
        let at = |offset: u32| start.wrapping_add(offset);
        let begun = || {
            let mut half = DirectionState::default();
            let syn = TcpSegment { sequence: at(u32::MAX), syn: true, ..SEGMENT };
            half.push(&syn, MARK, &mut |_| panic!("a SYN has no bytes"));
            half
        };
        let parts: [(u32, &[u8]); 4] =
            [(at(0), b"abc"), (at(3), b"de"), (at(5), b"f"), (at(6), b"ghi")];
        for order in [[0, 1, 2, 3], [3, 2, 1, 0], [1, 0, 3, 2], [2, 3, 0, 1]] {
            let parts = order.map(|offset: usize| parts[offset]);
            assert_eq!(joined(&mut begun(), &parts, false), "abcdefghi", "{start} {order:?}");
        }
        // Segments are retransmitted, split differently, and overlap.
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
fn missing_bytes_are_a_gap() {
    let mut half = DirectionState::default();
    assert_eq!(joined(&mut half, &[(10, b"ab"), (15, b"fg")], false), "ab");
    assert_eq!((half.ahead.len(), half.early), (1, 1));
    assert_eq!(joined(&mut half, &[], true), "___fg");
    assert_eq!(half.memory_size(), 0);
}

/// The other side has acknowledged the missing bytes: they were sent, but not captured.
#[test]
fn acknowledged_bytes_are_not_awaited() {
    let mut half = DirectionState::default();
    assert_eq!(joined(&mut half, &[(10, b"ab"), (15, b"f"), (16, b"g")], false), "ab");
    half.acknowledge(17, MARK);
    let more: Vec<u8> = (0..REORDERED_SEGMENTS_MAX).map(|_| b'h').collect();
    let more: Vec<(u32, &[u8])> = (17_u32..).zip(more.chunks(1)).collect();
    let all = joined(&mut half, &more, false);
    assert!(all.starts_with("___fghhhhh"), "{all}");
}

/// The last bytes were not captured, but the other side has acknowledged them, or a FIN follows.
#[test]
fn missing_bytes_at_the_end_are_a_gap() {
    let begun = || {
        let mut half = DirectionState::default();
        assert_eq!(joined(&mut half, &[(10, b"ab")], false), "ab");
        half
    };
    let mut half = begun();
    half.acknowledge(13, MARK);
    assert_eq!(joined(&mut half, &[], true), "", "this may be a FIN");
    let mut half = begun();
    half.acknowledge(20, MARK);
    assert_eq!(joined(&mut half, &[], true), "_______");
    let mut half = begun();
    half.acknowledge(12, MARK);
    half.end_at(15, MARK);
    assert!(!half.is_over());
    assert_eq!(joined(&mut half, &[], true), "___");
}

#[test]
fn the_number_of_waiting_bytes_is_limited() {
    let mut half = DirectionState::default();
    let payload = vec![b'x'; 60_000];
    let mut out = |_: ReassembledPiece<'_>| {};
    for offset in 0..200_u32 {
        let sequence = 10_u32.wrapping_add(offset.wrapping_mul(70_000));
        half.push(&TcpSegment { sequence, payload: &payload, ..SEGMENT }, MARK, &mut out);
        assert!(half.memory_size() <= AHEAD_MAX + 60_000);
    }
}

#[test]
fn truncated_bytes_are_a_gap() {
    let mut half = DirectionState::default();
    let mut all = Vec::new();
    let mut out = |piece: ReassembledPiece<'_>| all.push(format!("{piece:?}"));
    for (sequence, payload, missing) in [(5, &b"ab"[..], 3), (10, b"f", 0), (8, b"d", 3)] {
        half.push(&TcpSegment { sequence, payload, missing, ..SEGMENT }, MARK, &mut out);
    }
    let mark = format!("{MARK:?}");
    let gap = |length: u64| format!("Gap({length}, {mark})");
    let data = |bytes: &[u8]| format!("Data({bytes:?}, {mark})");
    assert_eq!(all, [data(b"ab"), gap(3), data(b"f"), gap(1)]);
}
