//! Converts between lengths and the numbers of the streams.

/// A number as a `u32`; the maximum if it does not fit.
pub fn to_u32(number: impl TryInto<u32>) -> u32 {
    number.try_into().unwrap_or(u32::MAX)
}

/// A number as a length; the maximum if it does not fit.
pub fn to_usize(number: impl TryInto<usize>) -> usize {
    number.try_into().unwrap_or(usize::MAX)
}
