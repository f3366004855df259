//! Handwritten code for streams of no, one or two numbers.

use super::{Fault, HandWritten, exactly, room, u16_at, u32_at};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(u32);

impl<'a> HandWritten<'a> for Number {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        Ok(Self(u32::from_le_bytes(*exactly(bytes)?)))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 4)?;
        out.copy_from_slice(&self.0.to_le_bytes());
        Ok(out)
    }
}

/// A number that must not be 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NonZero(u32);

impl NonZero {
    fn check(self) -> Result<Self, Fault> {
        match self.0 {
            0 => Err(Fault::OutOfRange { at: 0, expected: 1, found: 0 }),
            _ => Ok(self),
        }
    }
}

impl<'a> HandWritten<'a> for NonZero {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        Self(u32::from_le_bytes(*exactly(bytes)?)).check()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        self.check()?;
        let out = room(buf, 4)?;
        out.copy_from_slice(&self.0.to_le_bytes());
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair(u32, u32);

impl<'a> HandWritten<'a> for Pair {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let bytes: &[u8; 8] = exactly(bytes)?;
        Ok(Self(u32_at(bytes, 0), u32_at(bytes, 4)))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 8)?;
        out[..4].copy_from_slice(&self.0.to_le_bytes());
        out[4..].copy_from_slice(&self.1.to_le_bytes());
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Real(f64);

impl<'a> HandWritten<'a> for Real {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        Ok(Self(f64::from_le_bytes(*exactly(bytes)?)))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 8)?;
        out.copy_from_slice(&self.0.to_le_bytes());
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Flag(u8);

impl<'a> HandWritten<'a> for Flag {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let [flag] = *exactly(bytes)?;
        Ok(Self(flag))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, 1)?;
        out[0] = self.0;
        Ok(out)
    }
}

/// A number of one, two or four bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Length {
    length: u32,
    width: usize,
}

impl<'a> HandWritten<'a> for Length {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        let length = match bytes.len() {
            1 => bytes[0].into(),
            2 => u16_at(bytes, 0).into(),
            _ => u32::from_le_bytes(*exactly(bytes)?),
        };
        Ok(Self { length, width: bytes.len() })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, self.width)?;
        out.copy_from_slice(&self.length.to_le_bytes()[..self.width]);
        Ok(out)
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Nothing;

impl<'a> HandWritten<'a> for Nothing {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        exactly::<0>(bytes).map(|[]| Self)
    }

    fn encode<'b>(&self, _: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        Ok(&[])
    }
}
