//! Encoding of values.

use zerocopy::IntoBytes as _;

use super::{DataType, Element, Elements};
use crate::bytes::{Writer, to_u32};
use crate::error::{Error, ErrorKind};
use crate::layout::typed_value::VALUE;
use crate::layout::{ADS_DATA, Subject};
use crate::text::{CncStr, TextRef};

/// A value that can be encoded: a number, a `bool` or [`Boolean`](super::Boolean), a slice or an array
/// of these, a text ([`CncStr`] or [`TextRef`]), an [`Element`] or [`Elements`].
///
/// The bytes are the value in a request, or the content of an object or element. A [`CncStr`] is
/// written with one NUL, a [`TextRef`] with the end that it contains.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.6 and 4.3.7.
///
/// ```
/// use ads_cnc::address::Channel;
/// use ads_cnc::operation::{Operation, WriteByName};
/// use ads_cnc::value::EncodeValue;
///
/// // The example in section 4.3.7, which does not print the type.
/// let mut room = [0; 20];
/// let value = [123, 234, 345, 456, 567].encode_value(&mut room)?;
/// let op = WriteByName::new(Channel::new(1)?, "V.E.test", value)?;
/// assert_eq!(op.encode(&mut [0; 32])?[..13], *b"V.E.test\0\x7b\0\0\0");
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[diagnostic::on_unimplemented(
    note = "values are numbers, `bool`, slices and arrays of these, `CncStr`, `TextRef`, `Element` and `Elements`",
    note = "write a structure of your own member by member"
)]
pub trait EncodeValue: sealed::Sealed {
    /// The type of the elements.
    fn data_type(&self) -> DataType;

    /// The number of elements.
    fn element_count(&self) -> usize;

    /// The number of bytes that [`encode_value`](Self::encode_value) writes.
    fn value_len(&self) -> usize;

    /// Writes the value to the front of `buf` and returns the bytes written.
    ///
    /// This does not check the type or the number of elements against a description: see
    /// [`Shape::encode`](super::Shape::encode). The encoder of a request checks the limits of the
    /// request: a value has at most 2040 bytes in a request by handle, and 2047 in a request by
    /// name.
    ///
    /// # Errors
    /// [`ErrorKind::BufferTooSmall`], and [`ErrorKind::TooLong`] for a value of more than
    /// [`ADS_DATA_MAX`](crate::limits::ADS_DATA_MAX) bytes. On error, nothing is written.
    fn encode_value<'b>(&self, buf: &'b mut [u8]) -> Result<&'b [u8], Error>;

    /// Encodes the value into a new vector.
    ///
    /// # Errors
    /// [`ErrorKind::TooLong`], as for [`encode_value`](Self::encode_value).
    #[cfg(feature = "alloc")]
    fn value_to_vec(&self) -> Result<alloc::vec::Vec<u8>, Error> {
        check(self.value_len())?;
        let mut bytes = alloc::vec![0; self.value_len()];
        self.encode_value(&mut bytes)?;
        Ok(bytes)
    }
}

pub(super) mod sealed {
    pub trait Sealed {}
}

fn check(len: usize) -> Result<(), Error> {
    match to_u32(len) {
        len if len > ADS_DATA => Err(Error::new(ErrorKind::TooLong, VALUE, 0, ADS_DATA, len)),
        _ => Ok(()),
    }
}

/// Writes exactly `len` bytes, or returns an error and writes nothing.
fn fill(len: usize, buf: &mut [u8], write: impl FnOnce(&mut Writer<'_>)) -> Result<&[u8], Error> {
    check(len)?;
    Writer::fill(Subject::TypedValue, len, buf, write)
}

/// Implements [`EncodeValue`]. An entry has a Rust type, its data type, element count, length and encoding.
macro_rules! encode_value {
    ($(
        $(#[$doc:meta])*
        $(@$item:ident $(; $n:ident)?)? $form:ty, |$value:ident| $data_type:expr, $count:expr, $len:expr,
        |$buf:ident| $encode:expr;
    )+) => { $(
        impl $(<$item: super::Scalar $(, const $n: usize)?>)? sealed::Sealed for $form {}

        $(#[$doc])*
        #[allow(unused_variables, reason = "the type alone can determine the result")]
        impl $(<$item: super::Scalar $(, const $n: usize)?>)? EncodeValue for $form {
            fn data_type(&self) -> DataType {
                let $value = self;
                $data_type
            }

            fn element_count(&self) -> usize {
                let $value = self;
                $count
            }

            fn value_len(&self) -> usize {
                let $value = self;
                $len
            }

            fn encode_value<'b>(
                &self,
                $buf: &'b mut [u8],
            ) -> Result<&'b [u8], Error> {
                let $value = self;
                $encode
            }
        }
    )+ };
}

encode_value! {
    /// Encodes one number or BOOLEAN.
    @T T, |item| T::TYPE, 1, size_of::<T::Wire>(),
    |buf| fill(item.value_len(), buf, |out| out.put(item.to_wire().as_bytes()));
    /// Encodes the numbers in the order of the slice; in an array with several dimensions, the last
    /// index varies fastest (VAR-21, assumed).
    @T [T], |items| T::TYPE, items.len(), items.len().saturating_mul(size_of::<T::Wire>()),
    |buf| fill(items.value_len(), buf, |out| {
        items.iter().for_each(|item| out.put(item.to_wire().as_bytes()));
    });
    /// Encodes an array like the slice of its elements.
    @T; N [T; N], |items| T::TYPE, N, items.as_slice().value_len(),
    |buf| items.as_slice().encode_value(buf);
    /// Encodes the text and one NUL.
    CncStr<'_>, |text| DataType::String, 1, text.len().saturating_add(1),
    |buf| fill(text.value_len(), buf, |out| TextRef::from(*text).write(out));
    /// Encodes the text and its end.
    TextRef<'_>, |text| DataType::String, 1, text.field_len(),
    |buf| fill(text.value_len(), buf, |out| text.write(out));
    /// Encodes the bytes of the elements.
    Elements<'_>, |elements| Elements::data_type(elements), elements.len(),
    elements.as_bytes().len(),
    |buf| fill(elements.value_len(), buf, |out| out.put(elements.as_bytes()));
    /// Encodes the number, or the text with its end.
    Element<'_>, |element| Element::data_type(element), 1,
    element.len(),
    |buf| element.write(buf);
}
