//! The golden sequences of streaming with the interface alone and a sender.

use ads_cnc::streaming::{Ack, DiagnosticKind, LINE_END_ERROR, NcText, ProgramEnd, Sender};
use ads_cnc_conformance::simulator::program::StreamingInterface;
use ads_cnc_vectors::{Given, Pieces, StreamAck, StreamAction, StreamError, StreamStep, Streaming};

use crate::{cases, stated_fault};

#[test]
fn streams_go_as_stated() {
    for case in cases("streaming", 35) {
        let Given::Streaming(given) = &case.given else { unreachable!() };
        let fault = run(given, &case.id);
        assert_eq!(fault, stated_fault(case), "{}", case.id);
    }
}

/// Goes through the steps up to the first at fault.
fn run<'c>(given: &'c Streaming, id: &str) -> Option<(&'static str, &'c str)> {
    let text = given.text.as_ref().map(Pieces::bytes);
    let mut cnc = Cnc {
        interface: StreamingInterface::new(),
        sender: text.as_deref().map(|text| Sender::new(NcText::new(text).expect("a good text"))),
        running: false,
        program: Vec::new(),
    };
    for step in &given.steps {
        let at = format!("{id}: {}", step.id);
        let fault = cnc.step(step, &at);
        if !matches!(fault, Some("outcome" | "overfull" | "not-started")) {
            assert_eq!(cnc.interface.len(), step.held, "{at}");
        }
        if let Some(fault) = fault {
            return Some((fault, &step.id));
        }
    }
    if let Some(sender) = &mut cnc.sender {
        assert_eq!(sender.packet(), None, "{id}: packets are left");
    }
    None
}

struct Cnc<'a> {
    interface: StreamingInterface,
    sender: Option<Sender<'a>>,
    running: bool,
    /// What was taken since the start.
    program: Vec<u8>,
}

impl Cnc<'_> {
    fn step(&mut self, step: &StreamStep, at: &str) -> Option<&'static str> {
        match step.action {
            StreamAction::Start => {
                self.running = true;
                self.program.clear();
                None
            }
            StreamAction::Reset => {
                self.running = false;
                self.interface.reset();
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
        let ack = self.interface.write(&data);
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

    fn take(&mut self, step: &StreamStep, at: &str) -> Option<&'static str> {
        if !self.running {
            return Some("not-started");
        }
        let stated = step.bytes.as_ref().expect("a take has bytes").bytes();
        let data = match self.interface.read() {
            Ok(data) => data.to_vec(),
            Err(error) => {
                let number = Some(LINE_END_ERROR);
                let error = StreamError { number, line: error.line(), column: error.column() };
                assert_eq!(step.error, Some(error), "{at}");
                return Some("line-end");
            }
        };
        if data != stated {
            return Some("outcome");
        }
        let before = lines(&self.program);
        self.program.extend_from_slice(&data);
        let text = NcText::new(&self.program).expect("lines that can be streamed");
        for finding in text.diagnostics().filter(|finding| finding.line as usize > before) {
            let class = match finding.kind {
                DiagnosticKind::Loop(_) => "loop",
                DiagnosticKind::BackwardJump { .. } => "backward-jump",
                _ => continue,
            };
            let error = StreamError { number: None, line: finding.line, column: finding.column };
            assert_eq!(step.error, Some(error), "{at}");
            return Some(class);
        }
        assert_eq!(step.error, None, "{at}");
        let end = program_end(&self.program);
        assert_eq!(end.map(|(end, _)| end.to_string()), step.ends, "{at}");
        let (_, line) = end?;
        self.running = false;
        let behind: Vec<u8> = data
            .split_inclusive(|&byte| byte == b'\n')
            .skip(line - before)
            .flatten()
            .copied()
            .collect();
        assert_eq!(step.discarded.as_ref().map_or(Vec::new(), Pieces::bytes), behind, "{at}");
        text.diagnostics()
            .any(|finding| matches!(finding.kind, DiagnosticKind::AfterEnd { .. }))
            .then_some("lost")
    }
}

fn lines(text: &[u8]) -> usize {
    text.iter().filter(|&&byte| byte == b'\n').count()
}

/// The first program end and its line: a line more would be behind it.
fn program_end(program: &[u8]) -> Option<(ProgramEnd, usize)> {
    let with_more = [program, b"X0\r\n"].concat();
    let text = NcText::new(&with_more).expect("lines that can be streamed");
    text.diagnostics().find_map(|finding| match finding.kind {
        DiagnosticKind::AfterEnd { end, of } => Some((end, of as usize)),
        _ => None,
    })
}
