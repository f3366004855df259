//! Values as JSON.

use ads_cnc::Element;
use serde_json::Value;

use super::{Type, printable};
use crate::number::to_usize;

/// Maximum number of dimensions of a value as JSON: each dimension indents each element further,
/// and many parsers of JSON accept at most about 100 levels.
pub const JSON_DIMENSIONS_MAX: usize = 16;

/// Converts a value to JSON: a number, a boolean, a string, or nested arrays of these with one
/// level for each dimension (an array without elements may have fewer levels). A REAL that is not
/// finite becomes a string such as `NaN`.
///
/// ```
/// use ads_cnc::value::DataType;
/// use ads_cnc_conformance::values::{Type, value_of};
///
/// let matrix = Type::known(DataType::Uns08, vec![2, 2]);
/// assert_eq!(value_of(&matrix, &[1, 2, 3, 4]).unwrap().to_string(), "[[1,2],[3,4]]");
/// ```
///
/// Returns `None` if the type is unknown, the bytes do not match it, or it has more than
/// [`JSON_DIMENSIONS_MAX`] dimensions.
pub fn value_of(ty: &Type, bytes: &[u8]) -> Option<Value> {
    if ty.dimensions.len() > JSON_DIMENSIONS_MAX {
        return None;
    }
    let elements = ty.elements(bytes).ok().flatten()?;
    let mut values: Vec<Value> = elements.iter().map(element).collect();
    let mut dimensions = ty.dimensions.iter().rev();
    let Some(mut row) = dimensions.next().copied() else { return values.pop() };
    for &outer in dimensions {
        let len = to_usize(row).max(1);
        let mut rest = values.into_iter();
        let rows = std::iter::from_fn(|| {
            let row: Vec<Value> = rest.by_ref().take(len).collect();
            (!row.is_empty()).then_some(Value::Array(row))
        });
        values = rows.collect();
        row = outer;
    }
    Some(Value::Array(values))
}

fn element(element: Element<'_>) -> Value {
    match element {
        Element::Boolean(flag) => flag.is_true().into(),
        Element::Real32(number) if number.is_finite() => number.into(),
        Element::Real32(number) => format!("{number:?}").into(),
        Element::Real64(number) if number.is_finite() => number.into(),
        Element::Real64(number) => format!("{number:?}").into(),
        Element::String(text) => text.text().to_string().into(),
        // An integer is displayed as in JSON.
        other => match other.to_string().parse() {
            Ok(integer) => Value::Number(integer),
            Err(_) => printable(&format!("{other:?}")).into(),
        },
    }
}

#[cfg(test)]
mod tests {
    use ads_cnc::value::{DataType, EncodeValue as _};

    use super::*;

    #[test]
    fn every_number_has_a_place() {
        let real = Type::known(DataType::Real64, vec![2]);
        let bytes = [f64::NAN, 0.25].value_to_vec().unwrap();
        assert_eq!(value_of(&real, &bytes).unwrap().to_string(), "[\"NaN\",0.25]");
        let lword = Type::known(DataType::Lword, vec![]);
        assert_eq!(value_of(&lword, &[0xFF; 8]).unwrap().to_string(), u64::MAX.to_string());
        let none = Type::known(DataType::Uns08, vec![0]);
        assert_eq!(value_of(&none, &[]).unwrap().to_string(), "[]");
        let text = Type::hinted(DataType::String);
        assert_eq!(value_of(&text, b"L\xE4nge\0x").unwrap().to_string(), "\"Länge\"");
    }

    #[test]
    fn a_value_with_too_many_dimensions_has_no_json() {
        let ty = |count| Type::known(DataType::Boolean, vec![1; count]);
        let most = JSON_DIMENSIONS_MAX;
        let expected = format!("{}true{}", "[".repeat(most), "]".repeat(most));
        assert_eq!(value_of(&ty(most), &[1]).unwrap().to_string(), expected);
        assert_eq!(value_of(&ty(most + 1), &[1]), None);
    }
}
