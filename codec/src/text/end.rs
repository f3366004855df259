//! The ends of texts.

use super::{CncStr, TextRef};
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::Field;

/// The bytes before and after the first NUL; `None` without a NUL.
#[inline]
pub(crate) fn split_nul(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (text, rest) = bytes.split_at_checked(text_len(bytes))?;
    Some((text, rest.get(1..)?))
}

/// The number of bytes before the first NUL; without a NUL, the number of all bytes.
pub(crate) fn text_len(bytes: &[u8]) -> usize {
    bytes.iter().position(|&byte| byte == 0).unwrap_or(bytes.len())
}

/// Splits bytes whose first NUL is at `len` (see [`text_len`]) into the text before the NUL and its
/// tail, the bytes after the NUL; `None` without a NUL, or if a byte of the tail is not NUL.
#[inline]
pub(crate) fn split_padded(bytes: &[u8], len: usize) -> Option<TextRef<'_>> {
    match bytes.split_at_checked(len)? {
        (text, [_, tail @ ..]) if tail.is_empty() || padding_len(tail) == tail.len() => {
            Some(TextRef::with_tail(CncStr::without_nul(text), Some(tail)))
        }
        _ => None,
    }
}

/// The number of NULs at the start of a tail. Cold, because most texts end in exactly one NUL.
#[cold]
#[inline(never)]
fn padding_len(tail: &[u8]) -> usize {
    tail.iter().position(|&byte| byte != 0).unwrap_or(tail.len())
}

/// The error for bytes that are not a text of `len` bytes followed by one or more NULs.
#[cold]
#[inline(never)]
pub(crate) fn not_cstring(field: Field, at: u32, max: u32, bytes: &[u8], len: usize) -> Error {
    match bytes.split_at_checked(len) {
        Some((_, [_, tail @ ..])) => not_padded(field, at, len, tail),
        _ => Error::new(ErrorKind::MissingNul, field, at, max, to_u32(bytes.len())),
    }
}

/// The error for bytes that are not a text of `len` bytes, with or without NULs after it.
#[cold]
#[inline(never)]
pub(crate) fn not_optional_nul(field: Field, at: u32, bytes: &[u8], len: usize) -> Error {
    match bytes.split_at_checked(len) {
        Some((_, [_, tail @ ..])) => not_padded(field, at, len, tail),
        _ => Error::new(ErrorKind::Truncated, field, at, 1, 0),
    }
}

/// The error for bytes other than NUL after a text of `len` bytes and its NUL.
#[cold]
#[inline(never)]
pub(crate) fn not_padded(field: Field, at: u32, len: usize, tail: &[u8]) -> Error {
    let after = at.saturating_add(to_u32(len)).saturating_add(1);
    let end = after.saturating_add(to_u32(padding_len(tail)));
    let found = after.saturating_add(to_u32(tail.len()));
    Error::new(ErrorKind::Trailing, field.to_whole(), end, end, found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_nul_ends_a_text() {
        for filler in [1, 0x7F, 0x80, 0x81, 0xFF] {
            for len in (0..40_usize).step_by(if cfg!(miri) { 13 } else { 1 }) {
                let mut bytes = std::vec![filler; len];
                assert_eq!(text_len(&bytes), len);
                for nul in (0..len).rev() {
                    bytes[nul] = 0;
                    assert_eq!(text_len(&bytes), nul, "{bytes:?}");
                    assert_eq!(split_nul(&bytes), Some((&bytes[..nul], &bytes[nul + 1..])));
                    let is_padded = bytes[nul..].iter().all(|&byte| byte == 0);
                    let split = split_padded(&bytes, nul).map(|text| text.tail());
                    assert_eq!(split, is_padded.then_some(Some(&bytes[nul + 1..])), "{bytes:?}");
                    if nul % 3 == 0 {
                        bytes[nul] = filler;
                    }
                }
            }
        }
    }
}
