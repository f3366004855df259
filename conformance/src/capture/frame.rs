//! The headers around what went over a connection.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

pub(super) const FIN: u8 = 0x01;
pub(super) const SYN: u8 = 0x02;
pub(super) const PSH: u8 = 0x08;
pub(super) const ACK: u8 = 0x10;

const TCP: u8 = 6;
const TCP_LEN: u16 = 20;
const WINDOW: u16 = 0xFFFF;
const HOPS: u8 = 64;

/// One connection: its ends, and how many bytes each has sent.
#[derive(Clone, Debug)]
pub(super) struct Flow {
    local: End,
    remote: End,
}

#[derive(Clone, Copy, Debug)]
struct End {
    addr: SocketAddr,
    mac: [u8; 6],
    /// Number of the next byte.
    next: u32,
}

impl Flow {
    pub(super) fn new(local: SocketAddr, remote: SocketAddr) -> Self {
        // Locally administered addresses, which nobody has.
        let end = |addr, last| End { addr, mac: [2, 0, 0, 0, 0, last], next: 0 };
        Self { local: end(local, 1), remote: end(remote, 2) }
    }

    /// The whole packet, from Ethernet on.
    pub(super) fn packet(&mut self, outgoing: bool, flags: u8, data: &[u8]) -> Vec<u8> {
        let (from, to) = match outgoing {
            true => (&mut self.local, &self.remote),
            false => (&mut self.remote, &self.local),
        };
        // The first segment acknowledges nothing.
        let acknowledged = if flags & ACK == 0 { 0 } else { to.next };
        let mut tcp = Vec::with_capacity(data.len().saturating_add(TCP_LEN.into()));
        tcp.extend(from.addr.port().to_be_bytes());
        tcp.extend(to.addr.port().to_be_bytes());
        tcp.extend(from.next.to_be_bytes());
        tcp.extend(acknowledged.to_be_bytes());
        // Five words of header.
        tcp.extend([0x50, flags]);
        tcp.extend(WINDOW.to_be_bytes());
        // Checksum and urgent pointer.
        tcp.extend([0; 4]);
        tcp.extend(data);
        let packet = around(from, to, tcp);
        let bytes = u32::try_from(data.len()).unwrap_or(u32::MAX);
        let marks = u32::from(flags & (SYN | FIN) != 0);
        from.next = from.next.wrapping_add(bytes).wrapping_add(marks);
        packet
    }
}

/// IP and Ethernet around a segment, whose checksum is filled in.
fn around(from: &End, to: &End, mut tcp: Vec<u8>) -> Vec<u8> {
    let length = u16::try_from(tcp.len()).unwrap_or(u16::MAX);
    let (kind, header) = match (from.addr.ip(), to.addr.ip()) {
        (IpAddr::V4(source), IpAddr::V4(target)) => {
            let (source, target) = (source.octets(), target.octets());
            let pseudo = [&source[..], &target, &[0, TCP], &length.to_be_bytes()].concat();
            seal(&mut tcp, 16, &pseudo);
            (0x0800_u16, v4(source, target, length))
        }
        (source, target) => {
            let (source, target) = (six(source), six(target));
            let long = u32::from(length).to_be_bytes();
            let pseudo = [&source[..], &target, &long, &[0, 0, 0, TCP]].concat();
            seal(&mut tcp, 16, &pseudo);
            (0x86DD, v6(source, target, length))
        }
    };
    [&to.mac[..], &from.mac, &kind.to_be_bytes(), &header, &tcp].concat()
}

fn six(ip: IpAddr) -> [u8; 16] {
    match ip {
        IpAddr::V4(ip) => Ipv4Addr::to_ipv6_mapped(&ip).octets(),
        IpAddr::V6(ip) => Ipv6Addr::octets(&ip),
    }
}

fn v4(source: [u8; 4], target: [u8; 4], length: u16) -> Vec<u8> {
    let total = length.saturating_add(20).to_be_bytes();
    // Version and words of header; no identification; not to be fragmented.
    let mut header = vec![0x45, 0];
    header.extend(total);
    header.extend([0, 0, 0x40, 0, HOPS, TCP, 0, 0]);
    header.extend(source);
    header.extend(target);
    seal(&mut header, 10, &[]);
    header
}

fn v6(source: [u8; 16], target: [u8; 16], length: u16) -> Vec<u8> {
    let mut header = vec![0x60, 0, 0, 0];
    header.extend(length.to_be_bytes());
    header.extend([TCP, HOPS]);
    header.extend(source);
    header.extend(target);
    header
}

/// Fills in the checksum at an offset: the complement of the sum of all words.
fn seal(bytes: &mut [u8], at: usize, pseudo: &[u8]) {
    let words = |bytes: &[u8]| -> u32 {
        let word = |pair: &[u8]| match *pair {
            [high, low] => u32::from(u16::from_be_bytes([high, low])),
            [high] => u32::from(u16::from_be_bytes([high, 0])),
            _ => 0,
        };
        bytes.chunks(2).map(word).fold(0, u32::wrapping_add)
    };
    let mut sum = words(bytes).wrapping_add(words(pseudo));
    while sum > 0xFFFF {
        sum = (sum & 0xFFFF).wrapping_add(sum >> 16);
    }
    let checksum = u16::try_from(sum).map_or(0, |sum| !sum).to_be_bytes();
    if let Some(field) = bytes.get_mut(at..at.saturating_add(2)) {
        field.copy_from_slice(&checksum);
    }
}
