//! What is missing of a capture, and what that leaves open.

use ads_cnc::ads::{AmsHeader, FrameRef};
use ads_cnc::limits::AMS_HEADER_LEN;
use ads_cnc::{Decode as _, Error};

use super::super::book::{Scene, Topic};
use super::super::frames::Span;
use super::super::table::Way;
use super::super::tally::count;
use super::super::tcp::Mark;
use super::{Judge, Lost, PATIENCE, Seen, is_cnc, is_reply, service_clause, spot};
use crate::exchange::call_of;
use crate::suite::Checks as _;

impl Judge {
    pub(super) fn broken(&mut self, error: Error, bytes: &[u8], way: &Way, span: Span) {
        let scene = Scene::Bytes(bytes, spot(way, Some(span), None));
        let topic = self.side(way);
        self.book.on(topic, &scene).check("ADS-5", false, "the headers of a frame", error);
        self.lost.entry(way.connection).or_default().gap = Some(span.last.packet);
    }

    /// Who sent this, as far as the ports tell.
    fn side(&self, way: &Way) -> Topic {
        let asks = self.waiting.range((way.connection, 0)..=(way.connection, u32::MAX)).next();
        match asks.and_then(|(_, all)| all.front()) {
            Some(asked) if asked.way.from == way.from => Topic::ClientFrames,
            Some(_) => Topic::CncFrames,
            // The listener's port is the lower one as a rule.
            None if way.to.port() < way.from.port() => Topic::ClientFrames,
            None => Topic::CncFrames,
        }
    }

    /// A frame whose rest was not captured.
    pub(super) fn cut(&mut self, bytes: &[u8], way: &Way, span: Span) {
        let scene = Scene::Bytes(bytes, spot(way, Some(span), None));
        let there = bytes.len();
        let found = format!("{there} bytes of a frame whose rest was not captured");
        let begin = FrameRef::HEADERS_LEN.saturating_sub(AMS_HEADER_LEN);
        let header = bytes.get(begin..FrameRef::HEADERS_LEN).map(AmsHeader::decode);
        let Some(Ok(header)) = header else {
            let topic = self.side(way);
            self.book.on(topic, &scene).open("ADS-5", found);
            return;
        };
        if !is_reply(&header) {
            if is_cnc(header.target.port) {
                let rule = service_clause(header.command);
                self.open_service(Topic::ClientServices, Topic::ClientFrames, &scene, rule, found);
            }
            return;
        }
        let asked = self.forget((way.connection, header.invoke_id));
        let asked = asked.filter(|asked| is_cnc(asked.header.target.port));
        let Some(asked) = asked else { return };
        let rule = service_clause(asked.header.command);
        self.open_service(Topic::CncServices, Topic::CncFrames, &scene, rule, &found);
        self.open_function(&asked, &scene, &found);
    }

    fn open_service(
        &mut self,
        topic: Topic,
        frames: Topic,
        scene: &Scene<'_>,
        rule: &'static str,
        found: impl std::fmt::Display,
    ) {
        let topic = if rule == "ADS-5" { frames } else { topic };
        self.book.on(topic, scene).open(rule, found);
    }

    /// What a lost answer leaves open: the requirement of the function that was asked.
    fn open_function(&mut self, asked: &Seen, scene: &Scene<'_>, found: &str) {
        let Ok(Some((frame, _))) = FrameRef::split(&asked.frame, u32::MAX) else { return };
        let Ok(Some(call)) = call_of(&frame) else { return };
        let Ok(request) = call.dispatch() else { return };
        let spec = request.function().spec();
        if spec.reply.is_some() {
            let topic = Topic::of_reply(request.function());
            self.book.on(topic, scene).open(spec.clause, found);
        }
    }

    pub(super) fn gap(&mut self, length: u64, way: &Way, mark: Mark) {
        count(&mut self.tally.gaps);
        self.lost.entry(way.connection).or_default().gap = Some(mark.packet);
        let span = Span { first: mark, last: mark };
        let scene = Scene::Bytes(&[], spot(way, Some(span), None));
        let found = format!("{length} bytes before this packet were not captured");
        let topic = self.side(way);
        self.book.on(topic, &scene).open("ADS-5", found);
    }

    pub(super) fn ended(&mut self, connection: u64) {
        let lost = self.lost.get(&connection).copied().unwrap_or_default();
        let keys = self.waiting.range((connection, 0)..=(connection, u32::MAX));
        let keys: Vec<_> = keys.map(|(key, _)| *key).collect();
        for key in keys {
            while let Some(asked) = self.forget(key) {
                self.unanswered(&asked, lost);
            }
        }
        let (mine, others) = std::mem::take(&mut self.early)
            .into_iter()
            .partition(|one: &Seen| one.way.connection == connection);
        self.early = others;
        let mine: Vec<Seen> = mine;
        for reply in mine {
            self.unasked(&reply);
        }
        self.lost.remove(&connection);
        self.waiting_of.remove(&connection);
    }

    fn unanswered(&mut self, asked: &Seen, lost: Lost) {
        count(&mut self.tally.unanswered);
        let scene = Scene::Bytes(&asked.frame, spot(&asked.way, Some(asked.span), None));
        if lost.gap.is_some_and(|packet| packet >= asked.span.last.packet) {
            self.open_function(asked, &scene, "the answer may be in a gap");
            return;
        }
        let waited = match (self.now, asked.span.last.time) {
            (Some(now), Some(then)) => now.since(then),
            _ => return,
        };
        if waited > PATIENCE && !lost.joined {
            let rule = service_clause(asked.header.command);
            let found = format!("none within {} s", waited.as_secs());
            let topic = if rule == "ADS-5" { Topic::CncFrames } else { Topic::CncServices };
            self.book.on(topic, &scene).check(rule, false, "an answer", found);
        }
    }
}
