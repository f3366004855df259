//! Compares the significant fields of a value in an answer with the expected fields.

use std::str::FromStr as _;

use ads_cnc::CncString;
use ads_cnc_vectors::{Fields, Tagged, Type, Value};
use serde_json::Value as Json;

use crate::text::hex::compact;
use crate::text::plural;
use crate::values::until_nul;

/// A difference between the expected value and the value in an answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Difference {
    Other(String),
    /// A text is equal up to its first NUL but differs after it or in the NUL itself; or a text
    /// without NUL lacks only its last character.
    End(String),
    /// The answer does not say how a text ends: the fields `open` and `tail` are omitted.
    Omitted(String),
}

/// The most severe difference between the expected value and the value in the answer; the first of
/// several that are equally severe.
pub(super) fn compare(reference: &Fields, found: &Json) -> Option<Difference> {
    record("", reference, found)
}

fn other(path: &str, what: impl std::fmt::Display) -> Option<Difference> {
    let path = if path.is_empty() { "the value" } else { path };
    Some(Difference::Other(format!("{path}: {what}")))
}

fn within(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

fn record(path: &str, reference: &Fields, found: &Json) -> Option<Difference> {
    let Some(given) = found.as_object() else {
        return other(path, format_args!("an object with fields is expected, not {found}"));
    };
    if let Some(surplus) = given.keys().find(|name| !reference.contains_key(*name)) {
        return other(&within(path, surplus), "no such field");
    }
    let mut slight = None;
    for (name, value) in reference {
        let path = within(path, name);
        let difference = match given.get(name) {
            None => other(&path, "is missing"),
            Some(found) => one(&path, value, found),
        };
        slight = worse(slight, difference);
        if let Some(Difference::Other(_)) = slight {
            return slight;
        }
    }
    slight
}

/// The more severe of two differences; the first if they are equally severe.
fn worse(one: Option<Difference>, other: Option<Difference>) -> Option<Difference> {
    let weight = |difference: &Option<Difference>| match difference {
        None => 0,
        Some(Difference::Omitted(_)) => 1,
        Some(Difference::End(_)) => 2,
        Some(Difference::Other(_)) => 3,
    };
    if weight(&other) > weight(&one) { other } else { one }
}

pub(super) fn one(path: &str, reference: &Value, found: &Json) -> Option<Difference> {
    match reference {
        Value::One(tagged) => single(path, tagged, found),
        Value::Record(fields) => record(path, fields, found),
        Value::List(items) => {
            let Some(given) = found.as_array() else {
                return other(path, format_args!("a list is expected, not {found}"));
            };
            if given.len() != items.len() {
                return other(
                    path,
                    format_args!("{} expected, not {}", plural(items.len(), "item"), given.len()),
                );
            }
            let pairs = items.iter().zip(given).enumerate();
            let differences = pairs.map(|(index, (reference, found))| {
                one(&format!("{path}[{index}]"), reference, found)
            });
            differences.fold(None, worse)
        }
    }
}

fn single(path: &str, reference: &Tagged, found: &Json) -> Option<Difference> {
    let text = |name: &str| found.get(name).and_then(Json::as_str);
    let kind = reference.kind.name();
    match text("type") {
        Some(given) if given == kind => {}
        Some(given) => return other(path, format_args!("type {kind} is expected, not {given}")),
        None => {
            return other(path, format_args!("an object with a type is expected, not {found}"));
        }
    }
    let mut given =
        ["value", "hex", "bits"].iter().filter_map(|name| Some((name, found.get(name)?)));
    if let Some((name, value)) = given.find(|(_, value)| !value.is_string()) {
        return other(path, format_args!("{name} must be a string, not the JSON {value}"));
    }
    match reference.kind {
        Type::String => {
            let expected = reference.hex.as_deref().unwrap_or_default();
            match hex(path, expected, text("hex")) {
                Some(Difference::Other(what)) if has_other_end(reference, text("hex")) => {
                    Some(Difference::End(what))
                }
                None => end(path, reference, found),
                characters => characters,
            }
        }
        Type::Bytes => hex(path, reference.hex.as_deref().unwrap_or_default(), text("hex")),
        Type::Real32 | Type::Real64 | Type::Real | Type::Lreal => {
            let bits = |text: &str| {
                u64::from_str_radix(text.strip_prefix("0x").unwrap_or_default(), 16).ok()
            };
            let given = text("bits");
            let same = given.and_then(bits).is_some_and(|bits| Some(bits) == reference.real_bits());
            let expected = reference.bits.as_deref().unwrap_or_default();
            let found = given.unwrap_or("none");
            if same {
                None
            } else {
                other(path, format_args!("bits {expected} is expected, not {found}"))
            }
        }
        Type::NetId | Type::Name => {
            let expected = reference.value.as_deref().unwrap_or_default();
            let given = text("value").unwrap_or("none");
            if expected == given {
                None
            } else {
                other(path, format_args!("{expected} is expected, not {given}"))
            }
        }
        _ => {
            let given = text("value");
            let number = given.and_then(|text| text.parse::<i128>().ok());
            let expected = reference.value.as_deref().unwrap_or_default();
            if number.is_some() && number == reference.integer() {
                None
            } else {
                other(
                    path,
                    format_args!("{expected} is expected, not {}", given.unwrap_or("nothing")),
                )
            }
        }
    }
}

fn hex(path: &str, reference: &[u8], given: Option<&str>) -> Option<Difference> {
    let expected = compact::show(reference);
    let Some(given) = given else {
        return other(path, format_args!("hex {expected} is expected, but hex is missing"));
    };
    match compact::parse(given) {
        Ok(bytes) if bytes == reference => None,
        Ok(bytes) => {
            let is_utf8 = std::str::from_utf8(&bytes).is_ok_and(|text| {
                CncString::from_str(text).is_ok_and(|text| text.as_bytes() == reference)
            });
            let hint = if is_utf8 { ", the text in UTF-8," } else { "" };
            let expected = if reference.is_empty() { "no byte" } else { &expected };
            let given = if bytes.is_empty() { "no byte".to_owned() } else { compact::show(&bytes) };
            other(path, format_args!("hex {given}{hint} where {expected} is expected"))
        }
        Err(why) => other(path, why),
    }
}

/// Whether a text differs from the expected text only in its end: it is equal up to the first NUL
/// or, if the expected text has no NUL, lacks only the last character.
fn has_other_end(reference: &Tagged, given: Option<&str>) -> bool {
    let reference_text = reference.hex.as_deref().unwrap_or_default();
    let Some(Ok(given)) = given.map(compact::parse) else { return false };
    until_nul(&given) == until_nul(reference_text)
        || reference.open && reference_text.split_last().is_some_and(|(_, most)| most == given)
}

/// Compares the ends of two texts with equal characters: `open` (no NUL) and `tail` (the bytes
/// after the NUL), which a testee may omit.
fn end(path: &str, reference: &Tagged, found: &Json) -> Option<Difference> {
    let open = found.get("open").and_then(Json::as_bool).unwrap_or(false);
    let tail = found.get("tail").and_then(Json::as_str).map(compact::parse);
    let is_told = open || tail.is_some();
    let reference_tail = reference.tail.as_deref().unwrap_or_default();
    let given_tail = match &tail {
        None => &[],
        Some(Ok(bytes)) => bytes.as_slice(),
        Some(Err(why)) => return other(path, why),
    };
    if open == reference.open && given_tail == reference_tail {
        return None;
    }
    let expected = match (reference.open, reference_tail) {
        (true, _) => "no NUL".to_owned(),
        (false, []) => "one NUL after it".to_owned(),
        (false, tail) => format!("{} after its NUL", compact::show(tail)),
    };
    if is_told {
        Some(Difference::End(format!("{path}: {expected} is expected")))
    } else {
        Some(Difference::Omitted(format!("{path}: {expected} is omitted")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_text(hex: &str, found: &str) -> String {
        let reference = format!(r#"{{"name":{{"type":"STRING","hex":"{hex}"}}}}"#);
        let reference: Fields = serde_json::from_str(&reference).unwrap();
        match compare(&reference, &serde_json::from_str(found).unwrap()) {
            Some(Difference::Other(what) | Difference::End(what) | Difference::Omitted(what)) => {
                what
            }
            None => String::new(),
        }
    }

    #[test]
    fn likely_mistakes_are_named() {
        assert_eq!(of_text("e4", r#"{"name":{"type":"STRING","hex":"e4"}}"#), "");
        assert_eq!(
            of_text("e4", r#"{"name":{"type":"STRING","hex":"c3a4"}}"#),
            "name: hex c3a4, the text in UTF-8, where e4 is expected"
        );
        assert_eq!(
            of_text("", r#"{"name":{"type":"STRING","hex":"00"}}"#),
            "name: hex 00 where no byte is expected"
        );
        assert_eq!(
            of_text("e4", r#"{"name":{"type":"STRING","hex":7}}"#),
            "name: hex must be a string, not the JSON 7"
        );
    }
}
