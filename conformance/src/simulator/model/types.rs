//! Types of values, and the conversion of TOML values to bytes.

use ads_cnc::CncStr;
use ads_cnc::value::DataType;
use toml::Value;

use crate::text::plural;

/// The kinds of items. Variables and elements allow only some of the types; COM objects have other
/// names for the types.
#[derive(Clone, Copy, Debug)]
pub(super) enum TypeNames {
    /// Variables (VAR-5).
    Variable,
    /// Elements (SDA-7).
    Element,
    /// COM objects (GEN-5).
    Object,
}

/// A type with its name.
#[derive(Clone, Copy, Debug)]
pub(super) struct NamedType {
    pub(super) name: &'static str,
    pub(super) data_type: DataType,
}

impl TypeNames {
    /// All types that these items may have.
    fn all(self) -> impl Iterator<Item = NamedType> {
        DataType::ALL.into_iter().filter_map(move |data_type| {
            let name = match self {
                Self::Variable => data_type.var_type().map(|_| data_type.name()),
                // Only objects use the types LINT and LWORD.
                Self::Element if matches!(data_type, DataType::Lint | DataType::Lword) => None,
                Self::Element => Some(data_type.name()),
                Self::Object => Some(data_type.object_name()),
            };
            Some(NamedType { name: name?, data_type })
        })
    }

    pub(super) fn find(self, name: &str) -> Result<NamedType, String> {
        self.all().find(|known| known.name == name).ok_or_else(|| {
            let known: Vec<&str> = self.all().map(|known| known.name).collect();
            format!("unknown type {name:?}; types: {}", known.join(" "))
        })
    }
}

/// Encodes one value of a type, or an array with `count` values, of `size` bytes each.
pub(super) fn bytes(
    data_type: DataType,
    size: usize,
    count: Option<usize>,
    value: &Value,
) -> Result<Vec<u8>, String> {
    let Some(count) = count else { return one(data_type, size, value) };
    let mut values = Vec::new();
    flatten(value, &mut values);
    if values.len() != count {
        return Err(format!("expected {}, found {}", plural(count, "value"), values.len()));
    }
    let mut bytes = Vec::new();
    for value in values {
        bytes.extend(one(data_type, size, value)?);
    }
    Ok(bytes)
}

/// Flattens a nested array of several dimensions.
fn flatten<'a>(value: &'a Value, into: &mut Vec<&'a Value>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| flatten(value, into)),
        value => into.push(value),
    }
}

fn one(data_type: DataType, size: usize, value: &Value) -> Result<Vec<u8>, String> {
    use DataType::{
        Boolean, Lint, Lword, Real32, Real64, Sgn08, Sgn16, Sgn32, Uns08, Uns16, Uns32,
    };

    match (data_type, value) {
        (Boolean, Value::Boolean(value)) => Ok(vec![u8::from(*value)]),
        (Boolean, Value::Integer(number)) => integer(*number, 0, 1, 1),
        (Uns08 | Uns16 | Uns32 | Lword, Value::Integer(number)) => {
            integer(*number, 0, unsigned_max(size), size)
        }
        (Sgn08 | Sgn16 | Sgn32 | Lint, Value::Integer(number)) => {
            // The maximum of a signed number has one bit less; for 8 bytes, `unsigned_max` already
            // returns this maximum.
            let max = unsigned_max(size) >> u32::from(size < 8);
            integer(*number, max.saturating_neg().saturating_sub(1), max, size)
        }
        (Real64, Value::Float(number)) => Ok(number.to_le_bytes().to_vec()),
        (Real64, Value::Integer(number)) => parsed::<f64>(number).map(|n| n.to_le_bytes().to_vec()),
        (Real32, Value::Float(number)) => parsed::<f32>(number).map(|n| n.to_le_bytes().to_vec()),
        (Real32, Value::Integer(number)) => parsed::<f32>(number).map(|n| n.to_le_bytes().to_vec()),
        (DataType::String, Value::String(text)) => string(text, size),
        (_, value) => Err(format!("a {} is not a value of this type", value.type_str())),
    }
}

const fn unsigned_max(size: usize) -> i64 {
    match size {
        1 => 0xFF,
        2 => 0xFFFF,
        4 => 0xFFFF_FFFF,
        // For 8 bytes; integers in TOML are at most `i64::MAX`.
        _ => i64::MAX,
    }
}

fn integer(number: i64, min: i64, max: i64, size: usize) -> Result<Vec<u8>, String> {
    if number < min || number > max {
        return Err(format!("expected a number from {min} to {max}, found {number}"));
    }
    Ok(number.to_le_bytes().into_iter().take(size).collect())
}

/// Converts a number to a type by way of its text; the parser rounds to the nearest value.
fn parsed<T: std::str::FromStr>(number: impl ToString) -> Result<T, String> {
    let text = number.to_string();
    text.parse().map_err(|_| format!("{text} is not a number"))
}

/// Encodes a text in CP1252, padded with NULs to `size` bytes. Bytes after a NUL in the text are
/// kept.
fn string(text: &str, size: usize) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    for (place, part) in text.split('\0').enumerate() {
        if place > 0 {
            bytes.push(0);
        }
        bytes.extend(CncStr::new(part).map_err(|error| error.to_string())?.bytes());
    }
    let length = bytes.len();
    if !bytes.contains(&0) && length >= size || length > size {
        return Err(format!(
            "{} and a NUL are more than {}",
            plural(length, "character"),
            plural(size, "byte")
        ));
    }
    bytes.resize(size, 0);
    Ok(bytes)
}
