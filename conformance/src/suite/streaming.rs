//! Cases of data streaming. Only comments and empty lines are written to the stream, which do not
//! move a device.

use std::time::{Duration, Instant};

use ads_cnc::address::Channel;
use ads_cnc::limits::STREAM_PACKET_MAX;
use ads_cnc::operation::WriteProgramStream;
use ads_cnc::streaming::{Ack, RETRY_AFTER};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::kit::{Probe, RawCall, with_reply};
use super::row::{CaseRow, case};
use crate::exchange::Exchange;
use crate::judge::{Checks as _, Needs, Step, Stop, assumed};
use crate::objects::ValueList;
use crate::text::plural;

#[rustfmt::skip]
pub(super) const CASES: &[CaseRow] = &[
    case("stream-object", &[STM_1, COM_2], Needs::Queries, object,
        "The stream object is listed with its name, its address and write access"),
    case("stream-whole-lines", &[STM_1, STM_4, STM_7], Needs::Writes, whole_lines,
        "A packet of whole lines is accepted by the channel's number and by its rank"),
    case("stream-longest", &[STM_2, STM_20], Needs::Writes, longest,
        "A packet of 992 bytes with a line of 990 characters is accepted"),
    case("stream-lengths", &[STM_2, STM_4], Needs::Writes, lengths,
        "Packets of any length up to 992 bytes are accepted"),
    case("stream-refused-for-now", &[STM_6], Needs::Writes, rejected_as_busy,
        "A packet that is rejected as busy is accepted when it is sent again"),
    case("stream-too-long", &[STM_2], Needs::Malformed, too_long,
        "A packet of 993 bytes is rejected"),
];

/// Index offset of the stream object in the group of a channel.
const OFFSET: u32 = 0x90;

/// The name of the stream object.
const NAME: &str = "mc_program_stream_w";

/// Looks for the stream object, by name and by address, among the channels' objects that the cases
/// read. Checks its name, address and write access. The object need not be listed.
fn object(probe: &mut Probe<'_>) -> Step {
    for object in probe.objects()? {
        let ValueList::Channel(number) = object.list else { continue };
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
        // The address of the object or its descriptor may be wrong.
        let rules = [STM_1, COM_2];
        probe.check(rules, here && named, expected, found);
        probe.check(rules, object.is_writable(), "write access", "none");
    }
    probe.finish(&format!("no object list has {NAME}"))
}

/// How long a rejected packet is sent again, so that the device can empty its buffer.
const BUSY_TIMEOUT: Duration = Duration::from_secs(30);

/// The first channel whose stream may be written.
fn channel(probe: &mut Probe<'_>) -> Step<Channel> {
    for channel in probe.channels()? {
        if probe.may(WriteProgramStream::new(channel, b"\r\n"))? {
            return Ok(channel);
        }
    }
    Err(Stop::not_applicable("no stream may be written"))
}

/// Sends bytes to the program stream, valid or not. Without a valid reply, the case is
/// inconclusive.
fn send(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<Exchange> {
    let lines = RawCall::new(WriteProgramStream::new(channel, b"\r\n"))?;
    with_reply(probe.call(&lines.with(|call| call.data = data.to_vec()))?)
}

/// Writes a packet repeatedly until it is accepted or the timeout has expired. Returns the last
/// reply if the packet was not accepted, and the number of earlier rejections.
fn repeat(probe: &mut Probe<'_>, channel: Channel, data: &[u8]) -> Step<(Option<Exchange>, u32)> {
    let (begun, mut waited, mut rejections) = (Instant::now(), Duration::ZERO, 0_u32);
    loop {
        let sent = send(probe, channel, data)?;
        if sent.success().is_some() {
            return Ok((None, rejections));
        }
        if begun.elapsed().max(waited) > BUSY_TIMEOUT {
            return Ok((Some(sent), rejections));
        }
        rejections = rejections.saturating_add(1);
        probe.target.client.wait(RETRY_AFTER);
        waited = waited.saturating_add(RETRY_AFTER);
    }
}

/// Writes a packet that must be accepted. Returns how often it was rejected in the round in which
/// it was accepted; a round ends at a timeout. Returns `None` if it is rejected although the buffer
/// of the device has space.
///
/// An error number does not show whether a rejection is temporary, nor whether the device empties
/// its buffer at all. Therefore, after the timeout, two packets with at least the same total length
/// are written by the channel's number. If the device accepts both, its buffer had space for the
/// rejected packet; otherwise the case is inconclusive.
fn write(
    probe: &mut Probe<'_>,
    channel: Channel,
    by_number: Channel,
    data: &[u8],
) -> Step<Option<u32>> {
    let half = comment(data.len().div_ceil(2).max(4));
    // This is tried twice, because the device may have emptied its buffer between two writes.
    for _ in 0..2 {
        let (rejection, rejections) = repeat(probe, channel, data)?;
        let Some(rejection) = rejection else { return Ok(Some(rejections)) };
        for _ in 0..2 {
            if send(probe, by_number, &half)?.is_error() {
                let seconds = BUSY_TIMEOUT.as_secs();
                let result = rejection.result();
                let why = format!("still rejected after {seconds} s: {result}");
                return Err(Stop::Inconclusive(why));
            }
        }
    }
    Ok(None)
}

fn write_accepted(probe: &mut Probe<'_>, rules: &[ClauseId], at: Channel, data: &[u8]) -> Step {
    let accepted = write(probe, at, at, data)?;
    let expected = || format!("{} of whole lines accepted", plural(data.len(), "byte"));
    probe.check(rules, accepted.is_some(), expected, "rejected, although the buffer has space");
    Ok(())
}

fn whole_lines(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let lines = b"; comment\r\n(a second line)\r\n\r\n";
    write_accepted(probe, &[STM_1, STM_4, STM_7], channel, lines)?;
    let rank = probe.ranks()?.into_iter().find(|(_, one)| *one == channel);
    let Some((by_index, _)) = rank else { return Ok(()) };
    if probe.may(WriteProgramStream::new(by_index, b"\r\n"))? {
        let accepted = write(probe, by_index, channel, lines)?.is_some();
        probe.check(STM_1, accepted, "lines accepted by the rank of the channel", "rejected");
    }
    Ok(())
}

fn longest(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    write_accepted(probe, &[STM_2, STM_20], channel, &comment(STREAM_PACKET_MAX))?;
    let many = comment(STREAM_PACKET_MAX / 8).repeat(8);
    write_accepted(probe, &[STM_2], channel, &many)
}

/// Writes packets of 4 to 992 bytes, among them lengths around 128 and around multiples of 256.
fn lengths(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    for len in [4_usize, 127, 128, 255, 256, 257, 511, 512, 513, 767, 768, 769, 991, 992] {
        write_accepted(probe, &[STM_2, STM_4], channel, &comment(len))?;
    }
    Ok(())
}

fn rejected_as_busy(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    let packet = comment(STREAM_PACKET_MAX);
    for _ in 0..8 {
        let accepted = write(probe, channel, channel, &packet)?;
        let found = "rejected, although the buffer has space";
        probe.check(STM_6, accepted.is_some(), "accepted, or rejected temporarily", found);
        if accepted != Some(0) {
            return Ok(());
        }
    }
    // The device rejected no packet, so the repetition of a rejected packet was not tested.
    Ok(())
}

fn too_long(probe: &mut Probe<'_>) -> Step {
    let channel = channel(probe)?;
    // A packet of the maximum length must be accepted first, because a target that rejects every
    // packet would pass the following checks.
    write_accepted(probe, &[STM_2], channel, &comment(STREAM_PACKET_MAX))?;
    for len in [993, 993, 994, 1024, 1984, 2048, 4094, 4096] {
        let sent = send(probe, channel, &comment(len))?;
        let expected = || format!("{} rejected", plural(len, "byte"));
        probe.check(STM_2, sent.is_error(), expected, &sent);
        // No manual states which error numbers mean a temporary and which a permanent rejection,
        // so the meaning of the error numbers is assumed.
        let errors = sent.reply().map(|reply| [reply.ams_error, reply.result]);
        let error = errors.into_iter().flatten().find(|error| !error.is_ok());
        let valid = error.map(Ack::from_result) == Some(Ack::Rejected);
        probe.check(assumed(STM_2), valid, "a permanent rejection", &sent);
    }
    Ok(())
}

/// A comment of this number of bytes, which is at least 4, including its line end.
fn comment(len: usize) -> Vec<u8> {
    let mut line = vec![b'('];
    line.resize(len.saturating_sub(3), b'-');
    line.extend(b")\r\n");
    line
}
