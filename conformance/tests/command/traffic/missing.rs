//! A capture may lack packets, or contain them in another order than they were sent. Checks that need a
//! missing packet are inconclusive, and errors elsewhere still fail.

use ads_cnc_conformance::capture::Checked;
use ads_cnc_conformance::faults::FieldDefect;
use ads_cnc_conformance::judge::Verdict;

use super::defects::written;
use super::maker::{
    Link, Message, Segment, Side, checked, checked_anywhere, passes, pcap, pcap_every, segments,
    with,
};
use super::talk::{a_little, conversation, everything};

/// Number of segments of a TCP handshake.
const SHAKE: usize = 3;

fn whole(most: usize) -> Vec<Segment> {
    segments(&conversation(None, everything), most, (u32::MAX - 5000, 7))
}

/// The conversation of a client that uses the same invoke ID for every request.
fn monotone() -> Vec<Segment> {
    let mut all: Vec<Message> = Vec::new();
    for (side, bytes) in conversation(None, everything) {
        match all.last_mut() {
            Some(last) if last.0 == side => last.1.extend(bytes),
            _ => all.push((side, bytes)),
        }
    }
    for (_, bytes) in &mut all {
        bytes[34..38].copy_from_slice(&[7, 0, 0, 0]);
    }
    segments(&all, 1460, (1, 1))
}

/// Checks that no requirement fails, and that no warning or difference is reported.
fn blames_nobody(checked: &Checked, what: &str) {
    for verdict in [Verdict::Fail, Verdict::Warning, Verdict::Differs, Verdict::HarnessError] {
        assert_eq!(with(checked, verdict), [""; 0], "{what}: {:?}", checked.tally.lines());
    }
}

fn is_open(checked: &Checked, what: &str) {
    blames_nobody(checked, what);
    assert_ne!(with(checked, Verdict::Inconclusive), [""; 0], "{what}");
}

fn without(all: &[Segment], gone: impl Fn(usize, &Segment) -> bool) -> Vec<u8> {
    let rest = all.iter().enumerate().filter(|(place, one)| !gone(*place, one));
    pcap(&rest.map(|(_, one)| one.clone()).collect::<Vec<_>>(), Link::Raw)
}

/// Pseudo-random numbers that are the same each time.
fn chance(state: &mut u64) -> u64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    *state >> 33
}

fn shuffled(all: &[Segment], from: usize, seed: u64) -> Vec<Segment> {
    let mut state = seed;
    let mut mixed = all.to_vec();
    for part in mixed[from..].chunks_mut(8) {
        for place in (1..part.len()).rev() {
            let other = usize::try_from(chance(&mut state)).unwrap() % (place + 1);
            part.swap(place, other);
        }
    }
    mixed
}

#[test]
fn one_packet_may_be_missing() {
    let all = whole(1460);
    let exchanges = checked(&without(&all, |_, _| false)).tally.exchanges;
    for gone in (SHAKE..all.len()).step_by(9).chain([SHAKE, all.len() - 2, all.len() - 1]) {
        let what = format!("without {gone}, a packet of the {:?}", all[gone].side);
        let checked = checked(&without(&all, |place, _| place == gone));
        // If the last segment is missing, no later segment reveals the gap.
        if gone + 1 == all.len() {
            blames_nobody(&checked, &what);
        } else {
            is_open(&checked, &what);
            assert_eq!(checked.tally.gaps, 1, "{what}");
        }
        assert_eq!(checked.tally.exchanges + 1, exchanges, "{what}");
        blames_nobody(&checked_anywhere(&without(&all, |place, _| place == gone)), &what);
    }
}

#[test]
fn packets_of_the_handshake_may_be_missing() {
    let all = whole(1460);
    for gone in [&[0][..], &[1], &[2], &[0, 1], &[1, 2], &[0, 1, 2], &[1, 3], &[0, 4], &[1, 2, 4]] {
        let checked = checked(&without(&all, |place, _| gone.contains(&place)));
        blames_nobody(&checked, &format!("without {gone:?}"));
        assert!(checked.tally.exchanges > 100, "{gone:?}");
    }
}

#[test]
fn several_packets_may_be_missing() {
    let all = whole(700);
    for (every, length) in [(5, 1), (39, 1), (41, 2), (97, 9), (150, 80)] {
        for side in [None, Some(Side::Client), Some(Side::Cnc)] {
            let gone = |place: usize, one: &Segment| {
                place >= SHAKE && place % every < length && side.is_none_or(|side| side == one.side)
            };
            is_open(&checked(&without(&all, gone)), &format!("{length} of {every}, {side:?}"));
        }
    }
}

/// If all requests have the same invoke ID and packets are missing, a reply is not matched with a wrong
/// request.
#[test]
fn all_requests_may_have_the_same_invoke_id() {
    let all = monotone();
    let none = checked(&without(&all, |_, _| false));
    passes(&none);
    for gone in (SHAKE..all.len() - 2).step_by(17) {
        let checked = checked(&without(&all, |place, _| place == gone || place == gone + 20));
        is_open(&checked, &format!("without {gone}"));
        assert!(checked.tally.exchanges + 6 > none.tally.exchanges, "{gone}");
    }
    for seed in 0..4 {
        let mixed = shuffled(&all, SHAKE, seed);
        let checked = checked(&pcap(&mixed, Link::Raw));
        passes(&checked);
        assert_eq!(checked.tally.exchanges, none.tally.exchanges, "{seed}");
    }
}

#[test]
fn a_side_may_be_missing() {
    let all = whole(1460);
    for (side, case) in [(Side::Client, "cap-client-frames"), (Side::Cnc, "cap-cnc-frames")] {
        // The capture also lacks the first `from` segments: none, the handshake, or more.
        for from in [0, SHAKE, 50] {
            let file = without(&all, |place, one| one.side == side || place < from);
            for checked in [checked(&file), checked_anywhere(&file)] {
                is_open(&checked, &format!("without the {side:?}"));
                assert_eq!(checked.tally.exchanges, 0);
                let open = with(&checked, Verdict::Inconclusive);
                assert!(open.contains(&format!("{case} ADS-5")), "{open:?}");
            }
        }
    }
}

#[test]
fn neighbouring_packets_may_be_swapped() {
    let all = whole(1460);
    let exchanges = checked(&without(&all, |_, _| false)).tally.exchanges;
    for first in [SHAKE, SHAKE + 1] {
        let mut mixed = all.clone();
        mixed[first..].chunks_exact_mut(2).for_each(|two| two.swap(0, 1));
        let checked = checked(&pcap(&mixed, Link::Raw));
        passes(&checked);
        assert_eq!(checked.tally.exchanges, exchanges);
    }
}

#[test]
fn packets_may_be_shuffled() {
    for most in [1460, 100] {
        let all = whole(most);
        let exchanges = checked(&without(&all, |_, _| false)).tally.exchanges;
        for seed in 0..6 {
            let checked = checked(&pcap(&shuffled(&all, SHAKE, seed), Link::Raw));
            passes(&checked);
            assert_eq!((checked.tally.exchanges, checked.tally.gaps), (exchanges, 0), "{seed}");
            // If the handshake is shuffled, too, the beginning of the connection is unknown.
            let from = self::checked(&pcap(&shuffled(&all, 0, seed), Link::Raw));
            blames_nobody(&from, &format!("shuffled by {seed}"));
            assert!(from.tally.exchanges + 8 > exchanges, "{seed}");
        }
        let holed: Vec<Segment> = all
            .iter()
            .enumerate()
            .filter(|(place, _)| place % 50 != 49)
            .map(|(_, one)| one.clone())
            .collect();
        for seed in 0..6 {
            let checked = checked(&pcap(&shuffled(&holed, SHAKE, seed), Link::Raw));
            is_open(&checked, &format!("shuffled by {seed}, and not whole"));
        }
    }
}

/// A request may depend on a rejection or a read that a gap contains, so the request does not fail.
#[test]
fn preceding_packets_may_be_missing() {
    let talk = |writes: &[(u32, &[u8], u32)], gone: &[usize]| {
        let all: Vec<Message> =
            writes.iter().flat_map(|(to, data, result)| written(*to, data, *result)).collect();
        checked(&without(&segments(&all, 1460, (1, 1)), |place, _| gone.contains(&place)))
    };
    let stream: [(u32, &[u8], u32); 4] = [
        (0x90, b"N10 X1\r\n", 0x706),
        (0x90, b"N10 X1\r\n", 0),
        (0x90, b"N20 X2\r\n", 0),
        (0x90, b"N30 X3\r\n", 0),
    ];
    assert_eq!(with(&talk(&stream, &[]), Verdict::Fail), [""; 0]);
    is_open(&talk(&stream, &[SHAKE + 2]), "the request");
    is_open(&talk(&stream, &[SHAKE + 3]), "the reply");
    is_open(&talk(&stream, &[SHAKE + 2, SHAKE + 3]), "both");
    let service: [(u32, &[u8], u32); 3] = [
        (0x90, b"N10 X1\r\n", 0),
        (0x4A, b"V.G.SERVICE.RESPONSE\x001.732051\0", 0),
        (0x4A, b"V.G.SERVICE.RESPONSE_STATE\0\x01\0\0\0", 0),
    ];
    assert_eq!(with(&talk(&service, &[]), Verdict::Fail), ["cap-client-service SVC-2"]);
    is_open(&talk(&service, &[SHAKE, SHAKE + 1]), "what was read");
}

/// A reply without a request fails in a complete capture, also if packets are out of order.
#[test]
fn a_reply_without_a_request_fails() {
    let mut talk = conversation(None, everything);
    let twice = talk.iter().position(|(side, _)| *side == Side::Cnc).unwrap();
    talk.insert(twice + 40, talk[twice].clone());
    let all = segments(&talk, 1460, (1, 1));
    for (seed, mixed) in
        [all.clone(), shuffled(&all, SHAKE, 1), shuffled(&all, SHAKE, 2)].iter().enumerate()
    {
        let checked = checked(&pcap(mixed, Link::Raw));
        assert_eq!(with(&checked, Verdict::Fail), ["cap-cnc-frames ADS-5"], "{seed}");
        assert_eq!(checked.tally.unasked, 1);
    }
    // Repeats a reply more often than the judge stores replies.
    let many: Vec<Message> = std::iter::repeat_n(talk[twice].clone(), 20_000).collect();
    talk.splice(twice..twice, many);
    let checked = checked(&pcap(&segments(&talk, 1460, (1, 1)), Link::Raw));
    assert_eq!(with(&checked, Verdict::Fail), ["cap-cnc-frames ADS-5"]);
    assert_eq!(checked.tally.unasked, 20_001);
}

/// A request without a reply fails if the capture continues long enough after the request.
#[test]
fn a_request_without_a_reply_fails() {
    let mut talk = conversation(None, everything);
    let silent = talk.iter().rposition(|(side, bytes)| *side == Side::Cnc && bytes.len() < 100);
    let silent = silent.unwrap() - 100;
    let silent = (silent..).find(|&place| talk[place].0 == Side::Cnc).unwrap();
    talk.remove(silent);
    let all = segments(&talk, 1460, (1, 1));
    for mixed in [all.clone(), shuffled(&all, SHAKE, 1), shuffled(&all, SHAKE, 2)] {
        let checked = checked(&pcap_every(&mixed, Link::Raw, 200));
        let failed = with(&checked, Verdict::Fail);
        assert!(failed.len() == 1 && failed[0].starts_with("cap-cnc-services ADS-"), "{failed:?}");
        assert_eq!(checked.tally.unanswered, 1);
    }
    // The missing reply may be in a gap, so a request before a gap is inconclusive, even if the
    // CNC really did not reply.
    let cut = without(&all, |place, _| place == all.len() - 20);
    blames_nobody(&checked(&cut), "a gap behind it");
    let lone: Vec<Segment> = all[..=SHAKE].to_vec();
    blames_nobody(&checked(&pcap_every(&lone, Link::Raw, 60_000)), "nothing behind it");
}

/// These defects are detected in some other orders of the packets too.
#[test]
fn defects_fail_in_any_order() {
    for (defect, requirement) in [
        ("ams-header.invoke_id.flip", "ADS-5"),
        ("ams-header.source_port.flip", "ADS-5"),
        ("ams-header.command.flip", "ADS-5"),
        ("read-write-reply.length.flip", "ADS-3"),
    ] {
        let talk = conversation(FieldDefect::by_id(defect).as_ref(), a_little);
        let all = segments(&talk, 1460, (1, 1));
        for seed in 0..3 {
            let checked = checked(&pcap(&shuffled(&all, SHAKE, seed), Link::Raw));
            let failed = with(&checked, Verdict::Fail);
            let is_named = |one: &String| one.starts_with("cap-cnc-") && one.ends_with(requirement);
            assert!(failed.iter().any(is_named), "{defect} {seed}: {failed:?}");
        }
    }
}
