//! Counters of a capture, mainly of packets and frames that are not judged.

use std::collections::BTreeMap;
use std::fmt::Display;

use ads_cnc::CncStr;
use ads_cnc::ads::{AmsPort, Command};
use ads_cnc::operation::{AdsService, Call, DispatchError, Function};

use super::file::FileEnd;
use crate::exchange::Exchange;
use crate::explain::{ExplainQuery, ExplainSubject, command_name, explain};
use crate::rules::function_at;
use crate::text::hex::spaced;
use crate::text::{escape, plural, shorten};
use crate::value_format::ValueFormat;
use crate::values::until_nul;

/// Maximum number of different keys in a map of counters, such as unknown addresses.
const UNKNOWN_MAX: usize = 1000;

/// Maximum number of entries that a line shows.
const SHOWN: usize = 8;

/// Counters of a capture.
#[derive(Clone, Debug, Default)]
pub struct CaptureTally {
    /// Packets in the file.
    pub packets: u64,
    /// Packets in the parts of the file that `ads-cnc run` wrote, in which the suite is the client.
    pub of_suite: u64,
    /// Fragments of IP packets that contain TCP.
    pub fragments: u64,
    /// Packets with a truncated or invalid header.
    pub unreadable: u64,
    /// Packets with an unsupported link type, by link type.
    pub links: BTreeMap<i32, u64>,
    /// TCP segments on the selected ports.
    pub segments: u64,
    /// TCP segments on other ports.
    pub elsewhere: u64,
    /// TCP connections on the selected ports, including those without an AMS frame.
    pub connections: u64,
    /// AMS frames in EtherCAT frames instead of TCP, as ADS Monitor records them.
    pub ethercat: u64,
    /// Connections whose beginning was not captured; with [`Ports::Any`](super::Ports::Any), only
    /// those with an AMS frame.
    pub joined: u64,
    /// Segments that begin with bytes that were already captured or counted as a gap, such as
    /// retransmitted segments.
    pub repeated: u64,
    /// Segments that were captured while earlier bytes were missing.
    pub early: u64,
    /// Gaps, that is, places where bytes were not captured.
    pub gaps: u64,
    /// Bytes skipped to find a frame.
    pub skipped: u64,
    /// Whole AMS frames.
    pub frames: u64,
    /// Messages between clients and their local router.
    pub router: u64,
    /// Requests to, and replies from, AMS ports that do not belong to a task of a CNC, by port.
    pub other_ports: BTreeMap<u16, u64>,
    /// Frames to and from the ports of a CNC with commands other than Read, Write and ReadWrite, by
    /// command.
    pub commands: BTreeMap<u16, u64>,
    /// Requests for which no function is found, and requests that may access content at the address
    /// of a function (SDA-12), by service and address.
    pub unknown: BTreeMap<String, u64>,
    /// Requests with a reply.
    pub exchanges: u64,
    /// The first exchanges: packet, function with the fields that identify the object (such as its
    /// name or index) or with the address, and result.
    pub listed: Vec<String>,
    /// Requests with an error reply.
    pub rejected: u64,
    /// Requests whose reply was not captured.
    pub unanswered: u64,
    /// Requests that were dropped because too many waited for a reply.
    pub forgotten: u64,
    /// Facts about names, objects and elements that were not stored because of the limit of 24 MiB.
    pub unkept: u64,
    /// Packets of NC programs that were not checked for loops and jumps back because of the limit
    /// of 32 channels.
    pub unchecked: u64,
    /// Replies whose request was not captured.
    pub unasked: u64,
    /// Frames that were incomplete at the end of a connection or of the capture.
    pub unfinished: u64,
    /// The way in which the file ended.
    pub end: Option<FileEnd>,
}

/// Increments a counter.
pub(super) const fn count(number: &mut u64) {
    *number = number.saturating_add(1);
}

/// Increments the counter of a key. A new key is ignored if the map has [`UNKNOWN_MAX`] keys.
pub(super) fn count_of<K: Ord>(all: &mut BTreeMap<K, u64>, key: K) {
    if all.len() < UNKNOWN_MAX || all.contains_key(&key) {
        count(all.entry(key).or_default());
    }
}

/// Maximum number of listed exchanges.
const LISTED_MAX: usize = 10_000;

impl CaptureTally {
    /// Adds a request with its reply to the list, unless the list has [`LISTED_MAX`] entries.
    pub(super) fn list(&mut self, packet: u64, exchange: &Exchange) {
        if self.listed.len() < LISTED_MAX {
            let (asked, result) = (asked(exchange), answered(exchange));
            self.listed.push(format!("#{packet}  {asked}: {result}"));
        }
    }

    /// Notes about traffic that is missing in the capture.
    pub fn missing(&self) -> Vec<String> {
        let cut = match &self.end {
            Some(FileEnd::Cut(why)) => Some(format!("the file was judged only in part: {why}")),
            _ => None,
        };
        let gaps = (self.gaps > 0).then(|| {
            let gaps = plural(self.gaps, "gap");
            format!("{gaps}: checks that need the missing bytes are inconclusive")
        });
        cut.into_iter().chain(gaps).collect()
    }

    /// Whether there are packets, and the suite is the client in all of them, because `ads-cnc run`
    /// wrote the file.
    pub const fn is_of_suite(&self) -> bool {
        self.packets > 0 && self.of_suite == self.packets
    }

    /// One line for each group of counters: the content of the capture, and the parts that were not
    /// judged.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!(
            "{}, {} in {}, {}, {} with a reply",
            plural(self.packets, "packet"),
            plural(self.segments, "TCP segment"),
            plural(self.connections, "connection"),
            plural(self.frames, "frame"),
            plural(self.exchanges, "request"),
        )];
        // Number, unit and text of each line.
        let counters = [
            (self.ethercat, "AMS frame", " in EtherCAT, without TCP"),
            (self.rejected, "request", " with an error reply"),
            (self.joined, "connection", " with a beginning that was not captured"),
            (self.repeated, "segment", " retransmitted"),
            (self.early, "segment", " out of order"),
            (self.skipped, "byte", " skipped to find a frame"),
            (self.unanswered, "request", " without a reply"),
            (
                self.forgotten,
                "request",
                " of these dropped: more than 4096 on a connection, or 16 MiB, waited for replies",
            ),
            (
                self.unkept,
                "fact",
                " about names, objects and elements not compared: at most 24 MiB are stored",
            ),
            (
                self.unchecked,
                "packet",
                " of NC programs not checked for loops and jumps back: at most 32 channels are checked",
            ),
            (self.unasked, "reply", " without a captured request"),
            (self.unfinished, "frame", " incomplete at the end of the connection or the capture"),
            (self.router, "message", " to a local router, not judged"),
            (self.fragments, "fragment", " of IP packets, not reassembled"),
            (self.unreadable, "packet", " with truncated or invalid headers, not judged"),
        ];
        let counters = counters.into_iter().filter(|(number, ..)| *number > 0);
        lines.extend(counters.map(|(number, noun, what)| plural(number, noun) + what));
        lines.extend(unjudged("link types", &self.links));
        lines.extend(unjudged("frames to AMS ports", &self.other_ports));
        let commands = self.commands.iter().map(|(number, count)| {
            let name = command_name(Command(*number));
            (name.map_or_else(|| number.to_string(), ToOwned::to_owned), *count)
        });
        lines.extend(unjudged("AMS commands", &commands.collect()));
        lines.extend(unjudged("calls of undocumented addresses", &self.unknown));
        if self.segments == 0 && self.elsewhere > 0 {
            let elsewhere = self.elsewhere;
            lines.push(format!(
                "not read: {} on other ports; see --port and --any-port",
                plural(elsewhere, "TCP segment")
            ));
        }
        lines.extend(self.missing());
        lines
    }
}

/// Maximum number of bytes of a value that are shown.
const VALUE_MAX: usize = 16;

/// Maximum number of fields of a request that are shown, and of characters of each.
const FIELDS_MAX: usize = 3;
const FIELD_MAX: usize = 64;

/// Maximum number of characters of a reply that are shown.
const REPLY_MAX: usize = 100;

/// Describes a request: the function with the fields in its data that identify an object, or with
/// the address; only the service and the address if no function matches.
fn asked(exchange: &Exchange) -> String {
    let call = exchange.call();
    let (function, fault) = match call.dispatch() {
        Ok(request) => (request.function(), String::new()),
        Err(rejection) => {
            let function = function_at(&call);
            let fault = function.and_then(|function| mistake(function, &call, &rejection));
            let Some((function, fault)) = function.zip(fault) else {
                return format!("not documented: {exchange}");
            };
            (function, format!(", {fault}"))
        }
    };
    let spec = function.spec();
    let mut fields = Vec::new();
    if let Some(stream) = spec.request {
        // Ignore the error of the walk: `fault` describes the error of a rejected request.
        let _fault = stream.walk(call.data, |segment| {
            if fields.len() < FIELDS_MAX {
                fields.extend(shown(segment.field.name(), segment.bytes));
            }
        });
        // `walk` stops at a name without its NUL; show the name anyway.
        let first = stream.layout().fields.first().map_or("", |field| field.name);
        if fields.is_empty() && first == "name" {
            fields.extend(shown(first, call.data));
        }
    }
    if fields.is_empty() {
        let Exchange { index_group, index_offset, .. } = exchange;
        fields.push(format!("{index_group}, {index_offset}"));
    }
    let title = spec.name.trim_end_matches(" by index");
    format!("{title} {}{fault}", fields.join(", "))
}

/// A field that identifies the object of a request; `None` for other fields.
fn shown(field: &str, bytes: &[u8]) -> Option<String> {
    match (field, <[u8; 4]>::try_from(bytes)) {
        ("name" | "kind", _) => {
            let text = CncStr::from_bytes(until_nul(bytes)).ok()?.to_string();
            (!text.is_empty()).then(|| shorten(&escape(&text), FIELD_MAX))
        }
        ("handle", Ok(number)) => Some(format!("{:#x}", u32::from_le_bytes(number))),
        ("index" | "class" | "instance", Ok(number)) => {
            Some(format!("{field} {}", u32::from_le_bytes(number)))
        }
        _ => None,
    }
}

/// Describes the error in a call of `function`; `None` if the call may not be meant for `function`.
fn mistake(function: Function, call: &Call<'_>, rejection: &DispatchError) -> Option<String> {
    let spec = function.spec();
    let is_com = |port: AmsPort| port == AmsPort::COM;
    match rejection {
        DispatchError::Stream(error) => Some(format!("malformed: {error}")),
        _ if is_com(call.port) != is_com(spec.task.port()) => {
            Some(format!("at port {} instead of {}", call.port, spec.task.port()))
        }
        // A Read at the address of a function may address an element (SDA-12).
        DispatchError::Service { expected, found } if *found != AdsService::Read => {
            Some(format!("by {found} instead of {expected}"))
        }
        _ => None,
    }
}

/// The result of an exchange: the fields or the first bytes of the reply, the first bytes that were
/// written, or the error.
fn answered(exchange: &Exchange) -> String {
    let written = (exchange.service == AdsService::Write).then_some(&*exchange.data);
    match exchange.success() {
        Some([]) if written.is_some_and(|data| !data.is_empty()) => {
            format!("{} written", bytes_of(written.unwrap_or_default()))
        }
        Some(data) if !data.is_empty() => decoded(exchange, data).unwrap_or_else(|| bytes_of(data)),
        _ => exchange.result_in_words(),
    }
}

/// The fields of a reply with their values, if the stream determines their types.
fn decoded(exchange: &Exchange, data: &[u8]) -> Option<String> {
    let stream = exchange.call().dispatch().ok()?.function().spec().reply?;
    let (subject, values) = (ExplainSubject::Stream(stream), ValueFormat::default());
    let part = explain(&ExplainQuery { subject, values }, data).parts.into_iter().next()?;
    let is_known = part.faults.is_empty() && part.rows.iter().all(|row| !row.value.is_empty());
    let is_opaque =
        part.rows.iter().any(|row| ["value", "content", "data"].contains(&row.field.as_str()));
    let fields = part.rows.iter().map(|row| format!("{} {}", row.field, row.value));
    let fields = fields.collect::<Vec<_>>().join(", ");
    (is_known && !is_opaque).then(|| shorten(&fields, REPLY_MAX))
}

fn bytes_of(data: &[u8]) -> String {
    match data.get(..VALUE_MAX) {
        Some(start) if data.len() > VALUE_MAX => {
            format!("{} … ({})", spaced(start), plural(data.len(), "byte"))
        }
        _ => spaced(data),
    }
}

/// The first [`SHOWN`] counters of a map as text; `None` if the map is empty.
fn unjudged<K: Display>(what: &str, all: &BTreeMap<K, u64>) -> Option<String> {
    let shown = all.iter().take(SHOWN).map(|(key, number)| format!("{key} ({number})"));
    let shown: Vec<String> = shown.collect();
    let more = match all.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!shown.is_empty()).then(|| format!("not judged: {what} {}{more}", shown.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_named() {
        let commands = BTreeMap::from([(Command::READ_STATE.0, 4), (77, 1)]);
        let lines = CaptureTally { commands, ..CaptureTally::default() }.lines();
        let line = "not judged: AMS commands 77 (1), ReadState (4)";
        assert!(lines.iter().any(|one| one == line), "{lines:?}");
    }
}
