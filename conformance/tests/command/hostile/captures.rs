//! Captures with many requests, with and without replies.

use std::net::SocketAddr;
use std::time::Duration;

use ads_cnc::Encode as _;
use ads_cnc::ads::{AmsAddr, AmsHeader, AmsPort, Command, FrameRef};
use ads_cnc_conformance::capture::Capture;
use ads_cnc_conformance::client::Tap as _;
use ads_cnc_conformance::simulator::NET_ID;

use super::run;
use crate::common::file::TestFile;

fn end(port: u16) -> SocketAddr {
    SocketAddr::from(([127, 0, 0, 1], port))
}

fn request(command: Command, invoke_id: u32) -> AmsHeader {
    let ams = |port| AmsAddr { net_id: NET_ID, port: AmsPort(port) };
    AmsHeader::request(ams(552), ams(0x8000), command, invoke_id)
}

fn frame(header: AmsHeader, payload: &[u8]) -> Vec<u8> {
    FrameRef::new(header, payload).unwrap().encode_to_vec().unwrap()
}

/// A capture of `count` requests on one connection, each with the reply that `answer` returns, if any.
fn captured(count: u32, answer: impl Fn(u32, &AmsHeader) -> Option<AmsHeader>) -> TestFile {
    let file = TestFile::new(".pcapng", b"");
    let mut capture = Capture::create(&file.0).unwrap();
    capture.opened(end(50_000), end(48898));
    for number in 0..count {
        let header = request(Command::READ, number);
        let payload = [0x03_u8, 0x03, 0x12, 0, 0, 0, 0, 0, 4, 0, 0, 0];
        capture.sent(&frame(header, &payload));
        if let Some(header) = answer(number, &header) {
            capture.received(&frame(header, &[0; 12]));
        }
    }
    capture.closed();
    capture.finish().unwrap();
    file
}

/// Long and short requests without replies, on one connection or on many open connections, do not use
/// too much memory.
#[test]
fn requests_without_replies_are_dropped() {
    for (connections, requests, bytes) in
        [(1, 1800_u32, 60_000_u32), (200, 1800, 60_000), (1800, 1800, 60_000), (80, 320_000, 4)]
    {
        let file = TestFile::new(".pcapng", b"");
        let mut capture = Capture::create(&file.0).unwrap();
        let mut payload = vec![0; 12 + bytes as usize];
        payload[8..12].copy_from_slice(&bytes.to_le_bytes());
        for number in 0..requests {
            if number % (requests / connections) == 0 {
                let opened = u16::try_from(number / (requests / connections)).unwrap();
                capture.opened(end(50_000 + opened), end(48898));
            }
            let header = request(Command::WRITE, number);
            capture.sent(&frame(header, &payload));
        }
        capture.finish().unwrap();
        let ended = run(&["check", file.path()]);
        let told =
            "of these dropped: more than 4096 on a connection, or 16 MiB, waited for replies";
        assert!(ended.stdout.contains(told), "{connections}: {}", ended.stdout);
    }
}

/// NC programs of more than 32 channels are not all checked, because the checks need much memory.
#[test]
fn programs_of_many_channels_are_limited() {
    let file = TestFile::new(".pcapng", b"");
    let mut capture = Capture::create(&file.0).unwrap();
    capture.opened(end(50_000), end(48898));
    for channel in 1..=35_u8 {
        let mut header = request(Command::WRITE, channel.into());
        header.target.port = AmsPort(553);
        let data = b"N10 X1\r\n";
        let address = [channel, 1, 0x12, 0, 0x90, 0, 0, 0, 8, 0, 0, 0];
        capture.sent(&frame(header, &[&address[..], data].concat()));
        capture.received(&frame(header.response(), &[0; 4]));
    }
    capture.closed();
    capture.finish().unwrap();
    let ended = run(&["check", file.path()]);
    let told = "3 packets of NC programs not checked for loops and jumps back: at most 32 channels";
    assert!(ended.stdout.contains(told), "{}", ended.stdout);
}

/// With wrong or missing replies, the check of a capture takes at most six times as long as with
/// correct ones (plus 2 s): its time does not grow with the square of the number of requests.
#[test]
fn captures_are_checked_in_linear_time() {
    type Answer = fn(u32, &AmsHeader) -> Option<AmsHeader>;
    let ways: [(&str, Answer); 5] = [
        ("answered", |_, header| Some(header.response())),
        ("not answered", |_, _| None),
        ("answered from elsewhere", |_, header| {
            let right = header.response();
            Some(AmsHeader { target: right.source, source: right.target, ..right })
        }),
        ("answered to other invoke IDs", |number, header| {
            Some(AmsHeader { invoke_id: !number, ..header.response() })
        }),
        ("answered by another command with one invoke ID", |_, header| {
            Some(AmsHeader { invoke_id: 7, command: Command::WRITE, ..header.response() })
        }),
    ];
    let mut usual = Duration::ZERO;
    for (what, answer) in ways {
        let file = captured(60_000, answer);
        let ended = run(&["check", file.path()]);
        eprintln!("{what}: {:?}, exit {:?}", ended.time, ended.code);
        assert!(ended.code.is_some_and(|code| code < 6), "{what}: {}", ended.stderr);
        if usual.is_zero() {
            usual = ended.time;
        }
        // With a linear search through the waiting requests, the check would take more than thirty
        // times as long.
        assert!(ended.time < usual * 6 + Duration::from_secs(2), "{what}: {:?}", ended.time);
    }
}

/// A packet of 4 MiB with many short messages takes no time that grows with the square of their
/// number.
#[test]
fn a_long_packet_is_split_in_linear_time() {
    let header = request(Command::READ_STATE, 1);
    let requests = "110376 frames, 0 requests with a reply";
    for (message, told) in [
        (vec![0, 0x10, 0, 0, 0, 0], "699050 messages to a local router"),
        (frame(header, &[]), requests),
    ] {
        // A pcap file of IP packets: a SYN, and then the messages. An IP length of 0 is that of the
        // rest of the record.
        let mut file = b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\0\0\x80\0\x65\0\0\0".to_vec();
        let messages = message.repeat((4 << 20) / message.len());
        for (sequence, flags, payload) in [(0_u8, 2_u8, &[][..]), (1, 0x10, &messages)] {
            let length = u32::try_from(40 + payload.len()).unwrap().to_le_bytes();
            file.extend([&[0; 8], &length[..], &length].concat());
            file.extend(b"\x45\0\0\0\0\0\0\0\x40\x06\0\0\x0a\0\0\x01\x0a\0\0\x02");
            file.extend([0xC3, 0x50, 0xBF, 2, 0, 0, 0, sequence, 0, 0, 0, 0, 0x50, flags]);
            file.extend([0xFF, 0xFF, 0, 0, 0, 0]);
            file.extend(payload);
        }
        let file = TestFile::new(".pcap", &file);
        let ended = run(&["check", file.path()]);
        assert!(ended.code.is_some_and(|code| code < 6), "{}", ended.stderr);
        assert!(ended.stdout.contains(told), "{}", ended.stdout);
        assert!(ended.time < Duration::from_secs(10), "{:?}", ended.time);
    }
}
