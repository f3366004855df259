//! A capture that the tools write contains exactly the bytes of their connections. `.ci/wireshark` reads
//! such a capture with Wireshark.

use std::fs;
use std::net::SocketAddr;
use std::sync::Arc;

use crate::common::ads_cnc;
use crate::common::file::TestFile;
use ads_cnc::Kind;
use ads_cnc::address::Channel;
use ads_cnc::operation::{CountVariables, ReadByName, Request};
use ads_cnc_conformance::capture::Capture;
use ads_cnc_conformance::client::{Client, Target};
use ads_cnc_conformance::gate::Gate;
use ads_cnc_conformance::net;
use ads_cnc_conformance::simulator::{Cnc, Server};
use pcap_parser::pcapng::Block;
use pcap_parser::{Linktype, PcapBlockOwned, PcapError, create_reader};

/// A TCP connection of a capture: the bytes in each direction, and the ports of client and server.
#[derive(Debug, Default)]
struct Flow {
    ports: (u16, u16),
    sent: Vec<u8>,
    received: Vec<u8>,
}

fn word(bytes: &[u8], at: usize) -> u16 {
    u16::from_be_bytes([bytes[at], bytes[at + 1]])
}

fn long(bytes: &[u8], at: usize) -> u32 {
    u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap())
}

/// The ones' complement sum of these parts: all bits are 1 if the Internet checksum in the parts is
/// correct.
fn sum(parts: &[&[u8]]) -> u16 {
    let bytes = parts.concat();
    let words = bytes.chunks(2).map(|two| [two[0], *two.get(1).unwrap_or(&0)]);
    let mut sum: u32 = words.map(|two| u32::from(u16::from_be_bytes(two))).sum();
    while sum > 0xFFFF {
        sum = (sum & 0xFFFF) + (sum >> 16);
    }
    sum as u16
}

/// The packets of a capture; checks that they are complete and in the order of their times.
pub(crate) fn packets(capture: &[u8]) -> Vec<Vec<u8>> {
    let mut reader = create_reader(1 << 20, capture).unwrap();
    let (mut packets, mut last) = (Vec::new(), (0, 0));
    loop {
        let (len, block) = match reader.next() {
            Ok(block) => block,
            Err(PcapError::Eof) => return packets,
            Err(PcapError::Incomplete(_)) => {
                reader.refill().unwrap();
                continue;
            }
            Err(error) => panic!("{error:?}"),
        };
        let PcapBlockOwned::NG(block) = block else { panic!("not pcapng") };
        match block {
            Block::SectionHeader(_) => {}
            Block::InterfaceDescription(one) => assert_eq!(one.linktype, Linktype::ETHERNET),
            Block::EnhancedPacket(packet) => {
                let time = (packet.ts_high, packet.ts_low);
                let (len, given) = (packet.origlen as usize, packet.caplen as usize);
                assert!(time >= last && len == given);
                last = time;
                packets.push(packet.data[..len].to_vec());
            }
            other => panic!("{other:?}"),
        }
        reader.consume(len);
    }
}

/// Reassembles the connections of a capture and checks every header.
fn flows(capture: &[u8]) -> Vec<Flow> {
    let (mut flows, mut numbers): (Vec<Flow>, (u32, u32)) = (Vec::new(), (0, 0));
    for packet in packets(capture) {
        let (ethernet, ip) = packet.split_at(14);
        let tcp = match (word(ethernet, 12), ip[0] >> 4) {
            (0x0800, 4) => {
                assert_eq!((usize::from(word(ip, 2)), ip[9]), (ip.len(), 6));
                assert_eq!(sum(&[&ip[..20]]), 0xFFFF);
                let length = (word(ip, 2) - 20).to_be_bytes();
                assert_eq!(sum(&[&ip[12..20], &[0, 6], &length, &ip[20..]]), 0xFFFF);
                &ip[20..]
            }
            (0x86DD, 6) => {
                assert_eq!((usize::from(word(ip, 4)) + 40, ip[6]), (ip.len(), 6));
                let length = word(ip, 4).to_be_bytes();
                let pseudo = [&[0, 0], &length[..], &[0, 0, 0, 6]].concat();
                assert_eq!(sum(&[&ip[8..40], &pseudo, &ip[40..]]), 0xFFFF);
                &ip[40..]
            }
            other => panic!("{other:?}"),
        };
        let (ports, flags, data) = ((word(tcp, 0), word(tcp, 2)), tcp[13], &tcp[20..]);
        if flags == 2 {
            flows.push(Flow { ports, ..Flow::default() });
            numbers = (long(tcp, 4), 0);
        }
        let flow = flows.last_mut().unwrap();
        let outgoing = ports == flow.ports;
        assert!(outgoing || ports == (flow.ports.1, flow.ports.0));
        let (own, other) = match outgoing {
            true => (&mut numbers.0, numbers.1),
            false => (&mut numbers.1, numbers.0),
        };
        assert_eq!(long(tcp, 4), *own);
        assert!(flags & 0x10 == 0 || long(tcp, 8) == other);
        *own += data.len() as u32 + u32::from(flags & 3 != 0);
        let bytes = if outgoing { &mut flow.sent } else { &mut flow.received };
        bytes.extend(data);
    }
    flows
}

/// Compares the captured connection of a client with the client's own record of its exchanges.
fn conversation(listen: SocketAddr) {
    let cnc = Arc::new(Cnc::with_default_model().unwrap());
    let server = Server::start(net::listen(listen).unwrap(), cnc).unwrap();
    let file = TestFile::new(".pcapng", b"");
    let target = Target::local(server.addr(), server.net_id());
    let client = Client::connect(target, Gate::queries()).unwrap();
    let mut client = client.with_capture(Capture::create(&file.0).unwrap());
    let channel = Channel::new(1).unwrap();
    let (mut sent, mut received) = (Vec::new(), Vec::new());
    let requests: [Request<'_>; 3] = [
        CountVariables::new(channel, Kind::V_E).into(),
        // This value does not fit into one TCP segment.
        ReadByName::new(channel, "V.E.largest").unwrap().into(),
        ReadByName::new(channel, "V.E.no such variable").unwrap().into(),
    ];
    for request in requests {
        let mut buf = [0; 256];
        let exchange = client.call(&request.encode(&mut buf).unwrap());
        sent.extend(&exchange.sent);
        received.extend(&exchange.received);
    }
    client.end_capture().unwrap();
    let flows = flows(&fs::read(&file.0).unwrap());
    assert_eq!(flows.len(), 1);
    assert_eq!(flows[0].ports.1, server.addr().port());
    assert!(received.len() > 2048);
    assert_eq!((&flows[0].sent, &flows[0].received), (&sent, &received));
}

#[test]
fn a_capture_contains_the_exchanges_of_a_client() {
    conversation(SocketAddr::from(([127, 0, 0, 1], 0)));
    conversation(SocketAddr::from(([0, 0, 0, 0, 0, 0, 0, 1], 0)));
}

/// The capture contains every frame of a run, including the queries before the first case.
#[test]
fn a_run_is_captured_completely() {
    let capture = TestFile::new(".pcapng", b"");
    let output = ads_cnc(&["run", "--only", "COM", "--json", "-", "--capture", capture.path()]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let flows = flows(&fs::read(&capture.0).unwrap());
    let frames = |bytes: &[u8]| {
        let (mut rest, mut count) = (bytes, 0);
        while !rest.is_empty() {
            assert_eq!(rest[..2], [0, 0]);
            let length = u32::from_le_bytes(rest[2..6].try_into().unwrap()) as usize;
            rest = &rest[6 + length..];
            count += 1;
        }
        count
    };
    let sent: u64 = flows.iter().map(|flow| frames(&flow.sent)).sum();
    let received: u64 = flows.iter().map(|flow| frames(&flow.received)).sum();
    assert!(sent >= report["frames"].as_u64().unwrap(), "{sent}");
    assert_eq!(sent, received);
}
