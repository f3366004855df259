//! Owned values.

use alloc::vec::Vec;

use super::encode::encode_value;
use super::{Boolean, DataType, Elements, EncodeValue as _, Item, Strings, StringsRef};

/// All elements of a value, owned: those of more than one dimension with the last index running
/// fastest (VAR-21, assumed).
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, sections 4.3.4 … 4.3.7.
///
/// ```
/// use ads_cnc::Numbers;
/// use ads_cnc::value::{DataType, Elements, EncodeValue, Values};
///
/// let elements = Elements::new(DataType::Sgn16, Numbers::from(&[2]), &[1, 0, 0xFE, 0xFF])?;
/// let values = Values::from(elements);
/// assert_eq!(values, Values::Sgn16(vec![1, -2]));
/// assert_eq!(values.value_to_vec()?, [1, 0, 0xFE, 0xFF]);
/// # Ok::<(), ads_cnc::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Values {
    /// One byte; 0 is FALSE, any other TRUE.
    Boolean(Vec<Boolean>),
    /// Signed, one byte.
    Sgn08(Vec<i8>),
    /// Unsigned, one byte.
    Uns08(Vec<u8>),
    /// Signed, two bytes.
    Sgn16(Vec<i16>),
    /// Unsigned, two bytes.
    Uns16(Vec<u16>),
    /// Signed, four bytes.
    Sgn32(Vec<i32>),
    /// Unsigned, four bytes.
    Uns32(Vec<u32>),
    /// Signed, eight bytes; of objects only.
    Lint(Vec<i64>),
    /// Unsigned, eight bytes; of objects only.
    Lword(Vec<u64>),
    /// IEEE 754 binary32; not of variables.
    Real32(Vec<f32>),
    /// IEEE 754 binary64.
    Real64(Vec<f64>),
    /// CP1252 texts and what follows their NULs.
    String(Strings),
}

/// Does the same with the numbers, whatever they are, and another thing with texts.
macro_rules! each {
    ($values:ident, $items:ident => $do:expr, $texts:ident => $with_texts:expr) => {
        match $values {
            Values::Boolean($items) => $do,
            Values::Sgn08($items) => $do,
            Values::Uns08($items) => $do,
            Values::Sgn16($items) => $do,
            Values::Uns16($items) => $do,
            Values::Sgn32($items) => $do,
            Values::Uns32($items) => $do,
            Values::Lint($items) => $do,
            Values::Lword($items) => $do,
            Values::Real32($items) => $do,
            Values::Real64($items) => $do,
            Values::String($texts) => $with_texts,
        }
    };
}

impl Values {
    /// The type of the elements.
    pub fn data_type(&self) -> DataType {
        each!(self, items => items.as_slice().data_type(), texts => texts.as_ref().data_type())
    }

    /// How many.
    pub fn len(&self) -> usize {
        each!(self, items => items.len(), texts => texts.as_ref().len())
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl From<Elements<'_>> for Values {
    fn from(elements: Elements<'_>) -> Self {
        match elements.data_type() {
            DataType::Boolean => Self::Boolean(numbers(elements)),
            DataType::Sgn08 => Self::Sgn08(numbers(elements)),
            DataType::Uns08 => Self::Uns08(numbers(elements)),
            DataType::Sgn16 => Self::Sgn16(numbers(elements)),
            DataType::Uns16 => Self::Uns16(numbers(elements)),
            DataType::Sgn32 => Self::Sgn32(numbers(elements)),
            DataType::Uns32 => Self::Uns32(numbers(elements)),
            DataType::Lint => Self::Lint(numbers(elements)),
            DataType::Lword => Self::Lword(numbers(elements)),
            DataType::Real32 => Self::Real32(numbers(elements)),
            DataType::Real64 => Self::Real64(numbers(elements)),
            DataType::String => Self::String(StringsRef::of(elements).into()),
        }
    }
}

/// The numbers of elements that are of this type.
fn numbers<T: Item>(elements: Elements<'_>) -> Vec<T> {
    elements.items().map(|items| items.to_vec()).unwrap_or_default()
}

encode_value! {
    /// All elements as they are.
    Values, |values| Values::data_type(values), Values::len(values),
    each!(values, items => items.as_slice().value_len(), texts => texts.as_ref().value_len()),
    |buf| each!(
        values, items => items.as_slice().encode_value(buf), texts => texts.as_ref().encode_value(buf)
    );
}
