//! Numbers in place.

use core::fmt;

use zerocopy::{FromBytes as _, IntoBytes as _};

use super::Item;
use super::shape::{count, place};
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::field::typed_value::{COUNT, VALUE};
use crate::variable::Numbers;

/// The elements of a value of one type, read in place: no copy, no allocation, no alignment.
///
/// ```
/// use ads_cnc::value::Items;
///
/// // Whole array, section 4.3.4; that they are SGN32 is assumed.
/// let bytes = b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0";
/// let items = Items::<i32>::new(bytes)?;
/// assert!(items.iter().eq([123, 234, 345, 456, 567]));
/// assert_eq!(items.get(3), Some(456));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Items<'a, T: Item>(&'a [T::Wire]);

impl<'a, T: Item> Items<'a, T> {
    /// The elements in these bytes.
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`] if the last element is cut.
    pub fn new(bytes: &'a [u8]) -> Result<Self, Error> {
        match <[T::Wire]>::ref_from_bytes(bytes) {
            Ok(items) => Ok(Self(items)),
            Err(_) => {
                let each = size_of::<T::Wire>();
                let left = bytes.len().checked_rem(each).unwrap_or(0);
                let at = to_u32(bytes.len().saturating_sub(left));
                Err(Error::new(ErrorKind::Truncated, VALUE, at, to_u32(each), to_u32(left)))
            }
        }
    }

    /// How many.
    pub const fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The element at this place, from 0.
    pub fn get(&self, place: usize) -> Option<T> {
        self.0.get(place).copied().map(T::from_wire)
    }

    /// The element with these indices in an array of these dimensions; of more than one dimension,
    /// the last index runs fastest (VAR-21, assumed).
    ///
    /// # Errors
    /// Those of [`Shape::place`](super::Shape::place), and [`ErrorKind::Mismatch`] for another
    /// number of elements than the dimensions have.
    pub fn element(&self, indices: Numbers<'_>, dimensions: Numbers<'_>) -> Result<T, Error> {
        let place = place(indices, dimensions)?;
        let (elements, given) = (count(dimensions).unwrap_or(u32::MAX), to_u32(self.len()));
        let element = usize::try_from(place).ok().and_then(|place| self.get(place));
        match element {
            Some(element) if given == elements => Ok(element),
            _ => Err(Error::new(ErrorKind::Mismatch, COUNT, 0, elements, given)),
        }
    }

    /// All in their order.
    pub fn iter(
        &self,
    ) -> impl ExactSizeIterator<Item = T> + DoubleEndedIterator + Clone + use<'a, T> {
        self.0.iter().copied().map(T::from_wire)
    }

    /// The bytes.
    pub fn as_bytes(&self) -> &'a [u8] {
        self.0.as_bytes()
    }

    /// Fills `out` with just as many elements.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for another number of elements; nothing is written.
    pub fn copy_to(&self, out: &mut [T]) -> Result<(), Error> {
        let (elements, given) = (to_u32(self.len()), to_u32(out.len()));
        if self.len() != out.len() {
            return Err(Error::new(ErrorKind::Mismatch, COUNT, 0, elements, given));
        }
        out.iter_mut().zip(self.iter()).for_each(|(out, item)| *out = item);
        Ok(())
    }

    /// The elements in a vector of their own.
    #[cfg(feature = "alloc")]
    pub fn to_vec(&self) -> alloc::vec::Vec<T> {
        self.iter().collect()
    }
}

impl<T: Item> PartialEq for Items<'_, T> {
    fn eq(&self, other: &Items<'_, T>) -> bool {
        self.iter().eq(other.iter())
    }
}

impl<T: Item> fmt::Debug for Items<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}
