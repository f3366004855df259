//! Typed values: parses and formats them by a type, for example that in the description of a
//! variable, in the descriptor of an object or in the attributes of an element.

mod json;
mod parse;
mod show;

pub use json::{JSON_DIMENSIONS_MAX, value_of};
pub use parse::{InvalidValue, parse};
pub(crate) use show::{element_label, number};
pub use show::{lines, plain, printable};

use std::fmt;

use ads_cnc::value::{DataType, Shape};
use ads_cnc::{CncStr, Elements, Error, U32List, VariableType};

use crate::text::{escape, plural};

/// The bytes of a STRING before the first NUL.
pub(crate) fn until_nul(value: &[u8]) -> &[u8] {
    value.split(|&byte| byte == 0).next().unwrap_or_default()
}

/// The type of a value: name, data type, dimensions and size, as far as known.
///
/// ```
/// use ads_cnc::value::DataType;
/// use ads_cnc_conformance::values::{Type, parse, plain};
///
/// let ty = Type::known(DataType::Sgn16, vec![3]);
/// assert_eq!(ty.to_string(), "SGN16[3]");
/// let bytes = parse(&ty, "1,-2,0x10").unwrap();
/// assert_eq!(bytes, [1, 0, 0xFE, 0xFF, 0x10, 0]);
/// assert_eq!(plain(&ty, &bytes).as_deref(), Some("1,-2,16"));
/// assert_eq!(
///     parse(&ty, "1,2,40000").unwrap_err().to_string(),
///     "40000 is not of type SGN16, whose range is -32768 to 32767"
/// );
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Type {
    /// The name of the type, as the CNC or the codec states it, or `type` with the number of a type
    /// that the manuals do not define; empty if nothing is known about the type.
    pub name: String,
    /// The data type, if the manuals define the type.
    pub data_type: Option<DataType>,
    /// Number of elements in each dimension; empty for a single element.
    pub dimensions: Vec<u32>,
    /// Size of the whole value in bytes, if known.
    pub size: Option<u32>,
}

impl Type {
    /// An unknown type.
    pub const UNKNOWN: Self =
        Self { name: String::new(), data_type: None, dimensions: Vec::new(), size: None };

    /// The type in a variable's description.
    pub fn of_variable(var_type: VariableType, dimensions: U32List<'_>, size: u32) -> Self {
        let data_type = var_type.data_type();
        let name = match data_type {
            Some(known) => known.name().to_owned(),
            None => format!("type {}", var_type.0),
        };
        Self { name, data_type, dimensions: dimensions.iter().collect(), size: Some(size) }
    }

    /// The type of the content of an object or an element, from the name of the type and the size
    /// of the content in bytes. It is an array if the size of the content is twice the size of the
    /// type, or a larger multiple.
    pub fn of_content(name: CncStr<'_>, size: u32) -> Self {
        let data_type = DataType::by_name(name);
        let ty =
            Self { name: name.to_string(), data_type, dimensions: Vec::new(), size: Some(size) };
        ty.fitted(size)
    }

    /// A known data type with dimensions.
    pub fn known(data_type: DataType, dimensions: Vec<u32>) -> Self {
        let count = dimensions.iter().try_fold(1_u32, |count, &len| count.checked_mul(len));
        let size = data_type.size().zip(count).and_then(|(each, count)| each.checked_mul(count));
        Self { name: data_type.name().to_owned(), data_type: Some(data_type), dimensions, size }
    }

    /// A known data type whose dimensions and size are unknown.
    pub fn hinted(data_type: DataType) -> Self {
        let name = data_type.name().to_owned();
        Self { name, data_type: Some(data_type), dimensions: Vec::new(), size: None }
    }

    /// Makes a type without dimensions an array if the length of the value in bytes is twice the
    /// size of an element, or a larger multiple. Also sets the size if it is unknown.
    #[must_use]
    pub fn fitted(mut self, len: u32) -> Self {
        let each = self.data_type.and_then(DataType::size);
        if let (Some(each), true) = (each, self.dimensions.is_empty()) {
            match (len.checked_div(each), len.checked_rem(each)) {
                (Some(count), Some(0)) if count > 1 => self.dimensions.push(count),
                _ => {}
            }
        }
        self.size = self.size.or(Some(len));
        self
    }

    /// The type of the element that these indices select.
    ///
    /// # Errors
    /// If the indices do not select an element.
    pub fn element(&self, indices: U32List<'_>) -> Result<Self, String> {
        let one = Self { dimensions: Vec::new(), size: None, ..self.clone() };
        let dimensions = &self.dimensions;
        if indices.len() != dimensions.len() {
            let given: String = indices.iter().map(|index| format!("[{index}]")).collect();
            let needed = dimensions.len();
            return Err(match needed {
                0 => format!("{self} is not an array, so it has no element {given}"),
                _ => {
                    format!(
                        "{given} is not an element of {self}, which requires {}",
                        plural(needed, "index")
                    )
                }
            });
        }
        for (index, &len) in indices.iter().zip(dimensions) {
            if index >= len {
                return Err(format!(
                    "index {index} is out of bounds for {self}; indices start at 0"
                ));
            }
        }
        let shape = self.shape().map(|shape| shape.element_shape().size());
        Ok(Self { size: shape.or(one.data_type.and_then(DataType::size)), ..one })
    }

    /// The shape of the value; `None` if a part of it is unknown, or type, dimensions and size
    /// disagree.
    fn shape(&self) -> Option<Shape<'_>> {
        Shape::new(self.data_type?, U32List::from(self.dimensions.as_slice()), self.size?).ok()
    }

    /// The elements of a value; `None` if the data type is unknown.
    ///
    /// # Errors
    /// If the bytes are not a value of this type.
    pub fn elements<'a>(&'a self, bytes: &'a [u8]) -> Result<Option<Elements<'a>>, Error> {
        let dimensions = U32List::from(self.dimensions.as_slice());
        self.data_type.map(|known| Elements::new(known, dimensions, bytes)).transpose()
    }
}

/// The name of the type, with the dimensions in brackets.
impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&escape(&self.name))?;
        self.dimensions.iter().try_for_each(|len| write!(f, "[{len}]"))
    }
}
