//! Values as JSON.

use ads_cnc::Element;
use serde_json::Value;

use super::{Type, printable};
use crate::number::to_usize;

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
/// Returns `None` if the type is unknown or the bytes do not match it.
pub fn value_of(ty: &Type, bytes: &[u8]) -> Option<Value> {
    let elements = ty.elements(bytes).ok().flatten()?;
    let mut values: Vec<Value> = elements.iter().map(element).collect();
    let mut dimensions = ty.dimensions.iter().rev();
    let Some(mut row) = dimensions.next().copied() else { return values.pop() };
    for &outer in dimensions {
        let len = to_usize(row).max(1);
        values = values.chunks(len).map(|chunk| Value::Array(chunk.to_vec())).collect();
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
}
