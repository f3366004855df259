//! From slices to binrw's declarations, and zerocopy's layouts into both.
//!
//! binrw only sees bytes that a view has accepted, so that its errors never surface, and reads a
//! fixed part in one piece instead of field by field.

use alloc::vec::Vec;

use binrw::io::{self, Read, Seek, SeekFrom};
use binrw::meta::ReadEndian;
use binrw::{BinRead, BinResult, Endian};
use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, IntoBytes};

use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::text::{CncString, Text};

/// Reads what a view of `stream` has accepted.
pub(crate) fn read<T>(stream: Stream, accepted: &[u8]) -> Result<T, Error>
where
    T: for<'a> BinRead<Args<'a> = ()> + ReadEndian,
{
    let mut source = Source { bytes: accepted, at: 0 };
    let value = T::read(&mut source);
    let used = source.at;
    // Both cannot happen on accepted bytes; if a declaration were wrong, this says so.
    let unread = || {
        let (given, used) = (to_u32(accepted.len()), u32::try_from(used).unwrap_or(u32::MAX));
        Error::new(ErrorKind::Mismatch, Field::whole(stream), used, used, given)
    };
    match value {
        Ok(value) if usize::try_from(used) == Ok(accepted.len()) => Ok(value),
        _ => Err(unread()),
    }
}

/// A zerocopy layout as one field of a binrw declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fixed<T>(pub(crate) T);

impl<T: FromBytes + IntoBytes> BinRead for Fixed<T> {
    type Args<'a> = ();

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

/// `count` numbers in one piece; the view has found them to be there.
#[binrw::parser(reader)]
pub(crate) fn numbers(count: u32) -> BinResult<Vec<u32>> {
    let mut numbers = Vec::new();
    if let Ok(count) = usize::try_from(count) {
        numbers.reserve_exact(count);
        for _ in 0..count {
            let mut number = U32::ZERO;
            reader.read_exact(number.as_mut_bytes())?;
            numbers.push(number.get());
        }
    }
    Ok(numbers)
}

/// Records to the end of the stream; the view has found the last one whole.
#[binrw::parser(reader, endian)]
pub(crate) fn records<T: FromBytes + IntoBytes>() -> BinResult<Vec<Fixed<T>>> {
    let count = left(reader)?.checked_div(size_of::<T>()).unwrap_or(0);
    let mut records = Vec::with_capacity(count);
    for _ in 0..count {
        records.push(Fixed::read_options(reader, endian, ())?);
    }
    Ok(records)
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

/// Text to the end of the stream; the view has found its end to be allowed.
#[binrw::parser(reader, endian)]
pub(crate) fn text() -> BinResult<Text> {
    let text = before_nul(reader)?;
    let ended = reader.read(&mut [0])? > 0;
    let tail = if ended { Some(rest(reader, endian, ())?) } else { None };
    Ok(Text { text, tail })
}

/// Text to the NUL that the view has found, and the NUL.
#[binrw::parser(reader)]
pub(crate) fn leading_text() -> BinResult<CncString> {
    let text = before_nul(reader)?;
    reader.read_exact(&mut [0])?;
    Ok(text)
}

/// Text to the next NUL or to the end; looked for first, so that the text is allocated once.
fn before_nul<R: Read + Seek>(reader: &mut R) -> BinResult<CncString> {
    let start = reader.stream_position()?;
    let (mut len, mut window) = (0_usize, [0; 32]);
    loop {
        let read = reader.read(&mut window)?;
        let part = window.get(..read).unwrap_or_default();
        let text = part.iter().take_while(|&&byte| byte != 0).count();
        len = len.saturating_add(text);
        if text < part.len() || part.is_empty() {
            break;
        }
    }
    reader.seek(SeekFrom::Start(start))?;
    let mut text = alloc::vec![0; len];
    reader.read_exact(&mut text)?;
    Ok(CncString::without_nul(text))
}

/// All bytes that are left.
#[binrw::parser(reader)]
pub(crate) fn rest() -> BinResult<Vec<u8>> {
    let mut bytes = alloc::vec![0; left(reader)?];
    reader.read_exact(&mut bytes)?;
    Ok(bytes)
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
    bytes: &'a [u8],
    at: u64,
}

impl Source<'_> {
    fn rest(&self) -> &[u8] {
        usize::try_from(self.at).ok().and_then(|at| self.bytes.get(at..)).unwrap_or_default()
    }
}

impl Read for Source<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let rest = self.rest();
        let len = rest.len().min(out.len());
        if let (Some(out), Some(rest)) = (out.get_mut(..len), rest.get(..len)) {
            out.copy_from_slice(rest);
        }
        self.at = self.at.saturating_add(u64::try_from(len).unwrap_or(0));
        Ok(len)
    }
}

impl Seek for Source<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let len = u64::try_from(self.bytes.len()).unwrap_or(u64::MAX);
        self.at = position(to, self.at, len)?;
        Ok(self.at)
    }
}

fn position(to: SeekFrom, at: u64, len: u64) -> io::Result<u64> {
    let position = match to {
        SeekFrom::Start(start) => Some(start),
        SeekFrom::Current(by) => at.checked_add_signed(by),
        SeekFrom::End(by) => len.checked_add_signed(by),
    };
    position.ok_or_else(|| io::ErrorKind::InvalidInput.into())
}
