//! Texts in place.

use core::fmt;

use super::element::part;
use super::{DataType, Elements, Shape};
use crate::bytes::{to_len, to_u32};
use crate::error::Error;
use crate::text::TextRef;
use crate::variable::Numbers;

/// The texts of a value, each in the same number of bytes (assumed); what follows a NUL is kept.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.4 … 4.3.7.
///
/// ```
/// use ads_cnc::value::StringsRef;
///
/// let texts = StringsRef::new(b"abc\0d\0\0e", 2)?;
/// assert_eq!(texts.get(1).map(|text| text.text().to_string()).as_deref(), Some("d"));
/// assert_eq!(
///     StringsRef::new(b"abc\0d\0\0", 2).unwrap_err().to_string(),
///     "typed-value: size at offset 0: mismatch, 6 expected, 7 found"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct StringsRef<'a> {
    bytes: &'a [u8],
    each: usize,
    count: usize,
}

impl<'a> StringsRef<'a> {
    /// So many texts in these bytes.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`](crate::ErrorKind::Mismatch) if the bytes cannot be shared, each
    /// of several texts having one at least.
    pub fn new(bytes: &'a [u8], count: u32) -> Result<Self, Error> {
        let dimension = [count];
        let shape = Shape::new(DataType::String, Numbers::from(&dimension), to_u32(bytes.len()))?;
        Ok(Self { bytes, each: to_len(shape.element_size()), count: to_len(count) })
    }

    /// The texts of elements that were found to be texts.
    pub(super) fn of(elements: Elements<'a>) -> Self {
        let each = to_len(elements.shape().element_size());
        Self { bytes: elements.as_bytes(), each, count: elements.len() }
    }

    /// How many.
    pub const fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Bytes that each may have.
    pub const fn element_size(&self) -> usize {
        self.each
    }

    /// The text at this place, from 0.
    pub fn get(&self, place: usize) -> Option<TextRef<'a>> {
        match place < self.count {
            true => part(self.bytes, self.each, place).map(TextRef::split),
            false => None,
        }
    }

    /// All in their order.
    pub fn iter(
        &self,
    ) -> impl ExactSizeIterator<Item = TextRef<'a>> + DoubleEndedIterator + Clone + use<'a> {
        let texts = *self;
        // None is absent: their number is that of the bytes.
        (0..self.count).map(move |place| texts.get(place).unwrap_or(TextRef::split(&[])))
    }

    /// The bytes.
    pub const fn as_bytes(&self) -> &'a [u8] {
        self.bytes
    }
}

impl fmt::Debug for StringsRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(feature = "alloc")]
pub use owned::Strings;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::text::CncStr;

    /// [`StringsRef`], owned, in one allocation.
    ///
    /// ```
    /// use ads_cnc::value::{Strings, StringsRef};
    ///
    /// let texts = Strings::from(StringsRef::new(b"abc\0d\0\0e", 2)?);
    /// assert_eq!(texts.as_ref().get(0).unwrap().text(), "abc");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, PartialEq, Eq, Hash)]
    pub struct Strings {
        bytes: Vec<u8>,
        each: usize,
        count: usize,
    }

    impl Strings {
        /// The texts, borrowed.
        pub fn as_ref(&self) -> StringsRef<'_> {
            StringsRef { bytes: &self.bytes, each: self.each, count: self.count }
        }
    }

    impl From<StringsRef<'_>> for Strings {
        fn from(texts: StringsRef<'_>) -> Self {
            Self { bytes: texts.bytes.into(), each: texts.each, count: texts.count }
        }
    }

    /// One text and its NUL.
    impl From<CncStr<'_>> for Strings {
        fn from(text: CncStr<'_>) -> Self {
            let mut bytes = text.to_bytes(1);
            bytes.push(0);
            Self { each: bytes.len(), bytes, count: 1 }
        }
    }

    impl fmt::Debug for Strings {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            fmt::Debug::fmt(&self.as_ref(), f)
        }
    }
}
