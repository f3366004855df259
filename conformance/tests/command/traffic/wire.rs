//! The verdicts do not depend on how a conversation is split into packets, and missing bytes are reported.

use ads_cnc_conformance::capture::{CaptureOptions, Collector, FileEnd, FileError, Ports, check};
use ads_cnc_conformance::judge::Verdict;

use super::maker::{
    Link, Message, Segment, Side, checked, checked_anywhere, passes, pcap, segments, sum, with,
};
use super::talk::{conversation as talk, everything, recorded};

fn conversation() -> Vec<Message> {
    talk(None, everything)
}

#[test]
fn links_do_not_matter() {
    let all = conversation();
    let expected = sum(&checked(&recorded(None, everything)));
    for link in Link::ALL {
        let checked = checked(&pcap(&segments(&all, 1460, (1, 1)), link));
        passes(&checked);
        assert_eq!(sum(&checked), expected, "{link:?}");
        assert_eq!(checked.tally.unreadable, 0, "{link:?}");
    }
}

#[test]
fn segments_do_not_matter() {
    let all = conversation();
    let expected = sum(&checked(&pcap(&segments(&all, 1460, (1, 1)), Link::Raw)));
    // Some of these sequence numbers wrap around.
    for (most, begin) in [
        (1, (1, 1)),
        (3, (u32::MAX - 100, u32::MAX)),
        (7, (0, 5)),
        (37, (0x7FFF_FF00, 0xFFFF_FF00)),
    ] {
        let checked = checked(&pcap(&segments(&all, most, begin), Link::Raw));
        passes(&checked);
        assert_eq!(sum(&checked), expected, "{most}");
    }
}

/// Neighbouring segments of the same side may be swapped, and segments may be repeated or split in
/// another way.
#[test]
fn order_does_not_matter() {
    let all = conversation();
    let straight = segments(&all, 11, (1, 1));
    let expected = sum(&checked(&pcap(&straight, Link::Raw)));
    let mut mixed: Vec<Segment> = Vec::new();
    for (place, segment) in straight.iter().enumerate() {
        if place % 5 == 4 && place + 1 < straight.len() {
            let next = &straight[place + 1];
            if next.side == segment.side && !next.syn {
                mixed.push(next.clone());
            }
        }
        mixed.push(segment.clone());
        if place % 7 == 3 {
            let mut again = segment.clone();
            // The repeated segment also contains the bytes of the next segment.
            if let Some(next) = straight.get(place + 1).filter(|next| next.side == again.side) {
                again.payload.extend(&next.payload);
            }
            mixed.push(again);
        }
    }
    let checked = checked(&pcap(&mixed, Link::Ethernet));
    passes(&checked);
    assert_eq!(sum(&checked), expected);
    assert!(checked.tally.repeated > 10 && checked.tally.early > 10);
}

#[test]
fn any_port_is_found() {
    let all = conversation();
    let mut segments = segments(&all, 1460, (1, 1));
    segments.iter_mut().for_each(|segment| segment.port = 12345);
    let file = pcap(&segments, Link::Raw);
    let unasked = checked(&file);
    assert_eq!((unasked.tally.frames, passes(&unasked)), (0, 0));
    let found = checked_anywhere(&file);
    assert!(passes(&found) > 50);
    assert_eq!(found.tally.exchanges * 2, found.tally.frames);
    // A connection of another protocol is ignored.
    let other = vec![(Side::Client, b"GET / HTTP/1.1\r\n\r\n".to_vec()), (Side::Cnc, vec![0; 900])];
    let other = checked_anywhere(&pcap(&self::segments(&other, 100, (1, 1)), Link::Raw));
    assert_eq!((other.tally.frames, passes(&other)), (0, 0));
}

/// A capture may begin in the middle of a frame.
#[test]
fn the_beginning_may_be_missing() {
    let all = conversation();
    let whole = segments(&all, 1460, (1, 1));
    for cut in [3, 4, 20, 21, 51] {
        let mut rest = whole[cut..].to_vec();
        if let Some(first) = rest.first_mut() {
            let gone = 5.min(first.payload.len());
            first.payload.drain(..gone);
            first.sequence = first.sequence.wrapping_add(u32::try_from(gone).unwrap());
        }
        let checked = checked(&pcap(&rest, Link::Raw));
        assert!(passes(&checked) > 40, "{cut}");
        assert_eq!(checked.tally.joined, 1, "{cut}");
        assert!(checked.tally.skipped > 0, "{cut}");
    }
}

/// With gaps in a capture, only checks that need missing bytes are inconclusive.
#[test]
fn gaps_are_inconclusive() {
    let all = conversation();
    let whole = segments(&all, 1460, (1, 1));
    let place = whole.iter().rposition(|one| one.side == Side::Cnc && one.payload.len() > 100);
    let mut holed = whole.clone();
    holed.remove(place.unwrap());
    let checked = checked(&pcap(&holed, Link::Raw));
    assert_eq!(checked.tally.gaps, 1);
    assert_eq!(with(&checked, Verdict::Fail), [""; 0]);
    let open = with(&checked, Verdict::Inconclusive);
    assert!(open.contains(&"cap-cnc-frames ADS-5".to_owned()), "{open:?}");
    assert!(open.len() <= 3, "{open:?}");
}

/// If a snap length truncates a reply, the requirement of its function is inconclusive.
#[test]
fn a_snap_length_makes_replies_inconclusive() {
    let all = conversation();
    let mut cut = segments(&all, 1460, (1, 1));
    let large = cut.iter_mut().find(|one| one.side == Side::Cnc && one.payload.len() > 130);
    large.unwrap().snap = Some(96);
    let checked = checked(&pcap(&cut, Link::Raw));
    assert_eq!(with(&checked, Verdict::Fail), [""; 0]);
    let open = with(&checked, Verdict::Inconclusive);
    assert!(open.contains(&"cap-cnc-com COM-2".to_owned()), "{open:?}");
    assert_eq!(checked.tally.gaps, 1);
}

/// A capture file that is truncated anywhere is judged up to the truncation, without failures.
#[test]
fn a_file_may_end_anywhere() {
    let all = conversation();
    let files = [
        pcap(&segments(&all[..12], 50, (1, 1)), Link::Sll),
        recorded(None, |session| {
            let channel = ads_cnc::address::Channel::new(1).unwrap();
            for _ in 0..3 {
                let count = ads_cnc::operation::CountObjects::new(channel);
                assert!(session.call(&count).is_ok());
            }
        }),
    ];
    for file in files {
        for length in 0..file.len() {
            match check(&file[..length], CaptureOptions::default()) {
                Ok(checked) => {
                    passes(&checked);
                    let end = checked.tally.end.clone().unwrap();
                    let told = checked
                        .tally
                        .lines()
                        .iter()
                        .any(|line| line.contains("the file was judged only in part"));
                    assert_eq!(told, end != FileEnd::Whole);
                }
                Err(error) => {
                    assert!(matches!(error, FileError::Empty | FileError::Format), "{error}");
                    assert!(length < 120, "{length}: {error}");
                }
            }
        }
    }
}

/// A changed byte anywhere in a file does not cause a panic.
#[test]
fn hostile_files_are_read() {
    let all = conversation();
    let file = pcap(&segments(&all[..6], 60, (1, 1)), Link::Ethernet);
    let pcapng = recorded(None, |session| {
        let channel = ads_cnc::address::Channel::new(1).unwrap();
        let _ = session.call(&ads_cnc::operation::CountObjects::new(channel)).is_ok();
    });
    for file in [file, pcapng] {
        for place in 0..file.len() {
            for value in [0, 0x7F, 0xFF] {
                let mut spoilt = file.clone();
                spoilt[place] = value;
                // Any result is valid; only a panic fails the test.
                let _ = check(&spoilt[..], CaptureOptions::default()).is_ok();
                let anywhere =
                    CaptureOptions { ports: Ports::Any, vectors: Some(Collector::new(false)) };
                let _ = check(&spoilt[..], anywhere).is_ok();
            }
        }
    }
}

/// A pcapng block that is shorter than its fields, or than its data, ends the file, in both byte
/// orders.
#[test]
fn a_block_shorter_than_its_fields_ends_a_file() {
    for little in [true, false] {
        let number = |one: u32| if little { one.to_le_bytes() } else { one.to_be_bytes() };
        // The major version 1 has two bytes.
        let version = if little { 1 } else { 0x1_0000 };
        let header = [0x0A0D_0D0A, 28, 0x1A2B_3C4D, version];
        for block in [
            &[0x8000_0001, 0, 0, 0, 0, 0, 0, 0][..],
            &[0x8000_0001, 11, 0, 0, 0, 0, 0, 0],
            &[0x8000_0001, 15, 0, 0, 0, 0, 0, 0],
            // An enhanced packet and a decryption secret with more data than the block, and name
            // resolutions without an end.
            &[6, 32, 0, 0, 0, 1, 0, 32],
            &[6, 32, 0, 0, 0, u32::MAX, 0, 32],
            &[10, 20, 0, 1, 20, 0, 0, 0],
            &[4, 12, 12, 0, 0, 0, 0, 0],
        ] {
            let all = [&header[..], &[u32::MAX, u32::MAX, 28], block].concat();
            let file: Vec<u8> = all.into_iter().flat_map(number).collect();
            let end = check(&file[..], CaptureOptions::default()).unwrap().tally.end.unwrap();
            let cut = "bytes that are not a record, after packet 0".to_owned();
            assert_eq!(end, FileEnd::Cut(cut), "{block:x?}");
        }
    }
}

/// A conversation with the simulated CNC passes on both sides.
#[test]
fn recorded_conversations_pass() {
    let checked = checked(&recorded(None, everything));
    assert!(passes(&checked) > 50);
    assert_eq!(checked.tally.exchanges * 2, checked.tally.frames);
    assert_eq!(checked.tally.gaps, 0);
}
