//! The type by which values are shown, and its name.

use ads_cnc::CncStr;
use ads_cnc::value::DataType;

/// The type by which values and contents are shown.
#[derive(Clone, Debug, Default)]
pub struct ValueFormat {
    /// The type; without a type, a value is shown as bytes.
    pub ty: Option<DataType>,
    /// Number of elements in each dimension; empty for a single element.
    pub dimensions: Vec<u32>,
}

/// The error for an unknown name of a type.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no type is called {0}; types: BOOLEAN, SGN08 … UNS32, REAL32, REAL64, STRING, and those of objects, BOOL, SINT … LREAL"
)]
pub struct UnknownType(String);

/// Finds a type by the name that variables, elements or objects use; case is ignored.
///
/// # Errors
/// If no type has this name.
pub fn type_by_name(name: &str) -> Result<DataType, UnknownType> {
    let upper = name.to_ascii_uppercase();
    let known = CncStr::new(&upper).ok().and_then(DataType::by_name);
    known.ok_or_else(|| UnknownType(name.to_owned()))
}
