//! The dissector for Wireshark, in Lua.

use serde_json::Value;

use super::Tables;

/// The Lua program of the dissector, with the placeholders `@VERSION@` and `@TABLES@`.
const PROGRAM: &str = include_str!("ads_cnc.lua");

/// The dissector, including the tables, as a Lua script.
pub fn dissector(tables: &Tables) -> Result<String, serde_json::Error> {
    let mut literal = String::new();
    to_lua(&serde_json::to_value(tables)?, "", &mut literal);
    Ok(PROGRAM.replace("@VERSION@", tables.version).replace("@TABLES@", &literal))
}

/// Writes a value as a Lua expression. Each item of an array that contains an object is on a
/// separate line.
fn to_lua(value: &Value, indent: &str, out: &mut String) {
    match value {
        Value::Null => out.push_str("nil"),
        Value::String(text) => quote(text, out),
        Value::Bool(_) | Value::Number(_) => out.push_str(&value.to_string()),
        Value::Array(items) => {
            let is_long = items.iter().any(Value::is_object);
            let inner = format!("{indent}  ");
            out.push('{');
            for item in items {
                out.push_str(&if is_long { format!("\n{inner}") } else { " ".to_owned() });
                to_lua(item, &inner, out);
                out.push(',');
            }
            out.push_str(&if is_long { format!("\n{indent}}}") } else { " }".to_owned() });
        }
        Value::Object(entries) => {
            out.push('{');
            for (key, value) in entries {
                out.push_str(&format!(" {key} = "));
                to_lua(value, indent, out);
                out.push(',');
            }
            out.push_str(" }");
        }
    }
}

/// Writes a string literal; characters beyond ASCII remain UTF-8.
fn quote(text: &str, out: &mut String) {
    out.push('"');
    for char in text.chars() {
        match char {
            '"' | '\\' => out.extend(['\\', char]),
            '\n' => out.push_str("\\n"),
            _ => out.push(char),
        }
    }
    out.push('"');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_quoted() {
        let mut lua = String::new();
        let value = serde_json::json!({ "a": "\"\\\n", "b": [1, null], "c": [{ "d": true }] });
        to_lua(&value, "", &mut lua);
        let expected = "{ a = \"\\\"\\\\\\n\", b = { 1, nil, }, c = {\n  { d = true, },\n}, }";
        assert_eq!(lua, expected);
    }

    #[test]
    fn the_dissector_has_every_stream_and_function() {
        let tables = Tables::new();
        let script = dissector(&tables).unwrap();
        assert!(!script.contains("@TABLES@") && !script.contains("@VERSION@"));
        let names = tables.streams.iter().map(|stream| format!("name = \"{}\"", stream.name));
        let ids = tables.functions.iter().map(|function| format!("id = \"{}\"", function.id));
        for part in names.chain(ids) {
            assert!(script.contains(&part), "{part}");
        }
    }
}
