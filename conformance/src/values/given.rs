//! The type that a reader of values is given.

use ads_cnc::CncStr;
use ads_cnc::value::DataType;

/// How values and contents are to be read.
#[derive(Clone, Debug, Default)]
pub struct ValueFormat {
    /// The type; without it a value is bytes.
    pub ty: Option<DataType>,
    /// Elements in each dimension; none for a single element.
    pub dimensions: Vec<u32>,
}

/// A name that no type has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no type is called {0}; there are BOOLEAN, SGN08 … UNS32, REAL32, REAL64, STRING, and those of objects, BOOL, SINT … LREAL"
)]
pub struct UnknownType(String);

/// The type of this name, as variables, elements or objects have it; case does not matter.
///
/// # Errors
/// No type has this name.
pub fn type_by_name(name: &str) -> Result<DataType, UnknownType> {
    let upper = name.to_ascii_uppercase();
    let known = CncStr::new(&upper).ok().and_then(DataType::by_name);
    known.ok_or_else(|| UnknownType(name.to_owned()))
}
