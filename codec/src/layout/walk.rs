//! One pass over a stream, driven by its table.

use super::{Field, Size, Stream};
use crate::bytes::Reader;
use crate::error::Error;

/// The bytes of a field, or of one item of a list.
///
/// ```
/// use ads_cnc::layout::Stream;
///
/// // The handle of V.G.array, and the index of its fifth element.
/// let bytes = [0x41, 0x23, 1, 0x20, 1, 0, 0, 0, 4, 0, 0, 0];
/// let mut last = None;
/// Stream::VariableHandleRead.walk(&bytes, |segment| last = Some(segment))?;
/// let last = last.unwrap();
/// assert_eq!((last.item, last.offset, last.bytes), (0, 8, &[4, 0, 0, 0][..]));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Segment<'a> {
    /// The field.
    pub field: Field,
    /// The index of the record in a stream of records; otherwise 0.
    pub record: u32,
    /// The index of the item in a list; otherwise 0.
    pub item: u32,
    /// The offset of the bytes in the stream.
    pub offset: u32,
    /// The bytes, including the NULs of a text; empty for a field without bytes.
    pub bytes: &'a [u8],
}

impl Stream {
    /// Calls `visit` for each field in order, up to the end or the first fault; for a list, calls
    /// it for each item instead. The fields that an ADS error or an empty extended description
    /// omits are not visited. No field is visited if the error is
    /// [`TooLong`](crate::ErrorKind::TooLong) for the stream as a whole.
    ///
    /// # Errors
    /// Those of the stream's decoders; for an extended description, those of
    /// [`ExtendedReply`](crate::ExtendedReply).
    pub fn walk<'a>(self, bytes: &'a [u8], visit: impl FnMut(Segment<'a>)) -> Result<(), Error> {
        let input = if self.layout().ends_itself() {
            Reader::without_limit(self, bytes)
        } else {
            Reader::new(self, bytes)?
        };
        let mut walk = Walk { input, record: 0, visit };
        loop {
            walk.record(self)?;
            if walk.input.is_empty() || !self.layout().repeats {
                return walk.input.finish();
            }
            walk.record = walk.record.saturating_add(1);
        }
    }
}

struct Walk<'a, V> {
    input: Reader<'a>,
    record: u32,
    visit: V,
}

impl<'a, V: FnMut(Segment<'a>)> Walk<'a, V> {
    fn visit(&mut self, field: Field, item: u32, offset: u32, bytes: &'a [u8]) {
        (self.visit)(Segment { field, record: self.record, item, offset, bytes });
    }

    #[inline]
    fn take(&mut self, field: Field, item: u32, size: u32) -> Result<&'a [u8], Error> {
        let at = self.input.at();
        let bytes = self.input.take(field, size)?;
        self.visit(field, item, at, bytes);
        Ok(bytes)
    }

    fn record(&mut self, stream: Stream) -> Result<(), Error> {
        // The previous field and its value, which is a count if the next field is a list.
        let mut counter = Field::whole(stream);
        let mut count = 0_u32;
        for (field, spec) in stream.fields().zip(stream.layout().fields) {
            match spec.size {
                Size::FixedOnSuccess(_) if count != 0 && self.input.is_empty() => break,
                Size::OptionalFixed(_) if self.input.at() == 0 && self.input.is_empty() => break,
                Size::Fixed(size)
                | Size::FixedOnSuccess(size)
                | Size::OptionalFixed(size)
                | Size::Padded(size) => {
                    let number = self.take(field, 0, size)?;
                    count = number.first_chunk().map_or(0, |le| u32::from_le_bytes(*le));
                }
                Size::Items { each: 1, .. } => {
                    self.take(field, 0, count)?;
                }
                Size::Items { each, max } => {
                    let mut at = self.input.at();
                    let items = self.input.items(counter, count, each, max)?;
                    let size = crate::bytes::to_usize(each).max(1);
                    for (item, bytes) in (0..).zip(items.chunks_exact(size)) {
                        self.visit(field, item, at, bytes);
                        at = at.saturating_add(each);
                    }
                }
                Size::CString { is_optional: true, .. } if self.input.is_empty() => {
                    self.take(field, 0, 0)?;
                }
                Size::CString { max, .. } => {
                    let at = self.input.at();
                    let bytes = self.input.as_bytes();
                    self.input.cstring(field, max)?;
                    self.visit(field, 0, at, bytes);
                }
                Size::CStringPrefix { max } => {
                    let at = self.input.at();
                    let bytes = self.input.as_bytes();
                    let used = self.input.cstring_prefix(field, max)?.len().saturating_add(1);
                    let bytes = bytes.get(..used).unwrap_or(bytes);
                    self.visit(field, 0, at, bytes);
                }
                Size::OptionalNul { .. } => {
                    let at = self.input.at();
                    let bytes = self.input.as_bytes();
                    self.input.optional_nul(field)?;
                    self.visit(field, 0, at, bytes);
                }
                Size::NonZero => {
                    let at = self.input.at();
                    let bytes = self.input.non_zero(field)?;
                    self.visit(field, 0, at, bytes);
                }
                Size::Uns8To32 => {
                    let at = self.input.at();
                    let bytes = self.input.uns8_to_32(field)?;
                    self.visit(field, 0, at, bytes);
                }
                Size::TextAndTail { min, max } | Size::Rest { min, max } => {
                    self.rest(field, min, max)?
                }
            }
            counter = field;
        }
        Ok(())
    }

    fn rest(&mut self, field: Field, min: u32, max: u32) -> Result<(), Error> {
        let at = self.input.at();
        let bytes = self.input.rest(field, min, max)?;
        self.visit(field, 0, at, bytes);
        Ok(())
    }
}
