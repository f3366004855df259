//! Type, dimensions and size of a value.

use super::element::Elements;
use super::{DataType, EncodeValue};
use crate::bytes::{Writer, to_u32, to_usize};
use crate::error::{Error, ErrorKind};
use crate::layout::Subject;
use crate::layout::typed_value::{COUNT, DIMENSION, INDEX, INDEX_COUNT, SIZE, TYPE, VALUE};
use crate::text::{CncStr, TextRef};
use crate::variable::{U32List, VariableType};

/// Type, dimensions and size of a value, checked to be consistent (VAR-8).
///
/// A shape computes the index of an element, and checks values before they are written.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2. The example there shows that the size is
/// the size of the type times the number of elements.
///
/// ```
/// use ads_cnc::U32List;
/// use ads_cnc::value::{DataType, Shape};
///
/// let shape = Shape::new(DataType::Sgn32, U32List::from(&[2, 3]), 24)?;
/// assert_eq!(shape.index_of(U32List::from(&[1, 2]))?, 5);
/// assert_eq!(
///     shape.index_of(U32List::from(&[2, 0])).unwrap_err().to_string(),
///     "index 2 is out of range 0..=1"
/// );
/// assert_eq!(
///     Shape::new(DataType::Sgn32, U32List::from(&[2, 3]), 20).unwrap_err().to_string(),
///     "size: expected 24 bytes, found 20"
/// );
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape<'a> {
    data_type: DataType,
    dimensions: U32List<'a>,
    count: u32,
    each: u32,
}

impl<'a> Shape<'a> {
    /// The shape of a value of `size` bytes; for a single element, `dimensions` is empty.
    ///
    /// In an array of two or more STRINGs, all texts have the same number of bytes, at least one
    /// (assumed).
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a wrong size. [`Error::expected`] is the size of the elements
    /// or, for STRING, `size` rounded down to a multiple of the number of elements, but at least
    /// this number. It is `u32::MAX` if the size of the elements or, for STRING, their number
    /// exceeds 32 bits. [`Error::found`] is `size`.
    pub fn new(data_type: DataType, dimensions: U32List<'a>, size: u32) -> Result<Self, Error> {
        let mismatch = |expected| Err(Error::new(ErrorKind::Mismatch, SIZE, 0, expected, size));
        if let Some(each) = data_type.size() {
            return match Self::with_element_size(data_type, each, dimensions) {
                Some(shape) if shape.size() == size => Ok(shape),
                shape => mismatch(shape.map_or(u32::MAX, |shape| shape.size())),
            };
        }
        let Some(count) = count(dimensions) else {
            return mismatch(u32::MAX);
        };
        let each = match (count, size.checked_div(count), size.checked_rem(count)) {
            (0, ..) if size == 0 => 0,
            (1, ..) => size,
            (_, Some(each), Some(0)) if each > 0 => each,
            // Each text needs at least its NUL; a value without texts has no bytes.
            (.., left) => return mismatch(size.saturating_sub(left.unwrap_or(size)).max(count)),
        };
        Ok(Self { data_type, dimensions, count, each })
    }

    /// The shape of elements of a fixed size; `None` if the size of the value exceeds 32 bits.
    pub(super) fn with_element_size(
        data_type: DataType,
        each: u32,
        dimensions: U32List<'a>,
    ) -> Option<Self> {
        let count = count(dimensions)?;
        count.checked_mul(each).map(|_| Self { data_type, dimensions, count, each })
    }

    /// The shape of a variable, from its description.
    ///
    /// # Errors
    /// Those of [`new`](Self::new), and [`ErrorKind::OutOfRange`] for an undocumented
    /// type.
    pub fn for_variable(
        var_type: VariableType,
        dimensions: U32List<'a>,
        size: u32,
    ) -> Result<Self, Error> {
        Self::new(known(var_type)?, dimensions, size)
    }

    /// The shape of a single element that is read or written by its indices.
    pub fn element_shape(&self) -> Shape<'static> {
        Shape { data_type: self.data_type, dimensions: U32List::EMPTY, count: 1, each: self.each }
    }

    /// The type of the elements.
    pub const fn data_type(&self) -> DataType {
        self.data_type
    }

    /// The number of elements in each dimension; empty for a single element.
    pub const fn dimensions(&self) -> U32List<'a> {
        self.dimensions
    }

    /// The number of elements: the product of the dimensions.
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// The size of one element in bytes; for a single STRING, the maximum size including its NUL.
    pub const fn element_size(&self) -> u32 {
        self.each
    }

    /// The size of the whole value in bytes.
    pub const fn size(&self) -> u32 {
        self.count.saturating_mul(self.each)
    }

    /// The index of an element in the flat array, from 0; the last of `indices` varies fastest (VAR-21,
    /// assumed).
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] if the number of indices is not the number of dimensions;
    /// [`ErrorKind::OutOfRange`] for an index outside its dimension; [`ErrorKind::Missing`] for a
    /// dimension of 0, which has no elements. The offset of the last two errors is the position of the
    /// dimension, from 0.
    pub fn index_of(&self, indices: U32List<'_>) -> Result<u32, Error> {
        index_of(indices, self.dimensions)
    }

    /// The elements of a value of this shape.
    ///
    /// A single STRING may have any length, because the length of the reply for a STRING is not
    /// documented (VAR-25).
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`] and [`ErrorKind::Trailing`] for any other value of a different
    /// size.
    pub fn elements(&self, bytes: &'a [u8]) -> Result<Elements<'a>, Error> {
        if self.data_type == DataType::String && self.count == 1 {
            return Elements::new(self.data_type, self.dimensions, bytes);
        }
        let (size, given) = (self.size(), to_u32(bytes.len()));
        if to_usize(size) == bytes.len() {
            return Ok(Elements { shape: *self, bytes });
        }
        if given < size {
            Err(Error::new(ErrorKind::Truncated, VALUE, 0, size, given))
        } else {
            Err(Error::new(ErrorKind::Trailing, VALUE, size, size, given))
        }
    }

    /// Encodes a value of this shape to the front of `buf`, for a request or as content.
    ///
    /// A [`TextRef`] is written with the end that it contains, a [`CncStr`] with one NUL. A single
    /// STRING may be shorter than the size of the shape.
    ///
    /// ```
    /// use ads_cnc::value::{DataType, Shape};
    /// use ads_cnc::{CncStr, U32List};
    ///
    /// // A STRING has 21 bytes by default.
    /// let shape = Shape::new(DataType::String, U32List::EMPTY, 21)?;
    /// assert_eq!(shape.encode(&CncStr::new("abc")?, &mut [0; 21])?, b"abc\0");
    /// assert_eq!(
    ///     shape.encode(&CncStr::new("a text of 21 letters.")?, &mut [0; 64]).unwrap_err().to_string(),
    ///     "typed-value: value at offset 0: too long, expected at most 21 bytes, found 22"
    /// );
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Mismatch`] for a different type or number of elements, or a different size of
    /// an array of STRING; [`ErrorKind::TooLong`] for a single STRING that is too long; and those
    /// of [`EncodeValue::encode_value`]. The limits of a request are checked when the request is
    /// encoded.
    pub fn encode<'b, V: EncodeValue + ?Sized>(
        &self,
        value: &V,
        buf: &'b mut [u8],
    ) -> Result<&'b [u8], Error> {
        let mismatch = |field, expected, found| {
            Err(Error::new(ErrorKind::Mismatch, field, 0, expected, found))
        };
        let given = value.data_type();
        if given != self.data_type {
            return mismatch(TYPE, self.data_type.number(), given.number());
        }
        self.check_count(value.element_count())?;
        let len = to_u32(value.value_len());
        match self.data_type {
            DataType::String if self.count == 1 => self.check_text(len, 0)?,
            DataType::String if len != self.size() => return mismatch(SIZE, self.size(), len),
            _ => {}
        }
        value.encode_value(buf)
    }

    /// Encodes texts, each with its NUL. If there are several texts, each is padded with NULs to
    /// the size of an element (assumed); a single text is not padded.
    ///
    /// ```
    /// use ads_cnc::value::{DataType, Shape};
    /// use ads_cnc::{CncStr, U32List};
    ///
    /// let shape = Shape::new(DataType::String, U32List::from(&[2]), 8)?;
    /// let texts = [CncStr::new("abc")?, CncStr::new("d")?];
    /// assert_eq!(shape.encode_texts(&texts, &mut [0; 8])?, b"abc\0d\0\0\0");
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`encode`](Self::encode). For a text that is too long, the offset of the error is the
    /// offset of the text in the value, in bytes.
    pub fn encode_texts<'b>(
        &self,
        texts: &[CncStr<'_>],
        buf: &'b mut [u8],
    ) -> Result<&'b [u8], Error> {
        if let [text] = texts {
            return self.encode(text, buf);
        }
        if self.data_type != DataType::String {
            let (expected, found) = (self.data_type.number(), DataType::String.number());
            return Err(Error::new(ErrorKind::Mismatch, TYPE, 0, expected, found));
        }
        self.check_count(texts.len())?;
        let mut at = 0_u32;
        for text in texts {
            self.check_text(to_u32(text.len()).saturating_add(1), at)?;
            at = at.saturating_add(self.each);
        }
        Writer::fill(Subject::TypedValue, to_usize(self.size()), buf, |out| {
            for text in texts {
                TextRef::from(*text).write(out);
                let room = to_usize(self.each).saturating_sub(text.len()).saturating_sub(1);
                (0..room).for_each(|_| out.put(&[0]));
            }
        })
    }

    fn check_count(&self, given: usize) -> Result<(), Error> {
        match to_u32(given) {
            given if given == self.count => Ok(()),
            given => Err(Error::new(ErrorKind::Mismatch, COUNT, 0, self.count, given)),
        }
    }

    fn check_text(&self, len: u32, at: u32) -> Result<(), Error> {
        if len > self.each {
            Err(Error::new(ErrorKind::TooLong, VALUE, at, self.each, len))
        } else {
            Ok(())
        }
    }
}

/// The type with the code of a variable; an error if the code is not documented.
pub(super) fn known(var_type: VariableType) -> Result<DataType, Error> {
    var_type.data_type().ok_or_else(|| {
        let bound = VariableType::STRING.0.min(var_type.0.max(VariableType::BOOLEAN.0));
        Error::new(ErrorKind::OutOfRange, TYPE, 0, bound, var_type.0)
    })
}

/// The product of the dimensions; `None` if it exceeds 32 bits.
fn count(dimensions: U32List<'_>) -> Option<u32> {
    // If a dimension is 0, the product is 0, even if the product of the other dimensions exceeds 32 bits.
    if dimensions.iter().any(|dimension| dimension == 0) {
        return Some(0);
    }
    dimensions.iter().try_fold(1, u32::checked_mul)
}

/// The implementation of [`Shape::index_of`].
fn index_of(indices: U32List<'_>, dimensions: U32List<'_>) -> Result<u32, Error> {
    let (given, expected) = (to_u32(indices.len()), to_u32(dimensions.len()));
    if given != expected {
        return Err(Error::new(ErrorKind::Mismatch, INDEX_COUNT, 0, expected, given));
    }
    let mut found = 0_u32;
    for (at, (index, dimension)) in (0_u32..).zip(indices.iter().zip(dimensions.iter())) {
        let Some(last) = dimension.checked_sub(1) else {
            return Err(Error::new(ErrorKind::Missing, DIMENSION, at, 0, 0));
        };
        if index > last {
            return Err(Error::new(ErrorKind::OutOfRange, INDEX, at, last, index));
        }
        found = found.saturating_mul(dimension).saturating_add(index);
    }
    Ok(found)
}
