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
