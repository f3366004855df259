//! Captures as ADS Monitor writes them: AMS frames in EtherCAT frames, and NetMon 2.x files.
//!
//! No file of the real ADS Monitor was available for these tests; `.ci/wireshark` converts a
//! capture to such a file with a script and `editcap`.

use ads_cnc::ads::FrameRef;
use ads_cnc_conformance::capture::{CaptureOptions, FileEnd, FileError, check};
use ads_cnc_conformance::faults::FieldDefect;
use ads_cnc_conformance::judge::Verdict;

use super::maker::{Link, Message, Side, checked, passes, pcap, segments, sum, with};
use super::talk::{conversation, everything};

/// The AMS frames of a conversation in the order in which they were sent, without AMS/TCP headers.
fn frames(messages: &[Message]) -> Vec<Vec<u8>> {
    let mut begun = [Vec::new(), Vec::new()];
    let mut all = Vec::new();
    for (side, bytes) in messages {
        let begun = &mut begun[usize::from(*side == Side::Cnc)];
        begun.extend(bytes);
        while let Ok(Some((_, length))) = FrameRef::split(begun, u32::MAX) {
            all.push(begun.drain(..length).skip(6).collect());
        }
    }
    all
}

/// An Ethernet frame that contains an AMS frame, padded to the minimum length.
fn packet(ams: &[u8], tag: &[u8]) -> Vec<u8> {
    let mut packet = vec![1, 1, 5, 1, 0, 0, 2, 0, 0, 0, 0, 1];
    packet.extend(tag);
    packet.extend([0x88, 0xA4]);
    let length = u16::try_from(ams.len() & 0x7FF).unwrap();
    packet.extend((length | 2 << 12).to_le_bytes());
    packet.extend(ams);
    packet.resize(packet.len().max(60), 0xEE);
    packet
}

fn packets(ams: &[Vec<u8>]) -> Vec<Vec<u8>> {
    ams.iter().map(|ams| packet(ams, &[])).collect()
}

/// A pcap file with one packet every `millis` milliseconds.
fn pcap_of(packets: &[Vec<u8>], millis: usize) -> Vec<u8> {
    let mut file = pcap(&[], Link::Ethernet);
    for (place, packet) in packets.iter().enumerate() {
        let millis = place * millis;
        let length = u32::try_from(packet.len()).unwrap();
        file.extend((1_700_000_000 + u32::try_from(millis / 1000).unwrap()).to_le_bytes());
        file.extend(u32::try_from(millis % 1000 * 1000).unwrap().to_le_bytes());
        file.extend([length.to_le_bytes(), length.to_le_bytes()].concat());
        file.extend(packet);
    }
    file
}

/// The first `number` frames of a conversation: requests of one client, each followed by its reply.
fn first(number: usize) -> Vec<Vec<u8>> {
    let mut all = frames(&conversation(None, everything));
    all.truncate(number);
    all
}

/// A NetMon 2 file with one packet per millisecond.
fn netmon(packets: &[Vec<u8>], minor: u8) -> Vec<u8> {
    let trailer: &[u8] = match minor {
        0 => &[],
        1 => &[1, 0],
        2 => &[1, 0, 9, 9, 9, 9],
        _ => &[1, 0, 9, 9, 9, 9, 8, 8, 8, 8, 8, 8, 8, 8, 7],
    };
    let mut file = b"GMBU".to_vec();
    file.extend([minor, 2, 1, 0]);
    file.extend([2026_u16, 11, 4, 26, 9, 30, 0, 0].map(u16::to_le_bytes).concat());
    file.resize(128, 0);
    let mut table = Vec::new();
    for (place, packet) in packets.iter().enumerate() {
        table.extend(u32::try_from(file.len()).unwrap().to_le_bytes());
        file.extend((place as u64 * 1000).to_le_bytes());
        let length = u32::try_from(packet.len()).unwrap();
        file.extend([length.to_le_bytes(), length.to_le_bytes()].concat());
        file.extend(packet);
        file.extend(trailer);
    }
    let offset = u32::try_from(file.len()).unwrap();
    file[24..28].copy_from_slice(&offset.to_le_bytes());
    file[28..32].copy_from_slice(&u32::try_from(table.len()).unwrap().to_le_bytes());
    file.extend(table);
    file
}

/// The verdicts and the number of checks are the same as for the same conversation over TCP.
#[test]
fn without_tcp_the_verdicts_are_the_same() {
    let talk = conversation(None, everything);
    let expected = sum(&checked(&pcap(&segments(&talk, 1460, (1, 1)), Link::Ethernet)));
    let ams = frames(&talk);
    let tagged: Vec<_> = ams.iter().map(|ams| packet(ams, &[0x81, 0, 0, 7])).collect();
    let mut files = vec![pcap_of(&packets(&ams), 1), pcap_of(&tagged, 1)];
    files.extend((0..4).map(|minor| netmon(&packets(&ams), minor)));
    for (place, file) in files.iter().enumerate() {
        let checked = checked(file);
        passes(&checked);
        assert_eq!(sum(&checked), expected, "{place}");
        assert_eq!(checked.tally.ethercat, ams.len() as u64, "{place}");
        assert_eq!(checked.tally.end, Some(FileEnd::Whole), "{place}");
    }
}

#[test]
fn without_tcp_defects_fail() {
    for (defect, requirement) in [
        ("variable-description.access.invert", "VAR-6"),
        ("object-descriptor.size.flip", "COM-5"),
        ("read-write-reply.length.flip", "ADS-3"),
        ("ams-header.source_port.flip", "ADS-5"),
        ("ams-header.command.flip", "ADS-5"),
    ] {
        let talk = conversation(FieldDefect::by_id(defect).as_ref(), everything);
        let failed = with(&checked(&netmon(&packets(&frames(&talk)), 0)), Verdict::Fail);
        let is_named = |one: &String| one.starts_with("cap-cnc-") && one.ends_with(requirement);
        assert!(failed.iter().any(is_named), "{defect}: {failed:?}");
    }
}

/// A capture may begin with replies to requests before its beginning. A request without a reply
/// fails if the capture continues long enough after the request.
#[test]
fn a_capture_may_begin_anywhere() {
    let ams = first(12);
    for begin in 1..6 {
        passes(&checked(&pcap_of(&packets(&ams[begin..]), 1)));
    }
    let mut late = ams.clone();
    late.swap(0, 1);
    passes(&checked(&pcap_of(&packets(&late), 1)));
    let silent = [&ams[..3], &ams[4..]].concat();
    let failed = with(&checked(&pcap_of(&packets(&silent), 6000)), Verdict::Fail);
    assert!(failed.len() == 1 && failed[0].starts_with("cap-cnc-services ADS-"), "{failed:?}");
}

/// Requests of different clients may have the same invoke ID, but one client must not use an invoke ID
/// again before the reply.
#[test]
fn each_client_has_its_own_invoke_ids() {
    // The offset of the client's AMS port: the source of a request, and the target of a reply.
    let port = |frame: &[u8]| if frame[18] == 4 { 14 } else { 6 };
    let ams = first(12);
    for distance in [0_u8, 1] {
        let mut all = ams.clone();
        for frame in &mut all {
            let at = port(frame);
            frame[at] = 1;
        }
        // The second request has the invoke ID of the first and is sent before the reply to the first.
        let id = all[0][28..32].to_vec();
        for frame in &mut all[2..4] {
            frame[28..32].copy_from_slice(&id);
            let at = port(frame);
            frame[at] += distance;
        }
        all.swap(1, 2);
        let differs = with(&checked(&pcap_of(&packets(&all), 1)), Verdict::Differs);
        let expected: &[_] = if distance == 0 { &["cap-client-frames ADS-5"] } else { &[] };
        assert_eq!(differs, expected);
    }
}

/// A truncated frame is inconclusive, and a packet with truncated headers is counted.
#[test]
fn a_frame_may_be_truncated() {
    let mut all = packets(&first(6));
    let last = all[3].len() - 1;
    all[3].truncate(last.min(16 + 32));
    all.push(all[0][..40].to_vec());
    // A packet with EtherCAT process data, which is not an AMS frame.
    all.push([&all[0][..14], &[0x10, 0x10], &[0; 44][..]].concat());
    let checked = checked(&pcap_of(&all, 1));
    assert_eq!(with(&checked, Verdict::Fail), [""; 0]);
    assert!(!with(&checked, Verdict::Inconclusive).is_empty());
    assert_eq!(checked.tally.unreadable, 1);
}

#[test]
fn a_netmon_file_may_end_anywhere() {
    let all = packets(&first(6));
    for minor in [0, 3] {
        let file = netmon(&all, minor);
        for length in 0..file.len() {
            match check(&file[..length], CaptureOptions::default()) {
                Ok(checked) => {
                    assert_eq!(with(&checked, Verdict::Fail), [""; 0], "{length}");
                    assert!(matches!(checked.tally.end, Some(FileEnd::Cut(_))), "{length}");
                }
                Err(error) => {
                    assert!(matches!(error, FileError::Empty | FileError::Format), "{error}");
                    assert!(length < 4, "{length}: {error}");
                }
            }
        }
        for place in 0..file.len() {
            for value in [0, 0x7F, 0xFF] {
                let mut spoilt = file.clone();
                spoilt[place] = value;
                // Any result is valid; only a panic fails the test.
                let _ = check(&spoilt[..], CaptureOptions::default()).is_ok();
            }
        }
    }
}

/// Packets that a NetMon file lacks are detected with its frame table, and wrong counts in the file have
/// no effect.
#[test]
fn a_netmon_file_is_compared_with_its_frame_table() {
    let all = packets(&first(6));
    let file = netmon(&all, 0);
    let end = |file: &[u8]| match check(file, CaptureOptions::default()) {
        Ok(checked) => match checked.tally.end {
            Some(FileEnd::Cut(why)) => why,
            other => format!("{other:?}"),
        },
        Err(error) => error.to_string(),
    };
    let mut other = file.clone();
    let place = other.len() - 4;
    other[place] ^= 1;
    assert_eq!(
        end(&other),
        "the frame table lists 6 packets, but 6 consecutive ones were found; convert the file \
         with editcap -F pcapng"
    );
    let mut long = file.clone();
    long[128 + 12..128 + 16].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(end(&long), "packet 1: 4294967295 bytes, more than the maximum of 8388608");
    let mut old = file;
    old[..6].copy_from_slice(b"RTSS\x01\x01");
    assert_eq!(end(&old), "NetMon 1.1 instead of 2.x; convert it with editcap -F pcapng");
}
