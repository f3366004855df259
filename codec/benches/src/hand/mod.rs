//! Handwritten code for all streams, without the codec: `from_le_bytes` on slices, with the same
//! checks as in the codec.

mod ads;
mod bytes;
mod descriptors;
mod device;
mod fixed;
pub(crate) mod requests;
mod text;
mod variable;

pub(crate) use ads::{
    Frame, Header, ReadRequest, ReadWriteRequest, Reply, TcpHeader, WriteRequest,
};
pub(crate) use bytes::Bytes;
pub(crate) use descriptors::{Descriptor, Descriptors};
pub(crate) use device::{DeviceInfo, DeviceState};
pub(crate) use fixed::{Flag, Length, NonZero, Nothing, Number, Pair, Real};
pub(crate) use text::{Kind, Name, Open, Padded};
pub(crate) use variable::{
    Description, DescriptionByName, Extended, HandleRead, HandleWrite, IndexKind, NameWrite,
};

/// A fault: the expected and the found number, and for a fault in a field its offset `at`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    Truncated { at: u32, expected: u32, found: u32 },
    Trailing { expected: u32, found: u32 },
    TooLong { max: u32, found: u32 },
    TooMany { at: u32, max: u32, found: u32 },
    MissingNul { at: u32, max: u32, found: u32 },
    OutOfRange { at: u32, expected: u32, found: u32 },
    BufferTooSmall { expected: u32, found: u32 },
}

/// A stream that is decoded from all given bytes and encoded to the start of a buffer.
pub(crate) trait HandWritten<'a>: Sized {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault>;
    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault>;
}

/// Borrowed or owned bytes.
pub(crate) trait ByteStorage<'a>: From<&'a [u8]> + AsRef<[u8]> {}

impl<'a, B: From<&'a [u8]> + AsRef<[u8]>> ByteStorage<'a> for B {}

pub(crate) fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

pub(crate) fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

/// Checks that a stream of fixed length has exactly `N` bytes.
pub(crate) fn exactly<const N: usize>(bytes: &[u8]) -> Result<&[u8; N], Fault> {
    let (expected, found) = (N as u32, bytes.len() as u32);
    bytes.try_into().map_err(|_| match found < expected {
        true => Fault::Truncated { at: 0, expected, found },
        false => Fault::Trailing { expected, found },
    })
}

/// Checks that a stream or value has at most `max` bytes.
pub(crate) fn at_most(max: usize, len: usize) -> Result<(), Fault> {
    match len > max {
        true => Err(Fault::TooLong { max: max as u32, found: len as u32 }),
        false => Ok(()),
    }
}

/// Checks that a stream has at least `min` bytes.
pub(crate) fn at_least(min: usize, bytes: &[u8]) -> Result<(), Fault> {
    match bytes.len() < min {
        true => Err(Fault::Truncated { at: 0, expected: min as u32, found: bytes.len() as u32 }),
        false => Ok(()),
    }
}

/// The first `needed` bytes of a buffer.
pub(crate) fn room(buf: &mut [u8], needed: usize) -> Result<&mut [u8], Fault> {
    let found = buf.len() as u32;
    buf.get_mut(..needed).ok_or(Fault::BufferTooSmall { expected: needed as u32, found })
}
