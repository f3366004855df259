//! Elements of a type that is known only at run time.

use core::fmt;
use core::iter::FusedIterator;
use core::ops::Range;

use zerocopy::FromBytes as _;

use super::scalar::numbers;
use super::typed::beyond;
use super::{DataType, EncodeValue as _, Scalar, Shape};
use crate::bytes::{to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::typed_value::VALUE;
use crate::text::TextRef;
use crate::variable::U32List;

/// Declares [`Element`] for the types of fixed size and STRING.
macro_rules! element {
    ($( $variant:ident: $number:ty; )+) => {
        /// One element of a value.
        ///
        /// `TryFrom` converts an element:
        ///
        /// | from | to |
        /// |---|---|
        /// | an integer of any type | `i8` … `u64` by its value, if it fits; `f32`, `f64` if it is exact |
        /// | REAL32 | `f32`, `f64` |
        /// | REAL64 | `f64` |
        /// | BOOLEAN | `bool` |
        /// | STRING | [`TextRef`], [`CncStr`](crate::CncStr) and, with `alloc`, `String` |
        ///
        /// There are no other conversions: no REAL32 or REAL64 to an integer, no REAL64 to `f32`, no
        /// BOOLEAN to a number, no number to `bool`.
        ///
        /// ```
        /// use ads_cnc::{Element, ErrorKind};
        ///
        /// assert_eq!(u8::try_from(Element::Sgn32(200))?, 200);
        /// let error = u8::try_from(Element::Sgn32(300)).unwrap_err();
        /// assert_eq!((error.kind(), error.to_string()), (ErrorKind::OutOfRange, "300 does not fit UNS08".into()));
        /// let error = u8::try_from(Element::Real64(200.0)).unwrap_err();
        /// assert_eq!(error.to_string(), "expected UNS08, found REAL64");
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        ///
        /// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2; sizes of the types: GEN-5.
        ///
        /// ```
        /// use ads_cnc::U32List;
        /// use ads_cnc::value::{Boolean, DataType, Element, Elements};
        ///
        /// // Two BOOLEANs, as in the value of V.E.Variable_3.
        /// let elements = Elements::new(DataType::Boolean, U32List::from(&[2]), &[0, 1])?;
        /// let second = elements.element(U32List::from(&[1]))?;
        /// assert_eq!(second, Element::Boolean(Boolean::TRUE));
        /// assert_eq!((second.data_type(), second.to_string()), (DataType::Boolean, "TRUE".into()));
        /// assert!(bool::try_from(second)?);
        /// # Ok::<(), ads_cnc::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[non_exhaustive]
        pub enum Element<'a> {
            $(
                #[doc = concat!("A value of the type [`DataType::", stringify!($variant), "`].")]
                $variant($number),
            )+
            /// Text up to its first NUL or to the end of its bytes (VAR-22, assumed), and the bytes
            /// after the NUL.
            String(TextRef<'a>),
        }

        impl<'a> Element<'a> {
            /// The type of the element.
            pub const fn data_type(&self) -> DataType {
                match self {
                    $( Self::$variant(_) => DataType::$variant, )+
                    Self::String(_) => DataType::String,
                }
            }

            /// Decodes an element from exactly these bytes.
            fn read(data_type: DataType, bytes: &'a [u8]) -> Option<Self> {
                Some(match data_type {
                    $( DataType::$variant => Self::$variant(read(bytes)?), )+
                    DataType::String => Self::String(TextRef::split(bytes)),
                })
            }

            pub(super) fn len(&self) -> usize {
                match self {
                    $( Self::$variant(number) => number.value_len(), )+
                    Self::String(text) => text.value_len(),
                }
            }

            pub(super) fn write<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error> {
                match self {
                    $( Self::$variant(number) => number.encode_value(buf), )+
                    Self::String(text) => text.encode_value(buf),
                }
            }
        }

        /// Displays a number, TRUE or FALSE for a BOOLEAN, or a text without its end.
        impl fmt::Display for Element<'_> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $( Self::$variant(number) => number.fmt(f), )+
                    Self::String(text) => text.fmt(f),
                }
            }
        }
    };
}

numbers!(element!);

/// The elements of a value, accessed by their indices or in order. With more than one dimension, the
/// last index varies fastest (VAR-21, assumed).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.2 and 4.3.4 … 4.3.7.
///
/// ```
/// use ads_cnc::U32List;
/// use ads_cnc::value::{DataType, Element, Elements};
///
/// let elements = Elements::new(DataType::Uns16, U32List::from(&[2, 2]), &[1, 0, 2, 0, 3, 0, 4, 0])?;
/// assert_eq!(elements.element(U32List::from(&[0, 1]))?, Element::Uns16(2));
/// assert_eq!(elements.iter().last(), Some(Element::Uns16(4)));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Elements<'a> {
    pub(super) shape: Shape<'a>,
    pub(super) bytes: &'a [u8],
}

impl<'a> Elements<'a> {
    /// The elements of a value with this type and these dimensions; for a single element,
    /// `dimensions` is empty.
    ///
    /// In an array of STRING, all texts have the same number of bytes (assumed).
    ///
    /// # Errors
    /// For a type of fixed size, [`ErrorKind::Truncated`] and [`ErrorKind::Trailing`] if the number
    /// of bytes is not the size of the elements. For STRING, [`ErrorKind::Mismatch`] if the bytes
    /// of several texts cannot be divided equally among them, with at least one byte for each text,
    /// or if there are bytes but no texts.
    pub fn new(
        data_type: DataType,
        dimensions: U32List<'a>,
        bytes: &'a [u8],
    ) -> Result<Self, Error> {
        let found = to_u32(bytes.len());
        match data_type.size() {
            None => Ok(Self { shape: Shape::new(data_type, dimensions, found)?, bytes }),
            Some(each) => match Shape::with_element_size(data_type, each, dimensions) {
                Some(shape) => shape.elements(bytes),
                None => Err(Error::new(ErrorKind::Truncated, VALUE, 0, u32::MAX, found)),
            },
        }
    }

    /// The type, dimensions and size of the value.
    pub const fn shape(&self) -> Shape<'a> {
        self.shape
    }

    /// The type of the elements.
    pub const fn data_type(&self) -> DataType {
        self.shape.data_type()
    }

    /// The number of elements.
    pub fn len(&self) -> usize {
        to_usize(self.shape.count())
    }

    /// Whether the array is empty: one of its dimensions is 0.
    pub fn is_empty(&self) -> bool {
        self.shape.count() == 0
    }

    /// The element at this index, from 0, in the order of [`iter`](Self::iter).
    ///
    /// # Errors
    /// [`ErrorKind::OutOfRange`] for an index after the last element, and [`ErrorKind::Missing`] if
    /// there are no elements.
    pub fn get(&self, index: usize) -> Result<Element<'a>, Error> {
        self.at(index).ok_or_else(|| beyond(self.len(), index))
    }

    fn at(&self, index: usize) -> Option<Element<'a>> {
        if index >= self.len() {
            return None;
        }
        let each = to_usize(self.shape.element_size());
        let bytes = self.bytes.get(index.checked_mul(each)?..)?.get(..each)?;
        Element::read(self.data_type(), bytes)
    }

    /// The element with these indices.
    ///
    /// # Errors
    /// Those of [`Shape::index_of`].
    pub fn element(&self, indices: U32List<'_>) -> Result<Element<'a>, Error> {
        self.get(to_usize(self.shape.index_of(indices)?))
    }

    /// Iterates over the elements in order.
    pub fn iter(&self) -> ElementIter<'a> {
        ElementIter { elements: *self, indices: 0..self.len() }
    }

    /// The bytes of the value.
    pub const fn as_bytes(&self) -> &'a [u8] {
        self.bytes
    }
}

fn read<T: Scalar>(bytes: &[u8]) -> Option<T> {
    T::Wire::read_from_bytes(bytes).ok().map(T::from_wire)
}

impl fmt::Debug for Elements<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

/// An iterator over the elements of a value.
///
/// ```
/// use ads_cnc::U32List;
/// use ads_cnc::value::{DataType, Element, Elements};
///
/// let bytes = [123_i32, 234, 345].map(i32::to_le_bytes).concat();
/// let elements = Elements::new(DataType::Sgn32, U32List::from(&[3]), &bytes)?;
/// assert_eq!(elements.iter().last(), Some(Element::Sgn32(345)));
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ElementIter<'a> {
    elements: Elements<'a>,
    indices: Range<usize>,
}

impl<'a> Iterator for ElementIter<'a> {
    type Item = Element<'a>;

    fn next(&mut self) -> Option<Element<'a>> {
        self.elements.at(self.indices.next()?)
    }

    fn nth(&mut self, ahead: usize) -> Option<Element<'a>> {
        self.elements.at(self.indices.nth(ahead)?)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.indices.size_hint()
    }
}

impl DoubleEndedIterator for ElementIter<'_> {
    fn next_back(&mut self) -> Option<Self::Item> {
        self.elements.at(self.indices.next_back()?)
    }
}

impl ExactSizeIterator for ElementIter<'_> {
    fn len(&self) -> usize {
        self.indices.len()
    }
}

impl FusedIterator for ElementIter<'_> {}

impl<'a> IntoIterator for Elements<'a> {
    type Item = Element<'a>;
    type IntoIter = ElementIter<'a>;

    fn into_iter(self) -> ElementIter<'a> {
        self.iter()
    }
}
