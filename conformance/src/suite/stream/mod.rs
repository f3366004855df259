//! Cases of data streaming. A device receives comments only, which do not move it.

mod buffer;
mod execution;
mod isolation;
mod words;

use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::RETRY_AFTER;
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use self::buffer::comment;
use super::row::{CaseRow, case};
use crate::judge::{Checks as _, Needs, Step, Stop};
use crate::objects::List;
use crate::suite::kit::{Probe, STREAM_BUFFER_LEN, send};

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("stream-object", &[STM_1, COM_2], Needs::Queries, object,
        "The object of the stream is listed by its name and at its address, and takes writes"),
    case("stream-whole-lines", &[STM_1, STM_4, STM_7], Needs::Writes, whole_lines,
        "A packet of whole lines is taken, by the number of the channel and by its rank"),
    case("stream-longest", &[STM_2, STM_20], Needs::Writes, longest,
        "A packet of 992 bytes is taken, and a line of 990 characters in it"),
    case("stream-refused-for-now", &[STM_6], Needs::Writes, refused_for_now,
        "What is refused for now is taken later, the same bytes again"),
    case("stream-too-long", &[STM_2], Needs::Simulator, buffer::too_long,
        "A packet of 993 bytes is refused, and nothing of it is taken"),
    case("stream-full", &[STM_3, STM_6, STM_12, STM_15], Needs::Simulator, buffer::full,
        "The interface holds 4094 bytes; then a write is refused until they were read"),
    case("stream-channels", &[STM_1, ADR_12], Needs::Simulator, execution::channels,
        "What is written to the stream of a channel is run there, and nowhere else"),
    case("stream-as-written", &[STM_4, STM_7], Needs::Simulator, execution::as_written,
        "Every character is run as it was written, and every line as a line"),
    case("stream-read-at-once", &[STM_12], Needs::Simulator, execution::at_once,
        "All that is there is read at once, before any of it is run"),
    case("stream-behind-the-end", &[STM_10, STM_14], Needs::Simulator, execution::behind_end,
        "What comes behind a program end that was read stays for the next start"),
    case("stream-dry", &[STM_7, STM_14, STM_16], Needs::Simulator, buffer::dry,
        "Where nothing more is written motion stops, and the next write resumes it"),
    case("stream-reset", &[STM_11, STM_14], Needs::Simulator, buffer::reset,
        "A reset empties the interface, and the next program is another"),
    case("stream-many-packets", &[STM_3, STM_6, STM_15], Needs::Simulator, buffer::many,
        "The interface holds packets of one line as long as they fit, however many"),
    case("stream-room-of-channels", &[STM_3, STM_12], Needs::Simulator, isolation::channels,
        "The interface of each channel has all its room, however full another's is"),
    case("stream-refused-whole", &[STM_3, STM_6], Needs::Simulator, isolation::in_part,
        "Of a packet that is refused no line is taken, though some would fit"),
    case("stream-lengths", &[STM_2, STM_4], Needs::Simulator, isolation::lengths,
        "A packet is run whole, whatever its length up to 992 bytes"),
    case("stream-comments", &[STM_8, STM_9], Needs::Simulator, words::comments,
        "A comment ends where it ends: behind it the same word ends streaming"),
    case("stream-ends", &[STM_9, STM_10], Needs::Simulator, words::ends,
        "M2, M30, M17 and M29 end a program anywhere in a line, and no other word does"),
    case("stream-forbidden-words", &[STM_8, STM_9], Needs::Simulator, words::forbidden_words,
        "Each word of a loop ends streaming where it stands, unless it is in a comment"),
    case("stream-permitted-words", &[STM_8, STM_19], Needs::Simulator, words::permitted_words,
        "Branches and jumps forward may span packets"),
];

/// Index offset of the stream object in the group of a channel.
const OFFSET: u32 = 0x90;

/// The name of the object.
const NAME: &str = "mc_program_stream_w";

/// Looks for the object in the lists of channels by name and address. That it is listed is not
/// required.
fn object(probe: &mut Probe<'_>) -> Step {
    for object in probe.objects()? {
        let List::Channel(number) = object.list else { continue };
        let Some((group, offset)) = object.address.content() else { continue };
        let groups = [0x12_0100, 0x02_0100].map(|base| base | u32::from(number));
        let here = groups.contains(&group.get()) && offset.get() == OFFSET;
        let named = object.name.as_cnc_str() == NAME;
        if !here && !named {
            continue;
        }
        let found = || format!("{} at {group}, {offset}", object.name);
        let expected =
            || format!("{NAME} at {:#x}, {OFFSET:#x}", groups.iter().max().unwrap_or(&0));
        // The object or its descriptor is wrong.
        let rules = [STM_1, COM_2];
        probe.check(rules, here && named, expected, found);
        probe.check(rules, object.is_writable(), "write access", "none");
    }
    probe.finish(&format!("no list names {NAME}"))
}

/// How long a device may take to empty its buffer.
const BUSY_TIMEOUT: Duration = Duration::from_secs(30);

/// The first channel whose stream may be written. On the simulated CNC its program is configured anew, so
/// that earlier lines have no effect.
fn channel(probe: &mut Probe<'_>) -> Step<Channel> {
    for channel in probe.channels()? {
        if probe.may(WriteProgramStream::new(channel, b"\r\n"))? {
            if let Some(cnc) = &probe.target.cnc {
                let config = cnc.with_program(channel.number(), |one| one.config().clone());
                let set_up = config.and_then(|config| cnc.set_program(channel.number(), config));
                set_up?;
            }
            return Ok(channel);
        }
    }
    Err(Stop::not_applicable("no stream may be written"))
}

/// Writes until the packet is accepted; returns how often it was rejected before, or `None` if it
/// is not accepted though it fits.
///
/// Whether a rejection is temporary is shown only by a later success, not by its error number.
fn write(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<Option<u32>> {
    let (begun, mut waited, mut refused) = (Instant::now(), Duration::ZERO, 0_u32);
    // The speed of the simulated CNC is known.
    let (wait, patience) = if probe.target.cnc.is_some() {
        (Duration::from_millis(5), Duration::from_millis(300))
    } else {
        (RETRY_AFTER, BUSY_TIMEOUT)
    };
    loop {
        let sent = send(probe, channel, data)?;
        if sent.is_taken() {
            return Ok(Some(refused));
        }
        if begun.elapsed().max(waited) > patience {
            let room = match &probe.target.cnc {
                Some(cnc) => {
                    let held = cnc.with_program(channel.number(), |program| program.buffered());
                    held?.saturating_add(data.len()) <= STREAM_BUFFER_LEN
                }
                None => false,
            };
            let why = format!("still refused after {} ms: {sent}", patience.as_millis());
            return if room { Ok(None) } else { Err(Stop::Inconclusive(why)) };
        }
        refused = refused.saturating_add(1);
        probe.target.client.wait(wait);
        waited = waited.saturating_add(wait);
    }
}

fn write_accepted(probe: &mut Probe<'_>, rules: &[ClauseId], at: Channel, data: &[u8]) -> Step {
    let taken = write(probe, at, data)?;
    let expected = || format!("{} bytes of whole lines taken", data.len());
    probe.check(rules, taken.is_some(), expected, "refused while there is room");
    Ok(())
}

fn whole_lines(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let lines = b"; comment\r\n(a second line)\r\n\r\n";
    write_accepted(probe, &[STM_1, STM_4, STM_7], channel, lines)?;
    let rank = probe.ranks()?.into_iter().find(|(_, one)| *one == channel);
    let Some((by_index, _)) = rank else { return Ok(()) };
    if probe.may(WriteProgramStream::new(by_index, b"\r\n"))? {
        write_accepted(probe, &[STM_1], by_index, lines)?;
    }
    Ok(())
}

fn longest(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    write_accepted(probe, &[STM_2, STM_20], channel, &comment(STREAM_PACKET_MAX))?;
    let many = comment(STREAM_PACKET_MAX / 8).repeat(8);
    write_accepted(probe, &[STM_2], channel, &many)
}

fn refused_for_now(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let packet = comment(STREAM_PACKET_MAX);
    for _ in 0..8 {
        let taken = write(probe, channel, &packet)?;
        let found = "refused while there is room";
        probe.check(STM_6, taken.is_some(), "taken, or refused for now", found);
        if taken != Some(0) {
            return Ok(());
        }
    }
    // Without a rejection the repetition could not be tested.
    Ok(())
}
