//! Building a stream from the bytes of its fields: the inverse of a walk.

use core::iter::Peekable;

use super::{Field, FieldSpec, Segment, Size, Stream};
use crate::bytes::{Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};

impl Stream {
    /// Writes a stream to the front of `buf` from the bytes of its fields, and returns the bytes
    /// written. This is the inverse of [`walk`](Self::walk), for programs that know the stream only at
    /// run time.
    ///
    /// Pass the parts in the order of the table, record by record. Each item of a list is a part;
    /// data with a length is one part. You may omit a count, which is then computed from its items,
    /// and the NULs that pad a text of fixed length. Any other text must include its NUL, if it has
    /// a NUL.
    ///
    /// ```
    /// use ads_cnc::layout::{Field, Stream};
    ///
    /// let field = |name| Field::by_name(Stream::VariableHandleRead, name).unwrap();
    /// let parts = [(field("handle"), [0x41, 0x23, 1, 0x20]), (field("indices"), [4, 0, 0, 0])];
    /// let mut buf = [0; 64];
    /// let bytes = Stream::VariableHandleRead.join(parts, &mut buf)?;
    /// assert_eq!(bytes, [0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0]);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`walk`](Self::walk); [`Mismatch`](ErrorKind::Mismatch), with the lengths of field
    /// and part, at the first field whose bytes would differ from its part, for example because a part
    /// is missing or out of order; [`BufferTooSmall`](ErrorKind::BufferTooSmall). After an error, the
    /// contents of `buf` are unspecified.
    pub fn join<P, B>(self, parts: P, buf: &mut [u8]) -> Result<&[u8], Error>
    where
        P: IntoIterator<Item = (Field, B), IntoIter: Clone>,
        B: AsRef<[u8]>,
    {
        let parts = parts.into_iter();
        let mut out = Out { buf, at: 0 };
        let mut left = parts.clone().peekable();
        while out.record(self, &mut left) && self.layout().repeats {}
        let (given, needed) = (to_u32(out.buf.len()), to_u32(out.at));
        let whole = Field::whole(self);
        let bytes = out
            .buf
            .get(..out.at)
            .ok_or_else(|| Error::new(ErrorKind::BufferTooSmall, whole, 0, needed, given))?;
        // Decode the result, because the parts alone do not show which fields a decoder would find.
        let mut read = Read { stream: self, parts: parts.peekable(), fault: None };
        self.walk(bytes, |segment| read.compare(&segment))?;
        let unread =
            read.parts.next().map(|(field, part)| differs(field, needed, 0, part.as_ref()));
        read.fault.or(unread).map_or(Ok(bytes), Err)
    }

    /// Whether the field is the count of the next field.
    fn is_count(self, field: Field) -> bool {
        let next = |row: &FieldSpec| matches!(row.size, Size::Items { .. });
        self.fields().zip(self.layout().fields).any(|(at, row)| next(row) && at.before() == field)
    }
}

/// The output and its length, which also counts bytes that do not fit into the buffer.
struct Out<'b> {
    buf: &'b mut [u8],
    at: usize,
}

impl Out<'_> {
    fn put(&mut self, bytes: &[u8]) {
        if let Some(room) = self.buf.get_mut(self.at..) {
            // The writer drops bytes that do not fit.
            Writer::new(room).put(bytes);
        }
        self.at = self.at.saturating_add(bytes.len());
    }

    /// Writes the parts of a record; returns whether the record had any parts.
    fn record<B: AsRef<[u8]>>(
        &mut self,
        stream: Stream,
        parts: &mut Peekable<impl Iterator<Item = (Field, B)>>,
    ) -> bool {
        let (mut is_any, mut count_at) = (false, None);
        for (field, row) in stream.fields().zip(stream.layout().fields) {
            let (start, mut items) = (self.at, 0_u32);
            while let Some((_, part)) = parts.next_if(|(of, _)| *of == field) {
                self.put(part.as_ref());
                (is_any, items) = (true, items.saturating_add(1));
                if !matches!(row.size, Size::Items { .. }) {
                    break;
                }
            }
            match row.size {
                Size::Items { each, .. } => {
                    let bytes = to_u32(self.at.saturating_sub(start));
                    let count = if each == 1 { bytes } else { items };
                    self.count(count_at, count);
                }
                Size::Padded(size) if items > 0 => {
                    let end = start.saturating_add(to_usize(size));
                    while self.at < end {
                        self.put(&[0]);
                    }
                }
                // In a reply whose result is an error, both the length and the data may be absent.
                size if stream.is_count(field) => {
                    let is_there = matches!(size, Size::Fixed(_)) || parts.peek().is_some();
                    count_at = (items == 0 && is_there).then_some(start);
                    if count_at.is_some() {
                        self.put(&[0; 4]);
                    }
                }
                _ => {}
            }
        }
        is_any
    }

    fn count(&mut self, at: Option<usize>, count: u32) {
        let room = at.and_then(|at| self.buf.get_mut(at..)?.first_chunk_mut());
        if let Some(room) = room {
            *room = count.to_le_bytes();
        }
    }
}

/// Compares the parts with the fields found in the bytes.
struct Read<P: Iterator> {
    stream: Stream,
    parts: Peekable<P>,
    fault: Option<Error>,
}

impl<B: AsRef<[u8]>, P: Iterator<Item = (Field, B)>> Read<P> {
    fn compare(&mut self, found: &Segment<'_>) {
        let field = found.field;
        let part = self.parts.next_if(|(of, _)| *of == field).map(|(_, part)| part);
        let part = part.as_ref().map(B::as_ref);
        let is_same = match (part, field.spec().map(|row| row.size)) {
            (None, _) => found.bytes.is_empty() || self.stream.is_count(field),
            (Some(part), Some(Size::Padded(_))) => {
                let padding = found.bytes.strip_prefix(part);
                padding.is_some_and(|padding| padding.iter().all(|&byte| byte == 0))
            }
            (Some(part), _) => part == found.bytes,
        };
        if !is_same && self.fault.is_none() {
            let len = to_u32(found.bytes.len());
            self.fault = Some(differs(field, found.offset, len, part.unwrap_or_default()));
        }
    }
}

fn differs(field: Field, offset: u32, len: u32, part: &[u8]) -> Error {
    Error::new(ErrorKind::Mismatch, field, offset, len, to_u32(part.len()))
}
