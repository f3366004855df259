//! Reading from a slice.

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

use super::errors::{not_all, too_long, truncated};
use super::{to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream};
use crate::text::end::{not_cstring, not_optional_nul, split_nul, split_padded, text_len};
use crate::text::{CncStr, TextRef};

/// The remaining bytes of a stream, and their offset.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    stream: Stream,
    bytes: &'a [u8],
    at: u32,
}

impl<'a> Reader<'a> {
    /// Starts reading a stream; rejects more bytes than its maximum length.
    #[inline]
    pub(crate) fn new(stream: Stream, bytes: &'a [u8]) -> Result<Self, Error> {
        let max = stream.layout().max;
        if bytes.len() > to_usize(max) {
            return Err(too_long(Field::whole(stream), max, to_u32(bytes.len())));
        }
        Ok(Self::without_limit(stream, bytes))
    }

    /// Starts reading a stream without a check of its length: [`finish`](Self::finish) reports
    /// extra bytes as `Trailing`.
    pub(crate) fn without_limit(stream: Stream, bytes: &'a [u8]) -> Self {
        Self { stream, bytes, at: 0 }
    }

    /// Reads a stream that consists of the fixed fields `T`.
    #[inline]
    pub(crate) fn exact<T>(stream: Stream, bytes: &'a [u8]) -> Result<&'a T, Error>
    where
        T: FromBytes + KnownLayout + Immutable + Unaligned,
    {
        T::ref_from_bytes(bytes).map_err(|_| not_all(stream, size_of::<T>(), bytes.len()))
    }

    /// Reads a stream whose only field is a number of four bytes.
    #[inline]
    pub(crate) fn number(stream: Stream, field: Field, bytes: &'a [u8]) -> Result<u32, Error> {
        let mut input = Self::without_limit(stream, bytes);
        let number = input.u32(field)?;
        input.finish()?;
        Ok(number)
    }

    #[inline]
    pub(crate) fn at(&self) -> u32 {
        self.at
    }

    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    #[inline]
    pub(crate) fn as_bytes(&self) -> &'a [u8] {
        self.bytes
    }

    #[inline]
    fn left(&self) -> u32 {
        to_u32(self.bytes.len())
    }

    #[inline]
    fn error(&self, kind: ErrorKind, field: Field, expected: u32) -> Error {
        Error::new(kind, field, self.at, expected, self.left())
    }

    /// Reads the next `size` bytes. If fewer remain, the error names `field`.
    #[inline]
    pub(crate) fn take(&mut self, field: Field, size: u32) -> Result<&'a [u8], Error> {
        let Some((head, rest)) = self.bytes.split_at_checked(to_usize(size)) else {
            return Err(self.error(ErrorKind::Truncated, field, size));
        };
        self.bytes = rest;
        self.at = self.at.saturating_add(size);
        Ok(head)
    }

    #[inline]
    pub(crate) fn u32(&mut self, field: Field) -> Result<u32, Error> {
        let Some((le, rest)) = self.bytes.split_first_chunk() else {
            return Err(self.error(ErrorKind::Truncated, field, 4));
        };
        self.bytes = rest;
        self.at = self.at.saturating_add(4);
        Ok(u32::from_le_bytes(*le))
    }

    /// Reads the bytes of the fixed rows at the start of the stream. This must be the first read.
    #[inline]
    pub(crate) fn head<const N: usize>(&mut self) -> Result<&'a [u8; N], Error> {
        let Some((head, rest)) = self.bytes.split_first_chunk() else {
            return Err(truncated(self.stream, 0, self.bytes.len()));
        };
        self.bytes = rest;
        self.at = to_u32(N);
        Ok(head)
    }

    /// Reads `count` items of `each` bytes; the preceding field, `counter`, contains the count.
    pub(crate) fn items(
        &mut self,
        counter: Field,
        count: u32,
        each: u32,
        max: u32,
    ) -> Result<&'a [u8], Error> {
        let fits = self.left().checked_div(each).unwrap_or(0).min(max);
        if count > fits {
            let at = self.at.saturating_sub(4);
            return Err(Error::new(ErrorKind::TooMany, counter, at, fits, count));
        }
        // This cannot overflow, because the items fit into the remaining bytes.
        self.take(counter, count.saturating_mul(each))
    }

    /// Reads `count` numbers of four bytes; otherwise like [`items`](Self::items).
    pub(crate) fn numbers(
        &mut self,
        counter: Field,
        count: u32,
        max: u32,
    ) -> Result<&'a [U32], Error> {
        let bytes = self.items(counter, count, 4, max)?;
        // This cannot fail, because the length is a multiple of four.
        Ok(<[U32]>::ref_from_bytes(bytes).unwrap_or_default())
    }

    /// Reads the rest of the stream as NUL-terminated text, possibly padded with NULs. `max` is
    /// only for the error: [`new`](Self::new) checks the length of a stream, and with binrw, the
    /// whole value is checked after its rows are read.
    pub(crate) fn cstring(&mut self, field: Field, max: u32) -> Result<TextRef<'a>, Error> {
        let at = self.at;
        let bytes = self.take_all();
        let len = text_len(bytes);
        match split_padded(bytes, len) {
            Some(text) => Ok(text),
            None => Err(not_cstring(field, at, max, bytes, len)),
        }
    }

    /// Reads a text and its NUL, which must be within the next `max` bytes. Returns the text
    /// without the NUL.
    pub(crate) fn cstring_prefix(&mut self, field: Field, max: u32) -> Result<CncStr<'a>, Error> {
        let window = self.bytes.get(..to_usize(max)).unwrap_or(self.bytes);
        let Some((text, _)) = split_nul(window) else {
            return Err(Error::new(
                ErrorKind::MissingNul,
                field,
                self.at,
                max,
                to_u32(window.len()),
            ));
        };
        // Splitting twice gives smaller code than splitting all bytes once.
        self.take(field, to_u32(text.len()).saturating_add(1))?;
        Ok(CncStr::without_nul(text))
    }

    /// Reads all remaining bytes.
    #[inline]
    pub(crate) fn take_all(&mut self) -> &'a [u8] {
        self.at = self.at.saturating_add(self.left());
        core::mem::take(&mut self.bytes)
    }

    /// Reads all remaining bytes, which must be `min` to `max` bytes.
    pub(crate) fn rest(&mut self, field: Field, min: u32, max: u32) -> Result<&'a [u8], Error> {
        if self.bytes.len() < to_usize(min) {
            return Err(self.error(ErrorKind::Truncated, field, min));
        }
        if self.bytes.len() > to_usize(max) {
            return Err(self.error(ErrorKind::TooLong, field, max));
        }
        Ok(self.take_all())
    }

    /// Like [`rest`](Self::rest), but splits the bytes at the first NUL into a text and its tail.
    #[inline]
    pub(crate) fn text_and_tail(
        &mut self,
        field: Field,
        min: u32,
        max: u32,
    ) -> Result<TextRef<'a>, Error> {
        self.rest(field, min, max).map(TextRef::split)
    }

    /// Reads all remaining bytes, at least one, as text with any number of NULs at its end.
    pub(crate) fn optional_nul(&mut self, field: Field) -> Result<TextRef<'a>, Error> {
        let at = self.at;
        let bytes = self.take_all();
        let len = text_len(bytes);
        match split_padded(bytes, len) {
            Some(text) => Ok(text),
            None if len == bytes.len() && len > 0 => {
                Ok(TextRef::with_tail(CncStr::without_nul(bytes), None))
            }
            None => Err(not_optional_nul(field, at, bytes, len)),
        }
    }

    /// Reads four bytes, which must not all be 0.
    #[inline]
    pub(crate) fn non_zero(&mut self, field: Field) -> Result<&'a [u8], Error> {
        let at = self.at;
        let bytes = self.take(field, 4)?;
        match bytes {
            [0, 0, 0, 0] => Err(Error::new(ErrorKind::OutOfRange, field, at, 1, 0)),
            _ => Ok(bytes),
        }
    }

    /// Reads a number of one, two or four bytes: all remaining bytes if one or two remain,
    /// otherwise four.
    #[inline]
    pub(crate) fn uns8_to_32(&mut self, field: Field) -> Result<&'a [u8], Error> {
        match self.left() {
            width @ (1 | 2) => self.take(field, width),
            _ => self.take(field, 4),
        }
    }

    /// Checks that no bytes remain.
    pub(crate) fn finish(self) -> Result<(), Error> {
        match self.bytes {
            [] => Ok(()),
            _ => {
                let given = self.at.saturating_add(self.left());
                let whole = Field::whole(self.stream);
                Err(Error::new(ErrorKind::Trailing, whole, self.at, self.at, given))
            }
        }
    }
}
