//! Defects of one field: its bytes are changed before the codec decodes them, or after it has
//! encoded them.
//!
//! The defects are generated from the field tables of the codec, so every field has defects.
//!
//! ```
//! use ads_cnc_conformance::faults::FieldDefect;
//!
//! let defect = FieldDefect::by_id("variable-handle-read.handle.flip").unwrap();
//! assert_eq!(defect.apply(&[1, 0, 0, 2, 0, 0, 0, 0]), [0, 0, 0, 2, 0, 0, 0, 0]);
//! ```

use std::fmt;

use ads_cnc::layout::{Field, Segment, Size, Stream};

use crate::number::to_usize;
use crate::text::named;

/// A defect of one field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldDefect {
    /// Stream, field and change, such as `variable-description.size.flip`.
    pub id: String,
    pub stream: Stream,
    pub field: Field,
    /// The change to the bytes.
    pub change: FieldChange,
}

/// A change to the bytes of a field. The length stays the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FieldChange {
    /// The lowest bit of the first byte is inverted.
    FlipLow,
    /// Every bit is inverted.
    Invert,
    /// The bytes are in reverse order.
    SwapBytes,
    /// Every byte is 0.
    Zero,
}

named! { FieldChange: FlipLow "flip", Invert "invert", SwapBytes "swap", Zero "zero", }

impl FieldChange {
    fn apply(self, bytes: &mut [u8]) {
        match self {
            Self::FlipLow => bytes.iter_mut().take(1).for_each(|byte| *byte ^= 1),
            Self::Invert => bytes.iter_mut().for_each(|byte| *byte = !*byte),
            Self::SwapBytes => bytes.reverse(),
            Self::Zero => bytes.fill(0),
        }
    }
}

impl FieldDefect {
    /// The defects of every stream except `Stream::ObjectDescriptors`: a defect of
    /// `Stream::ObjectDescriptor` changes each record of that list.
    pub fn all() -> Vec<Self> {
        let streams = Stream::all().filter(|stream| *stream != Stream::ObjectDescriptors);
        streams.flat_map(Self::of_stream).collect()
    }

    /// The defects of one stream: every change to every field, except the reversal of a field with
    /// a fixed length of one byte.
    pub fn of_stream(stream: Stream) -> Vec<Self> {
        let each = |field: Field| {
            let one = field.spec().is_some_and(|spec| spec.size == Size::Fixed(1));
            let changes = FieldChange::ALL.into_iter();
            let changes = changes.filter(move |change| !(one && *change == FieldChange::SwapBytes));
            changes.map(move |change| Self::new(stream, field, change))
        };
        stream.fields().flat_map(each).collect()
    }

    fn new(stream: Stream, field: Field, change: FieldChange) -> Self {
        let id = format!("{}.{}.{}", stream.layout().name, field.name(), change.name());
        Self { id, stream, field, change }
    }

    pub fn by_id(id: &str) -> Option<Self> {
        Stream::all().flat_map(Self::of_stream).find(|defect| defect.id == id)
    }

    /// Whether the field belongs to this stream, or to the records that this stream contains.
    pub fn touches(&self, stream: Stream) -> bool {
        self.stream == stream || stream == self.sequence()
    }

    /// Returns the stream with the bytes of the field changed, in each record and item. Bytes that
    /// the walk over the stream does not reach are not changed.
    pub fn apply(&self, bytes: &[u8]) -> Vec<u8> {
        let mut places = Vec::new();
        // The walk ends at the first invalid field; the fields before that field are changed
        // nevertheless.
        let _reached = self.sequence().walk(bytes, |segment: Segment<'_>| {
            if segment.field.name() == self.field.name() {
                let start = to_usize(segment.offset);
                places.push((start, start.saturating_add(segment.bytes.len())));
            }
        });
        let mut changed = bytes.to_vec();
        for (start, end) in places {
            if let Some(field) = changed.get_mut(start..end) {
                self.change.apply(field);
            }
        }
        changed
    }

    /// The stream whose walk finds the field: `Stream::ObjectDescriptors` for a field of one
    /// descriptor, because a single descriptor is a list with one record; otherwise the stream of
    /// the defect.
    fn sequence(&self) -> Stream {
        match self.stream {
            Stream::ObjectDescriptor => Stream::ObjectDescriptors,
            stream => stream,
        }
    }
}

impl fmt::Display for FieldDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (part, change) = match self.change {
            FieldChange::FlipLow => ("the lowest bit of the first byte", "is inverted"),
            FieldChange::Invert => ("every bit", "is inverted"),
            FieldChange::SwapBytes => ("the order of the bytes", "is reversed"),
            FieldChange::Zero => ("every byte", "is 0"),
        };
        let (stream, field) = (self.stream.layout().name, self.field.name());
        write!(f, "{stream}: {part} of the field {field} {change}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The description printed in the manual, but with another handle, because the printed handle
    /// is the same in reverse byte order.
    const DESCRIPTION: &[u8] =
        b"\x02\0\0\x03\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

    fn defect(id: &str) -> FieldDefect {
        FieldDefect::by_id(id).unwrap()
    }

    #[test]
    fn every_defect_is_found_by_its_id() {
        let all = FieldDefect::all();
        assert!(all.len() > 100);
        for one in all {
            assert_eq!(FieldDefect::by_id(&one.id), Some(one));
        }
        assert_eq!(FieldDefect::by_id("variable-description.size.melt"), None);
    }

    #[test]
    fn only_the_field_changes() {
        for one in FieldDefect::of_stream(Stream::VariableDescription) {
            let changed = one.apply(DESCRIPTION);
            assert_eq!(changed.len(), DESCRIPTION.len());
            let mut at = Vec::new();
            one.stream
                .walk(DESCRIPTION, |segment| {
                    let start = segment.offset as usize;
                    let range = start..start + segment.bytes.len();
                    if changed[range] != *segment.bytes {
                        at.push(segment.field);
                    }
                })
                .unwrap();
            assert_eq!(at, [one.field], "{}", one.id);
        }
    }

    #[test]
    fn every_change_has_its_effect() {
        let size = |id: &str| defect(id).apply(DESCRIPTION)[12..16].to_vec();
        assert_eq!(size("variable-description.size.flip"), [3, 0, 0, 0]);
        assert_eq!(size("variable-description.size.invert"), [0xFD, 0xFF, 0xFF, 0xFF]);
        assert_eq!(size("variable-description.size.swap"), [0, 0, 0, 2]);
        assert_eq!(size("variable-description.size.zero"), [0, 0, 0, 0]);
    }

    #[test]
    fn every_item_and_every_record_changes() {
        let indices = defect("variable-handle-read.indices.flip");
        let request = [1, 0, 0, 2, 2, 0, 0, 0, 4, 0, 0, 0, 6, 0, 0, 0];
        assert_eq!(indices.apply(&request)[8..], [5, 0, 0, 0, 7, 0, 0, 0]);

        let id = defect("object-descriptor.id.flip");
        assert!(id.touches(Stream::ObjectDescriptors) && id.touches(Stream::ObjectDescriptor));
        assert!(!id.touches(Stream::ObjectCount));
        let two = id.apply(&[0; 168]);
        assert_eq!((two[0], two[84]), (1, 1));
        assert_eq!(two.iter().filter(|&&byte| byte != 0).count(), 2);
    }

    #[test]
    fn bytes_after_a_fault_stay() {
        let name = defect("variable-description.name.invert");
        assert_eq!(name.apply(&DESCRIPTION[..22]), &DESCRIPTION[..22]);
        assert_eq!(name.apply(&[]), [0; 0]);
    }
}
