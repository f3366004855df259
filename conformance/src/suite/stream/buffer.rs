//! The program streams of the simulated CNC: which writes its buffer accepts.

use std::time::Duration;

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::streaming::Ack;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use crate::judge::{Checks as _, Step, Stop, assumed};
use crate::simulator::Cnc;
use crate::simulator::program::{Pace, ProgramConfig, Start, State, StreamingProgram};
use crate::suite::kit::{Probe, STREAM_BUFFER_LEN, StreamWrite, send, send_until_taken};

/// Configures the streaming program of the first channel, calls a function, and restores the
/// configuration.
pub(super) fn set_up(
    probe: &mut Probe<'_>,
    pace: Pace,
    start: Start,
    then: impl FnOnce(&mut Probe<'_>, Channel, &StreamProgram<'_>) -> Step,
) -> Step {
    let channel = probe.channel()?;
    set_up_at(probe, channel, pace, start, then)
}

/// Like [`set_up`], for any channel.
pub(super) fn set_up_at(
    probe: &mut Probe<'_>,
    channel: Channel,
    pace: Pace,
    start: Start,
    then: impl FnOnce(&mut Probe<'_>, Channel, &StreamProgram<'_>) -> Step,
) -> Step {
    let cnc = probe.cnc()?;
    let number = channel.number();
    let config = cnc.with_program(number, |program| program.config().clone())?;
    if config.name.is_empty() {
        return Err(Stop::NotApplicable(format!("streaming is off in channel {number}")));
    }
    let set = ProgramConfig { pace, start, ..config.clone() };
    cnc.set_program(number, set)?;
    let done = then(probe, channel, &StreamProgram { cnc: &cnc, number });
    cnc.set_program(number, config)?;
    done
}

/// Direct access to the streaming program.
pub(super) struct StreamProgram<'c> {
    cnc: &'c Cnc,
    number: u8,
}

impl StreamProgram<'_> {
    pub(super) fn with<T>(&self, then: impl FnOnce(&mut StreamingProgram) -> T) -> Step<T> {
        Ok(self.cnc.with_program(self.number, then)?)
    }

    pub(super) fn pace(&self, pace: Pace) -> Step {
        self.with(|program| program.set_pace(pace, Duration::ZERO))
    }

    pub(super) fn held(&self) -> Step<usize> {
        self.with(|program| program.buffered())
    }

    pub(super) fn executed(&self) -> Step<Vec<u8>> {
        self.with(|program| program.executed().recent().to_vec())
    }

    pub(super) fn state(&self) -> Step<State> {
        self.with(|program| program.state())
    }

    /// Starts the program; an error is one of the suite.
    pub(super) fn start(&self, probe: &mut Probe<'_>) -> Step {
        let started = self.with(|program| program.start(Duration::ZERO))?;
        let found = started.as_ref().err().map(ToString::to_string).unwrap_or_default();
        probe.require(STM_14, started.is_ok(), "a program that starts now", found)
    }
}

pub(super) fn expect<T: PartialEq + std::fmt::Debug>(
    probe: &mut Probe<'_>,
    rules: &[ClauseId],
    expected: T,
    found: T,
) {
    probe.check(rules, found == expected, || format!("{expected:?}"), || format!("{found:?}"));
}

/// Sends a packet that must be accepted.
pub(super) fn write_accepted(
    probe: &mut Probe<'_>,
    rules: &[ClauseId],
    channel: Channel,
    data: &[u8],
) -> Step<StreamWrite> {
    let sent = send_until_taken(probe, channel, data)?;
    probe.check(rules, sent.is_taken(), || format!("{} bytes taken", data.len()), &sent);
    Ok(sent)
}

pub(super) fn too_long(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let most = comment(STREAM_PACKET_MAX);
        // With an empty and a non-empty buffer, and repeatedly.
        for held in [0, most.len()] {
            for len in [993, 993, 994, 1024, 1984, 2048, STREAM_BUFFER_LEN, 4096] {
                let sent = send(probe, channel, &comment(len))?;
                let expected = || format!("{len} bytes refused");
                probe.check(STM_2, sent.is_refused(), expected, &sent);
                // That the error number shows it is assumed.
                let good = sent.assumed() == Ack::Rejected;
                probe.check(assumed(STM_2), good, "refused for good", &sent);
                expect(probe, &[STM_2], held, stage.held()?);
            }
            if held == 0 {
                write_accepted(probe, &[STM_2], channel, &most)?;
            }
        }
        Ok(())
    })
}

pub(super) fn full(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let packets: Vec<Vec<u8>> = [992, 992, 992, 992, 126].map(numbered).into();
        for packet in &packets {
            write_accepted(probe, &[STM_3], channel, packet)?;
        }
        expect(probe, &[STM_3], STREAM_BUFFER_LEN, stage.held()?);
        let more = b"N1\r\n";
        for _ in 0..2 {
            let sent = send(probe, channel, more)?;
            probe.check(STM_3, sent.is_refused(), "no byte more", &sent);
            probe.check(STM_6, sent.is_refused(), "refused for now", &sent);
            // That the error number shows it is assumed.
            let now = sent.assumed() == Ack::Busy;
            probe.check(assumed(STM_6), now, "refused for now, and not for good", &sent);
            expect(probe, &[STM_6], STREAM_BUFFER_LEN, stage.held()?);
        }
        stage.pace(Pace::Fast)?;
        stage.pace(Pace::Hold)?;
        expect(probe, &[STM_12], 0, stage.held()?);
        write_accepted(probe, &[STM_6], channel, more)?;
        stage.pace(Pace::Fast)?;
        let mut all = packets.concat();
        all.extend(more);
        expect(probe, &[STM_12, STM_15], all, stage.executed()?);
        Ok(())
    })
}

/// Packets of one short line, as many as fit.
pub(super) fn many(probe: &mut Probe<'_>) -> Step {
    const LEN: usize = 20;
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let count = STREAM_BUFFER_LEN / LEN;
        let line = |number: usize| format!("N{number:05} (of many)  \r\n").into_bytes();
        let mut all = Vec::new();
        for number in 0..count {
            let sent = write_accepted(probe, &[STM_3], channel, &line(number))?;
            if !sent.is_taken() {
                return Ok(());
            }
            all.extend(line(number));
        }
        expect(probe, &[STM_3], all.len(), stage.held()?);
        // A shorter packet fits, but then not even one of a single line.
        let left = STREAM_BUFFER_LEN.saturating_sub(all.len());
        let last = comment(left);
        let sent = send(probe, channel, &line(count))?;
        probe.check(STM_6, sent.is_refused(), "refused for now", &sent);
        write_accepted(probe, &[STM_3], channel, &last)?;
        expect(probe, &[STM_3], STREAM_BUFFER_LEN, stage.held()?);
        all.extend(last);
        stage.pace(Pace::Fast)?;
        write_accepted(probe, &[STM_6], channel, &line(count))?;
        all.extend(line(count));
        expect(probe, &[STM_15], all, stage.executed()?);
        Ok(())
    })
}

/// Different lines, to show their order.
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
            // Padded with blanks if it is too short for a line.
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

pub(super) fn dry(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Fast, Start::ByHand, |probe, channel, stage| {
        let (first, second) = (b"N10 X1\r\nN20 X2\r\n", b"N30 X3\r\n");
        write_accepted(probe, &[STM_14], channel, first)?;
        expect(probe, &[STM_14], first.len(), stage.held()?);
        expect(probe, &[STM_14], Vec::new(), stage.executed()?);
        stage.start(probe)?;
        expect(probe, &[STM_14, STM_7], first.to_vec(), stage.executed()?);
        expect(probe, &[STM_16], State::Dry, stage.state()?);
        send_until_taken(probe, channel, second)?;
        let both = [&first[..], second].concat();
        expect(probe, &[STM_16, STM_7], both, stage.executed()?);
        Ok(())
    })
}

pub(super) fn reset(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        send_until_taken(probe, channel, b"N10 X1\r\n")?;
        stage.with(|program| program.reset(Duration::ZERO))?;
        expect(probe, &[STM_11], (0, State::Stopped), (stage.held()?, stage.state()?));
        send_until_taken(probe, channel, b"N10 Y1\r\n")?;
        stage.pace(Pace::Fast)?;
        expect(probe, &[STM_14], Vec::new(), stage.executed()?);
        stage.start(probe)?;
        expect(probe, &[STM_11, STM_14], b"N10 Y1\r\n".to_vec(), stage.executed()?);
        Ok(())
    })
}

/// A comment with this number of bytes, including its line end.
pub(super) fn comment(len: usize) -> Vec<u8> {
    let mut line = vec![b'('];
    line.resize(len.saturating_sub(3), b'-');
    line.extend(b")\r\n");
    line
}
