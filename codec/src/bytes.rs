//! Reading from a slice and writing into one, by the rules of the field tables.

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

use crate::error::{Error, ErrorKind};
use crate::layout::{Cut, Field, Stream};
use crate::nul::{not_maybe_terminated, not_terminated, split_nul, split_padded, text_len};
use crate::text::{CncStr, TextRef};

/// A length as errors carry it.
pub(crate) fn to_u32(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

pub(crate) fn to_len(size: u32) -> usize {
    usize::try_from(size).unwrap_or(usize::MAX)
}

/// What is left of a stream, and where that begins.
pub(crate) struct Reader<'a> {
    stream: Stream,
    bytes: &'a [u8],
    at: u32,
}

impl<'a> Reader<'a> {
    /// Begins to read `bytes`, which must not be longer than the stream may be.
    #[inline]
    pub(crate) fn new(stream: Stream, bytes: &'a [u8]) -> Result<Self, Error> {
        let max = stream.layout().max;
        if bytes.len() > to_len(max) {
            return Err(too_long(Field::whole(stream), max, to_u32(bytes.len())));
        }
        Ok(Self::ending(stream, bytes))
    }

    /// Begins to read a stream whose fields tell its end, which says more than a limit.
    pub(crate) fn ending(stream: Stream, bytes: &'a [u8]) -> Self {
        Self { stream, bytes, at: 0 }
    }

    /// The fixed fields `T` that are all of `stream`, whose end they tell.
    #[inline]
    pub(crate) fn all<T>(stream: Stream, bytes: &'a [u8]) -> Result<&'a T, Error>
    where
        T: FromBytes + KnownLayout + Immutable + Unaligned,
    {
        T::ref_from_bytes(bytes).map_err(|_| not_all(stream, bytes.len()))
    }

    /// The bytes that are all of the stream of `field`, between `min` and `max` of them.
    #[inline]
    pub(crate) fn only(
        field: Field,
        min: u32,
        max: u32,
        bytes: &'a [u8],
    ) -> Result<&'a [u8], Error> {
        if bytes.len() < to_len(min) || bytes.len() > to_len(max) {
            return Err(not_between(field, min, max, bytes.len()));
        }
        Ok(bytes)
    }

    /// The number that is all of the stream of `field`.
    #[inline]
    pub(crate) fn number(field: Field, bytes: &'a [u8]) -> Result<u32, Error> {
        let mut input = Self::ending(field.stream(), bytes);
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

    /// The next `size` bytes, all of which belong to `field`.
    #[inline]
    pub(crate) fn take(&mut self, field: Field, size: u32) -> Result<&'a [u8], Error> {
        let Some((head, rest)) = self.bytes.split_at_checked(to_len(size)) else {
            return Err(self.error(ErrorKind::Truncated, field, size));
        };
        self.bytes = rest;
        self.at = self.at.saturating_add(size);
        Ok(head)
    }

    /// The fixed fields `T` at the start of a record.
    pub(crate) fn fixed<T>(&mut self) -> Result<&'a T, Error>
    where
        T: FromBytes + KnownLayout + Immutable + Unaligned,
    {
        match T::ref_from_prefix(self.bytes) {
            Ok((fixed, rest)) => {
                self.bytes = rest;
                self.at = self.at.saturating_add(to_u32(size_of::<T>()));
                Ok(fixed)
            }
            Err(_) => Err(cut(self.stream, self.at, self.bytes.len())),
        }
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

    /// `count` items of `each` bytes; the count stands in the field `counter`, right before.
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
        // Cannot be too much: it fits.
        self.take(counter, count.saturating_mul(each))
    }

    /// `count` numbers, as [`items`](Self::items).
    pub(crate) fn numbers(
        &mut self,
        counter: Field,
        count: u32,
        max: u32,
    ) -> Result<&'a [U32], Error> {
        let bytes = self.items(counter, count, 4, max)?;
        // A multiple of four by now, so that nothing gets lost.
        Ok(<[U32]>::ref_from_bytes(bytes).unwrap_or_default())
    }

    /// All that is left: text, the NUL that must end it, NULs that may pad it.
    pub(crate) fn terminated(&mut self, field: Field, max: u32) -> Result<TextRef<'a>, Error> {
        let (len, at) = (text_len(self.window(max)), self.at);
        let bytes = self.take_all();
        match split_padded(bytes, max, len) {
            Some(text) => Ok(text),
            None => Err(not_terminated(field, at, max, bytes, len)),
        }
    }

    /// Text up to and including the NUL that must end it.
    pub(crate) fn leading(&mut self, field: Field, max: u32) -> Result<CncStr<'a>, Error> {
        let Some((text, _)) = split_nul(self.window(max)) else {
            return Err(self.error(ErrorKind::MissingNul, field, max));
        };
        self.take(field, to_u32(text.len()).saturating_add(1))?;
        Ok(CncStr::without_nul(text))
    }

    /// At most `max` bytes of what is left.
    #[inline]
    fn window(&self, max: u32) -> &'a [u8] {
        self.bytes.get(..to_len(max)).unwrap_or(self.bytes)
    }

    /// All that is left.
    #[inline]
    fn take_all(&mut self) -> &'a [u8] {
        self.at = self.at.saturating_add(self.left());
        core::mem::take(&mut self.bytes)
    }

    /// All that is left, between `min` and `max` bytes.
    pub(crate) fn rest(&mut self, field: Field, min: u32, max: u32) -> Result<&'a [u8], Error> {
        if self.bytes.len() < to_len(min) {
            return Err(self.error(ErrorKind::Truncated, field, min));
        }
        if self.bytes.len() > to_len(max) {
            return Err(self.error(ErrorKind::TooLong, field, max));
        }
        Ok(self.take_all())
    }

    /// As [`rest`](Self::rest): text, and its NUL and what follows if there is one.
    #[inline]
    pub(crate) fn open(&mut self, field: Field, min: u32, max: u32) -> Result<TextRef<'a>, Error> {
        self.rest(field, min, max).map(TextRef::split)
    }

    /// All that is left, one byte at least: text, and NULs at its end if any.
    pub(crate) fn may_terminate(&mut self, field: Field, max: u32) -> Result<TextRef<'a>, Error> {
        let (len, at) = (text_len(self.window(max)), self.at);
        let bytes = self.take_all();
        match split_padded(bytes, max, len) {
            Some(text) => Ok(text),
            None if len == bytes.len() && len > 0 => {
                Ok(TextRef::with_tail(CncStr::without_nul(bytes), None))
            }
            None => Err(not_maybe_terminated(field, at, max, bytes, len)),
        }
    }

    /// Four bytes that are not all 0.
    #[inline]
    pub(crate) fn number_from_one(&mut self, field: Field) -> Result<&'a [u8], Error> {
        let at = self.at;
        let bytes = self.take(field, 4)?;
        match bytes {
            [0, 0, 0, 0] => Err(Error::new(ErrorKind::OutOfRange, field, at, 1, 0)),
            _ => Ok(bytes),
        }
    }

    /// All that is left: one, two or four bytes.
    #[inline]
    pub(crate) fn one_two_or_four(&mut self, field: Field) -> Result<&'a [u8], Error> {
        match self.left() {
            width @ (1 | 2) => self.take(field, width),
            _ => self.take(field, 4),
        }
    }

    /// Nothing may be left.
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

/// The field in which the fixed part of a record at `at` is cut.
// Not a method: a reader whose address is known to nobody stays in registers.
#[cold]
pub(crate) fn cut(stream: Stream, at: u32, left: usize) -> Error {
    match stream.cuts().get(left) {
        Some(cut) => cut_at(stream, *cut, at, left),
        None => Error::new(ErrorKind::Truncated, Field::whole(stream), at, 0, to_u32(left)),
    }
}

#[inline]
fn cut_at(stream: Stream, cut: Cut, at: u32, left: usize) -> Error {
    let (offset, size) = (u32::from(cut.offset), u32::from(cut.size));
    let found = to_u32(left).wrapping_sub(offset);
    Error::new(
        ErrorKind::Truncated,
        Field::new(stream, cut.field),
        at.wrapping_add(offset),
        size,
        found,
    )
}

/// Why so many bytes are not the fixed ones that are all of a stream.
#[cold]
fn not_all(stream: Stream, given: usize) -> Error {
    let cuts = stream.cuts();
    match cuts.get(given) {
        Some(cut) => cut_at(stream, *cut, 0, given),
        None => {
            let size = to_u32(cuts.len());
            Error::new(ErrorKind::Trailing, Field::whole(stream), size, size, to_u32(given))
        }
    }
}

/// Why so many bytes are too few or too many.
#[cold]
fn not_between(field: Field, min: u32, max: u32, given: usize) -> Error {
    let given = to_u32(given);
    if given < min {
        return Error::new(ErrorKind::Truncated, field, 0, min, given);
    }
    too_long(Field::whole(field.stream()), max, given)
}

#[cold]
fn too_long(field: Field, max: u32, given: u32) -> Error {
    Error::new(ErrorKind::TooLong, field, max, max, given)
}

/// Writes into a buffer that was found large enough before the first byte.
pub(crate) struct Writer<'b> {
    rest: &'b mut [u8],
}

impl<'b> Writer<'b> {
    /// Takes exactly `len` bytes of `buf`, or nothing at all.
    #[inline]
    pub(crate) fn run(
        stream: Stream,
        len: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let room = Self::room(stream, len, buf)?;
        write(&mut Writer::new(room));
        Ok(room)
    }

    /// Exactly `len` bytes of `buf`, which a stream may have.
    #[inline]
    pub(crate) fn room(
        stream: Stream,
        len: usize,
        buf: &'b mut [u8],
    ) -> Result<&'b mut [u8], Error> {
        let max = stream.layout().max;
        if len > to_len(max) {
            return Err(too_long(Field::whole(stream), max, to_u32(len)));
        }
        Self::part(stream, len, buf)
    }

    #[inline]
    fn part(stream: Stream, len: usize, buf: &'b mut [u8]) -> Result<&'b mut [u8], Error> {
        let given = buf.len();
        buf.get_mut(..len).ok_or_else(|| {
            let (whole, given) = (Field::whole(stream), to_u32(given));
            Error::new(ErrorKind::BufferTooSmall, whole, 0, to_u32(len), given)
        })
    }

    /// Writes into this.
    #[inline]
    pub(crate) fn new(rest: &'b mut [u8]) -> Self {
        Self { rest }
    }

    /// As [`run`](Self::run), for `behind` bytes behind a front.
    #[inline]
    pub(crate) fn run_behind(
        stream: Stream,
        front: usize,
        behind: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let room = Self::room_behind(stream, front, behind, buf)?;
        write(&mut Writer::new(room));
        Ok(room)
    }

    /// As [`room`](Self::room), for `behind` bytes behind a front. No sum can overflow then, which
    /// the compiler sees, so that writing needs no further checks.
    #[inline]
    pub(crate) fn room_behind(
        stream: Stream,
        front: usize,
        behind: usize,
        buf: &'b mut [u8],
    ) -> Result<&'b mut [u8], Error> {
        let max = stream.layout().max;
        if to_len(max).checked_sub(front).is_none_or(|most| behind > most) {
            let len = to_u32(front.saturating_add(behind));
            return Err(too_long(Field::whole(stream), max, len));
        }
        // Never wraps: the sum is at most `max`.
        Self::part(stream, front.wrapping_add(behind), buf)
    }

    /// Writes these bytes, which are all of the stream.
    #[inline]
    pub(crate) fn copy(stream: Stream, bytes: &[u8], buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Self::run(stream, bytes.len(), buf, |out| out.put(bytes))
    }

    /// As [`run`](Self::run), for more than the stream that errors are told of.
    #[inline]
    pub(crate) fn fill(
        stream: Stream,
        len: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let room = Self::part(stream, len, buf)?;
        write(&mut Writer::new(room));
        Ok(room)
    }

    /// The next `len` bytes to write; none if there were fewer, which cannot be.
    #[inline]
    pub(crate) fn next(&mut self, len: usize) -> &'b mut [u8] {
        match core::mem::take(&mut self.rest).split_at_mut_checked(len) {
            Some((head, rest)) => {
                self.rest = rest;
                head
            }
            None => &mut [],
        }
    }

    pub(crate) fn put(&mut self, bytes: &[u8]) {
        let rest = core::mem::take(&mut self.rest);
        if let Some((head, tail)) = rest.split_at_mut_checked(bytes.len()) {
            head.copy_from_slice(bytes);
            self.rest = tail;
        }
    }

    #[inline]
    pub(crate) fn u32(&mut self, number: u32) {
        self.put(&number.to_le_bytes());
    }

    /// A NUL and what follows it, which mostly is nothing.
    #[inline]
    pub(crate) fn nul_and(&mut self, tail: &[u8]) {
        self.put(&[0]);
        if !tail.is_empty() {
            self.put(tail);
        }
    }
}
