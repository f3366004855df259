//! Handwritten code for the streams of variables.

use super::text::Text;
use super::{ByteStorage, Fault, HandWritten, at_least, at_most, exactly, room, u32_at};

const MAX: usize = 2048;

/// A list of dimensions or indices: borrowed bytes of a stream, or owned numbers.
pub(crate) trait U32List<'a> {
    fn read(bytes: &'a [u8]) -> Self;
    fn count(&self) -> usize;
    /// Writes the numbers to `out`, which has four bytes for each number.
    fn put(&self, out: &mut [u8]);
}

impl<'a> U32List<'a> for &'a [u8] {
    fn read(bytes: &'a [u8]) -> Self {
        bytes
    }

    fn count(&self) -> usize {
        self.len() / 4
    }

    fn put(&self, out: &mut [u8]) {
        out.copy_from_slice(self);
    }
}

impl<'a> U32List<'a> for Vec<u32> {
    fn read(bytes: &'a [u8]) -> Self {
        bytes.chunks_exact(4).map(|number| u32_at(number, 0)).collect()
    }

    fn count(&self) -> usize {
        self.len()
    }

    fn put(&self, out: &mut [u8]) {
        for (number, bytes) in self.iter().zip(out.chunks_exact_mut(4)) {
            bytes.copy_from_slice(&number.to_le_bytes());
        }
    }
}

/// Decodes the list of numbers after the count at offset `at`; returns the list and the bytes after
/// it.
fn numbers<'a, N: U32List<'a>>(
    bytes: &'a [u8],
    at: usize,
    max: usize,
) -> Result<(N, &'a [u8]), Fault> {
    let (count, rest) = (u32_at(bytes, at), &bytes[at + 4..]);
    let fits = (rest.len() / 4).min(max);
    if count as usize > fits {
        return Err(Fault::TooMany { at: at as u32, max: fits as u32, found: count });
    }
    let (numbers, rest) = rest.split_at(count as usize * 4);
    Ok((N::read(numbers), rest))
}

fn check_count<'a>(numbers: &impl U32List<'a>, at: u32, max: usize) -> Result<usize, Fault> {
    let count = numbers.count();
    match count > max {
        true => Err(Fault::TooMany { at, max: max as u32, found: count as u32 }),
        false => Ok(count),
    }
}

/// The four numbers at the start of a description, before the count of dimensions.
#[derive(Clone, Copy, Debug)]
struct Head {
    handle: u32,
    var_type: u32,
    access: u32,
    size: u32,
}

impl Head {
    fn read(bytes: &[u8]) -> Self {
        Self {
            handle: u32_at(bytes, 0),
            var_type: u32_at(bytes, 4),
            access: u32_at(bytes, 8),
            size: u32_at(bytes, 12),
        }
    }

    fn put(&self, count: usize, out: &mut [u8]) {
        out[..4].copy_from_slice(&self.handle.to_le_bytes());
        out[4..8].copy_from_slice(&self.var_type.to_le_bytes());
        out[8..12].copy_from_slice(&self.access.to_le_bytes());
        out[12..16].copy_from_slice(&self.size.to_le_bytes());
        out[16..20].copy_from_slice(&(count as u32).to_le_bytes());
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Description<B, N> {
    head: Head,
    dimensions: N,
    name: Text<B>,
}

impl<'a, B: ByteStorage<'a>, N: U32List<'a>> HandWritten<'a> for Description<B, N> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(MAX, bytes.len())?;
        at_least(20, bytes)?;
        let head = Head::read(bytes);
        let (dimensions, name) = numbers::<N>(bytes, 16, 506)?;
        if name.is_empty() {
            return Err(Fault::Truncated { at: bytes.len() as u32, expected: 1, found: 0 });
        }
        at_most(256, name.len())?;
        Ok(Self { head, dimensions, name: Text::split(name) })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let count = check_count(&self.dimensions, 16, 506)?;
        let name_at = 20 + 4 * count;
        self.name.check_open(name_at as u32, 1, 256)?;
        let len = name_at + self.name.len();
        at_most(MAX, len)?;
        let out = room(buf, len)?;
        self.head.put(count, out);
        self.dimensions.put(&mut out[20..name_at]);
        self.name.put(&mut out[name_at..]);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct DescriptionByName<N> {
    head: Head,
    dimensions: N,
}

impl<'a, N: U32List<'a>> HandWritten<'a> for DescriptionByName<N> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(MAX, bytes.len())?;
        at_least(20, bytes)?;
        let (dimensions, rest) = numbers(bytes, 16, 507)?;
        if !rest.is_empty() {
            let expected = (bytes.len() - rest.len()) as u32;
            return Err(Fault::Trailing { expected, found: bytes.len() as u32 });
        }
        Ok(Self { head: Head::read(bytes), dimensions })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let count = check_count(&self.dimensions, 16, 507)?;
        let out = room(buf, 20 + 4 * count)?;
        self.head.put(count, out);
        self.dimensions.put(&mut out[20..]);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct HandleRead<N> {
    handle: u32,
    indices: N,
}

impl<'a, N: U32List<'a>> HandWritten<'a> for HandleRead<N> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(MAX, bytes.len())?;
        at_least(8, bytes)?;
        let (indices, rest) = numbers(bytes, 4, 510)?;
        if !rest.is_empty() {
            let expected = (bytes.len() - rest.len()) as u32;
            return Err(Fault::Trailing { expected, found: bytes.len() as u32 });
        }
        Ok(Self { handle: u32_at(bytes, 0), indices })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let count = check_count(&self.indices, 4, 510)?;
        let out = room(buf, 8 + 4 * count)?;
        out[..4].copy_from_slice(&self.handle.to_le_bytes());
        out[4..8].copy_from_slice(&(count as u32).to_le_bytes());
        self.indices.put(&mut out[8..]);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct HandleWrite<B, N> {
    handle: u32,
    indices: N,
    value: B,
}

impl<'a, B: ByteStorage<'a>, N: U32List<'a>> HandWritten<'a> for HandleWrite<B, N> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(MAX, bytes.len())?;
        at_least(8, bytes)?;
        let (indices, value) = numbers(bytes, 4, 510)?;
        Ok(Self { handle: u32_at(bytes, 0), indices, value: value.into() })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let (count, value) = (check_count(&self.indices, 4, 510)?, self.value.as_ref());
        let value_at = 8 + 4 * count;
        at_most(MAX, value_at + value.len())?;
        let out = room(buf, value_at + value.len())?;
        out[..4].copy_from_slice(&self.handle.to_le_bytes());
        out[4..8].copy_from_slice(&(count as u32).to_le_bytes());
        self.indices.put(&mut out[8..value_at]);
        out[value_at..].copy_from_slice(value);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct NameWrite<B> {
    name: B,
    value: B,
}

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for NameWrite<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_most(MAX, bytes.len())?;
        let field = &bytes[..bytes.len().min(256)];
        let Some(nul) = field.iter().position(|&byte| byte == 0) else {
            return Err(Fault::MissingNul { at: 0, max: 256, found: field.len() as u32 });
        };
        Ok(Self { name: bytes[..nul].into(), value: bytes[nul + 1..].into() })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let (name, value) = (self.name.as_ref(), self.value.as_ref());
        at_most(256, name.len() + 1)?;
        let len = name.len() + 1 + value.len();
        at_most(MAX, len)?;
        let out = room(buf, len)?;
        out[..name.len()].copy_from_slice(name);
        out[name.len()] = 0;
        out[name.len() + 1..].copy_from_slice(value);
        Ok(out)
    }
}

#[derive(Clone, Debug)]
pub(crate) struct IndexKind<B> {
    index: u32,
    kind: Text<B>,
}

impl<'a, B: ByteStorage<'a>> HandWritten<'a> for IndexKind<B> {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        at_least(4, bytes)?;
        Ok(Self { index: u32_at(bytes, 0), kind: Text::terminated(&bytes[4..], 4, 256)? })
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        self.kind.check_terminated(4, 256)?;
        let out = room(buf, 4 + self.kind.len())?;
        out[..4].copy_from_slice(&self.index.to_le_bytes());
        self.kind.put(&mut out[4..]);
        Ok(out)
    }
}

/// An extended description: synchronisation and validity; `None` for a variable without one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extended(Option<(u32, u32)>);

impl<'a> HandWritten<'a> for Extended {
    fn decode(bytes: &'a [u8]) -> Result<Self, Fault> {
        if bytes.is_empty() {
            return Ok(Self(None));
        }
        let bytes: &[u8; 8] = exactly(bytes)?;
        Ok(Self(Some((u32_at(bytes, 0), u32_at(bytes, 4)))))
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Fault> {
        let Some((synchronisation, validity)) = self.0 else {
            return Ok(&[]);
        };
        let out = room(buf, 8)?;
        out[..4].copy_from_slice(&synchronisation.to_le_bytes());
        out[4..].copy_from_slice(&validity.to_le_bytes());
        Ok(out)
    }
}
