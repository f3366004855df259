//! Reading from slices and writing to slices by the rules of the field tables.

mod errors;
mod reader;
mod writer;

pub(crate) use errors::truncated;
pub(crate) use reader::Reader;
pub(crate) use writer::Writer;

/// Converts a length to the type that errors use; a greater length becomes `u32::MAX`.
pub(crate) fn to_u32(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

/// On a target with a smaller `usize`, [`to_usize`] would truncate lengths.
const _: () = assert!(usize::BITS >= u32::BITS);

#[allow(clippy::as_conversions, reason = "`try_from` is not const; usize has at least 32 bits")]
pub(crate) const fn to_usize(size: u32) -> usize {
    size as usize
}
