//! Checks of data streaming: the streaming interface of a channel, and the lines of its program that
//! are executed.

use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::ads::AdsError;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::{Call, Request, WriteProgramStream};
use ads_cnc_conformance::simulator::program::{
    Pace, ProgramConfig, ProgramState, Start, StreamingProgram,
};

use crate::checks::checks;
use crate::target::{CheckResult, TestCnc, ensure, same};

checks! {
    each_channel_executes_its_own_stream,
    lines_are_executed_as_written,
    packets_of_any_length_are_executed,
    a_packet_that_is_too_long_takes_no_room,
    many_packets_fill_the_interface,
    each_channel_has_its_own_room,
    a_packet_without_room_is_rejected_whole,
    all_packets_are_read_at_once,
    a_packet_that_is_sent_twice_is_executed_twice,
    lines_written_after_a_program_end_stay,
    a_reset_ends_the_program,
    loops_and_jumps_back_end_streaming,
    branches_may_span_packets,
    comments_hide_words,
    four_words_end_the_program,
}

/// Maximum number of bytes in the streaming interface.
pub(crate) const BUFFER_LEN: usize = 4094;

/// Writes any bytes to a program stream, including bytes that the codec would not encode.
pub(crate) fn send(
    target: &TestCnc,
    channel: Channel,
    data: &[u8],
) -> CheckResult<Result<(), AdsError>> {
    let request = Request::from(WriteProgramStream::new(channel, b"\r\n"));
    let mut buf = [0; 8];
    let call = Call { data, ..request.encode(&mut buf)? };
    Ok(target.call(&call)?.map(drop))
}

/// Writes to a program stream and repeats a rejected write up to seven times, because the manuals
/// do not state when a CNC rejects data although the interface has room.
pub(crate) fn send_until_taken(
    target: &TestCnc,
    channel: Channel,
    data: &[u8],
) -> CheckResult<Result<(), AdsError>> {
    let mut sent = send(target, channel, data)?;
    for _ in 1..8 {
        if sent.is_ok() {
            break;
        }
        sent = send(target, channel, data)?;
    }
    Ok(sent)
}

/// The program stream of a channel: the writes of the client, and the state inside the CNC.
#[derive(Clone, Copy)]
struct Stream<'t> {
    target: &'t TestCnc,
    channel: u8,
}

/// The program stream of channel 1, with this pace and start.
fn first(target: &TestCnc, pace: Pace, start: Start) -> CheckResult<Stream<'_>> {
    stream(target, 1, pace, start)
}

fn stream(target: &TestCnc, channel: u8, pace: Pace, start: Start) -> CheckResult<Stream<'_>> {
    let stream = Stream { target, channel };
    let config = stream.with(|program| program.config().clone())?;
    target.cnc().set_program(channel, ProgramConfig { pace, start, ..config })?;
    Ok(stream)
}

impl Stream<'_> {
    fn with<T>(self, then: impl FnOnce(&mut StreamingProgram) -> T) -> CheckResult<T> {
        Ok(self.target.cnc().with_program(self.channel, then)?)
    }

    fn pace(self, pace: Pace) -> CheckResult {
        self.with(|program| program.set_pace(pace, Duration::ZERO))
    }

    fn holds(self, expected: usize) -> CheckResult {
        same("bytes in the interface", self.with(|program| program.buffered())?, expected)
    }

    fn executed(self) -> CheckResult<Vec<u8>> {
        self.with(|program| program.executed().recent().to_vec())
    }

    fn has_executed(self, expected: &[u8]) -> CheckResult {
        same("the lines executed", self.executed()?, expected.to_vec())
    }

    fn state(self) -> CheckResult<ProgramState> {
        self.with(|program| program.state())
    }

    fn start(self) -> CheckResult {
        Ok(self.with(|program| program.start(Duration::ZERO))??)
    }

    fn number(self) -> CheckResult<Channel> {
        Ok(Channel::new(self.channel.into())?)
    }

    fn accepts(self, data: &[u8]) -> CheckResult {
        let sent = send_until_taken(self.target, self.number()?, data)?;
        ensure(sent.is_ok(), format_args!("{} bytes: {sent:?}", data.len()))
    }

    fn rejects(self, data: &[u8]) -> CheckResult {
        let sent = send(self.target, self.number()?, data)?;
        ensure(sent.is_err(), format_args!("{} bytes are accepted", data.len()))
    }
}

/// A comment with this number of bytes, including its line end.
fn comment(len: usize) -> Vec<u8> {
    let mut line = vec![b'('];
    line.resize(len - 3, b'-');
    line.extend(b")\r\n");
    line
}

/// Each channel is addressed by its number and by its rank, and executes the lines sent to it.
fn each_channel_executes_its_own_stream(target: &TestCnc) -> CheckResult {
    for (rank, channel) in (1..).zip(target.channels()) {
        let stream = stream(target, channel, Pace::Fast, Start::Once)?;
        let (one, two) = (format!("X{channel}\r\n"), format!("Y{channel}\r\n"));
        stream.accepts(one.as_bytes())?;
        stream.has_executed(one.as_bytes())?;
        let sent = send_until_taken(target, Channel::by_index(rank)?, two.as_bytes())?;
        ensure(sent.is_ok(), format_args!("rank {rank}: {sent:?}"))?;
        stream.has_executed((one + &two).as_bytes())?;
    }
    Ok(())
}

/// Tests tabs, and a comment with all printable ASCII characters except `()$#;%`.
fn lines_are_executed_as_written(target: &TestCnc) -> CheckResult {
    let graphic: String =
        (b' '..=b'~').map(char::from).filter(|c| !"()$#;%".contains(*c)).collect();
    let lines = [
        "n10 x1 Y2  z-0.5\r\n",
        "\tN20\tG01  X 1 \r\n",
        &format!("({graphic})\r\n"),
        "\r\n",
        "; the last\r\n",
    ];
    let stream = first(target, Pace::Fast, Start::Once)?;
    let all = lines.concat();
    stream.accepts(all.as_bytes())?;
    stream.has_executed(all.as_bytes())?;
    for line in lines {
        stream.accepts(line.as_bytes())?;
    }
    stream.has_executed(all.repeat(2).as_bytes())?;
    same("the state", stream.state()?, ProgramState::Dry)
}

/// Tests packets of 3 bytes, around 128 bytes and multiples of 256 bytes, and of the maximum
/// length.
fn packets_of_any_length_are_executed(target: &TestCnc) -> CheckResult {
    let stream = first(target, Pace::Fast, Start::Once)?;
    let mut all = Vec::new();
    for len in [3, 127, 128, 255, 256, 257, 511, 512, 513, 767, 768, 769, 991, 992] {
        let packet = match len {
            3 => b";\r\n".to_vec(),
            _ => [b"X1\r\n".to_vec(), comment(len - 4)].concat(),
        };
        stream.accepts(&packet)?;
        all.extend(packet);
        stream.has_executed(&all)?;
    }
    Ok(())
}

/// Tests a packet that is too long with an empty and with a non-empty interface.
fn a_packet_that_is_too_long_takes_no_room(target: &TestCnc) -> CheckResult {
    let stream = first(target, Pace::Hold, Start::Once)?;
    for held in [0, STREAM_PACKET_MAX] {
        for len in [993, 993, 994, 1024, 1984, 2048, BUFFER_LEN, 4096] {
            stream.rejects(&comment(len))?;
            stream.holds(held)?;
        }
        if held == 0 {
            stream.accepts(&comment(STREAM_PACKET_MAX))?;
        }
    }
    Ok(())
}

/// Fills the interface with packets of one short line each.
fn many_packets_fill_the_interface(target: &TestCnc) -> CheckResult {
    let stream = first(target, Pace::Hold, Start::Once)?;
    let line = |number: usize| format!("N{number:05} (of many)  \r\n").into_bytes();
    let count = BUFFER_LEN / line(0).len();
    let mut all = Vec::new();
    for number in 0..count {
        stream.accepts(&line(number))?;
        all.extend(line(number));
    }
    stream.holds(all.len())?;
    stream.rejects(&line(count))?;
    let last = comment(BUFFER_LEN - all.len());
    stream.accepts(&last)?;
    stream.holds(BUFFER_LEN)?;
    stream.pace(Pace::Fast)?;
    stream.accepts(&line(count))?;
    stream.has_executed(&[all, last, line(count)].concat())
}

fn each_channel_has_its_own_room(target: &TestCnc) -> CheckResult {
    const FILLING: [usize; 5] = [992, 992, 992, 992, 126];
    let all = target.channels();
    for &full in &all {
        for &other in all.iter().filter(|other| **other != full) {
            let full = stream(target, full, Pace::Hold, Start::Once)?;
            let other = stream(target, other, Pace::Hold, Start::Once)?;
            for len in FILLING {
                full.accepts(&comment(len))?;
            }
            full.holds(BUFFER_LEN)?;
            other.holds(0)?;
            for len in FILLING {
                other.accepts(&comment(len))?;
            }
            other.holds(BUFFER_LEN)?;
            other.pace(Pace::Fast)?;
            full.holds(BUFFER_LEN)?;
            other.holds(0)?;
        }
    }
    Ok(())
}

/// The first line of the packet would fit into the interface, but the second would not.
fn a_packet_without_room_is_rejected_whole(target: &TestCnc) -> CheckResult {
    for room in [4, 40, 500, 988] {
        let stream = first(target, Pace::Hold, Start::Once)?;
        let last = BUFFER_LEN - 4 * 700 - room;
        let mut all = Vec::new();
        for len in [700, 700, 700, 700, last.min(992), last.saturating_sub(992)] {
            if len > 0 {
                stream.accepts(&comment(len))?;
                all.extend(comment(len));
            }
        }
        let packet = [&b"X1\r\n"[..], &comment(room)].concat();
        for _ in 0..2 {
            stream.rejects(&packet)?;
            stream.holds(all.len())?;
        }
        stream.pace(Pace::Fast)?;
        stream.has_executed(&all)?;
        stream.accepts(&packet)?;
        stream.has_executed(&[all, packet].concat())?;
    }
    Ok(())
}

fn all_packets_are_read_at_once(target: &TestCnc) -> CheckResult {
    let slow = Pace::lines_per_second(1).expect("a pace");
    let stream = first(target, Pace::Hold, Start::Once)?;
    let packets = ["X1\r\n", "X2\r\nX3\r\n", "X4\r\n"];
    for packet in packets {
        stream.accepts(packet.as_bytes())?;
    }
    stream.holds(packets.concat().len())?;
    stream.pace(slow)?;
    stream.holds(0)?;
    stream.has_executed(b"")?;
    stream.pace(Pace::Fast)?;
    stream.has_executed(packets.concat().as_bytes())
}

fn a_packet_that_is_sent_twice_is_executed_twice(target: &TestCnc) -> CheckResult {
    let stream = first(target, Pace::Fast, Start::Once)?;
    stream.accepts(b"X1\r\n")?;
    stream.accepts(b"X1\r\n")?;
    stream.has_executed(b"X1\r\nX1\r\n")
}

/// Lines that are written after the decoder has read the program end, but before it is executed, remain
/// in the interface.
fn lines_written_after_a_program_end_stay(target: &TestCnc) -> CheckResult {
    let slow = Pace::lines_per_second(1).expect("a pace");
    for end in ["M30", "M2", "M17", "M29"] {
        let stream = first(target, slow, Start::Once)?;
        stream.accepts(format!("X1\r\n{end}\r\nX2\r\n").as_bytes())?;
        stream.holds(0)?;
        stream.accepts(b"Y1\r\n")?;
        stream.pace(Pace::Fast)?;
        ensure(
            matches!(stream.state()?, ProgramState::Ended(_)),
            format_args!("{end} ends no program"),
        )?;
        let before = stream.executed()?;
        same(
            "lines after the end",
            before.windows(2).any(|two| [b"X2", b"Y1"].contains(&two.try_into().unwrap())),
            false,
        )?;
        stream.holds(4)?;
        stream.start()?;
        stream.has_executed(&[&before[..], b"Y1\r\n"].concat())?;
    }
    Ok(())
}

fn a_reset_ends_the_program(target: &TestCnc) -> CheckResult {
    let stream = first(target, Pace::Hold, Start::Once)?;
    stream.accepts(b"N10 X1\r\n")?;
    stream.with(|program| program.reset(Duration::ZERO))?;
    stream.holds(0)?;
    same("the state", stream.state()?, ProgramState::Stopped)?;
    stream.accepts(b"N10 Y1\r\n")?;
    stream.pace(Pace::Fast)?;
    stream.has_executed(b"")?;
    stream.start()?;
    stream.has_executed(b"N10 Y1\r\n")
}

fn loops_and_jumps_back_end_streaming(target: &TestCnc) -> CheckResult {
    for word in [
        "$FOR P1=0,9,1",
        "$ENDFOR",
        "$DO",
        "$ENDDO",
        "$REPEAT",
        "$UNTIL P1==1",
        "$WHILE P1==1",
        "$ENDWHILE",
        "$GOTO N10",
    ] {
        let stream = first(target, Pace::Fast, Start::Once)?;
        stream.accepts(b"N10: X1\r\n")?;
        stream.accepts(format!("({word})\r\nX2 ; {word}\r\n").as_bytes())?;
        same("the state", stream.state()?, ProgramState::Dry)?;
        stream.accepts(format!("{word}\r\nX3\r\n").as_bytes())?;
        let aborted = matches!(stream.state()?, ProgramState::Aborted(_));
        ensure(aborted, format_args!("{word} does not end streaming"))?;
        let has_x3 = stream.executed()?.windows(2).any(|two| two == b"X3");
        ensure(!has_x3, format_args!("the line after {word} is executed"))?;
    }
    Ok(())
}

fn branches_may_span_packets(target: &TestCnc) -> CheckResult {
    let packets = [
        "$IF P1==1\r\nX1\r\n",
        "$ELSEIF P1==2\r\n",
        "$ELSE\r\n$ENDIF\r\n",
        "$SWITCH P1\r\n$CASE 1\r\nX2\r\n",
        "$BREAK\r\n$DEFAULT\r\n",
        "$ENDSWITCH\r\n$GOTO N40\r\n",
        "X3\r\n",
        "N40: X4\r\n",
    ];
    let stream = first(target, Pace::Fast, Start::Once)?;
    for packet in packets {
        stream.accepts(packet.as_bytes())?;
        same("the state", stream.state()?, ProgramState::Dry)?;
    }
    stream.has_executed(packets.concat().as_bytes())
}

fn comments_hide_words(target: &TestCnc) -> CheckResult {
    let ends_streaming = |text: &str, ends: bool| {
        let stream = first(target, Pace::Fast, Start::Once)?;
        stream.accepts(text.as_bytes())?;
        let state = stream.state()?;
        let passed = if ends {
            matches!(state, ProgramState::Aborted(_))
        } else {
            state == ProgramState::Dry
        };
        ensure(passed, format_args!("{state:?} after {text:?}"))
    };
    for word in ["$FOR P1=0,9,1", "$ENDDO", "$REPEAT", "$WHILE P1==1"] {
        for text in [
            format!("X1 ({word})\r\n"),
            format!("X1 ({word}\r\nX2\r\n"),
            format!("X1 ;{word}\r\nX2\r\n"),
            format!("#COMMENT BEGIN\r\n{word}\r\nX9\r\n#COMMENT END\r\nX1\r\n"),
        ] {
            ends_streaming(&text, false)?;
        }
        // In these texts, the word is not in a comment.
        for text in [
            format!("(x) {word}\r\n"),
            format!("(x\r\n{word}\r\n"),
            format!(";x\r\n{word}\r\n"),
            format!("#COMMENT BEGIN\r\nX9\r\n#COMMENT END\r\n{word}\r\n"),
            format!("N10 {word}\r\n"),
        ] {
            ends_streaming(&text, true)?;
        }
    }
    ends_streaming("N10: X1\r\nX2\r\n$GOTO N10\r\n", true)?;
    ends_streaming("$GOTO N10\r\nX2\r\nN10: X1\r\n", false)
}

fn four_words_end_the_program(target: &TestCnc) -> CheckResult {
    let end = ["M30", "M2", "M17", "M29", "N90 G00 X1 M30", "N90 M30 (end)", "N90 M30 ; end"];
    let go_on = ["M3 S1000", "M20", "M170", "M300", "(M30)", "X1 ; M30", "(M2"];
    for line in end.into_iter().chain(go_on) {
        let stream = first(target, Pace::Fast, Start::Once)?;
        stream.accepts(format!("X1\r\n{line}\r\nX2\r\n").as_bytes())?;
        let is_ended = matches!(stream.state()?, ProgramState::Ended(_));
        let has_x2 = stream.executed()?.windows(2).any(|two| two == b"X2");
        let ends = end.contains(&line);
        same(
            format_args!("the end by {line}, and the line after it"),
            (is_ended, has_x2),
            (ends, !ends),
        )?;
    }
    Ok(())
}
