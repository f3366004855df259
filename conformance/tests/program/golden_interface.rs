//! The golden sequences of streaming with the interface alone and a sender.

use std::time::Duration;

use ads_cnc::streaming::{Ack, DiagnosticKind, LINE_END_ERROR, NcText, ProgramEnd};
use ads_cnc_conformance::simulator::program::StreamingInterface;
use ads_cnc_conformance::suite::replay::{StepResult, StreamActor, play_stream};
use ads_cnc_vectors::{Given, Pieces, StreamAck, StreamError, StreamStep};

use crate::{cases, stated_fault};

#[test]
fn streams_go_as_stated() {
    for case in cases("streaming", 35) {
        let Given::Streaming(given) = &case.given else { unreachable!() };
        let mut cnc =
            Cnc { interface: StreamingInterface::new(), running: false, program: Vec::new() };
        let fault = play_stream(&mut cnc, given).expect(&case.id);
        assert_eq!(fault, stated_fault(case), "{}", case.id);
    }
}

struct Cnc {
    interface: StreamingInterface,
    running: bool,
    /// What was taken since the start.
    program: Vec<u8>,
}

impl StreamActor for Cnc {
    fn start(&mut self, _: Duration) -> StepResult<()> {
        self.running = true;
        self.program.clear();
        Ok(())
    }

    fn reset(&mut self, _: Duration) -> StepResult<()> {
        self.running = false;
        self.interface.reset();
        Ok(())
    }

    fn held(&mut self) -> StepResult<usize> {
        Ok(self.interface.len())
    }

    fn write(&mut self, data: &[u8], _: StreamAck, _: &StreamStep, _: Duration) -> StepResult<Ack> {
        Ok(self.interface.write(data))
    }

    fn take(&mut self, step: &StreamStep, _: Duration) -> StepResult<Option<&'static str>> {
        Ok(self.taken(step))
    }
}

impl Cnc {
    fn taken(&mut self, step: &StreamStep) -> Option<&'static str> {
        let at = &step.id;
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
