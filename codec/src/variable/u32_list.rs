//! A list of UNS32 in a stream, in memory or in a name.

use core::fmt;
use core::iter::FusedIterator;

use zerocopy::IntoBytes as _;
use zerocopy::little_endian::U32;

use crate::bytes::Writer;

/// A list of dimensions or indices, borrowed from the bytes of a stream, from a slice of numbers or
/// from the brackets in a name.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.2, 4.3.4 and 4.3.6.
///
/// ```
/// use ads_cnc::{Decode, HandleReadRef, U32List};
///
/// let wire = HandleReadRef::decode(&[1, 0, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0])?;
/// assert_eq!(wire.indices, U32List::from(&[4]));
/// assert_eq!(wire.indices.iter().len(), 1);
/// for index in wire.indices {
///     assert_eq!(index, 4);
/// }
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct U32List<'a>(Source<'a>);

#[derive(Clone, Copy)]
enum Source<'a> {
    Wire(&'a [U32]),
    Memory(&'a [u32]),
    /// Text such as `[3][4]`, from a name that was checked.
    Name(&'a [u8]),
}

impl<'a> U32List<'a> {
    /// The empty list.
    pub const EMPTY: U32List<'static> = U32List(Source::Memory(&[]));

    #[inline]
    pub(crate) const fn from_wire(numbers: &'a [U32]) -> Self {
        Self(Source::Wire(numbers))
    }

    /// The indices in these brackets, which are from a name that was checked.
    pub(crate) const fn from_name(brackets: &'a [u8]) -> Self {
        Self(Source::Name(brackets))
    }

    /// The number of elements.
    #[inline]
    pub const fn len(&self) -> usize {
        match self.0 {
            Source::Wire(numbers) => numbers.len(),
            Source::Memory(numbers) => numbers.len(),
            Source::Name(brackets) => count_opened(brackets),
        }
    }

    /// Returns `true` if the list is empty.
    #[inline]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number at this index, from 0; `None` after the end.
    #[inline]
    pub fn get(&self, index: usize) -> Option<u32> {
        match self.0 {
            Source::Wire(numbers) => numbers.get(index).map(|number| number.get()),
            Source::Memory(numbers) => numbers.get(index).copied(),
            Source::Name(_) => self.iter().nth(index),
        }
    }

    /// Iterates over the numbers in order.
    #[inline]
    pub fn iter(&self) -> U32Iter<'a> {
        U32Iter(self.0)
    }

    /// Copies the numbers to a vector.
    #[cfg(feature = "alloc")]
    pub fn to_vec(self) -> alloc::vec::Vec<u32> {
        match self.0 {
            Source::Wire(numbers) => numbers.iter().map(|number| number.get()).collect(),
            Source::Memory(numbers) => numbers.to_vec(),
            Source::Name(_) => {
                let mut numbers = alloc::vec::Vec::with_capacity(self.len());
                numbers.extend(self.iter());
                numbers
            }
        }
    }

    pub(crate) fn encoded_len(&self) -> usize {
        self.len().saturating_mul(4)
    }

    #[inline]
    pub(crate) fn write(&self, out: &mut Writer<'_>) {
        match self.0 {
            Source::Wire(numbers) => out.put(numbers.as_bytes()),
            Source::Memory(numbers) => {
                let slots = out.next(self.encoded_len()).chunks_exact_mut(4);
                for (slot, number) in slots.zip(numbers) {
                    // With optimisation for size, `copy_from_slice` would contain a panic.
                    slot.iter_mut().zip(number.to_le_bytes()).for_each(|(to, from)| *to = from);
                }
            }
            Source::Name(_) => self.iter().for_each(|number| out.u32(number)),
        }
    }
}

/// The number of opening brackets, which is the number of indices.
#[cold]
const fn count_opened(mut brackets: &[u8]) -> usize {
    let mut count = 0_usize;
    while let Some((byte, rest)) = brackets.split_first() {
        if *byte == b'[' {
            count = count.saturating_add(1);
        }
        brackets = rest;
    }
    count
}

/// An iterator over the numbers of a [`U32List`].
///
/// ```
/// use ads_cnc::{U32Iter, U32List};
///
/// let mut numbers: U32Iter<'_> = U32List::from(&[2, 3]).iter();
/// assert_eq!((numbers.next(), numbers.len()), (Some(2), 1));
/// ```
#[derive(Clone)]
pub struct U32Iter<'a>(Source<'a>);

impl Iterator for U32Iter<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        match &mut self.0 {
            Source::Wire(numbers) => {
                let (first, rest) = numbers.split_first()?;
                *numbers = rest;
                Some(first.get())
            }
            Source::Memory(numbers) => {
                let (first, rest) = numbers.split_first()?;
                *numbers = rest;
                Some(*first)
            }
            Source::Name(brackets) => {
                let mut parts = brackets.splitn(2, |&byte| byte == b']');
                let (_, digits) = parts.next()?.split_first()?;
                *brackets = parts.next().unwrap_or_default();
                Some(decimal(digits))
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let len = U32List(self.0).len();
        (len, Some(len))
    }
}

impl ExactSizeIterator for U32Iter<'_> {}

impl FusedIterator for U32Iter<'_> {}

/// Formats the remaining numbers.
impl fmt::Debug for U32Iter<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("U32Iter").field(&U32List(self.0)).finish()
    }
}

impl<'a> IntoIterator for U32List<'a> {
    type Item = u32;
    type IntoIter = U32Iter<'a>;

    #[inline]
    fn into_iter(self) -> U32Iter<'a> {
        self.iter()
    }
}

/// The number with these digits; `u32::MAX` if it is greater.
pub(super) fn decimal(digits: &[u8]) -> u32 {
    digits.iter().fold(0_u32, |number, &digit| {
        number.saturating_mul(10).saturating_add(u32::from(digit & 0x0F))
    })
}

impl<'a> From<&'a [u32]> for U32List<'a> {
    fn from(numbers: &'a [u32]) -> Self {
        Self(Source::Memory(numbers))
    }
}

impl<'a, const N: usize> From<&'a [u32; N]> for U32List<'a> {
    fn from(numbers: &'a [u32; N]) -> Self {
        Self(Source::Memory(numbers))
    }
}

#[cfg(feature = "alloc")]
impl<'a> From<&'a alloc::vec::Vec<u32>> for U32List<'a> {
    fn from(numbers: &'a alloc::vec::Vec<u32>) -> Self {
        numbers.as_slice().into()
    }
}

impl PartialEq for U32List<'_> {
    fn eq(&self, other: &U32List<'_>) -> bool {
        self.len() == other.len() && self.iter().eq(other.iter())
    }
}

impl Eq for U32List<'_> {}

impl core::hash::Hash for U32List<'_> {
    fn hash<H: core::hash::Hasher>(&self, state: &mut H) {
        state.write_usize(self.len());
        self.iter().for_each(|number| state.write_u32(number));
    }
}

impl fmt::Debug for U32List<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_lists_from_all_sources_have_equal_hashes() {
        use std::hash::BuildHasher as _;

        let state = std::collections::hash_map::RandomState::new();
        let wire = [U32::new(3), U32::new(9)];
        let hash = state.hash_one(U32List::from(&[3, 9]));
        assert_eq!(state.hash_one(U32List::from_wire(&wire)), hash);
        assert_eq!(state.hash_one(U32List::from_name(b"[3][9]")), hash);
        assert_ne!(state.hash_one(U32List::from(&[3])), hash);
    }

    #[cfg(feature = "alloc")]
    #[test]
    fn copies_are_the_same_from_every_source() {
        let wire = [U32::new(3), U32::new(9)];
        for numbers in
            [U32List::from_wire(&wire), U32List::from(&[3, 9]), U32List::from_name(b"[3][9]")]
        {
            assert_eq!(numbers.to_vec(), [3, 9]);
        }
    }

    #[test]
    fn iterators_report_their_exact_length() {
        let wire = [U32::new(3), U32::new(0), U32::MAX_VALUE];
        let sources = [
            U32List::from_wire(&wire),
            U32List::from(&[3, 0, u32::MAX]),
            U32List::from_name(b"[3][0][4294967295]"),
        ];
        for numbers in sources {
            let mut left = numbers.iter();
            for (index, number) in [3, 0, u32::MAX].into_iter().enumerate() {
                assert_eq!((left.len(), numbers.get(index)), (3 - index, Some(number)));
                assert_eq!(left.next(), Some(number));
            }
            assert_eq!((left.len(), left.next(), numbers.get(3)), (0, None, None));
        }
        assert_eq!(U32List::from_name(b"").iter().len(), 0);
    }
}
