//! Writing to a slice.

use super::errors::too_long;
use super::{to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream, Subject};
use crate::stream::Encode;

/// Writes to a buffer. Bytes that do not fit are dropped, so the length of the buffer must be
/// checked: [`run`](Self::run) and [`fill`](Self::fill) do so before they write.
pub(crate) struct Writer<'b> {
    rest: &'b mut [u8],
}

impl<'b> Writer<'b> {
    /// Lets `write` write the first `len` bytes of `buf`, and returns them; `write` must write all
    /// of them. On error, nothing is written.
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

    /// The first `len` bytes of `buf`; rejects a length that exceeds the stream's maximum.
    #[inline]
    fn room(stream: Stream, len: usize, buf: &'b mut [u8]) -> Result<&'b mut [u8], Error> {
        let max = stream.layout().max;
        if len > to_usize(max) {
            return Err(too_long(Field::whole(stream), max, to_u32(len)));
        }
        Self::part(Subject::Stream(stream), len, buf)
    }

    #[inline]
    fn part(subject: Subject, len: usize, buf: &'b mut [u8]) -> Result<&'b mut [u8], Error> {
        let given = buf.len();
        buf.get_mut(..len).ok_or_else(|| {
            let (whole, given) = (Field::whole_subject(subject), to_u32(given));
            Error::new(ErrorKind::BufferTooSmall, whole, 0, to_u32(len), given)
        })
    }

    /// A writer to this buffer.
    #[inline]
    pub(crate) fn new(rest: &'b mut [u8]) -> Self {
        Self { rest }
    }

    /// Writes a stream that consists of these bytes.
    #[inline]
    pub(crate) fn copy(stream: Stream, bytes: &[u8], buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        Self::run(stream, bytes.len(), buf, |out| out.put(bytes))
    }

    /// Like [`run`](Self::run), but without a maximum length. Errors name `subject`.
    #[inline]
    pub(crate) fn fill(
        subject: Subject,
        len: usize,
        buf: &'b mut [u8],
        write: impl FnOnce(&mut Writer<'_>),
    ) -> Result<&'b [u8], Error> {
        let room = Self::part(subject, len, buf)?;
        write(&mut Writer::new(room));
        Ok(room)
    }

    /// The next `len` bytes to write; empty if fewer remain.
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

    /// Writes a part that is itself a stream. The part must be valid, and the buffer must have room
    /// for it.
    #[inline]
    pub(crate) fn stream(&mut self, part: &impl Encode) {
        // This cannot fail, because the part is valid and the buffer has the length of the part.
        let _written = part.encode(self.next(part.encoded_len()));
    }

    #[inline]
    pub(crate) fn array<const N: usize>(&mut self, bytes: [u8; N]) {
        if let Some((head, tail)) = core::mem::take(&mut self.rest).split_first_chunk_mut() {
            *head = bytes;
            self.rest = tail;
        }
    }

    #[inline]
    pub(crate) fn u32(&mut self, number: u32) {
        self.array(number.to_le_bytes());
    }

    /// Writes a NUL and then `tail`, which is usually empty.
    #[inline]
    pub(crate) fn nul_and(&mut self, tail: &[u8]) {
        self.put(&[0]);
        if !tail.is_empty() {
            self.put(tail);
        }
    }
}
