//! Captured traffic: read from a file and judged, or written to one.
//!
//! | step | where |
//! |---|---|
//! | packets out of pcap and pcapng | `file` |
//! | TCP segments out of packets | `link` |
//! | bytes in their order, connection by connection | `tcp`, `table` |
//! | AMS frames | `frames` |
//! | requests and their answers, judged | `judge` |
//! | a conversation into a pcapng file | `writer`, `frame` |
//!
//! Nothing is kept of a capture but what a judgement of what comes later needs; how much that may
//! be has a limit everywhere.
//!
//! ```
//! use ads_cnc_conformance::capture::{Options, check};
//!
//! // The beginning of a pcap file without a packet.
//! let file = b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\xff\xff\0\0\x01\0\0\0";
//! let checked = check(&file[..], Options::default())?;
//! assert_eq!(checked.tally.packets, 0);
//! assert!(checked.outcomes.iter().all(|outcome| !outcome.verdict().is_judged()));
//! # Ok::<(), ads_cnc_conformance::capture::FileError>(())
//! ```

mod file;
mod findings;
mod frame;
mod frames;
mod judge;
mod link;
mod table;
mod tally;
mod tcp;
mod time;
mod vectors;
mod writer;

use std::io::Read;
use std::net::SocketAddr;

pub use file::{End, FileError, RECORD_MAX};
pub use table::Ports;
pub use tally::Tally;
pub use time::Time;
pub use vectors::{Collector, VECTORS_MAX};
pub use writer::Capture;

use self::file::Packet;
use self::judge::Judge;
use self::link::Content;
use self::table::{Event, Table};
use self::tally::{count, count_of};
use self::tcp::Mark;
use crate::judge::Outcome;

pub const AMS_TCP_PORT: u16 = 48898;

#[derive(Debug)]
pub struct Options {
    /// TCP ports.
    pub ports: Ports,
    /// Where golden vectors are to be kept, if they are wanted.
    pub vectors: Option<Collector>,
}

impl Default for Options {
    fn default() -> Self {
        Self { ports: Ports::Of(vec![AMS_TCP_PORT]), vectors: None }
    }
}

#[derive(Debug)]
pub struct Checked {
    pub outcomes: Vec<Outcome>,
    pub tally: Tally,
    /// Golden vectors, if they were wanted.
    pub vectors: Option<Collector>,
}

/// What comes out of a capture before it is judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// A whole frame.
    Frame {
        from: SocketAddr,
        /// Whom it was sent to.
        to: SocketAddr,
        /// All of it.
        bytes: Vec<u8>,
    },
    /// Bytes that were not captured; how many, if that is known.
    Gap {
        from: SocketAddr,
        /// Whom they were sent to.
        to: SocketAddr,
        /// How many; 0 if nobody can say.
        length: u64,
    },
    /// So many bytes that are no frame, or only the beginning of one.
    Rest(usize),
}

/// Puts together what went over the connections of a file, pcap or pcapng, and hands over the frames
/// in it and what is missing between them. Nothing is judged.
///
/// ```
/// use ads_cnc_conformance::capture::{End, Ports, frames};
///
/// let file = b"\xd4\xc3\xb2\xa1\x02\0\x04\0\0\0\0\0\0\0\0\0\xff\xff\0\0\x01\0\0\0";
/// let mut pieces = Vec::new();
/// let end = frames(&file[..], Ports::Any, |piece| pieces.push(piece))?;
/// assert_eq!((end, pieces.len()), (End::Whole, 0));
/// # Ok::<(), ads_cnc_conformance::capture::FileError>(())
/// ```
///
/// # Errors
/// If it is no such file. One that ends too early is read as far as it goes, and its end says so.
pub fn frames(
    input: impl Read + Send,
    ports: Ports,
    mut each: impl FnMut(Piece),
) -> Result<End, FileError> {
    let mut table = Table::new(ports);
    read(input, &mut table, |step| {
        if let ReadStep::Event(event, _) = step
            && let Some(piece) = Piece::of(event)
        {
            each(piece);
        }
    })
}

impl Piece {
    fn of(event: Event) -> Option<Self> {
        Some(match event {
            Event::Frame(bytes, way, _) => Self::Frame { from: way.from, to: way.to, bytes },
            Event::Gap(length, way, _) => Self::Gap { from: way.from, to: way.to, length },
            Event::Cut(bytes, ..) | Event::Broken(_, bytes, ..) => Self::Rest(bytes.len()),
            Event::Skipped(length) => Self::Rest(length),
            Event::Unfinished => Self::Rest(0),
            Event::Router | Event::Joined(_) | Event::Ended(_) => return None,
        })
    }
}

/// What is found while a file is read.
enum ReadStep<'s> {
    /// The next packet; whether its segment is looked at.
    Packet(&'s Packet<'s>, Content<'s>, bool),
    /// Something on a connection.
    Event(Event, &'s Table),
}

fn read(
    input: impl Read + Send,
    table: &mut Table,
    mut each: impl FnMut(ReadStep<'_>),
) -> Result<End, FileError> {
    let mut events = Vec::new();
    let end = file::packets(input, |packet| {
        let content = link::segment(&packet);
        let wanted = matches!(&content, Content::Tcp(segment) if table.wants(segment));
        each(ReadStep::Packet(&packet, content, wanted));
        if let (Content::Tcp(segment), true) = (content, wanted) {
            let Packet { number, time, .. } = packet;
            let mark = Mark { packet: number, time, acknowledged: None };
            table.push(&segment, mark, &mut events);
        }
        events.drain(..).for_each(|event| each(ReadStep::Event(event, table)));
    })?;
    table.finish(&mut events);
    events.drain(..).for_each(|event| each(ReadStep::Event(event, table)));
    Ok(end)
}

/// Judges a file of captured packets, pcap or pcapng.
///
/// # Errors
/// If it is no such file. One that ends too early is judged as far as it goes.
pub fn check(input: impl Read + Send, options: Options) -> Result<Checked, FileError> {
    let mut table = Table::new(options.ports);
    let mut judge = Judge::new(options.vectors);
    let end = read(input, &mut table, |step| match step {
        ReadStep::Packet(packet, content, wanted) => {
            count(&mut judge.tally.packets);
            judge.at(packet.time);
            match content {
                Content::Tcp(_) if wanted => count(&mut judge.tally.segments),
                Content::Tcp(_) => count(&mut judge.tally.elsewhere),
                Content::Other => {}
                Content::Fragment => count(&mut judge.tally.fragments),
                Content::Unreadable => count(&mut judge.tally.unreadable),
                Content::Link(link) => count_of(&mut judge.tally.links, link),
            }
        }
        ReadStep::Event(event, table) => judge.take(event, table),
    })?;
    judge.tally.connections = table.connections();
    judge.tally.repeated = table.repeated;
    judge.tally.early = table.early;
    judge.tally.end = Some(end);
    let (outcomes, tally, vectors) = judge.finish();
    Ok(Checked { outcomes, tally, vectors })
}
