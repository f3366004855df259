//! Captured traffic: reads it from a file and judges it, or writes it to a file.
//!
//! | step | module |
//! |---|---|
//! | read packets from pcap and pcapng, or NetMon 2.x | `file`, `netmon` |
//! | find TCP segments, or AMS frames in EtherCAT frames | `link` |
//! | TCP reassembly | `tcp`, `table` |
//! | split into AMS frames, or follow those without TCP | `frames`, `ams_clients` |
//! | pair requests with replies and judge them | `judge` |
//! | write a conversation to a pcapng file | `writer`, `frame` |
//!
//! The memory for requests and replies that wait for each other, and for the facts about CNCs with
//! which later replies are compared, is limited.
//!
//! ```
//! use ads_cnc_conformance::capture::{CaptureOptions, check};
//!
//! // A pcap file without packets, which consists of its header only.
//! let file = b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\xff\xff\0\0\x01\0\0\0";
//! let checked = check(&file[..], CaptureOptions::default())?;
//! assert_eq!(checked.tally.packets, 0);
//! assert!(checked.outcomes.iter().all(|outcome| !outcome.verdict().is_judged()));
//! # Ok::<(), ads_cnc_conformance::capture::FileError>(())
//! ```

mod ams_clients;
mod connection_event;
mod endpoint;
mod file;
mod frame;
mod frames;
mod judge;
mod link;
mod netmon;
mod observation;
mod table;
mod tally;
mod tcp;
mod time;
mod vectors;
mod writer;

use std::io::Read;

pub use endpoint::Endpoint;
pub use file::{FileEnd, FileError, RECORD_MAX};
pub use table::Ports;
pub use tally::CaptureTally;
pub use time::Time;
pub use vectors::{Collector, VECTOR_BYTES_MAX, VECTORS_MAX};
pub use writer::Capture;

use self::ams_clients::AmsClients;
use self::connection_event::ConnectionEvent;
use self::file::Packet;
use self::judge::TrafficJudge;
use self::link::PacketContent;
use self::table::ConnectionTable;
use self::tally::{count, count_of};
use self::tcp::CapturePosition;
use crate::judge::{CaseOutcome, attribute};
use crate::process::progress;

pub const AMS_TCP_PORT: u16 = 48898;

#[derive(Debug)]
pub struct CaptureOptions {
    /// The TCP ports to read.
    pub ports: Ports,
    /// The collector of golden vectors; `None` if no vectors are collected.
    pub vectors: Option<Collector>,
}

impl Default for CaptureOptions {
    fn default() -> Self {
        Self { ports: Ports::Of(vec![AMS_TCP_PORT]), vectors: None }
    }
}

#[derive(Debug)]
pub struct Checked {
    pub outcomes: Vec<CaseOutcome>,
    pub tally: CaptureTally,
    /// The collected golden vectors, if requested.
    pub vectors: Option<Collector>,
}

/// A piece of a capture before it is judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CapturePiece {
    /// A whole frame.
    Frame {
        from: Endpoint,
        /// The receiver.
        to: Endpoint,
        /// The whole frame. An AMS/TCP header is added to a frame that was captured in an EtherCAT
        /// frame.
        bytes: Vec<u8>,
    },
    /// Bytes that were not captured.
    Gap {
        from: Endpoint,
        /// The receiver.
        to: Endpoint,
        /// Number of missing bytes; 0 if unknown.
        length: u64,
    },
    /// The number of bytes that are only the beginning of a frame, or that were skipped to find a
    /// frame. If bytes are not a frame although a frame must begin there, the number of bytes that
    /// `ads-cnc check` shows, at most 64. 0 for the beginning of a frame at the end of a
    /// connection.
    Rest(usize),
}

/// Reads a pcap, pcapng or NetMon 2.x file, reassembles its TCP connections, and calls `each` with
/// each piece, without judging it.
///
/// ```
/// use ads_cnc_conformance::capture::{FileEnd, Ports, frames};
///
/// let file = b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\xff\xff\0\0\x01\0\0\0";
/// let mut pieces = Vec::new();
/// let end = frames(&file[..], Ports::Any, |piece| pieces.push(piece))?;
/// assert_eq!((end, pieces.len()), (FileEnd::Whole, 0));
/// # Ok::<(), ads_cnc_conformance::capture::FileError>(())
/// ```
///
/// # Errors
/// If the file is empty or has another format, or reading fails at its start. A truncated file is
/// read up to its end, see [`FileEnd`].
pub fn frames(
    input: impl Read + Send,
    ports: Ports,
    mut each: impl FnMut(CapturePiece),
) -> Result<FileEnd, FileError> {
    let mut table = ConnectionTable::new(ports);
    read(input, &mut table, &mut AmsClients::default(), |step| {
        if let ReadStep::Event(event, _) = step
            && let Some(piece) = CapturePiece::of(event)
        {
            each(piece);
        }
    })
}

impl CapturePiece {
    fn of(event: ConnectionEvent) -> Option<Self> {
        Some(match event {
            ConnectionEvent::Frame(bytes, direction, _) => {
                Self::Frame { from: direction.from, to: direction.to, bytes }
            }
            ConnectionEvent::Gap(length, direction, _) => {
                Self::Gap { from: direction.from, to: direction.to, length }
            }
            ConnectionEvent::Cut(bytes, ..) | ConnectionEvent::Broken(_, bytes, ..) => {
                Self::Rest(bytes.len())
            }
            ConnectionEvent::Skipped(length) => Self::Rest(length),
            ConnectionEvent::Unfinished => Self::Rest(0),
            ConnectionEvent::Router(_)
            | ConnectionEvent::Joined(_)
            | ConnectionEvent::Running(_)
            | ConnectionEvent::Ended(_) => return None,
        })
    }
}

/// An event while reading a file.
enum ReadStep<'s> {
    /// The next packet, its content, and whether the content is a TCP segment on a selected port.
    Packet(&'s Packet<'s>, PacketContent<'s>, bool),
    /// An event on a connection.
    Event(ConnectionEvent, &'s ConnectionTable),
}

/// Calls a function for each packet of a file of any of the formats.
fn packets(
    mut input: impl Read + Send,
    each: impl FnMut(Packet<'_>),
) -> Result<FileEnd, FileError> {
    let mut start = Vec::new();
    let magic = u64::try_from(netmon::MAGIC.len()).unwrap_or_default();
    input.by_ref().take(magic).read_to_end(&mut start)?;
    if start == netmon::MAGIC || start == netmon::MAGIC_1 {
        return netmon::packets(input, each);
    }
    file::packets((&*start).chain(input), each)
}

fn read(
    input: impl Read + Send,
    table: &mut ConnectionTable,
    clients: &mut AmsClients,
    mut each: impl FnMut(ReadStep<'_>),
) -> Result<FileEnd, FileError> {
    let mut events = Vec::new();
    let end = packets(input, |packet| {
        let content = link::content(&packet);
        let Packet { number, time, .. } = packet;
        let mark = CapturePosition { packet: number, time, acknowledged: None };
        let wanted = matches!(&content, PacketContent::Tcp(segment) if table.wants(segment));
        each(ReadStep::Packet(&packet, content, wanted));
        if let (PacketContent::Tcp(segment), true) = (content, wanted) {
            table.push(&segment, mark, &mut events);
        }
        if let PacketContent::Ams(frame) = content {
            clients.push(frame, mark, &mut events);
        }
        events.drain(..).for_each(|event| each(ReadStep::Event(event, table)));
    })?;
    table.finish(&mut events);
    clients.finish(&mut events);
    events.drain(..).for_each(|event| each(ReadStep::Event(event, table)));
    Ok(end)
}

/// Number of packets after which the progress is updated with the number of failed cases.
const PACKETS_BETWEEN_COUNTS: u64 = 4096;

/// Judges a file of captured packets: pcap, pcapng or NetMon 2.x.
///
/// # Errors
/// If the file is empty or has another format, or reading fails at its start. A truncated file is
/// judged up to its end.
pub fn check(input: impl Read + Send, options: CaptureOptions) -> Result<Checked, FileError> {
    let mut table = ConnectionTable::new(options.ports);
    let mut judge = TrafficJudge::new(options.vectors);
    let mut clients = AmsClients::default();
    let end = read(input, &mut table, &mut clients, |step| match step {
        ReadStep::Packet(packet, content, wanted) => {
            count(&mut judge.tally.packets);
            if packet.is_of_suite {
                count(&mut judge.tally.of_suite);
            }
            if judge.tally.packets.is_multiple_of(PACKETS_BETWEEN_COUNTS) {
                progress::set_failed(judge.failed());
            }
            judge.at(packet.time);
            match content {
                PacketContent::Tcp(_) if wanted => count(&mut judge.tally.segments),
                PacketContent::Tcp(_) => count(&mut judge.tally.elsewhere),
                PacketContent::Ams(_) => count(&mut judge.tally.ethercat),
                PacketContent::Other => {}
                PacketContent::Fragment => count(&mut judge.tally.fragments),
                PacketContent::Unreadable => count(&mut judge.tally.unreadable),
                PacketContent::Link(link) => count_of(&mut judge.tally.links, link),
            }
        }
        ReadStep::Event(event, table) => judge.take(event, table),
    })?;
    judge.tally.connections = table.connections();
    judge.tally.repeated = table.repeated;
    judge.tally.early = table.early;
    judge.tally.end = Some(end);
    let (mut outcomes, tally, vectors) = judge.finish();
    attribute(&mut outcomes);
    Ok(Checked { outcomes, tally, vectors })
}
