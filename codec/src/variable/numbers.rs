//! A list of UNS32, from a stream or from memory.

use core::fmt;

use zerocopy::little_endian::U32;

use crate::bytes::Writer;

/// Dimensions or indices: borrowed from a stream's bytes or from a slice of numbers.
///
/// ```
/// use ads_cnc::{Decode, HandleReadRef, Numbers};
///
/// let wire = HandleReadRef::decode(&[1, 0, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0])?;
/// assert_eq!(wire.indices, Numbers::from(&[4]));
/// assert_eq!(wire.indices.iter().sum::<u32>(), 4);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Numbers<'a>(Source<'a>);

#[derive(Clone, Copy)]
enum Source<'a> {
    Wire(&'a [U32]),
    Memory(&'a [u32]),
}

impl<'a> Numbers<'a> {
    /// No number.
    pub const EMPTY: Numbers<'static> = Numbers(Source::Memory(&[]));

    pub(crate) const fn from_wire(numbers: &'a [U32]) -> Self {
        Self(Source::Wire(numbers))
    }

    /// How many.
    pub const fn len(&self) -> usize {
        match self.0 {
            Source::Wire(numbers) => numbers.len(),
            Source::Memory(numbers) => numbers.len(),
        }
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number at this place, from 0.
    pub fn get(&self, place: usize) -> Option<u32> {
        match self.0 {
            Source::Wire(numbers) => numbers.get(place).map(|number| number.get()),
            Source::Memory(numbers) => numbers.get(place).copied(),
        }
    }

    /// All in their order.
    pub fn iter(&self) -> impl Iterator<Item = u32> + use<'a> {
        let (wire, memory): (&[U32], &[u32]) = match self.0 {
            Source::Wire(numbers) => (numbers, &[]),
            Source::Memory(numbers) => (&[], numbers),
        };
        wire.iter().map(|number| number.get()).chain(memory.iter().copied())
    }

    pub(crate) fn encoded_len(&self) -> usize {
        self.len().saturating_mul(4)
    }

    pub(crate) fn write(&self, out: &mut Writer<'_>) {
        self.iter().for_each(|number| out.u32(number));
    }
}

impl<'a> From<&'a [u32]> for Numbers<'a> {
    fn from(numbers: &'a [u32]) -> Self {
        Self(Source::Memory(numbers))
    }
}

impl<'a, const N: usize> From<&'a [u32; N]> for Numbers<'a> {
    fn from(numbers: &'a [u32; N]) -> Self {
        Self(Source::Memory(numbers))
    }
}

impl PartialEq for Numbers<'_> {
    fn eq(&self, other: &Numbers<'_>) -> bool {
        self.len() == other.len() && self.iter().eq(other.iter())
    }
}

impl Eq for Numbers<'_> {}

impl fmt::Debug for Numbers<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
