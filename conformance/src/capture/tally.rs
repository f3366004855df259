//! Counters of a capture, mostly of packets and frames that are not judged.

use std::collections::BTreeMap;
use std::fmt::Display;

use super::file::FileEnd;
use crate::exchange::Exchange;

/// Maximum number of different addresses that are counted.
const UNKNOWN_MAX: usize = 1000;

/// Maximum number of them that are shown.
const SHOWN: usize = 8;

/// Counters of a capture.
#[derive(Clone, Debug, Default)]
pub struct CaptureTally {
    /// Packets of the file.
    pub packets: u64,
    /// IP fragments.
    pub fragments: u64,
    /// Packets with a header that is cut or wrong.
    pub unreadable: u64,
    /// Packets by unknown link type.
    pub links: BTreeMap<i32, u64>,
    /// TCP segments on the selected ports.
    pub segments: u64,
    /// TCP segments on other ports.
    pub elsewhere: u64,
    /// TCP connections on the selected ports.
    pub connections: u64,
    /// EtherCAT frames with an AMS frame.
    pub ethercat: u64,
    /// Connections whose beginning was not captured.
    pub joined: u64,
    /// Retransmitted segments.
    pub repeated: u64,
    /// Segments that were captured before an earlier one.
    pub early: u64,
    /// Gaps: places at which bytes are missing.
    pub gaps: u64,
    /// Bytes skipped to find a frame.
    pub skipped: u64,
    /// AMS frames.
    pub frames: u64,
    /// Messages between clients and their local router.
    pub router: u64,
    /// Frames by AMS port, if it is not a task of a CNC.
    pub other_ports: BTreeMap<u16, u64>,
    /// Frames by command, if it is none of the three services.
    pub commands: BTreeMap<u16, u64>,
    /// Calls by address, if no function has that address.
    pub unknown: BTreeMap<String, u64>,
    /// Requests with their replies.
    pub exchanges: u64,
    /// The first of them: packet, function, address and result.
    pub listed: Vec<String>,
    /// Requests answered by an error.
    pub refused: u64,
    /// Requests whose reply was not captured.
    pub unanswered: u64,
    /// Unanswered requests that were forgotten because too many waited.
    pub forgotten: u64,
    /// Names, objects and elements that were not stored because the limit of 24 MiB was reached.
    pub unkept: u64,
    /// Replies whose request was not captured.
    pub unasked: u64,
    /// Frames whose rest was not captured.
    pub unfinished: u64,
    /// How the file ended.
    pub end: Option<FileEnd>,
}

/// Increments a counter.
pub(super) const fn count(number: &mut u64) {
    *number = number.saturating_add(1);
}

/// Increments the counter of a key.
pub(super) fn count_of<K: Ord>(all: &mut BTreeMap<K, u64>, key: K) {
    if all.len() < UNKNOWN_MAX || all.contains_key(&key) {
        count(all.entry(key).or_default());
    }
}

/// Maximum number of exchanges that are listed.
const LISTED_MAX: usize = 10_000;

impl CaptureTally {
    /// Lists a request with its reply.
    pub(super) fn list(&mut self, packet: u64, exchange: &Exchange) {
        if self.listed.len() < LISTED_MAX {
            let request = exchange.call().dispatch().ok();
            let name = request.map_or("not documented", |request| request.function().spec().name);
            self.listed.push(format!("#{packet}  {name}: {exchange}: {}", exchange.result()));
        }
    }

    /// One line for each group of counters: what the capture has, and which part of it was not
    /// judged.
    pub fn lines(&self) -> Vec<String> {
        let Self { packets, segments, connections, frames, exchanges, .. } = self;
        let mut lines = vec![format!(
            "{packets} packets, {segments} TCP segments in {connections} connections, {frames} \
             frames, {exchanges} requests with their answers"
        )];
        let told = [
            (self.ethercat, "AMS frames in EtherCAT frames, without TCP"),
            (self.refused, "requests answered by an error number"),
            (self.joined, "connections whose beginning was not captured"),
            (self.repeated, "segments that came once more"),
            (self.early, "segments that came out of order"),
            (self.gaps, "gaps: what they touch is inconclusive"),
            (self.skipped, "bytes passed over to find a frame"),
            (self.unanswered, "requests without an answer"),
            (
                self.forgotten,
                "of them forgotten: more than 4096 on a connection, or 16 MiB, waited",
            ),
            (self.unkept, "names, objects and elements not compared: 24 MiB of them are kept"),
            (self.unasked, "answers to no request that was captured"),
            (self.unfinished, "frames unfinished when the connection or the capture ended"),
            (self.router, "messages to a local router, not judged"),
            (self.fragments, "fragments of IP packets, not put together"),
            (self.unreadable, "packets with headers cut or wrong, not judged"),
        ];
        let told = told.into_iter().filter(|(number, _)| *number > 0);
        lines.extend(told.map(|(number, what)| format!("{number} {what}")));
        lines.extend(unjudged("link types", &self.links));
        lines.extend(unjudged("frames to AMS ports", &self.other_ports));
        lines.extend(unjudged("AMS commands", &self.commands));
        lines.extend(unjudged("calls of what is documented nowhere,", &self.unknown));
        if self.segments == 0 && self.elsewhere > 0 {
            let elsewhere = self.elsewhere;
            lines.push(format!(
                "not looked at: {elsewhere} TCP segments on other ports; see --port and --any-port"
            ));
        }
        if let Some(FileEnd::Cut(why)) = &self.end {
            lines.push(format!("judged up to a cut of the file: {why}"));
        }
        lines
    }
}

/// The counters of a map as text, the first of them only.
fn unjudged<K: Display>(what: &str, all: &BTreeMap<K, u64>) -> Option<String> {
    let shown = all.iter().take(SHOWN).map(|(key, number)| format!("{key} ({number})"));
    let shown: Vec<String> = shown.collect();
    let more = match all.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!shown.is_empty()).then(|| format!("not judged: {what} {}{more}", shown.join(", ")))
}
