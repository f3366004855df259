//! Handwritten code for text fields: the text, and the bytes after its NUL.

use super::{ByteStorage, Fault, HandWritten, at_least, at_most, room};

/// A text field. `text` never contains a NUL, because it is only created by decoding.
#[derive(Clone, Debug)]
pub(crate) struct Text<B> {
    text: B,
    tail: Option<B>,
}

impl<'a, B: ByteStorage<'a>> Text<B> {
    pub(crate) fn split(field: &'a [u8]) -> Self {
        match field.iter().position(|&byte| byte == 0) {
            Some(nul) => Self { text: field[..nul].into(), tail: Some(field[nul + 1..].into()) },
            None => Self { text: field.into(), tail: None },
        }
    }

    /// Decodes a text that must end in one or more NULs.
    pub(crate) fn terminated(field: &'a [u8], at: u32, max: usize) -> Result<Self, Fault> {
        let found = field.len() as u32;
        if field.len() > max {
            return Err(Fault::TooLong { max: max as u32, found });
        }
        let Some(nul) = field.iter().position(|&byte| byte == 0) else {
            return Err(Fault::MissingNul { at, max: max as u32, found });
        };
        let (text, tail) = (&field[..nul], &field[nul + 1..]);
        if let Some(odd) = tail.iter().position(|&byte| byte != 0) {
            return Err(Fault::Trailing {
                expected: at + (nul + 1 + odd) as u32,
                found: at + found,
            });
        }
        Ok(Self { text: text.into(), tail: Some(tail.into()) })
    }

    pub(crate) fn len(&self) -> usize {
        let tail = self.tail.as_ref();
        self.text.as_ref().len() + tail.map_or(0, |tail| tail.as_ref().len() + 1)
    }

    /// Rejects the values that [`terminated`](Self::terminated) would reject.
    pub(crate) fn check_terminated(&self, at: u32, max: usize) -> Result<(), Fault> {
        at_most(max, self.len())?;
        match self.tail {
            Some(_) => self.check_padding(at),
            None => Err(Fault::MissingNul { at, max: max as u32, found: self.len() as u32 }),
        }
    }

    fn check_padding(&self, at: u32) -> Result<(), Fault> {
        let tail = self.tail.as_ref().map_or(&[][..], |tail| tail.as_ref());
        match tail.iter().position(|&byte| byte != 0) {
            None => Ok(()),
            Some(odd) => {
                let expected = at + (self.text.as_ref().len() + 1 + odd) as u32;
                Err(Fault::Trailing { expected, found: at + self.len() as u32 })
            }
        }
    }

    pub(crate) fn check_open(&self, at: u32, min: usize, max: usize) -> Result<(), Fault> {
        if self.len() < min {
            let (expected, found) = (min as u32, self.len() as u32);
            return Err(Fault::Truncated { at, expected, found });
        }
        at_most(max, self.len())
    }

    /// Writes the field to `out`, which has [`len`](Self::len) bytes.
    pub(crate) fn put(&self, out: &mut [u8]) {
        let text = self.text.as_ref();
        let (head, end) = out.split_at_mut(text.len());
        head.copy_from_slice(text);
        if let Some(tail) = &self.tail {
            end[0] = 0;
            end[1..].copy_from_slice(tail.as_ref());
        }
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let out = room(buf, self.len())?;
        self.put(out);
        Ok(out)
    }
}

/// Text that must end in a NUL.
#[derive(Clone, Debug)]
pub(crate) struct Name<B>(Text<B>);

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for Name<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        Text::terminated(bytes, 0, 256).map(Self)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        self.0.check_terminated(0, 256)?;
        self.0.encode(buf)
    }
}

/// Text that must end in a NUL, or no bytes.
#[derive(Clone, Debug)]
pub(crate) struct Kind<B>(Text<B>);

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for Kind<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        if bytes.is_empty() {
            return Ok(Self(Text { text: bytes.into(), tail: None }));
        }
        Text::terminated(bytes, 0, 256).map(Self)
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        if self.0.len() > 0 {
            self.0.check_terminated(0, 256)?;
        }
        self.0.encode(buf)
    }
}

/// Text that ends in a NUL or at the end of the stream.
#[derive(Clone, Debug)]
pub(crate) struct Open<B, const MIN: usize, const MAX: usize>(Text<B>);

impl<'a, B: ByteStorage<'a>, const MIN: usize, const MAX: usize> HandWritten<'a>
    for Open<B, MIN, MAX>
{
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_least(MIN, bytes)?;
        at_most(MAX, bytes.len())?;
        Ok(Self(Text::split(bytes)))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        self.0.check_open(0, MIN, MAX)?;
        self.0.encode(buf)
    }
}

/// Text that may end in a NUL, followed only by NULs.
#[derive(Clone, Debug)]
pub(crate) struct Padded<B, const MAX: usize>(Text<B>);

impl<'a, B: ByteStorage<'a>, const MAX: usize> HandWritten<'a> for Padded<B, MAX> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_least(1, bytes)?;
        at_most(MAX, bytes.len())?;
        match bytes.contains(&0) {
            true => Text::terminated(bytes, 0, MAX).map(Self),
            false => Ok(Self(Text { text: bytes.into(), tail: None })),
        }
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        self.0.check_open(0, 1, MAX)?;
        self.0.check_padding(0)?;
        self.0.encode(buf)
    }
}
