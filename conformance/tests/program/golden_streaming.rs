//! The golden sequences of streaming, run by `StreamingProgram`.

use std::time::Duration;

use ads_cnc::streaming::Ack;
use ads_cnc_conformance::simulator::program::{Pace, ProgramConfig, Start, StreamingProgram};
use ads_cnc_conformance::suite::replay::{StepResult, StreamActor, play_stream, take};
use ads_cnc_vectors::{Given, StreamAck, StreamStep};

use crate::{cases, stated_fault};

#[test]
fn streams_go_as_stated() {
    for case in cases("streaming", 35) {
        let Given::Streaming(given) = &case.given else { unreachable!() };
        let config =
            ProgramConfig { start: Start::ByHand, pace: Pace::Hold, ..ProgramConfig::default() };
        let fault = play_stream(&mut Direct(StreamingProgram::new(config)), given).expect(&case.id);
        assert_eq!(fault, stated_fault(case), "{}", case.id);
    }
}

struct Direct(StreamingProgram);

impl StreamActor for Direct {
    fn start(&mut self, now: Duration) -> StepResult<()> {
        self.0.start(now).expect("it starts");
        Ok(())
    }

    fn reset(&mut self, now: Duration) -> StepResult<()> {
        self.0.reset(now);
        Ok(())
    }

    fn held(&mut self) -> StepResult<usize> {
        Ok(self.0.buffered())
    }

    fn write(
        &mut self,
        data: &[u8],
        _: StreamAck,
        _: &StreamStep,
        now: Duration,
    ) -> StepResult<Ack> {
        Ok(self.0.write(data, now))
    }

    fn take(&mut self, step: &StreamStep, now: Duration) -> StepResult<Option<&'static str>> {
        take(&mut self.0, step, now)
    }
}
