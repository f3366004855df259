//! Escapes the texts of a report, because control characters from a target must not reach a
//! terminal. Line ends are escaped too, except in the output on stderr and in the call of a check.

use std::mem;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::document::Report;
use crate::text::{escape, escape_lines};

impl Report {
    /// The report with all texts escaped.
    pub(super) fn escaped(mut self) -> Self {
        // For a capture, the lines of a call after the first one contain the packet numbers. Each
        // case is converted separately, because the JSON of a whole report needs much memory.
        let cases = mem::take(&mut self.cases).into_iter();
        let cases = cases.map(|case| escaped(case, Some("call"))).collect();
        let target = escaped(mem::take(&mut self.target), Some("stderr"));
        Self { target, cases, ..escaped(self, None) }
    }
}

/// Escapes all texts of a part of a report. Those with the key `lines` keep their line ends.
fn escaped<T: Serialize + DeserializeOwned>(part: T, lines: Option<&str>) -> T {
    serde_json::to_value(part)
        .and_then(|part| serde_json::from_value(escape_value(part, false, lines)))
        .expect("escaping changes only the texts of a report")
}

/// Escapes a value, and all keys and values in it. Texts with the key `lines` keep their line ends,
/// and so does the value itself if `keeps_lines`.
fn escape_value(value: Value, keeps_lines: bool, lines: Option<&str>) -> Value {
    match value {
        Value::String(text) if keeps_lines => escape_lines(&text).into(),
        Value::String(text) => escape(&text).into(),
        Value::Array(items) => {
            items.into_iter().map(|item| escape_value(item, false, lines)).collect()
        }
        Value::Object(fields) => fields
            .into_iter()
            .map(|(key, value)| (escape(&key), escape_value(value, lines == Some(&key), lines)))
            .collect(),
        value @ (Value::Null | Value::Bool(_) | Value::Number(_)) => value,
    }
}
