//! Handles gaps, bytes that are not whole frames, and the ends of connections. Requirements that
//! cannot be judged because of missing bytes become inconclusive.

use ads_cnc::ads::{AmsHeader, FrameRef};
use ads_cnc::limits::AMS_HEADER_LEN;
use ads_cnc::operation::Call;
use ads_cnc::{Decode as _, Error};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::super::connection_event::{ConnectionEnd, SegmentDirection, Span};
use super::super::frames::{is_cnc, is_reply};
use super::super::observation::CapturedFrames;
use super::super::tally::count;
use super::super::tcp::CapturePosition;
use super::pair::REORDERED_MAX;
use super::{CapturedFrame, ConnectionLoss, REPLY_TIMEOUT, TrafficJudge, location};
use crate::evidence::Describe;
use crate::judge::{Checks as _, Rule};
use crate::rules::{Observation, Topic, service_clause};
use crate::text::plural;

impl TrafficJudge {
    pub(super) fn broken(
        &mut self,
        error: Error,
        bytes: &[u8],
        direction: &SegmentDirection,
        span: Span,
    ) {
        let observation = CapturedFrames::Bytes(bytes, location(direction, Some(span), None));
        let case = self.side(direction);
        self.rules.records.on(case, &observation).check(
            ADS_5,
            false,
            "the headers of a frame",
            error,
        );
        self.lost.entry(direction.connection).or_default().gap = Some(span.last.packet);
    }

    /// The side that sent the bytes, according to a waiting request of the connection, otherwise
    /// according to the ports.
    fn side(&self, direction: &SegmentDirection) -> Topic {
        let asks =
            self.waiting.range((direction.connection, 0)..=(direction.connection, u32::MAX)).next();
        match asks.and_then(|(_, all)| all.front()) {
            Some(request_frame) if request_frame.direction.from == direction.from => {
                Topic::ClientFrames
            }
            Some(_) => Topic::CncFrames,
            // The listener usually has the lower port.
            None if direction.to.port() < direction.from.port() => Topic::ClientFrames,
            None => Topic::CncFrames,
        }
    }

    /// Handles the beginning of a frame whose rest was not captured.
    pub(super) fn cut(&mut self, bytes: &[u8], direction: &SegmentDirection, span: Span) {
        let observation = CapturedFrames::Bytes(bytes, location(direction, Some(span), None));
        let there = bytes.len();
        let found = || format!("{} of a frame whose rest was not captured", plural(there, "byte"));
        let begin = FrameRef::HEADERS_LEN.saturating_sub(AMS_HEADER_LEN);
        let header = bytes.get(begin..FrameRef::HEADERS_LEN).map(AmsHeader::decode);
        let Some(Ok(header)) = header else {
            let case = self.side(direction);
            self.rules.records.on(case, &observation).open(ADS_5, found);
            return;
        };
        if !is_reply(&header) {
            if is_cnc(header.target.port) {
                let rule = service_clause(header.command);
                self.open_service(
                    Topic::ClientServices,
                    Topic::ClientFrames,
                    &observation,
                    rule,
                    found,
                );
            }
            return;
        }
        let request_frame = self.forget((direction.connection, header.invoke_id), 0);
        let request_frame =
            request_frame.filter(|request_frame| is_cnc(request_frame.header.target.port));
        let Some(request_frame) = request_frame else { return };
        let rule = service_clause(request_frame.header.command);
        self.open_service(Topic::CncServices, Topic::CncFrames, &observation, rule, found);
        self.open_function(&request_frame, &observation, found);
    }

    fn open_service(
        &mut self,
        case: Topic,
        frames: Topic,
        observation: &dyn Observation,
        rule: ClauseId,
        found: impl Describe,
    ) {
        let case = if rule == ADS_5 { frames } else { case };
        self.rules.records.on(case, observation).open(rule, found);
    }

    /// Makes the requirement of the requested function inconclusive after a lost reply, if the
    /// function returns data.
    fn open_function(
        &mut self,
        request_frame: &CapturedFrame,
        observation: &dyn Observation,
        found: impl Describe,
    ) {
        let Ok(Some((frame, _))) = FrameRef::split(&request_frame.frame, u32::MAX) else { return };
        let Ok(Some(call)) = Call::from_frame(&frame) else { return };
        let Ok(request) = call.dispatch() else { return };
        let spec = request.function().spec();
        if spec.reply.is_some() {
            let case = Topic::of_reply(request.function());
            self.rules.records.on(case, observation).open(Rule::of(spec.clause), found);
        }
    }

    pub(super) fn gap(&mut self, length: u64, direction: &SegmentDirection, mark: CapturePosition) {
        count(&mut self.tally.gaps);
        self.lost.entry(direction.connection).or_default().gap = Some(mark.packet);
        self.gap = self.gap.max(Some(mark.packet));
        self.rules.forget_cncs();
        let span = Span { first: mark, last: mark, end: 0 };
        let observation = CapturedFrames::Bytes(&[], location(direction, Some(span), None));
        let found = || format!("{} missing before this packet", plural(length, "byte"));
        let case = self.side(direction);
        self.rules.records.on(case, &observation).open(ADS_5, found);
    }

    pub(super) fn ended(&mut self, ending: ConnectionEnd) {
        let connection = ending.connection;
        self.judge_all_unmatched(connection);
        let mut lost = self.lost.remove(&connection).unwrap_or_default();
        if self.is_crossed {
            lost.gap = lost.gap.max(self.gap);
            lost.joined |= self.tally.joined > 0;
        }
        let keys = self.waiting.range((connection, 0)..=(connection, u32::MAX));
        let keys: Vec<_> = keys.map(|(key, _)| *key).collect();
        let is_missed = !keys.is_empty() || (!lost.unasked.is_empty() && !lost.is_running);
        if let Some(direction) = ending.unseen.filter(|_| is_missed) {
            self.one_sided(&direction, !keys.is_empty());
        }
        for key in keys {
            while let Some(request_frame) = self.forget(key, 0) {
                self.unanswered(&request_frame, &lost, ending);
            }
        }
        // If the capture lacks the beginning of the connection, these replies may belong to
        // requests that were sent before the capture began. They may also belong to a dropped
        // request.
        let unasked = lost.unasked.iter().filter(|_| !lost.joined && !lost.is_running);
        for reply in unasked {
            self.unasked(reply, lost.gap.is_some() || ending.unseen.is_some());
        }
        self.waiting_of.remove(&connection);
    }

    /// Handles a connection with one direction that was not captured.
    fn one_sided(&mut self, direction: &SegmentDirection, is_cnc: bool) {
        let observation = CapturedFrames::Bytes(&[], location(direction, None, None));
        let (case, found) = if is_cnc {
            (Topic::CncFrames, "no segment sent by the CNC was captured")
        } else {
            (Topic::ClientFrames, "no segment sent by the client was captured")
        };
        self.rules.records.on(case, &observation).open(ADS_5, found);
    }

    fn unanswered(
        &mut self,
        request_frame: &CapturedFrame,
        lost: &ConnectionLoss,
        ending: ConnectionEnd,
    ) {
        count(&mut self.tally.unanswered);
        let observation = CapturedFrames::Bytes(
            &request_frame.frame,
            location(&request_frame.direction, Some(request_frame.span), None),
        );
        let packet = request_frame.span.last.packet;
        if lost.gap.is_some_and(|gap| gap.saturating_add(REORDERED_MAX) >= packet) {
            self.open_function(request_frame, &observation, "the reply may be in a gap");
            return;
        }
        let waited = match (self.now, request_frame.span.last.time) {
            (Some(now), Some(then)) => now.since(then),
            _ => return,
        };
        // A missing reply is a failure only if both directions and later packets of the connection
        // were captured.
        let followed = ending.unseen.is_none() && ending.last > packet;
        if waited > REPLY_TIMEOUT && !lost.joined && followed {
            let rule = service_clause(request_frame.header.command);
            let found = || format!("none within {} s", waited.as_secs());
            let case = if rule == ADS_5 { Topic::CncFrames } else { Topic::CncServices };
            self.rules.records.on(case, &observation).check(rule, false, "an answer", found);
        }
    }
}
