//! The golden sequences of streaming, run by `Program`.

use std::time::Duration;

use ads_cnc::streaming::{Ack, CheckEvent, Checker, DiagnosticKind, NcText, Sender};
use ads_cnc_conformance::simulator::program::{
    Message, Pace, Program, ProgramConfig, Start, State,
};
use ads_cnc_vectors::{Given, Pieces, StreamAck, StreamAction, StreamError, StreamStep, Streaming};

use crate::{cases, stated_fault};

#[test]
fn streams_go_as_stated() {
    for case in cases("streaming", 35) {
        let Given::Streaming(given) = &case.given else { unreachable!() };
        assert_eq!(run(given, &case.id), stated_fault(case), "{}", case.id);
    }
}

/// Goes through the steps up to the first at fault.
fn run<'c>(given: &'c Streaming, id: &str) -> Option<(&'static str, &'c str)> {
    let text = given.text.as_ref().map(Pieces::bytes);
    let config =
        ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..ProgramConfig::default() };
    let mut scene = Scene {
        program: Program::new(config),
        sender: text.as_deref().map(|text| Sender::new(NcText::new(text).expect("a good text"))),
        now: Duration::ZERO,
    };
    for step in &given.steps {
        if let Some(at) = step.at {
            scene.now = Duration::from_millis(at);
        }
        let at = format!("{id}: {}", step.id);
        let fault = scene.step(step, &at);
        if !matches!(fault, Some("outcome" | "overfull" | "not-started")) {
            assert_eq!(scene.program.held(), step.held, "{at}");
        }
        if let Some(fault) = fault {
            return Some((fault, &step.id));
        }
    }
    if let Some(sender) = &mut scene.sender {
        assert_eq!(sender.packet(), None, "{id}: packets are left");
    }
    None
}

struct Scene<'a> {
    program: Program,
    sender: Option<Sender<'a>>,
    now: Duration,
}

impl Scene<'_> {
    fn step(&mut self, step: &StreamStep, at: &str) -> Option<&'static str> {
        match step.action {
            StreamAction::Start => {
                self.program.start(self.now).expect(at);
                None
            }
            StreamAction::Reset => {
                self.program.reset(self.now);
                None
            }
            StreamAction::Write => self.write(step, at),
            StreamAction::Take => self.take(step, at),
        }
    }

    fn write(&mut self, step: &StreamStep, at: &str) -> Option<&'static str> {
        let data = step.bytes.as_ref().expect("a write has bytes").bytes();
        let own = match &mut self.sender {
            Some(sender) => sender.packet() == Some(&data),
            None => true,
        };
        let ack = self.program.write(&data, self.now);
        if let Some(sender) = self.sender.as_mut().filter(|_| own) {
            sender.acknowledge(ack).expect("a packet is out");
        }
        let found = match ack {
            Ack::Accepted => StreamAck::Accepted,
            Ack::Busy => StreamAck::Later,
            Ack::Rejected => StreamAck::Refused,
        };
        match (found, step.ack.expect("a write has an answer")) {
            (StreamAck::Later, StreamAck::Accepted) => return Some("overfull"),
            (found, stated) => assert_eq!(found, stated, "{at}"),
        }
        match (own, ack) {
            (false, _) => Some("order"),
            (true, Ack::Rejected) => Some("too-long"),
            _ => None,
        }
    }

    /// Lets the decoder run for no time at all, in which it reads and runs what is there.
    fn take(&mut self, step: &StreamStep, at: &str) -> Option<&'static str> {
        if !matches!(self.program.state(), State::Running | State::Dry) {
            return Some("not-started");
        }
        let stated = step.bytes.as_ref().expect("a take has bytes").bytes();
        self.program.forget_executed();
        self.program.set_pace(Pace::Fast, self.now);
        self.program.set_pace(Pace::Hold, self.now);
        let executed = self.program.executed().kept();
        let Some(behind) = stated.strip_prefix(executed) else { return Some("outcome") };
        match self.program.state() {
            State::Aborted(Message { number, line, column, text, .. }) => {
                assert_eq!(step.error, Some(StreamError { number, line, column }), "{at}");
                Some(match number {
                    Some(_) => "line-end",
                    None if text.starts_with("$GOTO") => "backward-jump",
                    None => "loop",
                })
            }
            State::Ended(end) => {
                assert_eq!(
                    (step.error, step.ends.as_ref()),
                    (None, Some(&end.to_string())),
                    "{at}"
                );
                assert_eq!(step.discarded.as_ref().map_or(Vec::new(), Pieces::bytes), behind);
                let is_lost = |found: CheckEvent| {
                    matches!(found, CheckEvent::Diagnostic(found)
                        if matches!(found.kind, DiagnosticKind::AfterEnd { .. }))
                };
                Checker::new().check(&stated).any(is_lost).then_some("lost")
            }
            state => {
                assert_eq!((state, step.error, &step.ends), (State::Dry, None, &None), "{at}");
                (!behind.is_empty()).then_some("outcome")
            }
        }
    }
}
