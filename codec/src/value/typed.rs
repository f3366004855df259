//! Numbers of a type that is known at compile time, and conversions of elements to Rust types.

use zerocopy::FromBytes as _;

use super::{DataType, Element, Elements, Scalar};
use crate::bytes::to_u32;
use crate::content::ContentRef;
use crate::error::{Error, ErrorKind};
use crate::layout::typed_value::{COUNT, INDEX, NEGATIVE, NUMBER, TYPE, VALUE};
use crate::text::{CncStr, TextRef};
use crate::variable::ValueRef;

/// Splits the bytes into numbers.
fn split<T: Scalar>(bytes: &[u8]) -> Result<&[T::Wire], Error> {
    <[T::Wire]>::ref_from_bytes(bytes).map_err(|_| {
        let each = size_of::<T::Wire>();
        let left = bytes.len().checked_rem(each).unwrap_or(0);
        let at = to_u32(bytes.len().saturating_sub(left));
        Error::new(ErrorKind::Truncated, VALUE, at, to_u32(each), to_u32(left))
    })
}

fn get<T: Scalar>(bytes: &[u8], index: usize) -> Result<T, Error> {
    let all = split::<T>(bytes)?;
    all.get(index).copied().map(T::from_wire).ok_or_else(|| beyond(all.len(), index))
}

fn copy_to<T: Scalar>(bytes: &[u8], out: &mut [T]) -> Result<(), Error> {
    let all = split::<T>(bytes)?;
    if all.len() != out.len() {
        let (count, found) = (to_u32(all.len()), to_u32(out.len()));
        return Err(Error::new(ErrorKind::Mismatch, COUNT, 0, count, found));
    }
    out.iter_mut().zip(all).for_each(|(out, wire)| *out = T::from_wire(*wire));
    Ok(())
}

/// The error for an index that is not less than `count`.
pub(super) fn beyond(count: usize, index: usize) -> Error {
    match to_u32(count).checked_sub(1) {
        Some(last) => Error::new(ErrorKind::OutOfRange, INDEX, 0, last, to_u32(index)),
        None => Error::new(ErrorKind::Missing, VALUE, 0, 0, 0),
    }
}

macro_rules! typed_reads {
    ($( $(#[$meta:meta])? [$($view:lifetime)?] $type:ty, [$($own:lifetime)?], |$this:ident| $bytes:expr, $checked:literal, $example:literal; )+) => { $(
        /// Numbers and BOOLEANs, decoded as a Rust type. A single number has index 0.
        ///
        /// Only the number of bytes is checked.
        #[doc = $checked]
        /// returns [`Elements`], whose methods `items`, `copy_to` and `to_vec` also check the type.
        ///
        /// ```
        #[doc = $example]
        /// assert_eq!(value.get::<i32>(1)?, 456);
        /// assert_eq!(value.iter::<i32>()?.sum::<i32>(), 789);
        /// let mut numbers = [0_i32; 2];
        /// value.copy_to(&mut numbers)?;
        /// assert_eq!(numbers, [333, 456]);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        $(#[$meta])?
        impl $(<$view>)? $type {
            /// The number at this index, from 0.
            ///
            /// # Errors
            /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if the number of bytes is not
            /// a multiple of the type's size,
            /// [`ErrorKind::OutOfRange`](crate::ErrorKind::OutOfRange) for an index after the last
            /// number, [`ErrorKind::Missing`](crate::ErrorKind::Missing) if there are no bytes.
            pub fn get<T: Scalar>(&self, index: usize) -> Result<T, Error> {
                get(&self.bytes, index)
            }

            /// Iterates over the numbers in order.
            ///
            /// # Errors
            /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if the number of bytes is not
            /// a multiple of the type's size.
            pub fn iter<$($own,)? T: Scalar>(
                &$($own)? self,
            ) -> Result<
                impl ExactSizeIterator<Item = T> + DoubleEndedIterator + Clone + use<$($view,)? $($own,)? T>,
                Error,
            > {
                let $this = self;
                Ok(split::<T>($bytes)?.iter().copied().map(T::from_wire))
            }

            /// Copies all numbers to `out`, whose length must equal the number of numbers.
            ///
            /// # Errors
            /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if the number of bytes is not
            /// a multiple of the type's size, [`ErrorKind::Mismatch`](crate::ErrorKind::Mismatch)
            /// for an `out` of a different length. On error, nothing is written.
            pub fn copy_to<T: Scalar>(&self, out: &mut [T]) -> Result<(), Error> {
                copy_to(&self.bytes, out)
            }

            /// Copies the numbers to a vector.
            ///
            /// # Errors
            /// [`ErrorKind::Truncated`](crate::ErrorKind::Truncated) if the number of bytes is not
            /// a multiple of the type's size.
            #[cfg(feature = "alloc")]
            pub fn to_vec<T: Scalar>(&self) -> Result<alloc::vec::Vec<T>, Error> {
                Ok(self.iter()?.collect())
            }
        }
    )+ };
}

typed_reads! {
    ['a] ValueRef<'a>, [], |value| value.bytes,
        "With the variable's description, [`DescriptionRef::elements`](crate::DescriptionRef::elements)",
        "let value = ads_cnc::ValueRef { bytes: &[77, 1, 0, 0, 200, 1, 0, 0] };";
    ['a] ContentRef<'a>, [], |content| content.bytes,
        "With the type of the object or element, [`Elements::new`]",
        "let value = ads_cnc::ContentRef { bytes: &[77, 1, 0, 0, 200, 1, 0, 0] };";
    #[cfg(feature = "alloc")]
    [] crate::Value, ['a], |value| &value.bytes,
        "With the variable's description, [`Description::elements`](crate::Description::elements)",
        "let value = ads_cnc::Value { bytes: vec![77, 1, 0, 0, 200, 1, 0, 0] };";
    #[cfg(feature = "alloc")]
    [] crate::Content, ['a], |content| &content.bytes,
        "With the type of the object or element, [`Elements::new`]",
        "let value = ads_cnc::Content { bytes: vec![77, 1, 0, 0, 200, 1, 0, 0] };";
}

/// Numbers and BOOLEANs, decoded as a Rust type, which must match the type of the elements.
///
/// ```
/// use ads_cnc::{Decode, DescriptionByNameRef, ValueRef};
///
/// // SGN32[2].
/// let bytes = b"\x02\0\0\x02\x06\0\0\0\x01\0\0\0\x08\0\0\0\x01\0\0\0\x02\0\0\0";
/// let description = DescriptionByNameRef::decode(bytes)?;
/// let value = ValueRef { bytes: &[77, 1, 0, 0, 200, 1, 0, 0] };
/// let elements = description.elements(&value)?;
/// assert_eq!(elements.items::<i32>()?.sum::<i32>(), 789);
/// assert!(elements.items::<f64>().is_err());
///
/// // An element of any number type, if `f64` represents the number exactly.
/// let first: f64 = elements.get(0)?.try_into()?;
/// assert_eq!(first, 333.0);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
impl<'a> Elements<'a> {
    /// Iterates over the elements in order.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for elements of a different type.
    pub fn items<T: Scalar>(
        &self,
    ) -> Result<impl ExactSizeIterator<Item = T> + DoubleEndedIterator + Clone + use<'a, T>, Error>
    {
        self.check::<T>()?;
        Ok(split::<T>(self.as_bytes())?.iter().copied().map(T::from_wire))
    }

    /// Copies all elements to `out`, whose length must equal the number of elements.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a different type or number of elements. On error, nothing is written.
    pub fn copy_to<T: Scalar>(&self, out: &mut [T]) -> Result<(), Error> {
        self.check::<T>()?;
        copy_to(self.as_bytes(), out)
    }

    /// Copies the elements to a vector.
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for elements of a different type.
    #[cfg(feature = "alloc")]
    pub fn to_vec<T: Scalar>(&self) -> Result<alloc::vec::Vec<T>, Error> {
        Ok(self.items()?.collect())
    }

    fn check<T: Scalar>(&self) -> Result<(), Error> {
        if self.data_type() == T::TYPE { Ok(()) } else { Err(mismatch(T::TYPE, self.data_type())) }
    }
}

pub(super) fn mismatch(expected: DataType, found: DataType) -> Error {
    Error::new(ErrorKind::Mismatch, TYPE, 0, expected.number(), found.number())
}

/// The error for a failed conversion of an element: to a number type that does not represent the
/// integer exactly, or from a wrong type.
fn unfit(expected: DataType, element: Element<'_>) -> Error {
    let Some(number) = integer(element) else {
        return mismatch(expected, element.data_type());
    };
    let [a, b, c, d, e, f, g, h, ..] = number.unsigned_abs().to_le_bytes();
    let [low, high] = [[a, b, c, d], [e, f, g, h]].map(u32::from_le_bytes);
    let field = if number < 0 { NEGATIVE } else { NUMBER };
    Error::new(ErrorKind::OutOfRange, field, high, expected.number(), low)
}

/// The number in an element of any integer type; `None` for an element of another type.
fn integer(element: Element<'_>) -> Option<i128> {
    Some(match element {
        Element::Sgn08(number) => number.into(),
        Element::Uns08(number) => number.into(),
        Element::Sgn16(number) => number.into(),
        Element::Uns16(number) => number.into(),
        Element::Sgn32(number) => number.into(),
        Element::Uns32(number) => number.into(),
        Element::Lint(number) => number.into(),
        Element::Lword(number) => number.into(),
        Element::Boolean(_) | Element::Real32(_) | Element::Real64(_) | Element::String(_) => {
            return None;
        }
    })
}

/// Implements the conversions to integers from elements of any integer type, by value.
macro_rules! from_integers {
    ($( $type:ty )+) => { $(
        /// Converts an element of any integer type, by its value.
        ///
        /// # Errors
        /// [`ErrorKind::Mismatch`] for an element that is not an integer; [`ErrorKind::OutOfRange`]
        /// for a number that does not fit: [`Error::expected`] is the number of this type in the
        /// table of [`DataType`], [`Error::found`] and [`Error::offset`] are the low and the high
        /// 32 bits of the absolute value.
        impl TryFrom<Element<'_>> for $type {
            type Error = Error;

            fn try_from(element: Element<'_>) -> Result<Self, Error> {
                integer(element)
                    .and_then(|number| number.try_into().ok())
                    .ok_or_else(|| unfit(<$type>::TYPE, element))
            }
        }
    )+ };
}

from_integers! { i8 u8 i16 u16 i32 u32 i64 u64 }

/// Implements the conversions to floating-point numbers, from floating-point numbers of at most the same
/// size and from integers that the significand represents exactly.
macro_rules! from_numbers {
    ($( $type:ty, $digits:literal, |$element:ident| $float:expr; )+) => { $(
        /// Converts a floating-point number of at most the same size, or an integer that this type
        /// represents exactly.
        ///
        /// # Errors
        /// [`ErrorKind::Mismatch`] for an element of any other type; [`ErrorKind::OutOfRange`] for an
        /// integer that cannot be represented exactly, with the same numbers as the conversions to
        /// integers.
        impl TryFrom<Element<'_>> for $type {
            type Error = Error;

            fn try_from($element: Element<'_>) -> Result<Self, Error> {
                if let Some(float) = $float {
                    return Ok(float);
                }
                let exact = integer($element).filter(|number| digits(*number) <= $digits);
                let Some(number) = exact else {
                    return Err(unfit(<$type>::TYPE, $element));
                };
                // No step rounds, because no partial sum has more significant digits than the number.
                let size = number.unsigned_abs().to_be_bytes().into_iter().fold(0.0, |size, byte| {
                    size * 256.0 + Self::from(byte)
                });
                Ok(if number < 0 { -size } else { size })
            }
        }
    )+ };
}

from_numbers! {
    f32, 24, |element| match element {
        Element::Real32(number) => Some(number),
        _ => None,
    };
    f64, 53, |element| match element {
        Element::Real64(number) => Some(number),
        Element::Real32(number) => Some(number.into()),
        _ => None,
    };
}

/// The number of binary digits from the first 1 to the last 1.
fn digits(number: i128) -> u32 {
    let size = number.unsigned_abs();
    u128::BITS.saturating_sub(size.leading_zeros()).saturating_sub(size.trailing_zeros())
}

/// Implements the conversions from elements of one type.
macro_rules! from_one {
    ($( $(#[$meta:meta])? $type:ty, $data_type:ident, $element:pat => $value:expr; )+) => { $(
        /// # Errors
        /// [`ErrorKind::Mismatch`] for an element of any other type.
        $(#[$meta])?
        impl<'a> TryFrom<Element<'a>> for $type {
            type Error = Error;

            fn try_from(element: Element<'a>) -> Result<Self, Error> {
                match element {
                    $element => Ok($value),
                    _ => Err(mismatch(DataType::$data_type, element.data_type())),
                }
            }
        }
    )+ };
}

from_one! {
    bool, Boolean, Element::Boolean(boolean) => boolean.is_true();
    TextRef<'a>, String, Element::String(text) => text;
    CncStr<'a>, String, Element::String(text) => text.text();
    #[cfg(feature = "alloc")]
    alloc::string::String, String, Element::String(text) => text.text().chars().collect();
}
