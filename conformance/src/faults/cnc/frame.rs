//! Defects of frames (mainly ADS).

use ads_cnc::ads::{Command, FrameRef};
use ads_cnc_vectors::ClauseId;
use ads_cnc_vectors::ids::*;

use super::{CncDefect, CncFault, Upstream, fault, set_u32, u32_at};
use crate::number::to_u32;

/// The offsets of fields in a frame, from the start of the AMS/TCP header.
pub(super) const TCP_LENGTH: usize = 2;
pub(super) const TARGET: usize = 6;
pub(super) const SOURCE: usize = 14;
pub(super) const DATA_LENGTH: usize = 26;
pub(super) const ERROR: usize = 30;
pub(super) const INVOKE_ID: usize = 34;
pub(super) const RESULT: usize = 38;
pub(super) const LENGTH: usize = 42;
pub(super) const DATA: usize = 46;

/// A row whose defect changes the frames that the CNC sends.
pub(super) const fn sent(
    id: &'static str,
    breaks: &'static [ClauseId],
    what: &'static str,
    frame: fn(&Upstream<'_>, &FrameRef<'_>, Vec<u8>) -> Vec<u8>,
) -> CncDefect {
    fault(id, breaks, what, CncFault::Frame(frame))
}

/// The frame with the lengths in its AMS/TCP and AMS headers corrected.
pub(in crate::faults) fn measured(mut bytes: Vec<u8>) -> Vec<u8> {
    let length = to_u32(bytes.len());
    set_u32(&mut bytes, TCP_LENGTH, length.saturating_sub(6));
    set_u32(&mut bytes, DATA_LENGTH, length.saturating_sub(38));
    bytes
}

/// The frame with the bytes at an offset replaced by `new`.
pub(super) fn set(mut bytes: Vec<u8>, offset: usize, new: &[u8]) -> Vec<u8> {
    bytes.iter_mut().skip(offset).zip(new).for_each(|(old, new)| *old = *new);
    bytes
}

/// The result field of a response frame; 0 if the frame is too short.
pub(super) fn result(bytes: &[u8]) -> u32 {
    u32_at(bytes, RESULT).unwrap_or_default()
}

pub(super) fn is(request: &FrameRef<'_>, commands: &[Command]) -> bool {
    commands.contains(&request.header().command)
}

#[rustfmt::skip]
pub(super) const ROWS: &[CncDefect] = &[
    sent("cnc.ads.invoke-id-of-before", &[ADS_5],
        "a response has the invoke ID of the previous request",
        |cnc, request, bytes| {
            let mut memory = cnc.memory();
            let before = std::mem::replace(&mut memory.count, request.header().invoke_id);
            set(bytes, INVOKE_ID, &before.to_le_bytes())
        }),
    sent("cnc.ads.header-big-endian", &[ADS_5, GEN_1],
        "data length, error and invoke ID of the AMS header have the most significant byte first",
        |_, _, mut bytes| {
            for offset in [DATA_LENGTH, ERROR, INVOKE_ID] {
                let number = u32_at(&bytes, offset).unwrap_or_default();
                set_u32(&mut bytes, offset, number.swap_bytes());
            }
            bytes
        }),
    sent("cnc.ads.error-always", &[ADS_5],
        "the AMS header has the error 1 although the result in the reply is 0 (success)",
        |_, _, bytes| match result(&bytes) { 0 => set(bytes, ERROR, &[1, 0, 0, 0]), _ => bytes }),
    sent("cnc.ads.sent-twice", &[ADS_5], "each response is sent twice", |_, _, bytes| bytes.repeat(2)),
    sent("cnc.ads.late", &[ADS_5],
        "the CNC answers each request with the response to the previous one, and the first \
         correctly",
        |cnc, _, bytes| {
            let mut memory = cnc.memory();
            let before = std::mem::replace(&mut memory.frame, bytes.clone());
            if before.is_empty() { bytes } else { before }
        }),
];
