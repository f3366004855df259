//! Cases of data streaming. What goes to a device are comments alone: they move nothing.

use std::thread;
use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, RETRY_AFTER};

use super::case::{Case, Rule, Step, Stop, assumed};
use super::declare;
use super::probe::{Probe, harness};
use super::replay::send;
use crate::cnc::program::{Pace, Program, ProgramConfig, Start, State};

pub(super) fn cases() -> Vec<Case> {
    vec![
        declare!(
            "stream-whole-lines",
            "A packet of whole lines is taken, by the number of the channel and by its rank",
            ["STM-1", "STM-4", "STM-7"],
            Writes,
            whole_lines
        ),
        declare!(
            "stream-longest",
            "A packet of 992 bytes is taken, and a line of 990 characters in it",
            ["STM-2", "STM-20"],
            Writes,
            longest
        ),
        declare!(
            "stream-refused-for-now",
            "What is refused for now is taken later, the same bytes again",
            ["STM-6"],
            Writes,
            refused_for_now
        ),
        declare!(
            "stream-too-long",
            "A packet of 993 bytes is refused, and nothing of it is taken",
            ["STM-2"],
            Embedded,
            too_long
        ),
        declare!(
            "stream-full",
            "The interface holds 4094 bytes; then a write is refused until they were read",
            ["STM-3", "STM-6", "STM-12", "STM-15"],
            Embedded,
            full
        ),
        declare!(
            "stream-dry",
            "Where nothing more is written motion stops, and the next write resumes it",
            ["STM-7", "STM-14", "STM-16"],
            Embedded,
            dry
        ),
        declare!(
            "stream-reset",
            "A reset empties the interface, and the next program is another",
            ["STM-11", "STM-14"],
            Embedded,
            reset
        ),
        declare!(
            "stream-forbidden-words",
            "Each word of a loop ends streaming where it stands, unless it is in a comment",
            ["STM-8", "STM-9"],
            Embedded,
            forbidden_words
        ),
        declare!(
            "stream-permitted-words",
            "Branches and jumps forward may span packets",
            ["STM-8", "STM-19"],
            Embedded,
            permitted_words
        ),
    ]
}

/// How long a device may take before it has read what it holds.
const PATIENCE: Duration = Duration::from_secs(30);

/// A comment of so many bytes, with its line end.
fn comment(len: usize) -> Vec<u8> {
    let mut line = vec![b'('];
    line.resize(len.saturating_sub(3), b'-');
    line.extend(b")\r\n");
    line
}

/// The first channel whose stream may be written. The embedded CNC's is set up anew: whatever was
/// sent before, it waits for lines.
fn channel(probe: &Probe<'_>) -> Step<Channel> {
    for channel in probe.channels()? {
        if probe.may(WriteProgramStream::new(channel, b"\r\n"))? {
            if let Some(cnc) = &probe.session.cnc {
                let config = cnc.with_program(channel.number(), |one| one.config().clone());
                let set_up = config.and_then(|config| cnc.set_program(channel.number(), config));
                set_up.map_err(harness)?;
            }
            return Ok(channel);
        }
    }
    Err(Stop::NotApplicable("no stream may be written".to_owned()))
}

/// Writes until it is taken; how often it was refused before.
fn write(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<Option<u32>> {
    let (begun, mut refused) = (Instant::now(), 0_u32);
    // Of the embedded CNC it is known how fast it is.
    let (wait, patience) = match probe.session.cnc.is_some() {
        true => (Duration::from_millis(5), Duration::from_millis(300)),
        false => (RETRY_AFTER, PATIENCE),
    };
    loop {
        match send(probe, channel, data)? {
            Ack::Accepted => return Ok(Some(refused)),
            Ack::Refused => return Ok(None),
            Ack::Later if begun.elapsed() > patience => {
                let why = format!("still refused after {} ms", patience.as_millis());
                return Err(Stop::Inconclusive(why));
            }
            Ack::Later => {
                refused = refused.saturating_add(1);
                thread::sleep(wait);
            }
        }
    }
}

fn taken(probe: &mut Probe<'_>, rules: &[&'static str], at: Channel, data: &[u8]) -> Step {
    let taken = write(probe, at, data)?;
    for &rule in rules {
        let expected = format!("{} bytes of whole lines taken", data.len());
        probe.check(rule, taken.is_some(), expected, "refused for good");
    }
    Ok(())
}

fn whole_lines(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let lines = b"; comment\r\n(a second line)\r\n\r\n";
    taken(probe, &["STM-1", "STM-4", "STM-7"], channel, lines)?;
    let ranks = (1_u32..).zip(probe.channels()?);
    let rank = ranks.filter(|(_, one)| *one == channel).map(|(rank, _)| rank).next();
    let by_index = Channel::by_index(rank.unwrap_or(1)).map_err(harness)?;
    if probe.may(WriteProgramStream::new(by_index, b"\r\n"))? {
        taken(probe, &["STM-1"], by_index, lines)?;
    }
    Ok(())
}

fn longest(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    taken(probe, &["STM-2", "STM-20"], channel, &comment(STREAM_PACKET_MAX))?;
    let many = comment(STREAM_PACKET_MAX / 8).repeat(8);
    taken(probe, &["STM-2"], channel, &many)
}

fn refused_for_now(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let packet = comment(STREAM_PACKET_MAX);
    for _ in 0..8 {
        let taken = write(probe, channel, &packet)?;
        probe.check("STM-6", taken.is_some(), "taken, or refused for now", "refused for good");
        if taken != Some(0) {
            return Ok(());
        }
    }
    // Nothing was refused: that the same is taken later could not be seen.
    Ok(())
}

/// The channel that the suite sets up, of the embedded CNC.
const CHANNEL: u8 = 1;

/// Sets the streaming program up, does something with it, and leaves it as it was.
fn set_up(
    probe: &mut Probe<'_>,
    pace: Pace,
    start: Start,
    then: impl FnOnce(&mut Probe<'_>, Channel, &Stage<'_>) -> Step,
) -> Step {
    let cnc = probe.cnc()?;
    let config = cnc.with_program(CHANNEL, |program| program.config().clone()).map_err(harness)?;
    let set = ProgramConfig { pace, start, ..config.clone() };
    cnc.set_program(CHANNEL, set).map_err(harness)?;
    let channel = Channel::new(CHANNEL.into()).map_err(harness)?;
    let done = then(probe, channel, &Stage(&cnc));
    cnc.set_program(CHANNEL, config).map_err(harness)?;
    done
}

/// The program from within.
struct Stage<'c>(&'c crate::cnc::Cnc);

impl Stage<'_> {
    fn with<T>(&self, then: impl FnOnce(&mut Program) -> T) -> Step<T> {
        self.0.with_program(CHANNEL, then).map_err(harness)
    }

    fn pace(&self, pace: Pace) -> Step {
        self.with(|program| program.set_pace(pace, Duration::ZERO))
    }

    fn held(&self) -> Step<usize> {
        self.with(|program| program.held())
    }

    fn executed(&self) -> Step<Vec<u8>> {
        self.with(|program| program.executed().kept().to_vec())
    }

    fn state(&self) -> Step<State> {
        self.with(|program| program.state())
    }
}

fn expect<T: PartialEq + std::fmt::Debug>(
    probe: &mut Probe<'_>,
    rules: &[&'static str],
    expected: T,
    found: T,
) {
    for &rule in rules {
        probe.check(rule, found == expected, format!("{expected:?}"), format!("{found:?}"));
    }
}

fn too_long(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let most = comment(STREAM_PACKET_MAX);
        let ack = send(probe, channel, &most)?;
        expect(probe, &["STM-2"], Ack::Accepted, ack);
        let ack = send(probe, channel, &comment(STREAM_PACKET_MAX.saturating_add(1)))?;
        probe.check("STM-2", ack != Ack::Accepted, "993 bytes refused", format!("{ack:?}"));
        // That it is refused for good is assumed.
        let good = ack == Ack::Refused;
        probe.check(assumed("STM-2"), good, "refused for good", format!("{ack:?}"));
        expect(probe, &["STM-2"], most.len(), stage.held()?);
        Ok(())
    })
}

/// The most bytes that the interface holds.
const HELD_MAX: usize = 4094;

fn full(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let packets: Vec<Vec<u8>> = [992, 992, 992, 992, 126].map(numbered).into();
        for packet in &packets {
            let ack = send(probe, channel, packet)?;
            expect(probe, &["STM-3"], Ack::Accepted, ack);
        }
        expect(probe, &["STM-3"], HELD_MAX, stage.held()?);
        let more = b"N1\r\n";
        for _ in 0..2 {
            let ack = send(probe, channel, more)?;
            let found = format!("{ack:?}");
            probe.check("STM-3", ack != Ack::Accepted, "no byte more", &found);
            probe.check("STM-6", ack == Ack::Later, "refused for now", found);
            expect(probe, &["STM-6"], HELD_MAX, stage.held()?);
        }
        stage.pace(Pace::Fast)?;
        stage.pace(Pace::Hold)?;
        expect(probe, &["STM-12"], 0, stage.held()?);
        let ack = send(probe, channel, more)?;
        expect(probe, &["STM-6"], Ack::Accepted, ack);
        stage.pace(Pace::Fast)?;
        let mut all = packets.concat();
        all.extend(more);
        expect(probe, &["STM-12", "STM-15"], all, stage.executed()?);
        Ok(())
    })
}

/// Lines that differ, so that their order shows.
fn numbered(len: usize) -> Vec<u8> {
    let mut lines = Vec::new();
    for number in 1.. {
        let line = format!("N{number} (of {len})\r\n");
        if lines.len().saturating_add(line.len()) > len {
            break;
        }
        lines.extend(line.as_bytes());
    }
    let left = len.saturating_sub(lines.len());
    match left {
        0 => lines,
        1..=3 => {
            // Blanks in front fill up what is too short for a line.
            let mut filled = vec![b' '; left];
            filled.extend(lines);
            filled
        }
        _ => {
            lines.extend(comment(left));
            lines
        }
    }
}

fn dry(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Fast, Start::ByHand, |probe, channel, stage| {
        let (first, second) = (b"N10 X1\r\nN20 X2\r\n", b"N30 X3\r\n");
        let ack = send(probe, channel, first)?;
        expect(probe, &["STM-14"], (Ack::Accepted, first.len()), (ack, stage.held()?));
        expect(probe, &["STM-14"], Vec::new(), stage.executed()?);
        stage.with(|program| program.start(Duration::ZERO))?.map_err(harness)?;
        expect(probe, &["STM-14", "STM-7"], first.to_vec(), stage.executed()?);
        expect(probe, &["STM-16"], State::Dry, stage.state()?);
        send(probe, channel, second)?;
        let both = [&first[..], second].concat();
        expect(probe, &["STM-16", "STM-7"], both, stage.executed()?);
        Ok(())
    })
}

fn reset(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        send(probe, channel, b"N10 X1\r\n")?;
        stage.with(|program| program.reset(Duration::ZERO))?;
        expect(probe, &["STM-11"], (0, State::Stopped), (stage.held()?, stage.state()?));
        send(probe, channel, b"N10 Y1\r\n")?;
        stage.pace(Pace::Fast)?;
        expect(probe, &["STM-14"], Vec::new(), stage.executed()?);
        stage.with(|program| program.start(Duration::ZERO))?.map_err(harness)?;
        expect(probe, &["STM-11", "STM-14"], b"N10 Y1\r\n".to_vec(), stage.executed()?);
        Ok(())
    })
}

fn forbidden_words(probe: &mut Probe<'_>) -> Step {
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
        set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
            send(probe, channel, b"N10: X1\r\n")?;
            send(probe, channel, format!("({word})\r\nX2 ; {word}\r\n").as_bytes())?;
            expect(probe, &["STM-9"], State::Dry, stage.state()?);
            send(probe, channel, format!("{word}\r\nX3\r\n").as_bytes())?;
            let state = stage.state()?;
            let aborted = matches!(state, State::Aborted(_));
            let found = format!("{state:?}");
            probe.check("STM-8", aborted, format!("{word} ends streaming"), found);
            // And nothing behind it is run.
            let executed = stage.executed()?;
            let behind = executed.windows(2).any(|two| two == b"X3");
            probe.check("STM-8", !behind, "nothing run behind it", "X3 was run");
            Ok(())
        })?;
    }
    Ok(())
}

fn permitted_words(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
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
        for packet in packets {
            let ack = send(probe, channel, packet.as_bytes())?;
            let done = (Ack::Accepted, State::Dry);
            expect(probe, &["STM-8", "STM-19"], done, (ack, stage.state()?));
        }
        let rules: Vec<Rule> = vec!["STM-19".into()];
        let all = stage.executed()? == packets.concat().as_bytes();
        probe.require(&rules, all, "every line run", "others")
    })
}
