//! What a stack writes that has no codec: `from_le_bytes` on slices, with the same checks.

pub(crate) mod descriptors;

/// What is wrong and where, without which nobody would look for a fault twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    Truncated { at: u32, expected: u32, found: u32 },
    TooLong { max: u32, found: u32 },
    BufferTooSmall { expected: u32, found: u32 },
}
