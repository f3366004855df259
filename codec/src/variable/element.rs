//! The elements of a value, typed by the variable's description.

use super::{Numbers, ValueRef, VariableType};
use crate::bytes::to_u32;
use crate::error::{Error, ErrorKind};
use crate::layout::field::variable_description;
use crate::layout::field::variable_value::VALUE;
use crate::text::TextRef;

/// One element of a value.
///
/// Manual: `ads-en` 1.05 and `ads-de` 1.051, section 4.3.2; sizes of the types: GEN-5.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Element<'a> {
    /// One byte; 0 is FALSE, any other TRUE.
    Boolean(u8),
    /// Signed, one byte.
    Sgn08(i8),
    /// Unsigned, one byte.
    Uns08(u8),
    /// Signed, two bytes.
    Sgn16(i16),
    /// Unsigned, two bytes.
    Uns16(u16),
    /// Signed, four bytes.
    Sgn32(i32),
    /// Unsigned, four bytes.
    Uns32(u32),
    /// IEEE 754 binary64.
    Real64(f64),
    /// Text to its first NUL or to the end of the reply (VAR-22).
    String(TextRef<'a>),
}

/// The elements of a value in their order: of more than one dimension, the last index runs
/// fastest (VAR-21, assumed).
#[derive(Clone, Debug)]
pub struct Elements<'a> {
    bytes: &'a [u8],
    var_type: VariableType,
}

impl<'a> ValueRef<'a> {
    /// The elements of a value of this type and these dimensions; none for a single element.
    ///
    /// A STRING is one element whatever its dimensions: how long each text of an array is, is not
    /// documented.
    ///
    /// ```
    /// use ads_cnc::{Decode, Element, Numbers, ValueRef, VariableType};
    ///
    /// let value = ValueRef::decode(&[77, 1, 0, 0, 200, 1, 0, 0])?;
    /// let mut elements = value.elements(VariableType::SGN32, Numbers::from(&[2]))?;
    /// assert_eq!(elements.next(), Some(Element::Sgn32(333)));
    /// assert_eq!(elements.next(), Some(Element::Sgn32(456)));
    /// assert_eq!(elements.next(), None);
    /// # Ok::<(), ads_cnc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Truncated`] and [`ErrorKind::Trailing`] for a value that has not just the size
    /// of its elements, [`ErrorKind::OutOfRange`] for a type the manuals do not have.
    pub fn elements(
        &self,
        var_type: VariableType,
        dimensions: Numbers<'_>,
    ) -> Result<Elements<'a>, Error> {
        let elements = Elements { bytes: self.bytes, var_type };
        if var_type == VariableType::STRING {
            return Ok(elements);
        }
        let Some(size) = var_type.element_size() else {
            let bound = VariableType::STRING.0.min(var_type.0.max(VariableType::BOOLEAN.0));
            let field = variable_description::TYPE;
            return Err(Error::new(ErrorKind::OutOfRange, field, 4, bound, var_type.0));
        };
        let size = dimensions.iter().fold(size, u32::saturating_mul);
        match to_u32(self.bytes.len()) {
            given if given < size => Err(Error::new(ErrorKind::Truncated, VALUE, 0, size, given)),
            given if given > size => Err(Error::new(ErrorKind::Trailing, VALUE, size, size, given)),
            _ => Ok(elements),
        }
    }
}

impl<'a> Elements<'a> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.bytes.split_first_chunk()?;
        self.bytes = rest;
        Some(*bytes)
    }
}

impl<'a> Iterator for Elements<'a> {
    type Item = Element<'a>;

    fn next(&mut self) -> Option<Element<'a>> {
        Some(match self.var_type {
            VariableType::BOOLEAN => Element::Boolean(u8::from_le_bytes(self.take()?)),
            VariableType::SGN08 => Element::Sgn08(i8::from_le_bytes(self.take()?)),
            VariableType::UNS08 => Element::Uns08(u8::from_le_bytes(self.take()?)),
            VariableType::SGN16 => Element::Sgn16(i16::from_le_bytes(self.take()?)),
            VariableType::UNS16 => Element::Uns16(u16::from_le_bytes(self.take()?)),
            VariableType::SGN32 => Element::Sgn32(i32::from_le_bytes(self.take()?)),
            VariableType::UNS32 => Element::Uns32(u32::from_le_bytes(self.take()?)),
            VariableType::REAL64 => Element::Real64(f64::from_le_bytes(self.take()?)),
            _ => {
                // The text is all there is; a type without a name does not get here.
                let text = core::mem::take(&mut self.bytes);
                self.var_type = VariableType::UNS08;
                Element::String(TextRef::split(text))
            }
        })
    }
}

impl Element<'_> {
    /// The element's type.
    pub const fn var_type(&self) -> VariableType {
        match self {
            Self::Boolean(_) => VariableType::BOOLEAN,
            Self::Sgn08(_) => VariableType::SGN08,
            Self::Uns08(_) => VariableType::UNS08,
            Self::Sgn16(_) => VariableType::SGN16,
            Self::Uns16(_) => VariableType::UNS16,
            Self::Sgn32(_) => VariableType::SGN32,
            Self::Uns32(_) => VariableType::UNS32,
            Self::Real64(_) => VariableType::REAL64,
            Self::String(_) => VariableType::STRING,
        }
    }
}
