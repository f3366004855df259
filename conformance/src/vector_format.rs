//! Formats values of vectors for a reader.

use ads_cnc_vectors::{Fields, Hex, Tagged, Type, Value};

/// Formats fields for a reader.
pub fn show(fields: &Fields) -> String {
    let field = |(name, value): (&String, &Value)| format!("{name} {}", show_value(value));
    fields.iter().map(field).collect::<Vec<_>>().join(", ")
}

fn show_value(value: &Value) -> String {
    match value {
        Value::One(one) => show_tagged(one),
        Value::List(items) => {
            format!("[{}]", items.iter().map(show_value).collect::<Vec<_>>().join(", "))
        }
        Value::Record(fields) => format!("({})", show(fields)),
    }
}

fn show_tagged(one: &Tagged) -> String {
    let mut text = match (one.kind, &one.value, &one.hex) {
        (Type::String, Some(text), _) => format!("{text:?}"),
        (_, Some(number), _) => number.clone(),
        (_, None, hex) => hex.as_ref().map_or_else(String::new, Hex::to_string),
    };
    if let Some(tail) = &one.tail {
        // Long padding would hide the fields after it.
        if tail.len() > 4 && tail.iter().all(|&byte| byte == 0) {
            text.push_str(&format!(" and after its NUL {} × 00", tail.len()))
        } else {
            text.push_str(&format!(" and after its NUL {tail}"))
        }
    }
    if one.open {
        text.push_str(" without NUL");
    }
    text
}
