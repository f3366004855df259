//! Reads and changes the bytes of requests and replies.

use super::{ReplyData, text};
pub(in crate::faults) use crate::number::u32_at;

/// Writes an UNS32 at an offset, if it is within the bytes.
pub(in crate::faults) fn set_u32(bytes: &mut [u8], offset: usize, number: u32) {
    if let Some(four) = bytes.get_mut(offset..).and_then(<[u8]>::first_chunk_mut::<4>) {
        *four = number.to_le_bytes();
    }
}

/// The reply with the UNS32 at an offset changed by `other`.
pub(in crate::faults) fn number(
    answer: ReplyData,
    offset: usize,
    other: fn(u32) -> u32,
) -> ReplyData {
    answer.map(|mut bytes| {
        if let Some(number) = u32_at(&bytes, offset) {
            set_u32(&mut bytes, offset, other(number));
        }
        bytes
    })
}

/// The bytes after the first NUL.
pub(in crate::faults) fn after_nul(bytes: &[u8]) -> &[u8] {
    bytes.get(text(bytes).len().saturating_add(1)..).unwrap_or_default()
}

/// The bytes as a sequence of UNS32, without an incomplete last one.
pub(in crate::faults) fn fours(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).filter_map(|four| u32_at(four, 0)).collect()
}

/// The records of 84 bytes in a list of descriptors.
pub(in crate::faults) fn records(bytes: &[u8]) -> Vec<[u8; 84]> {
    bytes.chunks_exact(84).filter_map(|record| record.first_chunk::<84>()).copied().collect()
}

/// The records of a list of descriptors, mutable.
pub(in crate::faults) fn records_mut(bytes: &mut [u8]) -> impl Iterator<Item = &mut [u8; 84]> {
    bytes.chunks_exact_mut(84).filter_map(|record| record.first_chunk_mut::<84>())
}

/// The dimensions of a description, and the offset of its name.
pub(in crate::faults) fn dimensions(description: &[u8]) -> (Vec<u32>, usize) {
    let count = u32_at(description, 16).and_then(|m| usize::try_from(m).ok()).unwrap_or_default();
    let end = count.saturating_mul(4).saturating_add(20).min(description.len());
    let numbers = description.get(20..end).unwrap_or_default();
    (fours(numbers), end)
}
