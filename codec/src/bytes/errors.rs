//! Errors of fixed fields and of lengths.

use super::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::{Field, Stream, Subject};

/// The error for a record at offset `at` that ends after `left` bytes, within its fixed fields.
#[cold]
#[inline(never)]
pub(crate) fn truncated(stream: Stream, at: u32, left: usize) -> Error {
    let (mut offset, left) = (0_u32, to_u32(left));
    for (field, &size) in (0_u8..).zip(stream.head_sizes()) {
        let (size, found) = (u32::from(size), left.saturating_sub(offset));
        if found < size {
            let (field, at) =
                (Field::new(Subject::Stream(stream), field), at.saturating_add(offset));
            return Error::new(ErrorKind::Truncated, field, at, size, found);
        }
        offset = offset.saturating_add(size);
    }
    Error::new(ErrorKind::Truncated, Field::whole(stream), at, 0, left)
}

/// The error for a stream of fixed length with too many or too few bytes.
// Not inlined: otherwise each decoder of a fixed stream would save registers for this rare case.
#[cold]
#[inline(never)]
pub(super) fn not_all(stream: Stream, size: usize, found: usize) -> Error {
    if found < size {
        return truncated(stream, 0, found);
    }
    let size = to_u32(size);
    Error::new(ErrorKind::Trailing, Field::whole(stream), size, size, to_u32(found))
}

#[cold]
pub(super) fn too_long(field: Field, max: u32, found: u32) -> Error {
    Error::new(ErrorKind::TooLong, field, max, max, found)
}
