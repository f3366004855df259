//! A captured conversation: frames of both sides, divided into segments, in any order.

use ads_cnc::Encode as _;
use ads_cnc::ads::{FrameRef, ReadReplyRef, WriteReply};

use super::{Input, calls};
use crate::common::CALLS;

/// A captured segment.
#[derive(Clone)]
pub(super) struct Segment {
    /// Whether the client sent the segment; otherwise, the CNC sent it.
    pub(super) is_client: bool,
    pub(super) sequence: u32,
    pub(super) payload: Vec<u8>,
}

/// The frames that were sent, and the segments that were captured.
pub(super) struct Conversation {
    /// The frames of the client and of the CNC.
    pub(super) sent: [Vec<Vec<u8>>; 2],
    begin: [u32; 2],
    pub(super) segments: Vec<Segment>,
    /// Whether the segments contain every byte that was sent.
    pub(super) is_whole: bool,
    pub(super) is_twice: bool,
}

/// Sequence numbers of a SYN. Some of them are so large that the numbers of the segments wrap around.
const BEGINS: [u32; 4] = [0, u32::MAX - 50, 0x7FFF_FFF0, u32::MAX];

impl Conversation {
    /// Input: the number of requests, the index of each request with the length of the data of its
    /// reply, the first sequence numbers, the lengths of the segments, then changes. A change swaps
    /// a segment with another one (0), repeats it (1), removes it (2), or appends the next one to
    /// it (3).
    pub(super) fn new(input: &mut Input<'_>) -> Self {
        let mut sent = [Vec::new(), Vec::new()];
        for id in 0..u32::from(input.byte() % 8) {
            let call = CALLS[usize::from(input.byte()) % CALLS.len()].call;
            let request = calls::frame(&call, id);
            sent[1].push(reply(&request, input.byte()));
            sent[0].push(request);
        }
        let begin = [*input.choose(&BEGINS), *input.choose(&BEGINS)];
        let lengths = [usize::from(input.byte()).max(4), usize::from(input.byte()).max(4)];
        let mut segments = Vec::new();
        for side in 0..2 {
            let mut sequence = begin[side].wrapping_add(1);
            for payload in sent[side].concat().chunks(lengths[side]) {
                segments.push(Segment {
                    is_client: side == 0,
                    sequence,
                    payload: payload.to_vec(),
                });
                sequence = sequence.wrapping_add(payload.len() as u32);
            }
        }
        let mut conversation = Self { sent, begin, segments, is_whole: true, is_twice: false };
        for _ in 0..64 {
            if input.is_empty() || conversation.segments.is_empty() {
                break;
            }
            let (what, place, other) = (input.byte(), input.byte(), input.byte());
            conversation.disturb(what, place.into(), other.into());
        }
        conversation.is_whole = conversation.is_captured();
        conversation
    }

    fn disturb(&mut self, what: u8, place: usize, other: usize) {
        let all = &mut self.segments;
        let (place, other) = (place % all.len(), other % all.len());
        match what % 4 {
            0 => all.swap(place, other),
            1 => {
                self.is_twice = true;
                let again = all[place].clone();
                all.insert(other, again);
            }
            2 => {
                all.remove(place);
            }
            _ => {
                let (first, second) = (all[place].clone(), all[other].clone());
                let end = first.sequence.wrapping_add(first.payload.len() as u32);
                if first.is_client == second.is_client && end == second.sequence {
                    all[place].payload.extend(second.payload);
                }
            }
        }
    }

    /// Whether every byte of both sides was captured.
    fn is_captured(&self) -> bool {
        (0..2).all(|side| {
            let mut there = vec![false; self.sent[side].concat().len()];
            for one in self.segments.iter().filter(|one| one.is_client == (side == 0)) {
                let begin = one.sequence.wrapping_sub(self.begin[side]).wrapping_sub(1) as usize;
                there[begin..begin + one.payload.len()].fill(true);
            }
            there.iter().all(|there| *there)
        })
    }

    /// A pcap file: both SYN, the segments, and both FIN.
    pub(super) fn pcap(&self) -> Vec<u8> {
        let mut file =
            b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\xff\xff\0\0\x65\0\0\0".to_vec();
        let mut packet = |is_client: bool, sequence: u32, flags: u8, payload: &[u8]| {
            let packet = packet(is_client, sequence, flags, payload);
            let length = (packet.len() as u32).to_le_bytes();
            file.extend([&[0; 8], &length[..], &length, &packet].concat());
        };
        packet(true, self.begin[0], 2, &[]);
        packet(false, self.begin[1], 2, &[]);
        for one in &self.segments {
            packet(one.is_client, one.sequence, 8, &one.payload);
        }
        for side in 0..2 {
            let length = self.sent[side].concat().len() as u32;
            packet(side == 0, self.begin[side].wrapping_add(1).wrapping_add(length), 1, &[]);
        }
        file
    }
}

/// The frame of a reply to a request. The reply to a Read or ReadWrite has `kind` bytes of data.
fn reply(request: &[u8], kind: u8) -> Vec<u8> {
    let Ok(Some((frame, _))) = FrameRef::split(request, u32::MAX) else { panic!("a frame") };
    let header = frame.header();
    let data = vec![kind; usize::from(kind)];
    let result = ads_cnc::ads::AdsError(0);
    let payload = match header.command.0 {
        3 => WriteReply { result }.encode_to_vec(),
        // The replies of Read and ReadWrite have the same form.
        _ => ReadReplyRef { result, data: Some(&data) }.encode_to_vec(),
    };
    let payload = payload.expect("a reply");
    FrameRef::new(header.response(), &payload)
        .and_then(|frame| frame.encode_to_vec())
        .expect("a frame")
}

/// An IPv4 packet with a TCP segment, without checksums and without a link layer.
fn packet(is_client: bool, sequence: u32, flags: u8, payload: &[u8]) -> Vec<u8> {
    let (client, cnc) = (([192, 0, 2, 20], 50000_u16), ([192, 0, 2, 10], 48898_u16));
    let (from, to) = if is_client { (client, cnc) } else { (cnc, client) };
    let length = (40 + payload.len()) as u16;
    let mut packet = vec![0x45, 0];
    packet.extend(length.to_be_bytes());
    packet.extend([0, 0, 0x40, 0, 64, 6, 0, 0]);
    packet.extend(from.0);
    packet.extend(to.0);
    packet.extend(from.1.to_be_bytes());
    packet.extend(to.1.to_be_bytes());
    packet.extend(sequence.to_be_bytes());
    packet.extend([0, 0, 0, 0, 0x50, flags, 0xFF, 0xFF, 0, 0, 0, 0]);
    packet.extend(payload);
    packet
}
