//! Converts between lengths and the numbers of the streams, and bytes to a number or a digest.

/// Converts a number to a `u32`; a number that does not fit becomes `u32::MAX`.
pub fn to_u32(number: impl TryInto<u32>) -> u32 {
    number.try_into().unwrap_or(u32::MAX)
}

/// Converts a number to a length; a number that does not fit becomes `usize::MAX`.
pub fn to_usize(number: impl TryInto<usize>) -> usize {
    number.try_into().unwrap_or(usize::MAX)
}

/// The UNS32 at an offset; `None` if it is not completely within the bytes.
pub(crate) fn u32_at(bytes: &[u8], offset: usize) -> Option<u32> {
    let four = bytes.get(offset..)?.first_chunk::<4>()?;
    Some(u32::from_le_bytes(*four))
}

const BASIS: u64 = 0xCBF2_9CE4_8422_2325;

/// The FNV-1a hash of the bytes with 64 bits, which is not cryptographic.
///
/// ```
/// use ads_cnc_conformance::number::digest;
///
/// assert_eq!(digest(b"foobar"), 0x85944171f73967e8);
/// ```
pub fn digest(bytes: &[u8]) -> u64 {
    digest_more(BASIS, bytes)
}

/// The digest of bytes in two parts: `digest` is that of the first part, and `bytes` are the rest.
pub(crate) fn digest_more(digest: u64, bytes: &[u8]) -> u64 {
    let next = |digest: u64, &byte: &u8| (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3);
    bytes.iter().fold(digest, next)
}
