//! Sends generated requests, including malformed queries, as far as the gate of a mode allows them,
//! and records the replies, to distinguish two CNCs.
//!
//! Only queries have malformed variants, some of them with the service Write. Writes to an axis or
//! a channel that may not exist are omitted: the suite sends most malformed writes to the simulated
//! CNC only. The requests are derived from the function table, from the lists of the CNC, from
//! boundary values and short sequences, but not from the cases of the suite. Two CNCs with equal
//! replies receive the same requests, so equal digests mean replies that are equal as far as
//! `meaning` compares them.

mod configurable;
mod queries;
mod writes;

use std::collections::BTreeMap;
use std::fmt::Display;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use ads_cnc::address::{Channel, ElementAddress, IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, DeviceInfoReply, DeviceStateReply};
use ads_cnc::dynamic::DynamicKind;
use ads_cnc::limits::{DESCRIPTOR_LEN, STREAM_PACKET_MAX};
use ads_cnc::operation::{
    AdsService, Call, CountDynamic, CountVariables, Effect, Function, Request, Task,
};
use ads_cnc::{CncString, Handle, Kind};

pub(super) use self::configurable::Compare;
use self::configurable::ConfigurableReplies;
use crate::client::{Client, Inquiry};
use crate::exchange::ExchangeError;
use crate::number::{digest, to_u32};
use crate::simulator::Cnc;
use crate::text::hex::compact;

/// The bytes of the result in the frame of a reply with data.
const RESULT: Range<usize> = 38..42;
/// The bytes of the lengths in the AMS/TCP header and the AMS header of a frame.
const LENGTHS: [Range<usize>; 2] = [2..6, 26..30];
/// The requested channel numbers and ranks.
const CHANNELS: [u32; 14] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 255];
/// The requested axes, axis indices and spindles.
const AXES: [u32; 7] = [1, 2, 3, 4, 5, 6, 255];
/// The number of requests of each query function of which malformed variants are also sent.
const MALFORMED_EACH: usize = 6;

#[derive(Clone)]
struct Variable {
    channel: Channel,
    name: CncString,
    handle: Option<Handle>,
    dimensions: Vec<u32>,
    writable: bool,
}

/// The address and size of the content of an object or element that a list contains.
struct ContentAddress {
    group: IndexGroup,
    offset: IndexOffset,
    element: Option<ElementAddress>,
    size: u32,
}

/// Sends the requests, and records the digest of each reply.
pub(super) struct ReplyRecorder<'t> {
    client: Client,
    cnc: Arc<Cnc>,
    correct_digests: Option<&'t [u64]>,
    answers: Vec<u64>,
    difference: Option<String>,
    malformed: BTreeMap<Function, usize>,
    variables: Vec<Variable>,
    contents: Vec<ContentAddress>,
    /// The axis indices to which nothing is written, as channel and index.
    unwritten_places: &'t [(u32, u32)],
    /// The replies whose values are ignored, because the configuration determines them; `None` to
    /// compare all values.
    configurable: Option<ConfigurableReplies>,
}

/// The digests of the recorded replies.
pub(super) struct RecordedAnswers {
    pub(super) answers: Vec<u64>,
    /// The first request whose reply differs from that of the other CNC.
    pub(super) difference: Option<String>,
}

/// Sends the generated requests that the client's gate allows. `correct_digests` contains the
/// digests of the replies of another CNC: the function stops at the first reply with a different
/// digest.
pub(super) fn ask_everything<'t>(
    client: Client,
    cnc: Arc<Cnc>,
    correct_digests: Option<&'t [u64]>,
    compare: Compare,
    unwritten_places: &'t [(u32, u32)],
) -> RecordedAnswers {
    let mut dialogue = ReplyRecorder {
        client,
        cnc,
        correct_digests,
        answers: Vec::new(),
        difference: None,
        malformed: BTreeMap::new(),
        variables: Vec::new(),
        contents: Vec::new(),
        unwritten_places,
        configurable: (compare == Compare::Configured).then(ConfigurableReplies::default),
    };
    dialogue.everything();
    let ReplyRecorder { answers, mut difference, .. } = dialogue;
    if difference.is_none()
        && correct_digests.is_some_and(|correct_digests| correct_digests.len() != answers.len())
    {
        difference = Some("the end: the other CNC is asked more".to_owned());
    }
    RecordedAnswers { answers, difference }
}

impl ReplyRecorder<'_> {
    fn everything(&mut self) {
        self.queries();
        if self.client.gate().may_let_writes_pass() {
            self.writes();
            self.streams();
            self.services();
        }
        // Some defects change a reply only after other requests, after writes or after some time.
        self.queries();
        for _ in 0..12 {
            self.cnc.pass(Duration::from_secs(1));
            self.channels().into_iter().for_each(|channel| self.parameters(channel));
        }
    }

    fn queries(&mut self) {
        self.variables.clear();
        self.contents.clear();
        for port in [Task::Geo, Task::Sda, Task::Com].map(Task::port) {
            self.inquire::<DeviceInfoReply>(port);
            self.inquire::<DeviceStateReply>(port);
        }
        for channel in self.channels() {
            self.variables(channel);
            self.parameters(channel);
            self.axes(channel);
        }
        self.objects();
        self.elements();
    }

    /// Sends a request if the client's gate allows it. If it is one of the first requests of a
    /// query function and the mode has malformed requests, then sends malformed variants of it.
    /// Returns the data of a successful reply.
    fn ask<'a>(&mut self, request: impl Into<Request<'a>>) -> Option<Vec<u8>> {
        let request = request.into();
        let mut buf = vec![0; request.encoded_len()];
        let call = request.encode(&mut buf).ok()?;
        let data = self.call(&call);
        let sent = self.malformed.entry(request.function()).or_default();
        *sent += 1;
        // The suite sends most malformed writes to the simulated CNC only
        // (`Needs::MalformedWrites`).
        let is_query = request.function().spec().effect == Effect::Query;
        if is_query && *sent <= MALFORMED_EACH && self.client.gate().lets_malformed_pass() {
            self.send_malformed(&call, data.as_ref().map_or(0, Vec::len));
        }
        data
    }

    /// Sends variants of a request, each with at most one change: data, service, port, read length,
    /// or one bit of the index group or offset. `answered` is the number of bytes of data in the
    /// reply to the correct request.
    fn send_malformed(&mut self, call: &Call<'_>, answered: usize) {
        let longer = [call.data, &[0]].concat();
        let shorter = |count: usize| call.data.get(..call.data.len().checked_sub(count)?);
        let data = [Some(&longer[..]), shorter(1), shorter(4), Some(&[][..])];
        for data in data.into_iter().flatten() {
            self.call(&Call { data, ..*call });
        }
        for service in [AdsService::Read, AdsService::Write, AdsService::ReadWrite] {
            self.call(&Call { service, ..*call });
        }
        for port in [0, 550, 551, 552, 553, 554, 10_000, 65_535].map(AmsPort) {
            self.call(&Call { port, ..*call });
        }
        let answered = to_u32(answered);
        for read_length in [0, 1, answered.saturating_sub(1), answered, u32::MAX] {
            self.call(&Call { read_length, ..*call });
        }
        for bit in 0..32 {
            let flipped = |number: u32| number ^ 1_u32.wrapping_shl(bit);
            let index_group = IndexGroup::new(flipped(call.index_group.get()));
            self.call(&Call { index_group, ..*call });
            let index_offset = IndexOffset::new(flipped(call.index_offset.get()));
            self.call(&Call { index_offset, ..*call });
        }
    }

    fn call(&mut self, call: &Call<'_>) -> Option<Vec<u8>> {
        if self.difference.is_some() {
            return None;
        }
        let exchange = self.client.call(call);
        let fault = match &exchange.outcome {
            Err(ExchangeError::NotPermitted(_) | ExchangeError::Unsendable(_)) => return None,
            Err(fault) => fault.to_string(),
            Ok(_) => String::new(),
        };
        let violations = exchange.violations.iter().map(|one| one.what.as_str());
        let outcome: Vec<&str> = violations.chain([fault.as_str()]).collect();
        let mut received = meaning(Some(call), &exchange.received);
        let data = exchange.reply().and_then(|reply| reply.success());
        let writes = self.client.gate().may_let_writes_pass();
        if let (Some(replies), Some(data)) = (&mut self.configurable, data)
            && let Some(marker) = replies.marker(call, data, writes)
        {
            received.truncate(RESULT.end);
            for length in LENGTHS {
                received.get_mut(length).unwrap_or_default().fill(0);
            }
            received.extend(marker.as_bytes());
        }
        self.record(&received, &outcome.join("\n"), || {
            let spec = call.dispatch().map(|request| request.function().spec().name);
            let data = compact::show(call.data);
            format!("{} to port {}: {exchange} [{data}]", spec.unwrap_or("no function"), call.port)
        });
        exchange.reply().and_then(|reply| reply.success()).map(<[u8]>::to_vec)
    }

    fn inquire<R: Inquiry>(&mut self, port: AmsPort) {
        if self.difference.is_none() {
            let inquired = self.client.inquire::<R>(port);
            let outcome = inquired.outcome.as_ref().err().map(ToString::to_string);
            let received = meaning(None, &inquired.received);
            self.record(&received, &outcome.unwrap_or_default(), || inquired.to_string());
        }
    }

    fn record(&mut self, received: &[u8], outcome: &str, request: impl FnOnce() -> String) {
        let answer = digest(&[received, outcome.as_bytes()].concat());
        let is_correct = self
            .correct_digests
            .is_none_or(|correct_digests| correct_digests.get(self.answers.len()) == Some(&answer));
        if !is_correct {
            self.difference = Some(request());
        }
        self.answers.push(answer);
    }

    /// The channels, by number and by rank, that reply to a query with a success.
    fn channels(&mut self) -> Vec<Channel> {
        let numbers = CHANNELS.iter().filter_map(|&number| Channel::new(number).ok());
        let ranks = CHANNELS.iter().filter_map(|&rank| Channel::by_index(rank).ok());
        numbers
            .chain(ranks)
            .filter(|&channel| {
                let variables = self.ask(CountVariables::new(channel, Kind::V_E));
                let parameters = self.ask(CountDynamic::new(channel, DynamicKind::P));
                variables.or(parameters).is_some()
            })
            .collect()
    }
}

/// A received frame without the differences that do not count. Each error number, and each value
/// TRUE of a write flag or of the write access in a descriptor, is replaced by 1: the manuals
/// document no error numbers, and every number except 0 is TRUE. The result of a write of 1 to 992
/// bytes to the program stream is removed: whether it is accepted or rejected as busy depends on
/// the speed of the CNC.
fn meaning(call: Option<&Call<'_>>, received: &[u8]) -> Vec<u8> {
    const ERROR: Range<usize> = 30..34;
    const DATA: usize = RESULT.end + 4;
    let mut received = received.to_vec();
    for number in [ERROR, RESULT] {
        set_to_one(received.get_mut(number).unwrap_or_default());
    }
    let function = call.and_then(|call| Some(call.dispatch().ok()?.function()));
    let data = received.get_mut(DATA..).unwrap_or_default();
    match function {
        Some(Function::WriteProgramStream) => {
            let len = call.map_or(0, |call| call.data.len());
            if (1..=STREAM_PACKET_MAX).contains(&len) {
                received.truncate(RESULT.start);
            }
        }
        Some(Function::ReadElementWriteFlag) => {
            data.iter_mut().for_each(|byte| *byte = (*byte).min(1))
        }
        Some(Function::ReadDescriptors) => {
            let records = data.chunks_mut(DESCRIPTOR_LEN);
            records.filter_map(|record| record.get_mut(8..10)).for_each(set_to_one);
        }
        _ => {}
    }
    received
}

/// Replaces a little-endian number by 1, unless it is 0.
fn set_to_one(number: &mut [u8]) {
    if number.iter().any(|byte| *byte != 0) {
        number.fill(0);
        number.iter_mut().take(1).for_each(|byte| *byte = 1);
    }
}

/// Index lists for an array with these dimensions: the first, the second and the last element in
/// all dimensions, an index after the last and index 1 in each dimension alone, and one index too
/// many.
fn parts(dimensions: &[u32]) -> Vec<Vec<u32>> {
    let mut parts: Vec<Vec<u32>> = [0, 1, u32::MAX]
        .map(|at| dimensions.iter().map(|&count| at.min(count.saturating_sub(1))).collect())
        .into();
    for beyond in 0..dimensions.len() {
        let each = dimensions.iter().enumerate();
        parts.push(each.map(|(at, &count)| if at == beyond { count } else { 0 }).collect());
        parts.push(dimensions.iter().enumerate().map(|(at, _)| u32::from(at == beyond)).collect());
    }
    parts.push(vec![0; dimensions.len() + 1]);
    parts.sort_unstable();
    parts.dedup();
    parts.retain(|part| !part.is_empty());
    parts
}

/// Indices as they are written in names: `[1][2]`.
fn brackets(indices: &[impl Display]) -> String {
    indices.iter().map(|index| format!("[{index}]")).collect()
}

fn number(data: &[u8]) -> Option<u32> {
    data.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}
