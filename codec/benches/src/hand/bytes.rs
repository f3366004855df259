//! Handwritten code for streams that are bytes without a structure.

use super::{ByteStorage, Fault, HandWritten, at_least, at_most, room};

#[derive(Clone, Debug)]
pub(crate) struct Bytes<B, const MIN: usize, const MAX: usize> {
    bytes: B,
}

impl<'a, B: ByteStorage<'a>, const MIN: usize, const MAX: usize> HandWritten<'a>
    for Bytes<B, MIN, MAX>
{
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_least(MIN, bytes)?;
        at_most(MAX, bytes.len())?;
        Ok(Self { bytes: bytes.into() })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let bytes = self.bytes.as_ref();
        at_least(MIN, bytes)?;
        at_most(MAX, bytes.len())?;
        let out = room(buf, bytes.len())?;
        out.copy_from_slice(bytes);
        Ok(out)
    }
}
