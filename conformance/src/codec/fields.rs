//! Fields and values in the notation of the vectors.

use ads_cnc::text::cp1252_to_char;
use ads_cnc::{Element, TextRef};
use ads_cnc_vectors::{Fields, Hex, Tagged, Type, Value};

/// Fields by name.
pub(super) type NamedFields = Vec<(&'static str, Value)>;

pub(super) fn collect(fields: NamedFields) -> Fields {
    fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

pub(super) fn record(fields: NamedFields) -> Value {
    Value::Record(collect(fields))
}

pub(super) fn tagged(kind: Type, value: impl ToString) -> Tagged {
    let value = Some(value.to_string());
    Tagged { kind, value, hex: None, bits: None, tail: None, open: false }
}

pub(super) fn one(kind: Type, value: impl ToString) -> Value {
    Value::One(tagged(kind, value))
}

pub(super) fn uns16(number: u16) -> Value {
    one(Type::Uns16, number)
}

pub(super) fn uns32(number: u32) -> Value {
    one(Type::Uns32, number)
}

pub(super) fn name(word: &str) -> Value {
    one(Type::Name, word)
}

pub(super) fn numbers(numbers: &[u32]) -> Value {
    Value::List(numbers.iter().copied().map(uns32).collect())
}

pub(super) fn data(bytes: &[u8]) -> Value {
    let hex = Some(Hex(bytes.to_vec()));
    Value::One(Tagged { kind: Type::Bytes, value: None, hex, bits: None, tail: None, open: false })
}

pub(super) fn text_tagged(text: TextRef<'_>) -> Tagged {
    let bytes: Vec<u8> = text.text().bytes().collect();
    Tagged {
        kind: Type::String,
        value: Some(bytes.iter().copied().map(cp1252_to_char).collect()),
        hex: Some(Hex(bytes)),
        bits: None,
        tail: text.tail().filter(|tail| !tail.is_empty()).map(|tail| Hex(tail.to_vec())),
        open: text.tail().is_none(),
    }
}

/// An element of type `kind`.
pub(super) fn element(kind: Type, element: Element<'_>) -> Tagged {
    match element {
        Element::Boolean(boolean) => tagged(kind, boolean.0),
        Element::Real32(number) => Tagged {
            bits: Some(format!("{:#010x}", number.to_bits())),
            ..tagged(kind, decimal(number.into()))
        },
        Element::Real64(number) => Tagged {
            bits: Some(format!("{:#018x}", number.to_bits())),
            ..tagged(kind, decimal(number))
        },
        Element::String(text) => text_tagged(text),
        other => tagged(kind, other),
    }
}

/// The shortest decimal notation of a float, as in the vectors: an exponent has a sign and at least
/// two digits.
pub(super) fn decimal(number: f64) -> String {
    let shortest = format!("{number:?}").to_lowercase();
    match shortest.split_once('e') {
        None => shortest,
        Some((digits, exponent)) => {
            let (sign, exponent) = match exponent.strip_prefix('-') {
                Some(exponent) => ('-', exponent),
                None => ('+', exponent),
            };
            format!("{digits}e{sign}{exponent:0>2}")
        }
    }
}
