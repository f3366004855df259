//! The decoder that executes a streaming program: its pace, program ends and errors.

use std::time::Duration;

use ads_cnc::limits::{STREAM_MAX, STREAM_PACKET_MAX};
use ads_cnc::streaming::{Ack, ProgramEnd};
use ads_cnc_conformance::number::digest;
use ads_cnc_conformance::simulator::program::{
    Pace, ProgramConfig, ProgramState, Start, StartError, StreamingProgram,
};
use proptest::prelude::*;

use crate::kept;

const ZERO: Duration = Duration::ZERO;

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

fn program(pace: Pace) -> StreamingProgram {
    StreamingProgram::new(ProgramConfig { pace, ..ProgramConfig::default() })
}

fn lines(rate: u32) -> StreamingProgram {
    program(Pace::lines_per_second(rate).unwrap())
}

#[track_caller]
fn aborted(program: &StreamingProgram) -> String {
    match program.state() {
        ProgramState::Aborted(message) => message.to_string(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_default_program_is_started_once() {
    let mut program = StreamingProgram::new(ProgramConfig::default());
    assert_eq!(program.state(), ProgramState::Dry);
    let line = [&[b'X'; 990][..], b"\r\n"].concat();
    let taken = (0..10).take_while(|_| program.write(&line, ZERO) == Ack::Accepted).count();
    // One line is being executed, and four lines wait in the interface.
    assert_eq!((taken, program.busy_count(), program.buffered()), (5, 1, 4 * 992));
    program.advance(ms(1));
    assert_eq!(program.write(&line, ms(1)), Ack::Accepted);
    program.advance(ms(6));
    assert_eq!((program.executed().line_count(), program.state()), (6, ProgramState::Dry));
}

#[test]
fn writes_of_a_wrong_size_are_rejected_in_any_state() {
    for start in [Start::ByHand, Start::Once, Start::Again] {
        let mut program =
            StreamingProgram::new(ProgramConfig { start, ..ProgramConfig::default() });
        assert_eq!(program.write(b"", ZERO), Ack::Rejected);
        assert_eq!(program.write(&[b'X'; STREAM_PACKET_MAX + 1], ZERO), Ack::Rejected);
        assert_eq!((program.buffered(), program.busy_count()), (0, 0));
    }
}

/// Lines are executed on time, and rounding errors do not accumulate.
#[test]
fn pace() {
    let mut program = lines(3);
    let text = b"N1\r\n".repeat(200);
    assert_eq!(program.write(&text, ms(100)), Ack::Accepted);
    for (at, run) in
        [(100, 0), (433, 0), (434, 1), (1099, 2), (1100, 3), (60_099, 179), (60_100, 180)]
    {
        program.advance(ms(at));
        assert_eq!(program.executed().line_count(), run, "{at} ms");
    }
    // A call of `advance` with an earlier time has no effect.
    program.advance(ms(5));
    assert_eq!(program.executed().line_count(), 180);

    let mut program = self::program(Pace::bytes_per_second(10).unwrap());
    program.write(b"N1 X1\r\nN2\r\n", ZERO);
    program.advance(ms(699));
    assert_eq!(program.executed().line_count(), 0);
    program.advance(ms(700));
    assert_eq!(program.executed().line_count(), 1);
    program.set_pace(Pace::Fast, ms(701));
    assert_eq!(program.executed().line_count(), 2);
}

#[test]
fn a_dry_stream_waits_for_the_next_write() {
    let mut program = lines(10);
    program.write(b"N1\r\n", ZERO);
    assert_eq!(program.state(), ProgramState::Running);
    program.advance(ms(5000));
    assert_eq!(program.state(), ProgramState::Dry);
    program.write(b"N2\r\n", ms(6000));
    assert_eq!((program.state(), program.executed().line_count()), (ProgramState::Running, 1));
    program.advance(ms(6099));
    assert_eq!(program.executed().line_count(), 1);
    program.advance(ms(6100));
    assert_eq!((program.state(), program.executed().line_count()), (ProgramState::Dry, 2));
}

/// Lines after a program end that the decoder read together with it are discarded; lines that were
/// written later remain for the next start.
#[test]
fn program_ends_discard_read_lines() {
    for (word, end) in [
        ("M2", ProgramEnd::M2),
        ("M30", ProgramEnd::M30),
        ("M17", ProgramEnd::M17),
        ("M29", ProgramEnd::M29),
    ] {
        let mut program = lines(10);
        program.write(format!("N1\r\nN2 {word}\r\nN3\r\n$FOR\r\n").as_bytes(), ZERO);
        program.write(b"N4 X4\r\n", ms(150));
        program.advance(ms(200));
        assert_eq!(program.state(), ProgramState::Ended(end));
        assert_eq!(program.executed().line_count(), 2);
        assert_eq!(program.buffered(), 7);
        assert_eq!(program.write(b"N5 $DO\r\n", ms(300)), Ack::Accepted);
        program.advance(ms(9000));
        assert_eq!(program.buffered(), 15);
        program.start(ms(10_000)).unwrap();
        assert_eq!(program.start(ms(10_000)), Err(StartError::Running));
        program.advance(ms(10_100));
        assert!(program.executed().lines().eq([
            &b"N1"[..],
            format!("N2 {word}").as_bytes(),
            b"N4 X4"
        ]));
        assert_eq!(aborted(&program), "streaming.nc:2:4: $DO in a stream");
    }
}

#[test]
fn a_program_may_be_started_again() {
    let config =
        ProgramConfig { start: Start::Again, pace: Pace::Fast, ..ProgramConfig::default() };
    let mut program = StreamingProgram::new(config);
    program.write(b"N1:\r\nM30\r\nN2\r\n", ZERO);
    assert_eq!(program.state(), ProgramState::Dry);
    // The label N1 belonged to the previous program, so the jump is not a backward jump.
    program.write(b"$GOTO N1\r\nM30\r\n", ZERO);
    assert!(program.executed().lines().eq([&b"N1:"[..], b"M30", b"$GOTO N1", b"M30"]));
    program.write(b"X1\r\n$FOR\r\n", ZERO);
    assert_eq!(aborted(&program), "streaming.nc:2:1: $FOR in a stream");
    program.reset(ZERO);
    assert_eq!(program.state(), ProgramState::Stopped);
}

#[test]
fn errors_abort_before_their_line() {
    for (text, run, message) in [
        ("N1\r\nN2 X2\r\nN3 $WHILE P1\r\nN4\r\n", 2, "streaming.nc:3:4: $WHILE in a stream"),
        ("N1:\r\n(a)\r\n$GOTO N1\r\n", 2, "streaming.nc:3:1: $GOTO back to line 1"),
        ("M30 $ENDFOR\r\n", 0, "streaming.nc:1:5: $ENDFOR in a stream"),
    ] {
        let mut program = lines(10);
        program.write(text.as_bytes(), ZERO);
        program.advance(ms(1000));
        assert_eq!(program.executed().line_count(), run);
        assert_eq!(aborted(&program), message);
        // After an error, writes fill the interface, and the program can be started only after a
        // reset.
        while program.write(b"N9 X1\r\n", ms(2000)) == Ack::Accepted {}
        assert_eq!((program.buffered(), program.busy_count()), (STREAM_MAX / 7 * 7, 1));
        assert_eq!(program.start(ms(2000)), Err(StartError::Aborted));
        program.reset(ms(2000));
        assert_eq!((program.buffered(), program.state()), (0, ProgramState::Stopped));
        program.start(ms(2000)).unwrap();
        program.write(b"$DO\r\n", ms(2000));
        assert_eq!(aborted(&program), "streaming.nc:1:1: $DO in a stream");
    }
}

#[test]
fn a_missing_line_end_aborts_when_read() {
    let mut program = lines(10);
    program.write(b"N1\r\n", ZERO);
    assert_eq!(program.write(b"N2\r\nN3\n", ms(50)), Ack::Accepted);
    program.advance(ms(99));
    assert_eq!(program.state(), ProgramState::Running);
    program.advance(ms(100));
    assert_eq!(
        aborted(&program),
        "streaming.nc:3:3: error 21476: streaming data without a correct line end: \
        CR LF expected, LF alone found"
    );
    assert_eq!((program.executed().line_count(), program.buffered()), (1, 0));
}

/// The interface does not store the boundaries of writes: a line may be split into two writes if the
/// decoder reads both writes together.
#[test]
fn a_line_may_be_split_into_two_writes() {
    let mut program = program(Pace::Hold);
    program.write(b"N1 ", ZERO);
    program.write(b"X1\r\n", ZERO);
    program.set_pace(Pace::Fast, ZERO);
    assert!(program.executed().lines().eq([b"N1 X1"]));
}

#[test]
fn comments_span_packets_and_calls_return() {
    let mut program = program(Pace::Fast);
    for packet in
        ["#COMMENT BEGIN\r\n", "$DO\r\nM30\r\n", "#COMMENT END\r\n", "N9 L M30\r\n", "X1\r\n"]
    {
        program.write(packet.as_bytes(), ZERO);
        assert_eq!(program.state(), ProgramState::Dry, "{packet}");
    }
    assert_eq!(program.executed().line_count(), 6);
}

#[test]
fn streaming_needs_a_name() {
    let config =
        ProgramConfig { name: String::new(), pace: Pace::Fast, ..ProgramConfig::default() };
    let mut program = StreamingProgram::new(config);
    assert_eq!(program.state(), ProgramState::Stopped);
    assert_eq!(program.start(ZERO), Err(StartError::NoName));
    assert_eq!(program.write(b"N1\r\n", ZERO), Ack::Accepted);
    program.advance(ms(1000));
    assert_eq!((program.buffered(), program.executed().line_count()), (4, 0));
}

#[test]
fn a_reset_executes_only_due_lines() {
    let mut program = lines(10);
    program.write(b"N1\r\nN2\r\nN3\r\n", ZERO);
    program.write(b"N4\r\n", ZERO);
    program.reset(ms(250));
    program.advance(ms(9000));
    assert_eq!((program.state(), program.buffered()), (ProgramState::Stopped, 0));
    assert_eq!(program.executed().digest(), digest(b"N1\r\nN2\r\n"));
    program.forget_executed();
    assert_eq!(program.executed().digest(), digest(b""));
}

#[test]
fn the_record_of_executed_lines_is_limited() {
    for kept in [0, 1, 10, 100, 5000] {
        let config = ProgramConfig { pace: Pace::Fast, kept, ..ProgramConfig::default() };
        let mut program = StreamingProgram::new(config);
        let mut all = Vec::new();
        for n in 0..2000_usize {
            let line = format!("N{n} {}\r\n", "X".repeat(n * 7 % 60));
            program.write(line.as_bytes(), ZERO);
            all.extend_from_slice(line.as_bytes());
            let executed = program.executed();
            assert!(executed.recent().len() <= 2 * kept + 70, "{kept}");
            assert!(executed.recent().len() >= kept.min(all.len()), "{kept}");
            assert!(all.ends_with(executed.recent()));
            let first = executed.first_recent() as usize - 1;
            assert_eq!(executed.lines().count(), n + 1 - first);
            let wanted = format!("N{first} ");
            assert!(executed.lines().next().unwrap().starts_with(wanted.as_bytes()));
        }
        assert_eq!(program.executed().digest(), digest(&all));
        assert_eq!(program.executed().byte_count(), all.len() as u64);
    }
}

/// The data of valid and of invalid writes.
fn piece() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        20 => (1..40_usize).prop_map(|count| b"N1 X1\r\n".repeat(count)),
        5 => (0..1000_usize).prop_map(|len| [&b"X".repeat(len)[..], b"\r\n"].concat()),
        1 => Just(b"N7:\r\n".to_vec()),
        1 => Just(b"M30\r\n".to_vec()),
        1 => Just(b"X1\r\n$GOTO N7\r\nX2\r\n".to_vec()),
        1 => Just(b"X1".to_vec()),
        1 => Just(b"#COMMENT BEGIN\r\n".to_vec()),
    ]
}

fn any_pace() -> impl Strategy<Value = Pace> {
    prop_oneof![
        1 => Just(Pace::Fast),
        4 => (1..5000_u32).prop_map(|rate| Pace::lines_per_second(rate).unwrap()),
        4 => (1..100_000_u32).prop_map(|rate| Pace::bytes_per_second(rate).unwrap()),
    ]
}

proptest! {
#![proptest_config(kept::cases(300, file!()))]

/// The result does not depend on the number of calls of `advance` in which the same time passes.
#[test]
fn the_result_does_not_depend_on_advances(
    pace in any_pace(),
    again in any::<bool>(),
    writes in prop::collection::vec((piece(), 0..200_u64, 1..30_u64), 1..40),
) {
    let start = if again { Start::Again } else { Start::Once };
    let config = ProgramConfig { pace, start, ..ProgramConfig::default() };
    let (mut busy, mut lazy) = (StreamingProgram::new(config.clone()), StreamingProgram::new(config));
    let mut now = ZERO;
    for (data, wait, ticks) in writes {
        let next = now + ms(wait);
        while now < next {
            busy.advance(now);
            now += ms(ticks);
        }
        now = next;
        prop_assert_eq!(busy.write(&data, now), lazy.write(&data, now));
        prop_assert_eq!(busy.state(), lazy.state());
        prop_assert_eq!(busy.executed(), lazy.executed());
        prop_assert_eq!(busy.buffered(), lazy.buffered());
        prop_assert!(busy.buffered() <= STREAM_MAX);
    }
}
}
