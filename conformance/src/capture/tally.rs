//! What was in a capture, counted; most of it is not judged.

use std::collections::BTreeMap;
use std::fmt::Display;

use super::file::FileEnd;

/// Addresses that are told apart.
const UNKNOWN_MAX: usize = 1000;

/// How many of those are shown.
const SHOWN: usize = 8;

/// What was in a capture.
#[derive(Clone, Debug, Default)]
pub struct CaptureTally {
    /// Packets of the file.
    pub packets: u64,
    /// Packets of IP that are pieces of one, headers that are cut or wrong, link types unknown here.
    pub fragments: u64,
    /// Packets with a header that is cut or wrong.
    pub unreadable: u64,
    /// Packets of each link type that is not known here.
    pub links: BTreeMap<i32, u64>,
    /// TCP segments on the ports that were looked at.
    pub segments: u64,
    /// TCP segments on other ports.
    pub elsewhere: u64,
    /// TCP connections on the ports that were looked at.
    pub connections: u64,
    /// Connections whose beginning was not captured.
    pub joined: u64,
    /// Segments that came once more.
    pub repeated: u64,
    /// Segments that came too early.
    pub early: u64,
    /// Places at which bytes are missing.
    pub gaps: u64,
    /// Bytes that were passed over to find a frame.
    pub skipped: u64,
    /// AMS frames.
    pub frames: u64,
    /// Messages between clients and their local router.
    pub router: u64,
    /// Frames to ports that are no task of a CNC.
    pub other_ports: BTreeMap<u16, u64>,
    /// Frames with a command that is none of the three services.
    pub commands: BTreeMap<u16, u64>,
    /// Calls of addresses at which no function is.
    pub unknown: BTreeMap<String, u64>,
    /// Requests with their answers.
    pub exchanges: u64,
    /// Those that were answered by an error.
    pub refused: u64,
    /// Requests of which no answer was seen.
    pub unanswered: u64,
    /// Those among them that were forgotten, because too many or too long ones waited.
    pub forgotten: u64,
    /// Names, objects and elements that were not kept, because 24 MiB were.
    pub unkept: u64,
    /// Answers of which no request was seen.
    pub unasked: u64,
    /// Frames whose rest never came.
    pub unfinished: u64,
    /// How the file ended.
    pub end: Option<FileEnd>,
}

/// One more.
pub(super) const fn count(number: &mut u64) {
    *number = number.saturating_add(1);
}

/// One more of these.
pub(super) fn count_of<K: Ord>(all: &mut BTreeMap<K, u64>, key: K) {
    if all.len() < UNKNOWN_MAX || all.contains_key(&key) {
        count(all.entry(key).or_default());
    }
}

impl CaptureTally {
    /// What a reader should know, a line each: what is there, and what was not judged.
    pub fn lines(&self) -> Vec<String> {
        let Self { packets, segments, connections, frames, exchanges, .. } = self;
        let mut lines = vec![format!(
            "{packets} packets, {segments} TCP segments in {connections} connections, {frames} \
             frames, {exchanges} requests with their answers"
        )];
        let told = [
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

/// What was counted and not judged, the first of it.
fn unjudged<K: Display>(what: &str, all: &BTreeMap<K, u64>) -> Option<String> {
    let shown = all.iter().take(SHOWN).map(|(key, number)| format!("{key} ({number})"));
    let shown: Vec<String> = shown.collect();
    let more = match all.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!shown.is_empty()).then(|| format!("not judged: {what} {}{more}", shown.join(", ")))
}
