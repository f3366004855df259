//! Owned text.

use alloc::borrow::ToOwned as _;
use alloc::vec::Vec;
use core::fmt;

use super::{CncStr, TextRef};
use crate::error::Error;

/// CP1252 text without a NUL, owned.
///
/// ```
/// use ads_cnc::CncString;
///
/// let name: CncString = "V.E.Länge".parse()?;
/// assert_eq!(name, "V.E.Länge");
/// assert_eq!(name.as_bytes(), b"V.E.L\xE4nge");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CncString(Vec<u8>);

impl CncString {
    /// A text with these bytes, which must not contain a NUL.
    #[cfg(feature = "arbitrary")]
    #[inline]
    pub(crate) const fn without_nul(bytes: Vec<u8>) -> Self {
        Self(bytes)
    }

    /// The text, borrowed.
    #[inline]
    pub fn as_cnc_str(&self) -> CncStr<'_> {
        CncStr::without_nul(&self.0)
    }

    /// The CP1252 bytes.
    pub fn as_bytes(&self) -> &[u8] {
        &self.0
    }
}

impl CncStr<'_> {
    /// Copies the text.
    pub fn to_owned(&self) -> CncString {
        (*self).into()
    }
}

impl From<CncStr<'_>> for CncString {
    fn from(text: CncStr<'_>) -> Self {
        Self(text.to_bytes(0))
    }
}

impl PartialEq<str> for CncString {
    fn eq(&self, other: &str) -> bool {
        self.as_cnc_str() == *other
    }
}

impl PartialEq<&str> for CncString {
    fn eq(&self, other: &&str) -> bool {
        *self == **other
    }
}

impl core::str::FromStr for CncString {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        CncStr::new(text).map(Into::into)
    }
}

impl fmt::Display for CncString {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.as_cnc_str(), f)
    }
}

impl fmt::Debug for CncString {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.as_cnc_str(), f)
    }
}

/// An owned text field with its end: see [`TextRef`].
///
/// ```
/// use ads_cnc::{Decode, VariableName};
///
/// let padded = VariableName::decode(b"V.E.a\0\0\0")?.name;
/// assert_eq!(padded.text.as_bytes(), b"V.E.a");
/// assert_eq!(padded.tail.as_deref(), Some(&[0, 0][..]));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "crate::serial::TextShape", into = "crate::serial::TextShape")
)]
pub struct Text {
    /// The text.
    pub text: CncString,
    /// The bytes after the first NUL; `None` if there is no NUL.
    pub tail: Option<Vec<u8>>,
}

impl Text {
    /// The field, borrowed.
    #[inline]
    pub fn as_ref(&self) -> TextRef<'_> {
        TextRef::with_tail(self.text.as_cnc_str(), self.tail.as_deref())
    }
}

/// Displays the text, without its end.
impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.text, f)
    }
}

impl fmt::Debug for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.as_ref(), f)
    }
}

impl From<TextRef<'_>> for Text {
    fn from(field: TextRef<'_>) -> Self {
        Self { text: field.text().into(), tail: field.tail().map(<[u8]>::to_owned) }
    }
}

impl From<CncString> for Text {
    fn from(text: CncString) -> Self {
        Self { text, tail: Some(Vec::new()) }
    }
}

impl core::str::FromStr for Text {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        text.parse::<CncString>().map(Into::into)
    }
}
