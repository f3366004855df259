//! Generators for parts of arbitrary values.

use alloc::vec::Vec;

use crate::text::{CncString, Text};

pub(crate) type Any<'u, 'a> = &'u mut arbitrary::Unstructured<'a>;

/// Generates at most `max` values.
pub(crate) fn up_to<T: for<'a> arbitrary::Arbitrary<'a>>(
    u: Any<'_, '_>,
    max: usize,
) -> arbitrary::Result<Vec<T>> {
    let len = u.arbitrary_len::<T>()?.min(max);
    (0..len).map(|_| u.arbitrary()).collect()
}

/// Generates a text of at most `max` bytes.
pub(crate) fn text(u: Any<'_, '_>, max: usize) -> arbitrary::Result<CncString> {
    let mut bytes: Vec<u8> = up_to(u, max)?;
    bytes.retain(|&byte| byte != 0);
    Ok(CncString::without_nul(bytes))
}

/// Generates a text and its NUL, followed by NULs if `is_padded`, otherwise by any bytes; at most
/// `max` bytes together.
pub(crate) fn ended(u: Any<'_, '_>, max: usize, is_padded: bool) -> arbitrary::Result<Text> {
    let text = text(u, max.saturating_sub(1))?;
    let left = max.saturating_sub(1).saturating_sub(text.as_bytes().len());
    let mut tail = up_to(u, left)?;
    if is_padded {
        tail.fill(0);
    }
    Ok(Text { text, tail: Some(tail) })
}

/// Like [`ended`], but the text may have no NUL and no bytes after it.
pub(crate) fn open(u: Any<'_, '_>, max: usize, is_padded: bool) -> arbitrary::Result<Text> {
    let ended = ended(u, max, is_padded)?;
    let is_open = !ended.text.as_bytes().is_empty() && u.arbitrary()?;
    Ok(Text { tail: ended.tail.filter(|_| !is_open), ..ended })
}

pub(crate) fn nothing() -> arbitrary::Result<Text> {
    Ok(Text { text: CncString::default(), tail: None })
}
