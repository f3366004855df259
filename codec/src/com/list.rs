//! A sequence of descriptors.

use core::fmt;
use core::iter::FusedIterator;
use core::slice;

use zerocopy::{FromBytes as _, IntoBytes as _};

use super::DescriptorRef;
use super::descriptor::DescriptorLayout;
use crate::bytes::{Reader, Writer, to_u32, truncated};
use crate::error::Error;
use crate::layout::Stream;
use crate::limits::DESCRIPTOR_LEN;
use crate::stream::{Decode, Encode};

#[doc = include_str!("../../doc/object-descriptors.md")]
///
/// Each record is a [`DescriptorRef`].
///
/// The read length of the request limits the number of records: a request for 84 × `k` bytes has a
/// reply with at most `k` records, and fewer at the end of the list. For other read lengths above 84,
/// one record is assumed.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 2.1.1.
///
/// `decode` can fail with [`Truncated`](crate::ErrorKind::Truncated) or
/// [`TooLong`](crate::ErrorKind::TooLong).
///
/// ```
/// use ads_cnc::{Decode, DescriptorsRef};
///
/// let descriptors = DescriptorsRef::decode(&[0; 168])?;
/// assert_eq!(descriptors.len(), 2);
/// for object in descriptors {
///     assert!(object.name().is_empty());
/// }
/// assert_eq!(
///     DescriptorsRef::decode(&[0; 85]).unwrap_err().to_string(),
///     "object-descriptors: id at offset 84: truncated, expected 4 bytes, found 1"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct DescriptorsRef<'a>(&'a [DescriptorLayout]);

impl<'a> DescriptorsRef<'a> {
    /// The number of descriptors.
    #[inline]
    pub const fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns `true` if the list is empty. A decoded list is never empty.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The descriptor at this index, from 0; `None` after the end.
    #[inline]
    pub fn get(&self, index: usize) -> Option<DescriptorRef<'a>> {
        self.0.get(index).map(DescriptorRef)
    }

    /// Up to `count` descriptors, starting at index `first`; empty after the end.
    pub fn slice(&self, first: usize, count: usize) -> Self {
        let from = self.0.get(first..).unwrap_or_default();
        Self(from.get(..count).unwrap_or(from))
    }

    /// Iterates over the descriptors.
    #[inline]
    pub fn iter(&self) -> DescriptorIter<'a> {
        DescriptorIter(self.0.iter())
    }
}

/// An iterator over the descriptors of a list.
///
/// ```
/// use ads_cnc::{Decode, DescriptorIter, DescriptorsRef};
///
/// let mut objects: DescriptorIter<'_> = DescriptorsRef::decode(&[0; 168])?.iter();
/// assert_eq!(objects.next_back().unwrap().id(), 0);
/// assert_eq!(objects.len(), 1);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone)]
pub struct DescriptorIter<'a>(slice::Iter<'a, DescriptorLayout>);

impl<'a> Iterator for DescriptorIter<'a> {
    type Item = DescriptorRef<'a>;

    #[inline]
    fn next(&mut self) -> Option<DescriptorRef<'a>> {
        self.0.next().map(DescriptorRef)
    }

    #[inline]
    fn nth(&mut self, skipped: usize) -> Option<DescriptorRef<'a>> {
        self.0.nth(skipped).map(DescriptorRef)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.0.size_hint()
    }
}

impl DoubleEndedIterator for DescriptorIter<'_> {
    fn next_back(&mut self) -> Option<Self::Item> {
        self.0.next_back().map(DescriptorRef)
    }
}

impl ExactSizeIterator for DescriptorIter<'_> {}

impl FusedIterator for DescriptorIter<'_> {}

/// Formats the remaining descriptors.
impl fmt::Debug for DescriptorIter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("DescriptorIter").field(&DescriptorsRef(self.0.as_slice())).finish()
    }
}

impl<'a> IntoIterator for DescriptorsRef<'a> {
    type Item = DescriptorRef<'a>;
    type IntoIter = DescriptorIter<'a>;

    #[inline]
    fn into_iter(self) -> DescriptorIter<'a> {
        self.iter()
    }
}

impl<'a> Decode<'a> for DescriptorsRef<'a> {
    const STREAM: Stream = Stream::ObjectDescriptors;

    fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
        Reader::new(Self::STREAM, bytes)?;
        let count = bytes.len() / DESCRIPTOR_LEN;
        match <[DescriptorLayout]>::ref_from_bytes_with_elems(bytes, count) {
            Ok(layouts) if !layouts.is_empty() => Ok(Self(layouts)),
            // The last descriptor is incomplete, or there are no bytes.
            _ => {
                let whole = count.saturating_mul(DESCRIPTOR_LEN);
                Err(truncated(Self::STREAM, to_u32(whole), bytes.len().saturating_sub(whole)))
            }
        }
    }
}

impl Encode for DescriptorsRef<'_> {
    fn encoded_len(&self) -> usize {
        self.0.as_bytes().len()
    }

    fn encode<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
        if self.is_empty() {
            // An empty list is not a valid stream: return the error of the decoder.
            Self::decode(&[])?;
        }
        Writer::copy(Self::STREAM, self.0.as_bytes(), buf)
    }
}

impl fmt::Debug for DescriptorsRef<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(feature = "alloc")]
pub use owned::Descriptors;

#[cfg(feature = "alloc")]
mod owned {
    use alloc::vec::Vec;

    use super::*;
    use crate::com::Descriptor;

    /// An owned [`DescriptorsRef`].
    ///
    /// ```
    /// use ads_cnc::{Descriptor, Descriptors};
    ///
    /// let mut list: Descriptors = [Descriptor::new("a", "BOOL")?].into_iter().collect();
    /// list.extend([Descriptor::new("b", "INT")?]);
    /// assert_eq!(list.len(), 2);
    /// for (object, name) in list.iter().zip(["a", "b"]) {
    ///     assert_eq!(object.name(), name);
    /// }
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    #[derive(Clone, Default, PartialEq, Eq, Hash)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
    pub struct Descriptors(Vec<DescriptorLayout>);

    impl From<DescriptorsRef<'_>> for Descriptors {
        fn from(list: DescriptorsRef<'_>) -> Self {
            Self(list.0.to_vec())
        }
    }

    impl DescriptorsRef<'_> {
        /// Copies the descriptors.
        pub fn to_owned(&self) -> Descriptors {
            (*self).into()
        }
    }

    impl<'a> Decode<'a> for Descriptors {
        const STREAM: Stream = Stream::ObjectDescriptors;

        fn decode(bytes: &'a [u8]) -> Result<Self, Error> {
            DescriptorsRef::decode(bytes).map(Self::from)
        }
    }

    impl Descriptors {
        /// The descriptors, borrowed.
        #[inline]
        pub fn as_ref(&self) -> DescriptorsRef<'_> {
            DescriptorsRef(&self.0)
        }

        /// The number of descriptors.
        pub fn len(&self) -> usize {
            self.0.len()
        }

        /// Returns `true` if the list is empty.
        pub fn is_empty(&self) -> bool {
            self.0.is_empty()
        }

        /// Iterates over the descriptors.
        pub fn iter(&self) -> DescriptorIter<'_> {
            self.as_ref().iter()
        }

        /// Appends a descriptor.
        pub fn push(&mut self, object: Descriptor) {
            self.0.push(object.0);
        }
    }

    impl FromIterator<Descriptor> for Descriptors {
        fn from_iter<I: IntoIterator<Item = Descriptor>>(objects: I) -> Self {
            Self(objects.into_iter().map(|object| object.0).collect())
        }
    }

    impl Extend<Descriptor> for Descriptors {
        fn extend<I: IntoIterator<Item = Descriptor>>(&mut self, objects: I) {
            self.0.extend(objects.into_iter().map(|object| object.0));
        }
    }

    impl<'a> IntoIterator for &'a Descriptors {
        type Item = DescriptorRef<'a>;
        type IntoIter = DescriptorIter<'a>;

        fn into_iter(self) -> DescriptorIter<'a> {
            self.iter()
        }
    }

    crate::stream::encode_as_ref!(Descriptors);

    impl fmt::Debug for Descriptors {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            fmt::Debug::fmt(&self.as_ref(), f)
        }
    }
}
