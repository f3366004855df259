//! A sender and the streaming program that receives its packets: without resets and permanent
//! rejections, no bytes are lost or duplicated.

use std::time::Duration;

use ads_cnc::streaming::{Ack, NcText, RETRY_AFTER, Sender};
use ads_cnc_conformance::number::digest;
use ads_cnc_conformance::simulator::program::{
    Pace, ProgramConfig, ProgramState, StreamingProgram,
};
use proptest::prelude::*;

use crate::kept;

/// Streams a text, and returns the time of the last write. `between` gets the acknowledgement of
/// the previous write; it returns the time before the next write, and whether this write is
/// rejected as busy before it reaches the interface.
fn stream(
    text: NcText<'_>,
    program: &mut StreamingProgram,
    mut between: impl FnMut(Option<Ack>) -> (Duration, bool),
) -> Duration {
    let mut sender = Sender::new(text);
    let (mut now, mut last) = (Duration::ZERO, None);
    while let Some(packet) = sender.packet() {
        let (wait, rejected) = between(last);
        now += wait;
        let ack = if rejected { Ack::Busy } else { program.write(packet, now) };
        assert_ne!(ack, Ack::Rejected);
        sender.acknowledge(ack).expect("a packet is out");
        last = Some(ack);
    }
    assert_eq!((sender.left_lines(), sender.left_bytes()), (0, 0));
    now
}

/// Streams 10 MB in simulated time to a decoder that executes 100 kB per second.
#[test]
fn ten_megabytes_arrive() {
    let mut wire = Vec::new();
    for n in 0.. {
        if wire.len() >= 10_000_000 {
            break;
        }
        let x = n * 7919 % 100_000;
        wire.extend_from_slice(format!("N{n} G01 X{x} Y-{n} (line {n})\r\n").as_bytes());
    }
    let text = NcText::new(&wire).unwrap();
    let pace = Pace::bytes_per_second(100_000).unwrap();
    let mut program =
        StreamingProgram::new(ProgramConfig { pace, kept: 10_000, ..ProgramConfig::default() });
    let cycle = Duration::from_millis(2);
    let mut most = 0;
    let now = stream(text, &mut program, |ack| {
        most += usize::from(ack == Some(Ack::Busy));
        (if ack == Some(Ack::Busy) { RETRY_AFTER / 20 } else { cycle }, false)
    });
    assert!(most > 1000, "the decoder is slow: {most}");
    assert_eq!(program.busy_count(), most as u64);
    program.advance(now + Duration::from_secs(1));
    assert_eq!(program.state(), ProgramState::Dry);
    let executed = program.executed();
    assert_eq!(executed.line_count(), text.line_count() as u64);
    assert_eq!((executed.byte_count(), executed.digest()), (wire.len() as u64, digest(&wire)));
    assert!(wire.ends_with(executed.recent()) && executed.recent().len() <= 20_100);
    // At this pace 10 MB take 100 s, so the decoder did not have to wait for data.
    let seconds = now.as_secs_f64();
    assert!((99.0..102.0).contains(&seconds), "{seconds}");
}

fn any_pace() -> impl Strategy<Value = Pace> {
    prop_oneof![
        1 => Just(Pace::Fast),
        4 => (10..5000_u32).prop_map(|rate| Pace::lines_per_second(rate).unwrap()),
        4 => (100..100_000_u32).prop_map(|rate| Pace::bytes_per_second(rate).unwrap()),
    ]
}

/// Lines of various lengths without program ends and errors.
fn lines() -> impl Strategy<Value = Vec<String>> {
    let line = (any::<u32>(), prop_oneof![9 => 0..80_usize, 1 => 0..960_usize])
        .prop_map(|(n, len)| format!("N{n} {}", "X".repeat(len)));
    prop::collection::vec(line, 0..300)
}

proptest! {
#![proptest_config(kept::cases(200, file!()))]

#[test]
fn what_is_run_is_the_text(
    lines in lines(),
    end in prop::sample::select(vec!["\n", "\r\n", "\r"]),
    pace in any_pace(),
    waits in prop::collection::vec((0..700_u64, prop::bool::weighted(0.2)), 1..50),
) {
    let bytes = lines.join(end).into_bytes();
    let text = NcText::new(&bytes).unwrap();
    let mut program = StreamingProgram::new(ProgramConfig { pace, ..ProgramConfig::default() });
    // The additional entry makes some writes succeed.
    let mut waits = waits.iter().chain([&(100, false)]).cycle();
    let now = stream(text, &mut program, |_| {
        let &(wait, rejected) = waits.next().unwrap();
        (Duration::from_millis(wait + 1), rejected)
    });
    program.advance(now + Duration::from_secs(3600));
    prop_assert_eq!(program.state(), ProgramState::Dry);
    let executed = program.executed();
    prop_assert_eq!(executed.line_count(), text.line_count() as u64);
    prop_assert!(executed.lines().eq(text.lines()));
    prop_assert_eq!(executed.byte_count(), text.wire_len() as u64);
}
}
