//! Types of values, and the conversion of TOML values to bytes.

use ads_cnc::{CncStr, VariableType};
use toml::Value;

use crate::text::plural;

/// A type by its name.
#[derive(Debug)]
pub(super) struct NamedType {
    pub(super) name: &'static str,
    pub(super) scalar: ScalarType,
}

/// How a value is encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ScalarType {
    Boolean,
    Unsigned(usize),
    Signed(usize),
    Real32,
    Real64,
    /// Text. The declared length includes the NUL.
    String,
}

impl ScalarType {
    /// Size of one value in bytes; `None` for a STRING.
    pub(super) const fn size(self) -> Option<usize> {
        match self {
            Self::Boolean => Some(1),
            Self::Unsigned(size) | Self::Signed(size) => Some(size),
            Self::Real32 => Some(4),
            Self::Real64 => Some(8),
            Self::String => None,
        }
    }
}

const fn named(name: &'static str, scalar: ScalarType) -> NamedType {
    NamedType { name, scalar }
}

/// Types of variables (VAR-5).
pub(super) const VARIABLE: &[NamedType] = &[
    named("BOOLEAN", ScalarType::Boolean),
    named("SGN08", ScalarType::Signed(1)),
    named("UNS08", ScalarType::Unsigned(1)),
    named("SGN16", ScalarType::Signed(2)),
    named("UNS16", ScalarType::Unsigned(2)),
    named("SGN32", ScalarType::Signed(4)),
    named("UNS32", ScalarType::Unsigned(4)),
    named("REAL64", ScalarType::Real64),
    named("STRING", ScalarType::String),
];

/// Types of elements (SDA-7).
pub(super) const ELEMENT: &[NamedType] = &[
    named("BOOLEAN", ScalarType::Boolean),
    named("SGN08", ScalarType::Signed(1)),
    named("UNS08", ScalarType::Unsigned(1)),
    named("SGN16", ScalarType::Signed(2)),
    named("UNS16", ScalarType::Unsigned(2)),
    named("SGN32", ScalarType::Signed(4)),
    named("UNS32", ScalarType::Unsigned(4)),
    named("REAL32", ScalarType::Real32),
    named("REAL64", ScalarType::Real64),
    named("STRING", ScalarType::String),
];

/// Types of COM objects (GEN-5).
pub(super) const OBJECT: &[NamedType] = &[
    named("BOOL", ScalarType::Boolean),
    named("BYTE", ScalarType::Unsigned(1)),
    named("SINT", ScalarType::Signed(1)),
    named("WORD", ScalarType::Unsigned(2)),
    named("INT", ScalarType::Signed(2)),
    named("DWORD", ScalarType::Unsigned(4)),
    named("DINT", ScalarType::Signed(4)),
    named("REAL", ScalarType::Real32),
    named("LWORD", ScalarType::Unsigned(8)),
    named("LINT", ScalarType::Signed(8)),
    named("LREAL", ScalarType::Real64),
    named("STRING", ScalarType::String),
];

pub(super) fn find(types: &'static [NamedType], name: &str) -> Result<&'static NamedType, String> {
    types.iter().find(|known| known.name == name).ok_or_else(|| {
        let known: Vec<&str> = types.iter().map(|known| known.name).collect();
        format!("unknown type {name:?}; types: {}", known.join(" "))
    })
}

/// The code of a variable's type.
pub(super) fn code(name: &str) -> VariableType {
    let codes = (1..=9).map(VariableType);
    codes.into_iter().find(|code| code.name() == Some(name)).unwrap_or(VariableType::STRING)
}

/// Encodes one value of a type, or an array with `count` values, of `size` bytes each.
pub(super) fn bytes(
    scalar: ScalarType,
    size: usize,
    count: Option<usize>,
    value: &Value,
) -> Result<Vec<u8>, String> {
    let Some(count) = count else { return one(scalar, size, value) };
    let mut values = Vec::new();
    flatten(value, &mut values);
    if values.len() != count {
        return Err(format!("expected {}, found {}", plural(count, "value"), values.len()));
    }
    let mut bytes = Vec::new();
    for value in values {
        bytes.extend(one(scalar, size, value)?);
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

fn one(scalar: ScalarType, size: usize, value: &Value) -> Result<Vec<u8>, String> {
    match (scalar, value) {
        (ScalarType::Boolean, Value::Boolean(value)) => Ok(vec![u8::from(*value)]),
        (ScalarType::Boolean, Value::Integer(number)) => integer(*number, 0, 1, 1),
        (ScalarType::Unsigned(size), Value::Integer(number)) => {
            integer(*number, 0, unsigned_max(size), size)
        }
        (ScalarType::Signed(size), Value::Integer(number)) => {
            // A signed number has one bit less.
            let max = unsigned_max(size) >> u32::from(size < 8);
            integer(*number, max.saturating_neg().saturating_sub(1), max, size)
        }
        (ScalarType::Real64, Value::Float(number)) => Ok(number.to_le_bytes().to_vec()),
        (ScalarType::Real64, Value::Integer(number)) => {
            parsed::<f64>(number).map(|n| n.to_le_bytes().to_vec())
        }
        (ScalarType::Real32, Value::Float(number)) => {
            parsed::<f32>(number).map(|n| n.to_le_bytes().to_vec())
        }
        (ScalarType::Real32, Value::Integer(number)) => {
            parsed::<f32>(number).map(|n| n.to_le_bytes().to_vec())
        }
        (ScalarType::String, Value::String(text)) => string(text, size),
        (_, value) => Err(format!("a {} is not a value of this type", value.type_str())),
    }
}

const fn unsigned_max(size: usize) -> i64 {
    match size {
        1 => 0xFF,
        2 => 0xFFFF,
        4 => 0xFFFF_FFFF,
        // Integers in TOML are at most `i64::MAX`.
        _ => i64::MAX,
    }
}

fn integer(number: i64, min: i64, max: i64, size: usize) -> Result<Vec<u8>, String> {
    if number < min || number > max {
        return Err(format!("expected a number from {min} to {max}, found {number}"));
    }
    Ok(number.to_le_bytes().into_iter().take(size).collect())
}

/// Parses a number; Rust rounds to the nearest value.
fn parsed<T: std::str::FromStr>(number: impl ToString) -> Result<T, String> {
    let text = number.to_string();
    text.parse().map_err(|_| format!("{text} is not a number"))
}

/// Encodes CP1252, padded with NULs. Bytes after a NUL in the text are kept.
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
