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

mod book;
mod file;
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

pub use file::{End, FileError, RECORD_MAX};
pub use table::Ports;
pub use tally::Tally;
pub use time::Time;
pub use vectors::{Collector, VECTORS_MAX};
pub use writer::Capture;

use self::file::Packet;
use self::judge::Judge;
use self::link::Content;
use self::table::Table;
use self::tally::{count, count_of};
use self::tcp::Mark;
use crate::suite::Outcome;

/// The TCP port of AMS.
pub const AMS_TCP_PORT: u16 = 48898;

/// What is looked for.
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

/// What came of a capture.
#[derive(Debug)]
pub struct Checked {
    /// Each case.
    pub outcomes: Vec<Outcome>,
    /// What was there.
    pub tally: Tally,
    /// Golden vectors, if they were wanted.
    pub vectors: Option<Collector>,
}

/// Judges a file of captured packets, pcap or pcapng.
///
/// # Errors
/// If it is no such file. One that ends too early is judged as far as it goes.
pub fn check(input: impl Read + Send, options: Options) -> Result<Checked, FileError> {
    let mut table = Table::new(options.ports);
    let mut judge = Judge::new(options.vectors);
    let mut events = Vec::new();
    let end = file::packets(input, |packet| {
        count(&mut judge.tally.packets);
        judge.at(packet.time);
        match link::segment(&packet) {
            Content::Tcp(segment) if table.wants(&segment) => {
                count(&mut judge.tally.segments);
                let Packet { number, time, .. } = packet;
                let mark = Mark { packet: number, time, acknowledged: None };
                table.push(&segment, mark, &mut events);
            }
            Content::Tcp(_) => count(&mut judge.tally.elsewhere),
            Content::Other => {}
            Content::Fragment => count(&mut judge.tally.fragments),
            Content::Unreadable => count(&mut judge.tally.unreadable),
            Content::Link(link) => count_of(&mut judge.tally.links, link),
        }
        events.drain(..).for_each(|event| judge.take(event, &table));
    })?;
    table.finish(&mut events);
    events.drain(..).for_each(|event| judge.take(event, &table));
    judge.tally.connections = table.connections();
    judge.tally.repeated = table.repeated;
    judge.tally.early = table.early;
    judge.tally.end = Some(end);
    let (outcomes, tally, vectors) = judge.finish();
    Ok(Checked { outcomes, tally, vectors })
}
