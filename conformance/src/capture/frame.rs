//! Builds the Ethernet, IP and TCP headers of a packet in a written capture.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use etherparse::{PacketBuilder, TcpHeader};

use crate::number::to_u32;

pub(super) const FIN: u8 = 0x01;
pub(super) const SYN: u8 = 0x02;
pub(super) const PSH: u8 = 0x08;
pub(super) const ACK: u8 = 0x10;

const WINDOW: u16 = 0xFFFF;
const HOPS: u8 = 64;

/// A connection: its two ends, with the next sequence number of each.
#[derive(Clone, Debug)]
pub(super) struct Flow {
    local: Endpoint,
    remote: Endpoint,
}

#[derive(Clone, Copy, Debug)]
struct Endpoint {
    addr: SocketAddr,
    mac: [u8; 6],
    /// Next sequence number.
    next: u32,
}

impl Flow {
    pub(super) fn new(local: SocketAddr, remote: SocketAddr) -> Self {
        // Locally administered MAC addresses do not belong to any vendor.
        let end = |addr, last| Endpoint { addr, mac: [2, 0, 0, 0, 0, last], next: 0 };
        Self { local: end(local, 1), remote: end(remote, 2) }
    }

    /// Builds a whole packet with all headers, beginning with Ethernet. An `outgoing` packet is
    /// sent by the local end.
    pub(super) fn packet(&mut self, outgoing: bool, flags: u8, data: &[u8]) -> io::Result<Vec<u8>> {
        let (from, to) = if outgoing {
            (&mut self.local, &self.remote)
        } else {
            (&mut self.remote, &self.local)
        };
        let builder = PacketBuilder::ethernet2(from.mac, to.mac);
        let builder = match (from.addr.ip(), to.addr.ip()) {
            (IpAddr::V4(source), IpAddr::V4(target)) => {
                builder.ipv4(source.octets(), target.octets(), HOPS)
            }
            (source, target) => builder.ipv6(six(source), six(target), HOPS),
        };
        let builder = builder.tcp_header(TcpHeader {
            fin: flags & FIN != 0,
            syn: flags & SYN != 0,
            psh: flags & PSH != 0,
            ack: flags & ACK != 0,
            // The first segment, a SYN without ACK, acknowledges nothing.
            acknowledgment_number: if flags & ACK == 0 { 0 } else { to.next },
            ..TcpHeader::new(from.addr.port(), to.addr.port(), from.next, WINDOW)
        });
        let mut packet = Vec::with_capacity(builder.size(data.len()));
        builder.write(&mut packet, data).map_err(io::Error::other)?;
        let bytes = to_u32(data.len());
        let marks = u32::from(flags & (SYN | FIN) != 0);
        from.next = from.next.wrapping_add(bytes).wrapping_add(marks);
        Ok(packet)
    }
}

fn six(ip: IpAddr) -> [u8; 16] {
    match ip {
        IpAddr::V4(ip) => Ipv4Addr::to_ipv6_mapped(&ip).octets(),
        IpAddr::V6(ip) => Ipv6Addr::octets(&ip),
    }
}
