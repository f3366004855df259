//! Converts errors of serde to messages for the author of a file or of a line of JSON.

use super::{did_you_mean, plural};

/// The message for an error in a TOML file: the position, the quoted line, and the reason.
pub(crate) fn toml_error(error: &toml::de::Error) -> String {
    let shown = error.to_string();
    let shown = shown.trim_end().trim_end_matches(error.message());
    let place = shown.strip_prefix("TOML parse error at ").unwrap_or(shown);
    format!("{place}{}", in_words(error.message(), "table"))
}

/// Describes a TOML value that does not have the expected type.
pub(crate) fn found(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) => format!("the text {text:?}"),
        toml::Value::Integer(number) => format!("the number {number}"),
        toml::Value::Boolean(value) => value.to_string(),
        toml::Value::Datetime(datetime) => datetime.to_string(),
        other => format!("a {}", other.type_str()),
    }
}

/// The message for an error in a JSON text: the reason; for a value of a wrong type also its key,
/// for invalid JSON also the position.
pub(crate) fn json_error(text: &str, error: &serde_json::Error) -> String {
    let (line, column) = (error.line(), error.column());
    let message = error.to_string();
    let place = format!(" at line {line} column {column}");
    let message = message.strip_suffix(&place).unwrap_or(&message);
    if error.is_eof() {
        return format!("the JSON ends too early, at line {line}, column {column}");
    }
    if !error.is_data() {
        return format!("the JSON is invalid at line {line}, column {column}: {message}");
    }
    let words = in_words(message, "object");
    let line = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    let read = line.get(..column).unwrap_or(line);
    match last_key(read) {
        Some(key) if message.starts_with("invalid ") => format!("{key}: {words}"),
        _ => words,
    }
}

/// The last key in the JSON up to the error; the error is in the value of this key.
fn last_key(read: &str) -> Option<&str> {
    let mut parts: Vec<&str> = read.split('"').collect();
    let value = |part: &&str| !part.trim_start().starts_with(':');
    while parts.last().is_some_and(value) {
        parts.pop();
    }
    parts.pop();
    parts.pop()
}

/// Rewrites a message of serde for the author of the file; `map` is the word for a map.
pub(crate) fn in_words(message: &str, map: &str) -> String {
    // For a word without quotes, the TOML parser reports an invalid value of the type that its
    // first characters suggest.
    let bare = ["invalid boolean", "invalid float", "string values must be quoted"];
    if bare.iter().any(|start| message.starts_with(start)) {
        return "expected a value: a number, true or false, a text in double quotes, or a day as \
                YYYY-MM-DD"
            .to_owned();
    }
    let other = || {
        let unknown = |what: &str| {
            let (word, known) = message.strip_prefix(what)?.split_once("`, ")?;
            let known: Vec<&str> = known.split('`').skip(1).step_by(2).collect();
            let near = did_you_mean(word, known.iter().copied());
            Some((word.to_owned() + " is unknown" + &near, known.join(", ")))
        };
        if let Some((unknown, known)) = unknown("unknown field `") {
            return Some(format!("the key {unknown}; known keys: {known}"));
        }
        if let Some((unknown, known)) = unknown("unknown variant `") {
            return Some(format!("the word {unknown}; known words: {known}"));
        }
        let key = |what: &str| message.strip_prefix(what)?.strip_suffix('`');
        if let Some(key) = key("missing field `") {
            return Some(format!("the key {key} is missing"));
        }
        if let Some(key) = key("duplicate field `") {
            return Some(format!("the key {key} appears twice"));
        }
        let (what, rest) = message.strip_prefix("invalid ")?.split_once(' ')?;
        let (found, wanted) = rest.rsplit_once(", expected ")?;
        let found = match (what, found.parse::<u64>()) {
            ("length", Ok(_)) if wanted.starts_with("struct ") => "a list".to_owned(),
            ("length", Ok(length)) => plural(length, "item"),
            _ => of_value(found, map),
        };
        Some(format!("expected {}, found {found}", of_type(wanted, map)))
    };
    other().unwrap_or_else(|| message.to_owned())
}

/// Rewrites the description of a value by serde.
fn of_value(found: &str, map: &str) -> String {
    match found.split_once(' ') {
        Some(("string", text)) => format!("the text {text}"),
        Some(("integer" | "floating", text)) => {
            format!("the number {}", text.trim_start_matches("point ").trim_matches('`'))
        }
        Some(("boolean", text)) => text.trim_matches('`').to_owned(),
        _ if found == "map" => format!("{} {map}", article(map)),
        _ if found == "sequence" => "a list".to_owned(),
        _ => found.to_owned(),
    }
}

/// Rewrites the description of an expected type by serde.
fn of_type(wanted: &str, map: &str) -> String {
    let most = match wanted {
        "u8" => u64::from(u8::MAX),
        "u16" => u64::from(u16::MAX),
        "u32" => u64::from(u32::MAX),
        _ => 0,
    };
    match wanted.split_once(' ') {
        _ if most > 0 => format!("a whole number from 0 to {most}"),
        Some(("struct", _)) => format!("{} {map}", article(map)),
        Some(("a", "map")) => format!("{} {map}", article(map)),
        Some(("a", "string")) => "a text".to_owned(),
        Some(("a", "boolean")) => "true or false".to_owned(),
        Some(("a", "sequence")) => "a list".to_owned(),
        Some(("a", tuple)) => match tuple.strip_prefix("tuple of size ") {
            Some(size) => format!("a list of {size} items"),
            None => wanted.to_owned(),
        },
        _ if matches!(wanted, "u64" | "usize" | "i8" | "i16" | "i32" | "i64") => {
            "a whole number".to_owned()
        }
        _ if matches!(wanted, "f32" | "f64") => "a number".to_owned(),
        _ => wanted.to_owned(),
    }
}

fn article(noun: &str) -> &'static str {
    if noun.starts_with('o') { "an" } else { "a" }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only errors are read")]
    struct Row {
        number: u8,
        place: (u32, u32),
        #[serde(default)]
        name: Option<String>,
        #[serde(default)]
        kind: Option<Kind>,
        #[serde(default)]
        rest: Vec<Row>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Kind {
        Read,
        Write,
    }

    #[test]
    fn errors_name_the_key_what_is_expected_and_what_is_found() {
        let right = r#""number": 1, "place": [1, 2]"#;
        for (line, words) in [
            (r#"{"number": 1}"#, "the key place is missing"),
            (
                r#"{"number": "1"}"#,
                r#"number: expected a whole number from 0 to 255, found the text "1""#,
            ),
            (
                r#"{"number": 300}"#,
                "number: expected a whole number from 0 to 255, found the number 300",
            ),
            (r#"{"place": [1]}"#, "place: expected a list of 2 items, found 1 item"),
            ("[]", "expected an object, found a list"),
            (r#"{"name": true}"#, "name: expected a text, found true"),
            (r#"{"name": "a: \"b\"", "rest": {}}"#, "rest: expected a list, found an object"),
            (r#"{"rest": [{"nmae": 1}]}"#, "the key nmae is unknown - did you mean name?; known"),
            (
                r#"{"kind": "wirte"}"#,
                "the word wirte is unknown - did you mean write?; known words: read",
            ),
            (r#"{"number": 1, "number": 1}"#, "the key number appears twice"),
            (r#""row""#, r#"expected an object, found the text "row""#),
            (r#"{"number": 1,}"#, "the JSON is invalid at line 1, column 14: trailing comma"),
        ] {
            let error = serde_json::from_str::<Row>(line).unwrap_err();
            let shown = json_error(line, &error);
            assert!(shown.starts_with(words), "{line}: {shown}");
        }
        let toml = "number = 1\nplace = [1, 2]\nname = 3\n";
        let shown = toml_error(&toml::from_str::<Row>(toml).unwrap_err());
        assert!(shown.starts_with("line 3, column 8\n  |\n3 | name = 3\n"), "{shown}");
        assert!(shown.ends_with("\nexpected a text, found the number 3"), "{shown}");
        assert!(serde_json::from_str::<Row>(&format!("{{{right}}}")).is_ok());
    }
}
