//! Converts between numbers of the streams and lengths.

pub(super) fn to_u32(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

pub(super) fn to_len(number: u32) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}
