//! Writes JSON that cannot control a terminal: in its strings, all characters for which
//! [`is_escaped`] returns true are escaped, such as DEL and C1. The JSON parses to the same
//! characters.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::{Formatter, PrettyFormatter};

use super::is_escaped;

/// Writes a value as indented JSON with a line end.
pub(crate) fn write(value: &impl Serialize, out: &mut dyn Write) -> io::Result<()> {
    let escaping = Escaping(PrettyFormatter::new());
    value.serialize(&mut Serializer::with_formatter(&mut *out, escaping))?;
    writeln!(out)
}

struct Escaping<'a>(PrettyFormatter<'a>);

/// Formats like [`PrettyFormatter`], except for string fragments.
impl Formatter for Escaping<'_> {
    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        for part in fragment.split_inclusive(is_escaped) {
            // All escaped characters have one UTF-16 code unit.
            match part.char_indices().next_back() {
                Some((at, last)) if is_escaped(last) => {
                    let before = part.get(..at).unwrap_or_default();
                    write!(out, "{before}\\u{:04x}", u32::from(last))?;
                }
                _ => out.write_all(part.as_bytes())?,
            }
        }
        Ok(())
    }

    fn begin_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_array(out)
    }

    fn end_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_array(out)
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_array_value(out, first)
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_array_value(out)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_object(out)
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_object(out)
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_object_key(out, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_object_value(out)
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_object_value(out)
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
