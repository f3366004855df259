//! From slices to binrw's declarations, and zerocopy's layouts into both.
//!
//! binrw only sees bytes that a view has accepted, so that its errors never surface, and reads a
//! fixed part in one piece instead of field by field.

use alloc::vec::Vec;

use binrw::io::{self, Read, Seek, SeekFrom};
use binrw::meta::ReadEndian;
use binrw::{BinRead, BinResult, Endian};
use zerocopy::{FromBytes, IntoBytes};

use crate::bytes::{to_len, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::text::{CncString, Text, TextRef};

/// Reads what a view of `stream` has accepted.
pub(crate) fn read<T>(stream: Stream, accepted: &[u8]) -> Result<T, Error>
where
    T: for<'a> BinRead<Args<'a> = ()> + ReadEndian,
{
    read_with(stream, accepted, ())
}

/// As [`read`], with what the view has found out already.
#[inline]
pub(crate) fn read_with<T, A>(stream: Stream, accepted: &[u8], found: A) -> Result<T, Error>
where
    T: for<'a> BinRead<Args<'a> = A> + ReadEndian,
{
    let mut source = Source { all: accepted, rest: accepted };
    match T::read_args(&mut source, found) {
        Ok(value) if source.rest.is_empty() => Ok(value),
        _ => Err(unread(stream, &source)),
    }
}

/// Cannot happen on accepted bytes; if a declaration were wrong, this says so.
#[cold]
fn unread(stream: Stream, source: &Source<'_>) -> Error {
    let (given, left) = (to_u32(source.all.len()), to_u32(source.rest.len()));
    let used = given.saturating_sub(left);
    Error::new(ErrorKind::Mismatch, Field::whole(stream), used, used, given)
}

/// A zerocopy layout as one field of a binrw declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fixed<T>(pub(crate) T);

impl<T: FromBytes + IntoBytes> BinRead for Fixed<T> {
    type Args<'a> = ();

    #[inline]
    fn read_options<R: Read + Seek>(
        reader: &mut R,
        _: Endian,
        (): Self::Args<'_>,
    ) -> BinResult<Self> {
        let mut fixed = T::new_zeroed();
        reader.read_exact(fixed.as_mut_bytes())?;
        Ok(Self(fixed))
    }
}

/// `count` numbers; the view has found them to be there.
#[binrw::parser(reader)]
pub(crate) fn numbers(count: u32) -> BinResult<Vec<u32>> {
    let mut numbers = filled::<u32>(reader, to_len(count))?;
    for number in &mut numbers {
        *number = u32::from_le(*number);
    }
    Ok(numbers)
}

/// Records to the end of the stream; the view has found the last one whole.
#[binrw::parser(reader)]
pub(crate) fn records<T: Clone + FromBytes + IntoBytes>() -> BinResult<Vec<T>> {
    let count = left(reader)?.checked_div(size_of::<T>()).unwrap_or(0);
    filled(reader, count)
}

/// A length and so many bytes, or nothing at the end of the stream.
#[binrw::parser(reader, endian)]
pub(crate) fn counted_unless_end() -> BinResult<Option<Vec<u8>>> {
    if left(reader)? < 4 {
        return Ok(None);
    }
    reader.seek(SeekFrom::Current(4))?;
    rest(reader, endian, ()).map(Some)
}

/// How many bytes a view has found before a text's NUL and, if there is one, behind it.
#[derive(Clone, Copy)]
pub(crate) struct TextLen {
    text: usize,
    tail: Option<usize>,
}

impl From<TextRef<'_>> for TextLen {
    fn from(field: TextRef<'_>) -> Self {
        Self { text: field.text().len(), tail: field.tail().map(<[u8]>::len) }
    }
}

/// Text, and its NUL and what follows if there is one.
#[binrw::parser(reader)]
pub(crate) fn text(len: TextLen) -> BinResult<Text> {
    let text = CncString::without_nul(filled(reader, len.text)?);
    let Some(tail) = len.tail else {
        return Ok(Text { text, tail: None });
    };
    reader.read_exact(&mut [0])?;
    Ok(Text { text, tail: Some(filled(reader, tail)?) })
}

/// Text of so many bytes, and its NUL.
#[binrw::parser(reader)]
pub(crate) fn leading_text(len: usize) -> BinResult<CncString> {
    let text = CncString::without_nul(filled(reader, len)?);
    reader.read_exact(&mut [0])?;
    Ok(text)
}

/// All bytes that are left.
#[binrw::parser(reader)]
pub(crate) fn rest() -> BinResult<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// So many from the reader, which only fills what has been filled before. Not by `vec![0; n]`:
/// allocators that clear what they give are slower for the little there is.
#[inline]
fn filled<T: Clone + FromBytes + IntoBytes>(
    reader: &mut impl Read,
    count: usize,
) -> BinResult<Vec<T>> {
    let mut filled = Vec::with_capacity(count);
    // Mostly there are neither dimensions nor anything behind a text's NUL.
    if count > 0 {
        filled.resize(count, T::new_zeroed());
        reader.read_exact(filled.as_mut_slice().as_mut_bytes())?;
    }
    Ok(filled)
}

/// Bytes that are left, which is what may be allocated.
fn left(reader: &mut impl Seek) -> BinResult<usize> {
    let at = reader.stream_position()?;
    let end = reader.seek(SeekFrom::End(0))?;
    reader.seek(SeekFrom::Start(at))?;
    Ok(usize::try_from(end.saturating_sub(at)).unwrap_or(0))
}

/// Reads from a slice. binrw's own cursor without std is several times slower.
struct Source<'a> {
    all: &'a [u8],
    rest: &'a [u8],
}

impl Source<'_> {
    #[inline]
    fn at(&self) -> u64 {
        length(self.all).saturating_sub(length(self.rest))
    }
}

fn length(bytes: &[u8]) -> u64 {
    u64::try_from(bytes.len()).unwrap_or(u64::MAX)
}

impl Read for Source<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let len = self.rest.len().min(out.len());
        self.read_exact(out.get_mut(..len).unwrap_or_default())?;
        Ok(len)
    }

    #[inline]
    fn read_exact(&mut self, out: &mut [u8]) -> io::Result<()> {
        let Some((head, rest)) = self.rest.split_at_checked(out.len()) else {
            return Err(io::ErrorKind::UnexpectedEof.into());
        };
        out.copy_from_slice(head);
        self.rest = rest;
        Ok(())
    }

    fn read_to_end(&mut self, out: &mut Vec<u8>) -> io::Result<usize> {
        let rest = core::mem::take(&mut self.rest);
        out.reserve_exact(rest.len());
        out.extend_from_slice(rest);
        Ok(rest.len())
    }
}

impl Seek for Source<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let position = match to {
            SeekFrom::Start(start) => Some(start),
            SeekFrom::Current(by) => self.at().checked_add_signed(by),
            SeekFrom::End(by) => length(self.all).checked_add_signed(by),
        };
        let at = position.ok_or(io::ErrorKind::InvalidInput)?;
        // Behind the end there is nothing.
        self.rest = usize::try_from(at).ok().and_then(|at| self.all.get(at..)).unwrap_or_default();
        Ok(at)
    }

    fn stream_position(&mut self) -> io::Result<u64> {
        Ok(self.at())
    }
}
