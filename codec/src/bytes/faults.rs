//! Why bytes are refused by their number.
//!
//! Apart from what succeeds, and no methods: a reader whose address is known to nobody stays in
//! registers.

use super::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::{Cut, Field, Stream};

/// The field in which the fixed part of a record at `at` is cut.
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
pub(super) fn not_all(stream: Stream, given: usize) -> Error {
    let cuts = stream.cuts();
    match cuts.get(given) {
        Some(cut) => cut_at(stream, *cut, 0, given),
        None => {
            let size = to_u32(cuts.len());
            Error::new(ErrorKind::Trailing, Field::whole(stream), size, size, to_u32(given))
        }
    }
}

#[cold]
pub(super) fn too_long(field: Field, max: u32, given: u32) -> Error {
    Error::new(ErrorKind::TooLong, field, max, max, given)
}
