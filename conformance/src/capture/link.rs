//! Finds the TCP segment, or the AMS frame in an EtherCAT frame, in a captured packet.

use std::net::{IpAddr, SocketAddr};

use ads_cnc::Decode as _;
use ads_cnc::ads::AmsHeader;
use ads_cnc::limits::AMS_HEADER_LEN;
use etherparse::{EtherType, LaxNetSlice, LaxSlicedPacket, TransportSlice};
use pcap_parser::Linktype;

use super::endpoint::Endpoint;
use super::file::Packet;
use crate::number::to_usize;

/// The EtherType of EtherCAT, and the type of EtherCAT frames that contain AMS frames (the upper
/// four bits of the EtherCAT header).
const ETHERCAT: u16 = 0x88A4;
const AMS_TYPE: u16 = 2;

/// A TCP segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct TcpSegment<'p> {
    pub(super) from: Endpoint,
    pub(super) to: Endpoint,
    pub(super) sequence: u32,
    pub(super) acknowledged: Option<u32>,
    pub(super) syn: bool,
    pub(super) fin: bool,
    pub(super) rst: bool,
    pub(super) payload: &'p [u8],
    /// Number of bytes of the payload that were not captured.
    pub(super) missing: usize,
}

/// An AMS frame in an EtherCAT frame. Beckhoff's ADS Monitor records the frames that the AMS router
/// of a PC forwards in this form: one per packet, in the order in which the router received them.
#[derive(Clone, Copy, Debug)]
pub(super) struct AmsFrame<'p> {
    pub(super) header: AmsHeader,
    /// The captured part of the header and the data.
    pub(super) bytes: &'p [u8],
    /// Whether the frame is shorter than its header states.
    pub(super) is_cut: bool,
}

/// The content of a packet.
#[derive(Clone, Copy, Debug)]
pub(super) enum PacketContent<'p> {
    Tcp(TcpSegment<'p>),
    /// An AMS frame in an EtherCAT frame.
    Ams(AmsFrame<'p>),
    /// Another protocol.
    Other,
    /// A fragment of an IP packet that contains TCP; fragments are not reassembled.
    Fragment,
    /// A header is truncated or invalid.
    Unreadable,
    /// An unsupported link type.
    Link(i32),
}

pub(super) fn content<'p>(packet: &Packet<'p>) -> PacketContent<'p> {
    let bytes = packet.bytes;
    let after = |length: usize| bytes.get(length..).unwrap_or_default();
    let typed = |at: usize| match bytes.get(at..) {
        Some([high, low, ..]) => EtherType(u16::from_be_bytes([*high, *low])),
        _ => EtherType(0),
    };
    let read = match packet.link {
        Linktype::ETHERNET => LaxSlicedPacket::from_ethernet(bytes).ok(),
        // Some systems use 12 or 14 for raw IP.
        Linktype::RAW | Linktype::IPV4 | Linktype::IPV6 | Linktype(12 | 14) => {
            LaxSlicedPacket::from_ip(bytes).ok()
        }
        // The first four bytes are the address family. They are skipped: the IP header contains the
        // version.
        Linktype::NULL | Linktype::LOOP => LaxSlicedPacket::from_ip(after(4)).ok(),
        Linktype::LINUX_SLL => Some(LaxSlicedPacket::from_ether_type(typed(14), after(16))),
        Linktype::LINUX_SLL2 => Some(LaxSlicedPacket::from_ether_type(typed(0), after(20))),
        Linktype(other) => return PacketContent::Link(other),
    };
    let Some(read) = read else { return PacketContent::Unreadable };
    match read.ether_payload() {
        Some(payload) if payload.ether_type.0 == ETHERCAT => of_ethercat(payload.payload),
        _ => of_ip(&read, packet.missing),
    }
}

/// Finds the AMS frame in the payload of an EtherCAT frame. The length is taken from the AMS
/// header, because the length in the EtherCAT header has only 11 bits, and short Ethernet frames
/// are padded.
fn of_ethercat(payload: &[u8]) -> PacketContent<'_> {
    let Some((kind, bytes)) = payload.split_first_chunk() else {
        return PacketContent::Unreadable;
    };
    // The frame contains process data, or has another type.
    if u16::from_le_bytes(*kind) >> 12 != AMS_TYPE {
        return PacketContent::Other;
    }
    let header = bytes.get(..AMS_HEADER_LEN).map(AmsHeader::decode);
    let Some(Ok(header)) = header else { return PacketContent::Unreadable };
    let length = to_usize(header.data_length);
    let whole = bytes.get(..length.saturating_add(AMS_HEADER_LEN));
    PacketContent::Ams(AmsFrame { header, bytes: whole.unwrap_or(bytes), is_cut: whole.is_none() })
}

fn of_ip<'p>(read: &LaxSlicedPacket<'p>, missing: usize) -> PacketContent<'p> {
    let Some((from, to, missing)) = read.net.as_ref().and_then(|net| ends(net, missing)) else {
        // A packet that ends inside the IP header is unreadable: it may contain TCP.
        return if read.stop_err.is_some() {
            PacketContent::Unreadable
        } else {
            PacketContent::Other
        };
    };
    let is_fragment = read.ip_payload().is_some_and(|payload| payload.fragmented);
    let is_tcp = read.ip_payload().is_some_and(|payload| payload.ip_number.0 == 6);
    match &read.transport {
        _ if is_fragment => {
            if is_tcp {
                PacketContent::Fragment
            } else {
                PacketContent::Other
            }
        }
        Some(TransportSlice::Tcp(tcp)) => PacketContent::Tcp(TcpSegment {
            from: Endpoint::Tcp(SocketAddr::new(from, tcp.source_port())),
            to: Endpoint::Tcp(SocketAddr::new(to, tcp.destination_port())),
            sequence: tcp.sequence_number(),
            acknowledged: tcp.ack().then(|| tcp.acknowledgment_number()),
            syn: tcp.syn(),
            fin: tcp.fin(),
            rst: tcp.rst(),
            payload: tcp.payload(),
            missing,
        }),
        _ if is_tcp => PacketContent::Unreadable,
        _ => PacketContent::Other,
    }
}

/// The source address, the destination address and the number of bytes of the IP packet that were
/// not captured.
fn ends(net: &LaxNetSlice<'_>, missing: usize) -> Option<(IpAddr, IpAddr, usize)> {
    // With segmentation offload, the length in the header is 0, because the network card sets it.
    let lost = |header_length: usize, captured_length: usize| match header_length {
        0 => missing,
        header_length => header_length.saturating_sub(captured_length),
    };
    match net {
        LaxNetSlice::Ipv4(ip) => {
            let header = ip.header();
            let extensions = ip.extensions().auth.map_or(0, |auth| auth.slice().len());
            let captured_length = header.slice().len().saturating_add(extensions);
            let captured_length = captured_length.saturating_add(ip.payload().payload.len());
            let missing = lost(header.total_len().into(), captured_length);
            Some((header.source_addr().into(), header.destination_addr().into(), missing))
        }
        LaxNetSlice::Ipv6(ip) => {
            let header = ip.header();
            let captured_length = ip.extensions().slice().len();
            let captured_length = captured_length.saturating_add(ip.payload().payload.len());
            let missing = lost(header.payload_length().into(), captured_length);
            Some((header.source_addr().into(), header.destination_addr().into(), missing))
        }
        LaxNetSlice::Arp(_) => None,
    }
}
