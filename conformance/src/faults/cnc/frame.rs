//! Frames (ADS).

use ads_cnc::ads::{Command, FrameRef};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::{CncFault, CncSeed, Upstream, fault, set_u32, u32_at};

/// Offsets in a frame.
pub(super) const TCP_LENGTH: usize = 2;
pub(super) const TARGET: usize = 6;
pub(super) const SOURCE: usize = 14;
pub(super) const COMMAND: usize = 22;
pub(super) const FLAGS: usize = 24;
pub(super) const DATA_LENGTH: usize = 26;
pub(super) const ERROR: usize = 30;
pub(super) const INVOKE_ID: usize = 34;
pub(super) const RESULT: usize = 38;
pub(super) const LENGTH: usize = 42;
pub(super) const DATA: usize = 46;

/// A row about frames.
pub(super) const fn sent(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    frame: fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>,
) -> CncSeed {
    fault(id, breaks, what, CncFault::Frame(frame))
}

/// The frame with its length fields corrected.
pub(in crate::faults) fn measured(mut bytes: Vec<u8>) -> Vec<u8> {
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
    set_u32(&mut bytes, TCP_LENGTH, length.saturating_sub(6));
    set_u32(&mut bytes, DATA_LENGTH, length.saturating_sub(38));
    bytes
}

/// The frame with other bytes at an offset.
pub(super) fn set(mut bytes: Vec<u8>, place: usize, new: &[u8]) -> Vec<u8> {
    bytes.iter_mut().skip(place).zip(new).for_each(|(old, new)| *old = *new);
    bytes
}

/// The result of a reply.
pub(super) fn result(bytes: &[u8]) -> u32 {
    u32_at(bytes, RESULT).unwrap_or_default()
}

pub(super) fn is(request: &FrameRef<'_>, commands: &[Command]) -> bool {
    commands.contains(&request.header().command)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncSeed] = &[
    sent("cnc.ads.invoke-id-0", &[ADS_5], "the invoke ID of a response is 0",
        |_, _, bytes| set(bytes, INVOKE_ID, &[0; 4])),
    sent("cnc.ads.invoke-id-own", &[ADS_5], "responses are counted by invoke IDs of their own",
        |cnc, _, bytes| {
            let mut memory = cnc.memory();
            memory.count = memory.count.wrapping_add(0x0100_0001);
            set(bytes, INVOKE_ID, &memory.count.to_le_bytes())
        }),
    sent("cnc.ads.invoke-id-16-bit", &[ADS_5],
        "the invoke ID of a response is the lower 16 bits of that of the request",
        |_, _, bytes| set(bytes, INVOKE_ID + 2, &[0; 2])),
    sent("cnc.ads.invoke-id-of-before", &[ADS_5],
        "the invoke ID of a response is that of the request before",
        |cnc, request, bytes| {
            let mut memory = cnc.memory();
            let before = std::mem::replace(&mut memory.count, request.header().invoke_id);
            set(bytes, INVOKE_ID, &before.to_le_bytes())
        }),
    sent("cnc.ads.addresses-not-swapped", &[ADS_5],
        "target and source of a response are those of the request",
        |_, _, mut bytes| {
            if let Some(addresses) = bytes.get_mut(TARGET..COMMAND) {
                addresses.rotate_left(8);
            }
            bytes
        }),
    sent("cnc.ads.target-port-48898", &[ADS_5],
        "the target port of a response is the number of the TCP port",
        |_, _, bytes| set(bytes, TARGET + 6, &48898_u16.to_le_bytes())),
    sent("cnc.ads.source-zero", &[ADS_5], "the source of a response is 0.0.0.0.0.0",
        |_, _, bytes| set(bytes, SOURCE, &[0; 6])),
    sent("cnc.ads.source-port-10000", &[ADS_5], "the source port of a response is 10000",
        |_, _, bytes| set(bytes, SOURCE + 6, &10000_u16.to_le_bytes())),
    sent("cnc.ads.command-0", &[ADS_5], "the command of a response is 0",
        |_, _, bytes| set(bytes, COMMAND, &[0; 2])),
    sent("cnc.ads.flags-request", &[ADS_5], "a response has the flags of a request",
        |_, _, bytes| set(bytes, FLAGS, &[4, 0])),
    sent("cnc.ads.flags-response-alone", &[ADS_5], "a response has the flags 0x0001",
        |_, _, bytes| set(bytes, FLAGS, &[1, 0])),
    sent("cnc.ads.reserved-1", &[ADS_5], "the reserved number in front of a frame is 1",
        |_, _, bytes| set(bytes, 0, &[1, 0])),
    sent("cnc.ads.tcp-length-of-data", &[ADS_5], "the length in front of a frame is that of the data",
        |_, _, mut bytes| {
            let length = u32_at(&bytes, DATA_LENGTH).unwrap_or_default();
            set_u32(&mut bytes, TCP_LENGTH, length);
            bytes
        }),
    sent("cnc.ads.tcp-length-of-frame", &[ADS_5], "the length in front of a frame counts itself",
        |_, _, mut bytes| {
            let length = u32_at(&bytes, TCP_LENGTH).unwrap_or_default();
            set_u32(&mut bytes, TCP_LENGTH, length.wrapping_add(6));
            bytes
        }),
    sent("cnc.ads.data-length-of-frame", &[ADS_5], "the data length of a response counts the header too",
        |_, _, mut bytes| {
            let length = u32_at(&bytes, DATA_LENGTH).unwrap_or_default();
            set_u32(&mut bytes, DATA_LENGTH, length.wrapping_add(32));
            bytes
        }),
    sent("cnc.ads.data-length-0", &[ADS_5], "the data length of a response is 0",
        |_, _, bytes| set(bytes, DATA_LENGTH, &[0; 4])),
    sent("cnc.ads.header-big-endian", &[ADS_5, GEN_1],
        "data length, error and invoke ID have the most significant byte first",
        |_, _, mut bytes| {
            for place in [DATA_LENGTH, ERROR, INVOKE_ID] {
                let number = u32_at(&bytes, place).unwrap_or_default();
                set_u32(&mut bytes, place, number.swap_bytes());
            }
            bytes
        }),
    sent("cnc.ads.error-always", &[ADS_5], "the AMS header has an error though the result says success",
        |_, _, bytes| match result(&bytes) { 0 => set(bytes, ERROR, &[1, 0, 0, 0]), _ => bytes }),
    sent("cnc.ads.sent-twice", &[ADS_5], "each response is sent twice", |_, _, bytes| bytes.repeat(2)),
    sent("cnc.ads.late", &[ADS_5],
        "each response is sent with the next request: the first request has the same twice",
        |cnc, _, bytes| {
            let mut memory = cnc.memory();
            let before = std::mem::replace(&mut memory.frame, bytes.clone());
            if before.is_empty() { bytes } else { before }
        }),
];
