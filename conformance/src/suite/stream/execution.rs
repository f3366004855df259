//! The program streams of the simulated CNC: which lines it executes.

use ads_cnc::address::Channel;
use ads_cnc_vectors::ids::*;

use super::buffer::{expect, set_up, set_up_at, write_accepted};
use crate::judge::{Checks as _, Step, Stop};
use crate::simulator::program::{Pace, Start, State};
use crate::suite::kit::Probe;

/// Each channel by its number, and by its rank.
pub(super) fn channels(probe: &mut Probe<'_>) -> Step {
    let all: Vec<(Channel, Channel)> = probe.ranks()?;
    for &(rank, channel) in &all {
        let number = channel.number();
        set_up_at(probe, channel, Pace::Fast, Start::Once, |probe, channel, stage| {
            let (one, two) = (format!("X{number}\r\n"), format!("Y{number}\r\n"));
            write_accepted(probe, &[STM_1], channel, one.as_bytes())?;
            expect(probe, &[STM_1], one.as_bytes().to_vec(), stage.executed()?);
            // Without the bit of logical addressing the group has the channel's rank.
            write_accepted(probe, &[STM_1, ADR_12], rank, two.as_bytes())?;
            let both = [one, two].concat().into_bytes();
            expect(probe, &[STM_1, ADR_12], both, stage.executed()?);
            Ok(())
        })?;
    }
    Ok(())
}

/// Every printable character of ASCII, and tabs, in comments, which do not end streaming.
pub(super) fn as_written(probe: &mut Probe<'_>) -> Step {
    let graphic: String =
        (b' '..=b'~').map(char::from).filter(|c| !"()$#;%".contains(*c)).collect();
    let lines = [
        "n10 x1 Y2  z-0.5\r\n".to_owned(),
        "\tN20\tG01  X 1 \r\n".to_owned(),
        format!("({graphic})\r\n"),
        "\r\n".to_owned(),
        "; the last\r\n".to_owned(),
    ];
    set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
        let all = lines.concat().into_bytes();
        write_accepted(probe, &[STM_4, STM_7], channel, &all)?;
        expect(probe, &[STM_4, STM_7], all.clone(), stage.executed()?);
        // The same, with one line per packet.
        for line in &lines {
            write_accepted(probe, &[STM_7], channel, line.as_bytes())?;
        }
        expect(probe, &[STM_7], all.repeat(2), stage.executed()?);
        let state = stage.state()?;
        probe.check(STM_4, state == State::Dry, "lines that all were run", || format!("{state:?}"));
        Ok(())
    })
}

/// Slow enough that no line is executed meanwhile.
fn slow() -> Step<Pace> {
    Pace::lines_per_second(1).ok_or_else(|| Stop::Harness("a pace of one line a second".into()))
}

pub(super) fn at_once(probe: &mut Probe<'_>) -> Step {
    let slow = slow()?;
    set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
        let packets = ["X1\r\n", "X2\r\nX3\r\n", "X4\r\n"];
        for packet in packets {
            write_accepted(probe, &[STM_12], channel, packet.as_bytes())?;
        }
        expect(probe, &[STM_12], packets.concat().len(), stage.held()?);
        stage.pace(slow)?;
        expect(probe, &[STM_12], (0, Vec::new()), (stage.held()?, stage.executed()?));
        stage.pace(Pace::Fast)?;
        expect(probe, &[STM_12], packets.concat().into_bytes(), stage.executed()?);
        Ok(())
    })
}

pub(super) fn behind_end(probe: &mut Probe<'_>) -> Step {
    let slow = slow()?;
    for end in ["M30", "M2", "M17", "M29"] {
        set_up(probe, slow, Start::Once, |probe, channel, stage| {
            let ending = format!("X1\r\n{end}\r\nX2\r\n");
            write_accepted(probe, &[STM_10], channel, ending.as_bytes())?;
            // The program end was read, but not executed yet.
            expect(probe, &[STM_10], 0, stage.held()?);
            let next = b"Y1\r\n";
            write_accepted(probe, &[STM_10], channel, next)?;
            stage.pace(Pace::Fast)?;
            let ended = matches!(stage.state()?, State::Ended(_));
            probe.require(STM_10, ended, || format!("{end} ends it"), "no end")?;
            let before = stage.executed()?;
            let lost = !before.windows(2).any(|two| two == b"X2" || two == b"Y1");
            probe.check(STM_10, lost, "nothing run behind it", || format!("{before:02x?}"));
            expect(probe, &[STM_10], next.len(), stage.held()?);
            stage.start(probe)?;
            let all = [before, next.to_vec()].concat();
            expect(probe, &[STM_10, STM_14], all, stage.executed()?);
            Ok(())
        })?;
    }
    Ok(())
}
