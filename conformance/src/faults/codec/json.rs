//! Changes to values in JSON.

use ads_cnc::text::cp1252_to_char;
use serde_json::{Map, Value as Json};

use crate::text::hex;

/// Changes every scalar value: a JSON object whose field `type` is a text.
pub(super) fn each(value: &mut Json, change: &mut dyn FnMut(&mut Map<String, Json>)) {
    match value {
        Json::Array(items) => items.iter_mut().for_each(|item| each(item, change)),
        Json::Object(fields) => {
            if fields.get("type").is_some_and(Json::is_string) {
                change(fields)
            } else {
                fields.values_mut().for_each(|field| each(field, change))
            }
        }
        _ => {}
    }
}

/// Changes every text; `change` receives and returns its bytes in CP1252.
pub(super) fn texts(value: &mut Json, change: fn(Vec<u8>) -> Vec<u8>) {
    each(value, &mut |one| {
        if one.get("type").and_then(Json::as_str) == Some("STRING")
            && let Some(bytes) = one.get("hex").and_then(Json::as_str)
        {
            let bytes = change(hex::compact::parse(bytes).unwrap_or_default());
            let text: String = bytes.iter().map(|byte| cp1252_to_char(*byte)).collect();
            one.insert("hex".to_owned(), Json::String(hex::spaced(&bytes)));
            one.insert("value".to_owned(), Json::String(text));
        }
    });
}

/// Changes every integer of these types.
pub(super) fn numbers(value: &mut Json, types: &[&str], change: fn(i128) -> i128) {
    each(value, &mut |one| {
        let is = one.get("type").and_then(Json::as_str).is_some_and(|kind| types.contains(&kind));
        let number = one.get("value").and_then(Json::as_str).and_then(|it| it.parse().ok());
        if let (true, Some(number)) = (is, number) {
            one.insert("value".to_owned(), Json::String(change(number).to_string()));
        }
    });
}

/// Changes every list with this name.
pub(super) fn lists(value: &mut Json, name: &str, change: fn(&mut Vec<Json>)) {
    match value {
        Json::Array(items) => items.iter_mut().for_each(|item| lists(item, name, change)),
        Json::Object(fields) => {
            for (field, value) in fields {
                match value {
                    Json::Array(items) if field == name => change(items),
                    value => lists(value, name, change),
                }
            }
        }
        _ => {}
    }
}

/// Replaces the value of a field by the other word of its pair; a value without a pair stays.
pub(super) fn words(value: &mut Json, field: &str, pairs: &[(&str, &str)]) {
    let Some(Json::Object(one)) = value.get_mut(field) else { return };
    let word = one.get("value").and_then(Json::as_str).unwrap_or_default();
    let other = pairs.iter().find_map(|(a, b)| match word {
        word if word == *a => Some(*b),
        word if word == *b => Some(*a),
        _ => None,
    });
    if let Some(other) = other.map(str::to_owned) {
        one.insert("value".to_owned(), Json::String(other));
    }
}
