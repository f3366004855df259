//! Borrowed text.

use core::fmt::{self, Write as _};
use core::hash::{Hash, Hasher};
use core::iter::FusedIterator;

use super::end::text_len;
use super::{char_to_cp1252, cp1252_to_char};
use crate::bytes::{Writer, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::text::TEXT;

/// CP1252 text without a NUL, borrowed from CP1252 bytes or from a Rust string.
///
/// ```
/// use ads_cnc::CncStr;
///
/// let wire = CncStr::from_bytes(b"V.E.L\xE4nge")?;
/// assert_eq!(wire, CncStr::new("V.E.Länge")?);
/// assert_eq!(wire.to_string(), "V.E.Länge");
/// assert_eq!(CncStr::new("V.E.Ω").unwrap_err().to_string(), "text at offset 4: U+03A9 is not in CP1252");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct CncStr<'a>(Source<'a>);

#[derive(Clone, Copy)]
enum Source<'a> {
    Bytes(&'a [u8]),
    /// A Rust string with a character outside ASCII, or a part of such a string. All its characters
    /// have CP1252 bytes.
    Str(&'a str),
}

impl<'a> CncStr<'a> {
    /// The empty text.
    pub const EMPTY: CncStr<'static> = CncStr(Source::Bytes(&[]));

    /// Creates a text from a Rust string. All its characters must have CP1252 bytes (see
    /// [`char_to_cp1252`]), and none may be NUL.
    ///
    /// # Errors
    /// [`ErrorKind::NotCp1252`], or [`ErrorKind::InnerNul`] for a NUL; the offset counts
    /// characters.
    pub fn new(text: &'a str) -> Result<Self, Error> {
        let mut ascii = true;
        for (at, character) in (0_u32..).zip(text.chars()) {
            ascii &= character.is_ascii();
            if character == '\0' {
                return Err(Error::new(ErrorKind::InnerNul, TEXT, at, 0, at));
            }
            if char_to_cp1252(character).is_none() {
                let point = u32::from(character);
                return Err(Error::new(ErrorKind::NotCp1252, TEXT, at, 0, point));
            }
        }
        Ok(Self(if ascii { Source::Bytes(text.as_bytes()) } else { Source::Str(text) }))
    }

    /// Creates a text from CP1252 bytes. Any byte but NUL is valid, including the five bytes that
    /// have no character in the code page.
    ///
    /// # Errors
    /// [`ErrorKind::InnerNul`] for a NUL in the bytes.
    pub fn from_bytes(bytes: &'a [u8]) -> Result<Self, Error> {
        let at = text_len(bytes);
        if at < bytes.len() {
            let at = to_u32(at);
            return Err(Error::new(ErrorKind::InnerNul, TEXT, at, 0, at));
        }
        Ok(Self(Source::Bytes(bytes)))
    }

    /// The text before the first NUL, or the whole text if it has no NUL.
    #[inline]
    pub(crate) fn until_nul(bytes: &'a [u8]) -> Self {
        Self(Source::Bytes(bytes.get(..text_len(bytes)).unwrap_or(bytes)))
    }

    /// A text with these bytes, which must not contain a NUL.
    #[inline]
    pub(crate) const fn without_nul(bytes: &'a [u8]) -> Self {
        Self(Source::Bytes(bytes))
    }

    /// The number of characters, which is also the number of CP1252 bytes.
    #[inline]
    pub fn len(&self) -> usize {
        match self.0 {
            Source::Bytes(bytes) => bytes.len(),
            Source::Str(text) => count(text),
        }
    }

    /// Returns `true` if the text is empty.
    #[inline]
    pub fn is_empty(&self) -> bool {
        match self.0 {
            Source::Bytes(bytes) => bytes.is_empty(),
            Source::Str(text) => text.is_empty(),
        }
    }

    /// The characters.
    pub fn chars(&self) -> Chars<'a> {
        Chars(match self.0 {
            Source::Bytes(bytes) => CharSource::Bytes(bytes.iter()),
            Source::Str(text) => CharSource::Str(text.chars()),
        })
    }

    /// The CP1252 bytes.
    pub fn bytes(&self) -> impl Iterator<Item = u8> + use<'a> {
        // Every character of a text has a CP1252 byte, so the filter drops no character.
        self.chars().filter_map(char_to_cp1252)
    }

    /// The bytes in memory, CP1252 or UTF-8. ASCII characters are the same in both.
    #[inline]
    pub(crate) const fn raw(self) -> &'a [u8] {
        match self.0 {
            Source::Bytes(bytes) => bytes,
            Source::Str(text) => text.as_bytes(),
        }
    }

    /// Splits the text at an offset in [`raw`](Self::raw). If no character begins at the offset, the result
    /// is the whole text and an empty text.
    pub(crate) fn split_at(self, at: usize) -> (Self, Self) {
        match self.0 {
            Source::Bytes(bytes) => {
                let (one, two) = bytes.split_at_checked(at).unwrap_or((bytes, &[]));
                (Self(Source::Bytes(one)), Self(Source::Bytes(two)))
            }
            Source::Str(text) => {
                let (one, two) = text.split_at_checked(at).unwrap_or((text, ""));
                (Self(Source::Str(one)), Self(Source::Str(two)))
            }
        }
    }

    #[inline]
    pub(crate) fn write(&self, out: &mut Writer<'_>) {
        match self.0 {
            Source::Bytes(bytes) => out.put(bytes),
            Source::Str(text) => put(text, out.next(count(text))),
        }
    }

    /// The CP1252 bytes in a vector with room for `more` bytes.
    #[cfg(feature = "alloc")]
    pub(crate) fn to_bytes(self, more: usize) -> alloc::vec::Vec<u8> {
        let mut all = alloc::vec::Vec::with_capacity(self.len().saturating_add(more));
        match self.0 {
            Source::Bytes(bytes) => all.extend_from_slice(bytes),
            Source::Str(_) => all.extend(self.bytes()),
        }
        all
    }
}

/// The number of characters of UTF-8 text. Cold, because most texts are stored as bytes.
#[cold]
fn count(text: &str) -> usize {
    // Each UTF-8 character has exactly one byte that is not a continuation byte.
    text.bytes().filter(|byte| byte & 0xC0 != 0x80).count()
}

#[cold]
fn put(text: &str, out: &mut [u8]) {
    let bytes = text.chars().filter_map(char_to_cp1252);
    out.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = byte);
}

/// An iterator over the characters of a text, for example of a [`CncStr`].
///
/// ```
/// use ads_cnc::CncStr;
///
/// assert!(CncStr::from_bytes(b"L\xE4nge")?.chars().eq("Länge".chars()));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Chars<'a>(CharSource<'a>);

impl<'a> Chars<'a> {
    /// The characters of a text that need not be CP1252.
    pub(crate) fn of_str(text: &'a str) -> Self {
        Self(CharSource::Str(text.chars()))
    }
}

#[derive(Clone, Debug)]
enum CharSource<'a> {
    Bytes(core::slice::Iter<'a, u8>),
    Str(core::str::Chars<'a>),
}

impl Iterator for Chars<'_> {
    type Item = char;

    fn next(&mut self) -> Option<char> {
        match &mut self.0 {
            CharSource::Bytes(bytes) => bytes.next().copied().map(cp1252_to_char),
            CharSource::Str(chars) => chars.next(),
        }
    }
}

impl FusedIterator for Chars<'_> {}

impl PartialEq for CncStr<'_> {
    fn eq(&self, other: &CncStr<'_>) -> bool {
        match (self.0, other.0) {
            (Source::Bytes(one), Source::Bytes(two)) => one == two,
            _ => self.chars().eq(other.chars()),
        }
    }
}

impl Eq for CncStr<'_> {}

impl PartialEq<str> for CncStr<'_> {
    fn eq(&self, other: &str) -> bool {
        self.chars().eq(other.chars())
    }
}

impl PartialEq<&str> for CncStr<'_> {
    fn eq(&self, other: &&str) -> bool {
        *self == **other
    }
}

impl Hash for CncStr<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.chars().for_each(|character| character.hash(state));
    }
}

impl fmt::Display for CncStr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.chars().try_for_each(|character| f.write_char(character))
    }
}

impl fmt::Debug for CncStr<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('"')?;
        for character in self.chars() {
            character.escape_debug().try_for_each(|escaped| f.write_char(escaped))?;
        }
        f.write_char('"')
    }
}
