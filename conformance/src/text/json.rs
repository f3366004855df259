//! Writes JSON that cannot control a terminal: in its strings, all characters for which
//! [`is_escaped`] returns true are escaped, such as DEL and C1. The JSON parses to the same
//! characters.

use std::io::{self, Write};

use serde::Serialize;

use super::is_escaped;

/// Writes a value as indented JSON with a line end.
pub(crate) fn write(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(Escaping(&mut *out), value)?;
    writeln!(out)
}

/// Writes JSON, and escapes the characters for which [`is_escaped`] returns true. The line feeds
/// between the values are kept; those in strings are already escaped.
struct Escaping<'w>(&'w mut dyn Write);

impl Write for Escaping<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // `serde_json` writes whole characters; otherwise, this is an error.
        let text = std::str::from_utf8(bytes).map_err(io::Error::other)?;
        for part in text.split_inclusive(|one| one != '\n' && is_escaped(one)) {
            // All escaped characters have one UTF-16 code unit.
            match part.char_indices().next_back() {
                Some((at, last)) if last != '\n' && is_escaped(last) => {
                    let before = part.get(..at).unwrap_or_default();
                    write!(self.0, "{before}\\u{:04x}", u32::from(last))?;
                }
                _ => self.0.write_all(part.as_bytes())?,
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_json_has_the_same_value() {
        let value = serde_json::json!({
            "k\u{9b}": ["a\u{1b}b\u{7f}\u{90}\u{9d}\u{202e}", "é\u{1f600}\"\\\n", [], {}, 1.5],
        });
        let mut out = Vec::new();
        write(&value, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains(r#""a\u001bb\u007f\u0090\u009d\u202e""#), "{text}");
        assert!(text.contains("\"é\u{1f600}\\\"\\\\\\n\""), "{text}");
        assert!(!text.chars().any(|one| one != '\n' && is_escaped(one)), "{text:?}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), value);
        // The layout is the same as without escapes.
        let plain = serde_json::json!([{"a": [1, 2], "b": {}}, "c"]);
        let mut out = Vec::new();
        write(&plain, &mut out).unwrap();
        assert_eq!(String::from_utf8(out).unwrap().trim_end(), format!("{plain:#}"));
    }
}
