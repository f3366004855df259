//! Converts between lengths and the numbers of the streams.

/// Converts a number to a `u32`; a number that does not fit becomes `u32::MAX`.
pub fn to_u32(number: impl TryInto<u32>) -> u32 {
    number.try_into().unwrap_or(u32::MAX)
}

/// Converts a number to a length; a number that does not fit becomes `usize::MAX`.
pub fn to_usize(number: impl TryInto<usize>) -> usize {
    number.try_into().unwrap_or(usize::MAX)
}
