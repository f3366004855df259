//! Reads messages from captures of the tools, and creates pcap files from messages, with several
//! link types and lengths of segments.

use ads_cnc_conformance::capture::{CaptureOptions, Checked, Ports, check};
use ads_cnc_conformance::judge::Verdict;
use etherparse::{PacketBuilder, PacketHeaders, TransportHeader};

use crate::capture::packets;

/// A side of a connection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Client,
    Cnc,
}

/// Bytes that one side sent at once.
pub(crate) type Message = (Side, Vec<u8>);

/// The messages in a capture that the tools have written; fails if a packet is not as expected.
pub(crate) fn messages(file: &[u8]) -> Vec<Message> {
    let mut all = Vec::new();
    // The TCP port of the side that connects.
    let mut client = 0;
    for packet in packets(file) {
        let headers = PacketHeaders::from_ethernet_slice(&packet).unwrap();
        let Some(TransportHeader::Tcp(tcp)) = &headers.transport else { panic!() };
        let payload = headers.payload.slice();
        if tcp.syn && !tcp.ack {
            client = tcp.source_port;
        }
        if !payload.is_empty() {
            let side = if tcp.source_port == client { Side::Client } else { Side::Cnc };
            all.push((side, payload.to_vec()));
        }
    }
    all
}

/// The link layer and the IP version of a capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Link {
    Ethernet,
    Vlan,
    DoubleVlan,
    EthernetV6,
    Raw,
    RawV6,
    Sll,
    Sll2,
    Null,
    Loop,
}

impl Link {
    pub(crate) const ALL: [Self; 10] = [
        Self::Ethernet,
        Self::Vlan,
        Self::DoubleVlan,
        Self::EthernetV6,
        Self::Raw,
        Self::RawV6,
        Self::Sll,
        Self::Sll2,
        Self::Null,
        Self::Loop,
    ];

    const fn number(self) -> u32 {
        match self {
            Self::Ethernet | Self::Vlan | Self::DoubleVlan | Self::EthernetV6 => 1,
            Self::Raw | Self::RawV6 => 101,
            Self::Sll => 113,
            Self::Sll2 => 276,
            Self::Null => 0,
            Self::Loop => 108,
        }
    }

    fn wrap(self, segment: &Segment) -> Vec<u8> {
        let v6 = matches!(self, Self::EthernetV6 | Self::RawV6);
        let ip = segment.packet(v6);
        let ty: u16 = if v6 { 0x86DD } else { 0x0800 };
        let mut out = vec![2, 0, 0, 0, 0, 2, 2, 0, 0, 0, 0, 1];
        match self {
            Self::Ethernet | Self::EthernetV6 => {}
            Self::Vlan => out.extend([0x81, 0, 0, 7]),
            Self::DoubleVlan => out.extend([0x88, 0xA8, 0, 9, 0x81, 0, 0, 7]),
            Self::Raw | Self::RawV6 => return ip,
            Self::Sll => out = vec![0, 0, 0, 1, 0, 6, 2, 0, 0, 0, 0, 1, 0, 0],
            Self::Sll2 => {
                out = ty.to_be_bytes().to_vec();
                out.extend([0; 18]);
                out.extend(ip);
                return out;
            }
            Self::Null => return [&[2, 0, 0, 0], &ip[..]].concat(),
            Self::Loop => return [&[0, 0, 0, 2], &ip[..]].concat(),
        }
        out.extend(ty.to_be_bytes());
        out.extend(ip);
        // Short Ethernet frames are padded to 60 bytes.
        if self == Self::Ethernet {
            out.resize(out.len().max(60), 0xEE);
        }
        out
    }
}

/// A TCP segment.
#[derive(Clone, Debug)]
pub(crate) struct Segment {
    pub(crate) side: Side,
    pub(crate) sequence: u32,
    pub(crate) acknowledged: u32,
    pub(crate) syn: bool,
    pub(crate) payload: Vec<u8>,
    /// Number of bytes of the packet that are captured; `None` for all.
    pub(crate) snap: Option<usize>,
    pub(crate) port: u16,
}

impl Segment {
    fn packet(&self, v6: bool) -> Vec<u8> {
        let to_cnc = self.side == Side::Client;
        let (from, to) = if to_cnc { (50000, self.port) } else { (self.port, 50000) };
        let build = |ip: etherparse::PacketBuilderStep<etherparse::IpHeaders>| {
            let mut tcp = ip.tcp(from, to, self.sequence, 0xFFFF);
            if self.syn {
                tcp = tcp.syn();
            }
            if !self.syn || !to_cnc {
                tcp = tcp.ack(self.acknowledged);
            }
            let mut out = Vec::new();
            tcp.write(&mut out, &self.payload).unwrap();
            out
        };
        let (one, other) = if to_cnc { (20, 10) } else { (10, 20) };
        match v6 {
            false => build(PacketBuilder::ipv4([192, 0, 2, one], [192, 0, 2, other], 64)),
            true => {
                let ip = |last| [0x20, 1, 0xD, 0xB8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, last];
                build(PacketBuilder::ipv6(ip(one), ip(other), 64))
            }
        }
    }
}

/// The segments of a connection: a handshake, and the messages in segments of at most `most` bytes.
/// `begin` contains the first sequence numbers of both sides.
pub(crate) fn segments(messages: &[Message], most: usize, begin: (u32, u32)) -> Vec<Segment> {
    let (mut client, mut cnc) = begin;
    let segment = |side, sequence, acknowledged, syn, payload: &[u8]| Segment {
        side,
        sequence,
        acknowledged,
        syn,
        payload: payload.to_vec(),
        snap: None,
        port: 48898,
    };
    let mut all = vec![
        segment(Side::Client, client.wrapping_sub(1), 0, true, &[]),
        segment(Side::Cnc, cnc.wrapping_sub(1), client, true, &[]),
        segment(Side::Client, client, cnc, false, &[]),
    ];
    for (side, bytes) in messages {
        for part in bytes.chunks(most) {
            let length = u32::try_from(part.len()).unwrap();
            match side {
                Side::Client => {
                    all.push(segment(*side, client, cnc, false, part));
                    client = client.wrapping_add(length);
                }
                Side::Cnc => {
                    all.push(segment(*side, cnc, client, false, part));
                    cnc = cnc.wrapping_add(length);
                }
            }
        }
    }
    all
}

/// A pcap file with one segment per millisecond.
pub(crate) fn pcap(segments: &[Segment], link: Link) -> Vec<u8> {
    pcap_every(segments, link, 1)
}

/// A pcap file with one segment every `millis` milliseconds.
pub(crate) fn pcap_every(segments: &[Segment], link: Link, millis: u32) -> Vec<u8> {
    let mut file = Vec::new();
    file.extend(0xA1B2_C3D4_u32.to_le_bytes());
    file.extend([2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    file.extend(0xFFFF_u32.to_le_bytes());
    file.extend(link.number().to_le_bytes());
    for (place, segment) in (0_u32..).zip(segments) {
        let packet = link.wrap(segment);
        let kept = segment.snap.map_or(packet.len(), |snap| snap.min(packet.len()));
        let time = place * millis;
        file.extend((1_700_000_000_u32 + time / 1000).to_le_bytes());
        file.extend((time % 1000 * 1000).to_le_bytes());
        file.extend(u32::try_from(kept).unwrap().to_le_bytes());
        file.extend(u32::try_from(packet.len()).unwrap().to_le_bytes());
        file.extend(&packet[..kept]);
    }
    file
}

/// The result of a check of a capture.
pub(crate) fn checked(file: &[u8]) -> Checked {
    check(file, CaptureOptions::default()).unwrap()
}

/// The result of a check of a capture, with AMS/TCP at any port.
pub(crate) fn checked_anywhere(file: &[u8]) -> Checked {
    check(file, CaptureOptions { ports: Ports::Any, vectors: None }).unwrap()
}

/// The requirements with this verdict, each with the ID of its case.
pub(crate) fn with(checked: &Checked, verdict: Verdict) -> Vec<String> {
    let all = checked.outcomes.iter().flat_map(|outcome| {
        let mine = outcome.verdicts.iter().filter(move |one| one.verdict == verdict);
        mine.map(|one| format!("{} {}", outcome.case.id, one.requirement))
    });
    all.collect()
}

/// Checks that no requirement fails, differs, is inconclusive or has a warning, and returns the
/// number of requirements that pass, summed over the cases.
pub(crate) fn passes(checked: &Checked) -> usize {
    for verdict in [
        Verdict::Fail,
        Verdict::Warning,
        Verdict::Differs,
        Verdict::Inconclusive,
        Verdict::HarnessError,
    ] {
        let found: Vec<_> = checked
            .outcomes
            .iter()
            .flat_map(|outcome| &outcome.verdicts)
            .filter(|one| one.verdict == verdict)
            .flat_map(|one| &one.judgements)
            .map(|one| (one.requirement, &one.expected, &one.found))
            .collect();
        assert!(found.is_empty(), "{verdict}: {found:?} {:?}", checked.tally.lines());
    }
    with(checked, Verdict::Pass).len()
}

/// The number of exchanges and of checks, and the requirements that pass.
pub(crate) fn sum(checked: &Checked) -> (u64, usize, Vec<String>) {
    let checks = checked.outcomes.iter().map(|outcome| outcome.checks).sum();
    (checked.tally.exchanges, checks, with(checked, Verdict::Pass))
}
