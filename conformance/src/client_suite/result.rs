//! Compares the result of a client with the expected value; several JSON notations of a value are
//! equal.

use serde_json::Value;

/// Whether a result equals the expected value. An array of one element equals the element, and
/// nested arrays equal the flat array. A number may be written as a string, a boolean as 0 or 1,
/// and null as an empty array or object. Of an object, only the expected fields that the client
/// returns are compared, of which there must be at least one.
pub(super) fn same(expected: &Value, found: &Value) -> bool {
    match (expected, found) {
        (Value::Object(expected), Value::Object(found)) => {
            let mut both =
                expected.iter().filter_map(|(key, value)| Some((value, found.get(key)?)));
            let any = expected.keys().any(|key| found.contains_key(key));
            any && both.all(|(expected, found)| same(expected, found))
        }
        (Value::Null, found) => match found {
            Value::Null => true,
            Value::Array(items) => items.is_empty(),
            Value::Object(fields) => fields.is_empty(),
            _ => false,
        },
        (Value::Array(_), _) | (_, Value::Array(_)) => {
            let (expected, found) = (flat(expected), flat(found));
            expected.len() == found.len()
                && expected.iter().zip(&found).all(|(expected, found)| same(expected, found))
        }
        _ => scalar(expected, found),
    }
}

fn flat(value: &Value) -> Vec<&Value> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        one => vec![one],
    }
}

fn scalar(expected: &Value, found: &Value) -> bool {
    match expected {
        Value::Bool(expected) => match found {
            Value::Bool(found) => expected == found,
            found => number(found) == Some(NumericValue::Whole(i128::from(*expected))),
        },
        Value::Number(_) => match (number(expected), number(found)) {
            (Some(NumericValue::Whole(expected)), Some(NumericValue::Whole(found))) => {
                expected == found
            }
            (Some(expected), Some(found)) => near(expected.real(), found.real()),
            _ => false,
        },
        Value::String(expected) => found.as_str() == Some(expected),
        _ => false,
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum NumericValue {
    Whole(i128),
    Real(f64),
}

impl NumericValue {
    #[allow(clippy::as_conversions, reason = "a whole number that is compared with a real one")]
    const fn real(self) -> f64 {
        match self {
            Self::Whole(number) => number as f64,
            Self::Real(number) => number,
        }
    }
}

fn number(value: &Value) -> Option<NumericValue> {
    let text = match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        _ => return None,
    };
    let whole = text.parse().ok().map(NumericValue::Whole);
    whole.or_else(|| text.parse().ok().map(NumericValue::Real))
}

/// Whether two numbers are equal in about 14 decimal digits.
fn near(expected: f64, found: f64) -> bool {
    let off = (expected - found).abs();
    off <= expected.abs() * 1e-14
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn notations_of_a_value_are_equal() {
        for (expected, found) in [
            (json!(30), json!("30")),
            (json!(30), json!([30])),
            (json!([[1, 2], [3, 4]]), json!([1, 2, 3, 4])),
            (json!(true), json!(1)),
            (json!(1234.2), json!("1234.2")),
            (json!(2.0), json!(2)),
            (json!(null), json!([])),
            (json!({"name": "P1", "size": 4}), json!({"size": 4, "comment": "-"})),
        ] {
            assert!(same(&expected, &found), "{expected} {found}");
        }
    }

    #[test]
    fn different_values_differ() {
        for (expected, found) in [
            (json!(30), json!(31)),
            (json!(30), json!(null)),
            (json!([1, 2]), json!([1, 2, 3])),
            (json!([]), json!([0])),
            (json!("a"), json!("a\0")),
            (json!(-1), json!(65535)),
            (json!({"name": "P1"}), json!({"size": 4})),
            (json!({"name": "P1", "size": 4}), json!({"name": "P1", "size": 5})),
            (json!(null), json!(0)),
        ] {
            assert!(!same(&expected, &found), "{expected} {found}");
        }
    }
}
