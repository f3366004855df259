//! Kinds of rows in the tables of streams: how to read, check and write each kind. Kinds that only
//! `packed` or handwritten types have are not among them.

#[cfg(feature = "arbitrary")]
pub(crate) mod any;
mod lists;
mod numbers;
mod text;

pub(crate) use lists::{Data, List, Rest};
pub(crate) use numbers::{Boolean, NonZero, Number};
pub(crate) use text::{CString, CStringPrefix, KindText, OptionalNul, TextAndTail};

use crate::bytes::{Reader, Writer, to_u32};
use crate::error::Error;
use crate::layout::{Field, Size, Type};

/// A kind of row.
///
/// The fixed rows at the start of a stream are its head. One check of the length covers the whole
/// head; each row of the head is then read at its offset in the table. The other rows are read from
/// the bytes after the head, in order.
pub(crate) trait Row {
    /// The type of the field in a borrowed type (a view).
    type View<'a>: Copy;
    const SIZE: Size;
    const TYPE: Type;
    /// Whether `read` can reject a value. Only used for rows of fixed size.
    const REJECTS: bool = false;

    /// Reads the row that begins at offset `at`.
    fn read<'a>(
        input: &mut Reader<'a>,
        head: &'a [u8],
        field: Field,
        at: usize,
    ) -> Result<Self::View<'a>, Error>;
    /// The length of the encoded row in bytes, including the count of a list.
    fn len(view: Self::View<'_>) -> usize;
    /// Rejects values that a decoder would reject, unless the check of the maximum length of the
    /// stream rejects them. The row, including its count, begins at offset `at`.
    #[inline]
    fn check(_: Self::View<'_>, _: Field, _at: usize) -> Result<(), Error> {
        Ok(())
    }
    /// Writes the bytes of the row that are in the head.
    fn write_head(_: Self::View<'_>, _head: &mut [u8], _at: usize) {}
    /// Writes the bytes of the row that are after the head.
    fn write(_: Self::View<'_>, _: &mut Writer<'_>) {}
}

/// Pulls bytes from a reader: those of one row, at most one more than the maximum of the row. For
/// types that are written by hand, src/io.rs pulls whole streams with it.
#[cfg(feature = "binrw")]
pub(crate) trait Pull {
    /// Reads `len` bytes, or fewer at the end of the reader.
    fn exact(&mut self, len: usize) -> binrw::io::Result<()>;
    /// Reads all bytes to the end of the reader, at most `max` + 1.
    fn rest(&mut self, max: u32) -> binrw::io::Result<()>;
    /// Reads the bytes up to and including the first NUL, at most `max`.
    fn until_nul(&mut self, max: u32) -> binrw::io::Result<()>;
    /// Reads a count and that number of items of `each` bytes, but at most `max` items.
    fn counted(&mut self, each: usize, max: u32) -> binrw::io::Result<()>;
}

/// A kind of row in a type that owns its data.
#[cfg(feature = "alloc")]
pub(crate) trait Owned: Row {
    type Type;
    /// The minimum length of the encoded row, including a count; for an optional text, that of a
    /// text with its NUL.
    #[cfg(feature = "arbitrary")]
    const LEAST: usize = match Self::SIZE {
        Size::Items { .. } => 4,
        size => crate::bytes::to_usize(size.least()),
    };

    fn own(view: Self::View<'_>) -> Self::Type;
    fn lend(owned: &Self::Type) -> Self::View<'_>;
    /// Pulls the row's bytes from a reader; `read` decodes them.
    #[cfg(feature = "binrw")]
    fn pull(from: &mut impl Pull) -> binrw::io::Result<()>;
    /// Generates a valid value, which exceeds the minimum length by at most `room` bytes.
    #[cfg(feature = "arbitrary")]
    fn any(u: any::Any<'_, '_>, room: usize) -> arbitrary::Result<Self::Type>;
}

/// The bytes of a head at offset `at`. `stream!` checks the offsets of its rows, so these bytes are
/// in the head.
#[inline(always)]
fn part<const N: usize>(head: &[u8], at: usize) -> [u8; N] {
    head.get(at..).and_then(<[u8]>::first_chunk).copied().unwrap_or([0; N])
}

#[inline(always)]
fn put<const N: usize>(head: &mut [u8], at: usize, bytes: [u8; N]) {
    if let Some(part) = head.get_mut(at..).and_then(<[u8]>::first_chunk_mut) {
        *part = bytes;
    }
}

/// The number in the four bytes before offset `at`: the count of a list.
#[inline(always)]
fn count(head: &[u8], at: usize) -> u32 {
    u32::from_le_bytes(part(head, at.saturating_sub(4)))
}

#[inline(always)]
fn put_count(head: &mut [u8], at: usize, count: usize) {
    put(head, at.saturating_sub(4), to_u32(count).to_le_bytes());
}
