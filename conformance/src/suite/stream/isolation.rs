//! Buffers: each channel has its own, and rejected packets take no space.

use ads_cnc_vectors::ids::*;

use super::buffer::{comment, expect, set_up, set_up_at, write_accepted};
use crate::judge::{Checks as _, Step};
use crate::simulator::program::{Pace, Start};
use crate::suite::kit::{Probe, STREAM_BUFFER_LEN, send};

/// Packets that fill a buffer.
const FILLING: [usize; 5] = [992, 992, 992, 992, 126];

/// While the buffer of one channel is full, those of the others are empty.
pub(super) fn channels(probe: &mut Probe<'_>) -> Step {
    let all = probe.channels()?;
    for &full in &all {
        for &other in all.iter().filter(|other| **other != full) {
            set_up_at(probe, full, Pace::Hold, Start::Once, |probe, full, first| {
                set_up_at(probe, other, Pace::Hold, Start::Once, |probe, other, second| {
                    for len in FILLING {
                        write_accepted(probe, &[STM_3], full, &comment(len))?;
                    }
                    expect(
                        probe,
                        &[STM_3],
                        (STREAM_BUFFER_LEN, 0),
                        (first.held()?, second.held()?),
                    );
                    for len in FILLING {
                        write_accepted(probe, &[STM_3], other, &comment(len))?;
                    }
                    expect(probe, &[STM_3], STREAM_BUFFER_LEN, second.held()?);
                    // Executing lines in one channel does not empty the buffer of the other.
                    second.pace(Pace::Fast)?;
                    expect(
                        probe,
                        &[STM_12],
                        (STREAM_BUFFER_LEN, 0),
                        (first.held()?, second.held()?),
                    );
                    Ok(())
                })
            })?;
        }
    }
    probe.finish("there is one channel")
}

/// Packets of several lines that do not fit as a whole, though some of their lines would.
pub(super) fn in_part(probe: &mut Probe<'_>) -> Step {
    for room in [4, 40, 500, 988] {
        set_up(probe, Pace::Hold, Start::Once, |probe, channel, stage| {
            let mut all = Vec::new();
            let last = STREAM_BUFFER_LEN.saturating_sub(4 * 700).saturating_sub(room);
            for len in [700, 700, 700, 700, last.min(992), last.saturating_sub(992)] {
                if len > 0 {
                    write_accepted(probe, &[STM_3], channel, &comment(len))?;
                    all.extend(comment(len));
                }
            }
            // The first line would fit, the second not.
            let packet = [&b"X1\r\n"[..], &comment(room)].concat();
            for _ in 0..2 {
                let sent = send(probe, channel, &packet)?;
                probe.check(STM_6, sent.is_refused(), "refused for now", &sent);
                expect(probe, &[STM_6], all.len(), stage.held()?);
            }
            stage.pace(Pace::Fast)?;
            expect(probe, &[STM_6], all.clone(), stage.executed()?);
            write_accepted(probe, &[STM_6], channel, &packet)?;
            all.extend(packet);
            expect(probe, &[STM_6], all, stage.executed()?);
            Ok(())
        })?;
    }
    Ok(())
}

/// Lengths around multiples of 256.
pub(super) fn lengths(probe: &mut Probe<'_>) -> Step {
    set_up(probe, Pace::Fast, Start::Once, |probe, channel, stage| {
        let mut all = Vec::new();
        for len in [3_usize, 127, 128, 255, 256, 257, 511, 512, 513, 767, 768, 769, 991, 992] {
            let packet = match len {
                0..=8 => b";\r\n".to_vec(),
                _ => [b"X1\r\n".to_vec(), comment(len.saturating_sub(4))].concat(),
            };
            write_accepted(probe, &[STM_2, STM_4], channel, &packet)?;
            all.extend(packet);
            expect(probe, &[STM_2, STM_4], all.clone(), stage.executed()?);
        }
        Ok(())
    })
}
