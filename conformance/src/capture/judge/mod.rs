//! Pairs requests with their replies and judges them.

mod gaps;
mod pair;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::Duration;

use ads_cnc::ads::{AmsHeader, FrameRef};
use ads_cnc::operation::Call;

use super::connection_event::{ConnectionEvent, SegmentDirection, Span};
use super::frames::{is_cnc, is_reply};
use super::observation::{CapturedFrames, Location};
use super::table::ConnectionTable;
use super::tally::{CaptureTally, count, count_of};
use super::time::Time;
use super::vectors::Collector;
use crate::client::answer;
use crate::exchange::{Exchange, ExchangeError, violations};
use crate::judge::{CaseOutcome, Checks as _};
use crate::rules::{RuleBook, Topic, service_clause};

/// If no reply is captured within this time after a request, the reply is missing.
const REPLY_TIMEOUT: Duration = Duration::from_secs(5);

/// A captured frame and its location.
#[derive(Clone, Debug)]
struct CapturedFrame {
    /// The number of the frame in the capture.
    number: u64,
    frame: Vec<u8>,
    header: AmsHeader,
    direction: SegmentDirection,
    span: Span,
}

/// The missing parts of a connection.
#[derive(Debug, Default)]
struct ConnectionLoss {
    /// Whether the beginning of the connection was not captured, or a waiting request was dropped.
    joined: bool,
    /// Whether requests may have been sent before the capture began, although all later frames were
    /// captured.
    is_running: bool,
    /// The number of the last packet that follows a gap, or that contains bytes that are not a
    /// frame.
    gap: Option<u64>,
    /// The first [`SHOWN`] replies that belong to no waiting request.
    unasked: Vec<CapturedFrame>,
}

/// Replies whose request has not been captured yet, in the order of the capture.
#[derive(Debug, Default)]
struct EarlyReplies {
    all: BTreeMap<u64, CapturedFrame>,
    /// The numbers of the replies by invoke ID.
    ids: BTreeSet<(u32, u64)>,
    /// The numbers of the replies by connection.
    connections: BTreeSet<(u64, u64)>,
    bytes: usize,
}

#[derive(Debug)]
pub(super) struct TrafficJudge {
    rules: RuleBook,
    pub(super) tally: CaptureTally,
    /// Requests without a reply, by connection and invoke ID.
    waiting: BTreeMap<(u64, u32), VecDeque<CapturedFrame>>,
    /// The keys of `waiting` with their parts swapped: invoke ID and connection.
    waiting_ids: BTreeSet<(u32, u64)>,
    /// For each connection, the numbers and invoke IDs of its waiting requests.
    waiting_of: BTreeMap<u64, BTreeMap<u64, u32>>,
    /// Memory of all waiting requests in bytes, estimated.
    waiting_bytes: usize,
    early: EarlyReplies,
    lost: BTreeMap<u64, ConnectionLoss>,
    /// The number of the last packet that follows a gap in any connection.
    gap: Option<u64>,
    /// Whether a request and its reply were captured on different connections.
    is_crossed: bool,
    vectors: Option<Collector>,
    now: Option<Time>,
    /// The highest number of a packet that completed a frame.
    newest: u64,
}

fn location(
    direction: &SegmentDirection,
    request_frame: Option<Span>,
    answered: Option<Span>,
) -> Location {
    Location { from: direction.from, to: direction.to, request: request_frame, reply: answered }
}

impl TrafficJudge {
    pub(super) fn new(vectors: Option<Collector>) -> Self {
        Self {
            rules: RuleBook::new(false),
            tally: CaptureTally::default(),
            waiting: BTreeMap::new(),
            waiting_ids: BTreeSet::new(),
            waiting_of: BTreeMap::new(),
            waiting_bytes: 0,
            early: EarlyReplies::default(),
            lost: BTreeMap::new(),
            gap: None,
            is_crossed: false,
            vectors,
            now: None,
            newest: 0,
        }
    }

    /// The number of cases that have failed.
    pub(super) fn failed(&self) -> usize {
        self.rules.records.failed()
    }

    /// The outcomes of all cases, the tally, and the collected vectors.
    pub(super) fn finish(mut self) -> (Vec<CaseOutcome>, CaptureTally, Option<Collector>) {
        self.tally.unkept = self.rules.missed();
        self.tally.unchecked = self.rules.unchecked();
        for line in self.tally.lines().into_iter().skip(1) {
            self.rules.records.note(Topic::CncFrames, line);
        }
        (self.rules.records.finish(), self.tally, self.vectors)
    }

    /// Sets the time to that of the current packet, unless an earlier packet has a later time.
    pub(super) fn at(&mut self, time: Option<Time>) {
        self.now = time.max(self.now);
    }

    /// Handles an event on a connection.
    pub(super) fn take(&mut self, event: ConnectionEvent, table: &ConnectionTable) {
        match event {
            ConnectionEvent::Frame(frame, direction, span) => {
                self.frame(frame, direction, span, table)
            }
            ConnectionEvent::Router(count) => {
                self.tally.router = self.tally.router.saturating_add(count);
            }
            ConnectionEvent::Broken(error, bytes, direction, span) => {
                self.broken(error, &bytes, &direction, span)
            }
            ConnectionEvent::Cut(bytes, direction, span) => self.cut(&bytes, &direction, span),
            ConnectionEvent::Gap(length, direction, mark) => self.gap(length, &direction, mark),
            ConnectionEvent::Skipped(length) => {
                let length = u64::try_from(length).unwrap_or(u64::MAX);
                self.tally.skipped = self.tally.skipped.saturating_add(length);
            }
            ConnectionEvent::Joined(connection) => {
                count(&mut self.tally.joined);
                self.lost.entry(connection).or_default().joined = true;
                self.rules.forget_cncs();
            }
            ConnectionEvent::Running(connection) => {
                self.lost.entry(connection).or_default().is_running = true;
            }
            ConnectionEvent::Unfinished => count(&mut self.tally.unfinished),
            ConnectionEvent::Ended(ending) => self.ended(ending),
        }
    }

    fn frame(
        &mut self,
        frame: Vec<u8>,
        direction: SegmentDirection,
        span: Span,
        table: &ConnectionTable,
    ) {
        count(&mut self.tally.frames);
        let Ok(Some((whole, _))) = FrameRef::split(&frame, u32::MAX) else { return };
        let header = whole.header();
        self.newest = self.newest.max(span.last.packet);
        let captured = CapturedFrame { number: self.tally.frames, header, direction, span, frame };
        if is_reply(&header) {
            self.reply(captured)
        } else {
            self.request(captured, table)
        }
        self.judge_expired(table);
    }

    fn request(&mut self, captured: CapturedFrame, table: &ConnectionTable) {
        let header = captured.header;
        if !is_cnc(header.target.port) {
            count_of(&mut self.tally.other_ports, header.target.port.0);
            return;
        }
        let Ok(Some((frame, _))) = FrameRef::split(&captured.frame, u32::MAX) else { return };
        let call = Call::from_frame(&frame);
        let exchange = call.as_ref().ok().copied().flatten().map(|call| Exchange {
            sent: captured.frame.clone(),
            outcome: Err(ExchangeError::Unseen),
            ..Exchange::new(&call)
        });
        let place = location(&captured.direction, Some(captured.span), None);
        let observation = match &exchange {
            Some(exchange) => CapturedFrames::Exchange(exchange, place),
            None => CapturedFrames::Bytes(&captured.frame, place),
        };
        let again = self.is_repeated(&captured, table);
        self.rules.records.request_headers(&observation, &header, again);
        match call {
            Err(error) => {
                let rule = service_clause(header.command);
                let mut record = self.rules.records.on(Topic::ClientServices, &observation);
                record.check(rule, false, "the request of the service", error);
            }
            Ok(None) => {
                count_of(&mut self.tally.commands, header.command.0);
                return;
            }
            Ok(Some(call)) => {
                self.rules
                    .records
                    .on(Topic::ClientServices, &observation)
                    .pass(service_clause(header.command));
                if let Some(unknown) = self.rules.records.request(&observation, &call) {
                    count_of(&mut self.tally.unknown, unknown);
                }
            }
        }
        self.wait(captured);
    }

    fn exchange(&mut self, request_frame: &CapturedFrame, reply: &CapturedFrame) {
        count(&mut self.tally.exchanges);
        self.is_crossed |= request_frame.direction.connection != reply.direction.connection;
        let Ok(Some((sent, _))) = FrameRef::split(&request_frame.frame, u32::MAX) else { return };
        let Ok(Some((received, _))) = FrameRef::split(&reply.frame, u32::MAX) else { return };
        // Only requests of the services Read, Write and ReadWrite are judged with their replies.
        let Ok(Some(call)) = Call::from_frame(&sent) else { return };
        let exchange = Exchange {
            sent: request_frame.frame.clone(),
            received: reply.frame.clone(),
            outcome: answer(request_frame.header, reply.header, received.data())
                .map(|answer| (answer, reply.header)),
            ..Exchange::new(&call)
        };
        self.tally.list(request_frame.span.last.packet, &exchange);
        let place = location(&request_frame.direction, Some(request_frame.span), Some(reply.span));
        let observation = CapturedFrames::Exchange(&exchange, place);
        let net_id = request_frame.header.target.net_id;
        let violations = violations(&request_frame.header, &reply.header);
        self.rules.reply(&observation, net_id, &call, &exchange, &violations);
        let Some(reply) = exchange.reply() else { return };
        if reply.success().is_none() {
            count(&mut self.tally.rejected);
        }
        if !reply.ams_error.is_ok() {
            return;
        }
        if let (Some(vectors), Ok(request)) = (&mut self.vectors, call.dispatch()) {
            let known = self.rules.described(net_id, &request);
            vectors.add(&request, &call, reply.success(), known.as_ref());
        }
    }
}
