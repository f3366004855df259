//! Reading from a slice and writing into one, by the rules of the field tables.

use zerocopy::little_endian::U32;
use zerocopy::{FromBytes, Immutable, KnownLayout, Unaligned};

use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Size, Stream};

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
    pub(crate) fn new(stream: Stream, bytes: &'a [u8]) -> Result<Self, Error> {
        let max = stream.layout().max;
        let given = to_u32(bytes.len());
        // The end of a stream of fixed length says more than its limit.
        if given > max && !stream.layout().ends_itself() {
            return Err(too_long(Field::whole(stream), max, given));
        }
        Ok(Self { stream, bytes, at: 0 })
    }

    /// The fixed fields `T` that are all of `stream`, whose end they tell.
    pub(crate) fn all<T>(stream: Stream, bytes: &'a [u8]) -> Result<&'a T, Error>
    where
        T: FromBytes + KnownLayout + Immutable + Unaligned,
    {
        let mut input = Self { stream, bytes, at: 0 };
        let fixed = input.fixed()?;
        input.finish()?;
        Ok(fixed)
    }

    /// The number that is all of the stream of `field`.
    #[inline]
    pub(crate) fn number(field: Field, bytes: &'a [u8]) -> Result<u32, Error> {
        let mut input = Self { stream: field.stream(), bytes, at: 0 };
        let number = input.u32(field)?;
        input.finish()?;
        Ok(number)
    }

    /// The bytes that are all of the stream of `field`, between `min` and `max` of them.
    #[inline]
    pub(crate) fn bytes(
        field: Field,
        min: u32,
        max: u32,
        bytes: &'a [u8],
    ) -> Result<&'a [u8], Error> {
        Self::new(field.stream(), bytes)?.rest(field, min, max)
    }

    pub(crate) fn at(&self) -> u32 {
        self.at
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    fn left(&self) -> u32 {
        to_u32(self.bytes.len())
    }

    #[cold]
    fn error(&self, kind: ErrorKind, field: Field, expected: u32) -> Error {
        Error::new(kind, field, self.at, expected, self.left())
    }

    /// The next `size` bytes, all of which belong to `field`.
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
            Err(_) => Err(self.cut()),
        }
    }

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
    pub(crate) fn terminated(&mut self, field: Field, max: u32) -> Result<&'a [u8], Error> {
        let left = self.left();
        let window = self.bytes.get(..to_len(max)).unwrap_or(self.bytes);
        let Some((text, tail)) = split_nul(window) else {
            return Err(self.error(ErrorKind::MissingNul, field, max));
        };
        let padding = tail.iter().take_while(|&&byte| byte == 0).count();
        let used = to_u32(text.len().saturating_add(padding).saturating_add(1));
        if used != left {
            let end = self.at.saturating_add(used);
            let given = self.at.saturating_add(left);
            let whole = Field::whole(self.stream);
            return Err(Error::new(ErrorKind::Trailing, whole, end, end, given));
        }
        self.take(field, left)
    }

    /// Text up to and including the NUL that must end it.
    pub(crate) fn leading(&mut self, field: Field, max: u32) -> Result<&'a [u8], Error> {
        let window = self.bytes.get(..to_len(max)).unwrap_or(self.bytes);
        match split_nul(window) {
            Some((text, _)) => self.take(field, to_u32(text.len()).saturating_add(1)),
            None => Err(self.error(ErrorKind::MissingNul, field, max)),
        }
    }

    /// All that is left, between `min` and `max` bytes.
    pub(crate) fn rest(&mut self, field: Field, min: u32, max: u32) -> Result<&'a [u8], Error> {
        let left = self.left();
        if left < min {
            return Err(self.error(ErrorKind::Truncated, field, min));
        }
        if left > max {
            return Err(self.error(ErrorKind::TooLong, field, max));
        }
        self.take(field, left)
    }

    /// All that is left, one byte at least: text, and NULs at its end if any.
    pub(crate) fn may_terminate(&mut self, field: Field, max: u32) -> Result<&'a [u8], Error> {
        if split_nul(self.bytes).is_some() {
            return self.terminated(field, max);
        }
        self.rest(field, 1, max)
    }

    /// Four bytes that are not all 0.
    pub(crate) fn number_from_one(&mut self, field: Field) -> Result<&'a [u8], Error> {
        let at = self.at;
        let bytes = self.take(field, 4)?;
        match bytes {
            [0, 0, 0, 0] => Err(Error::new(ErrorKind::OutOfRange, field, at, 1, 0)),
            _ => Ok(bytes),
        }
    }

    /// All that is left: one, two or four bytes.
    pub(crate) fn one_two_or_four(&mut self, field: Field) -> Result<&'a [u8], Error> {
        match self.left() {
            width @ (1 | 2) => self.take(field, width),
            _ => self.take(field, 4),
        }
    }

    /// Nothing may be left.
    pub(crate) fn finish(self) -> Result<(), Error> {
        if self.bytes.is_empty() {
            return Ok(());
        }
        let given = self.at.saturating_add(self.left());
        let whole = Field::whole(self.stream);
        Err(Error::new(ErrorKind::Trailing, whole, self.at, self.at, given))
    }

    /// The field in which the fixed part of a record is cut.
    #[cold]
    fn cut(&self) -> Error {
        let mut before = 0_u32;
        for field in self.stream.fields() {
            let size = match field.spec().map(|spec| spec.size) {
                Some(
                    Size::Fixed(size)
                    | Size::FixedUnlessError(size)
                    | Size::FixedOrNothing(size)
                    | Size::Padded(size),
                ) => size,
                _ => break,
            };
            let left = self.left().saturating_sub(before);
            if left < size {
                let at = self.at.saturating_add(before);
                return Error::new(ErrorKind::Truncated, field, at, size, left);
            }
            before = before.saturating_add(size);
        }
        self.error(ErrorKind::Truncated, Field::whole(self.stream), before)
    }
}

/// The text before the first NUL and the bytes behind it.
pub(crate) fn split_nul(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let nul = bytes.iter().position(|&byte| byte == 0)?;
    let (text, rest) = bytes.split_at_checked(nul)?;
    Some((text, rest.get(1..)?))
}

fn too_long(field: Field, max: u32, given: u32) -> Error {
    Error::new(ErrorKind::TooLong, field, max, max, given)
}

/// Writes into a buffer that was found large enough before the first byte.
pub(crate) struct Writer<'b> {
    rest: &'b mut [u8],
}

impl<'b> Writer<'b> {
    /// Takes exactly `len` bytes of `buf`, or nothing at all.
    pub(crate) fn run(
        stream: Stream,
        len: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let layout = stream.layout();
        if to_u32(len) > layout.max {
            return Err(too_long(Field::whole(stream), layout.max, to_u32(len)));
        }
        Self::fill(stream, len, buf, write)
    }

    /// Writes these bytes, which are all of the stream.
    #[inline]
    pub(crate) fn copy(stream: Stream, bytes: &[u8], buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Self::run(stream, bytes.len(), buf, |out| out.put(bytes))
    }

    /// As [`run`](Self::run), for more than the stream that errors are told of.
    pub(crate) fn fill(
        stream: Stream,
        len: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let given = to_u32(buf.len());
        let Some(out) = buf.get_mut(..len) else {
            let whole = Field::whole(stream);
            return Err(Error::new(ErrorKind::BufferTooSmall, whole, 0, to_u32(len), given));
        };
        write(&mut Writer { rest: &mut *out });
        Ok(out)
    }

    pub(crate) fn put(&mut self, bytes: &[u8]) {
        let rest = core::mem::take(&mut self.rest);
        if let Some((head, tail)) = rest.split_at_mut_checked(bytes.len()) {
            head.copy_from_slice(bytes);
            self.rest = tail;
        }
    }

    pub(crate) fn u32(&mut self, number: u32) {
        self.put(&number.to_le_bytes());
    }
}
