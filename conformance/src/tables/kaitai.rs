//! The streams as a Kaitai Struct description, from which the Kaitai compiler generates readers in
//! several programming languages.

use std::fmt::{self, Write};

use super::{FieldTable, SizeTable, StreamTable, Tables};

/// The first lines of the description.
const HEAD: &str = r#"meta:
  id: ads_cnc
  title: Byte streams with which an ISG or TwinCAT CNC is read and written over ADS
  license: MIT OR Apache-2.0
  ks-version: "0.10"
  endian: le
doc: |
  Version @VERSION@ of `ads-cnc tables --ksy`. Each type is a whole stream: read it from the data of an ADS
  request or reply. IDs in parentheses are requirements: `ads-cnc requirements VAR-4` prints one. Texts are bytes
  without the NUL; `name_text` is `name` as a string, which some languages reject for 81, 8D, 8F, 90 and 9D, the
  codes that Windows-1252 leaves undefined.
"#;

/// Returns the Kaitai Struct description of all streams, in YAML.
///
/// Each type checks that the stream is not longer than its maximum length, and that no bytes follow
/// the last field. The description does not check relations between values, such as the relation
/// between the size of a variable and its dimensions.
pub fn kaitai_struct(tables: &Tables) -> String {
    let mut out = HEAD.replace("@VERSION@", tables.version);
    // Writing to a string does not fail.
    let _written = write(tables, &mut out);
    out
}

fn write(tables: &Tables, out: &mut String) -> fmt::Result {
    writeln!(out, "types:")?;
    for stream in &tables.streams {
        let id = stream.name.replace('-', "_");
        writeln!(out, "  {id}:")?;
        writeln!(out, "    doc: {}", quoted(&format!("{} ({})", stream.title, stream.clause)))?;
        writeln!(out, "    seq:")?;
        if stream.repeats {
            writeln!(out, "      - id: records\n        type: record")?;
            writeln!(out, "        repeat: until\n        repeat-until: _io.eof")?;
        } else {
            fields(stream, "      ", out)?;
        }
        let max = stream.max_length;
        writeln!(out, "      - id: stream_end\n        size-eos: true")?;
        writeln!(out, "        valid:\n          expr: _.length == 0 and _io.size <= {max}")?;
        if stream.repeats {
            writeln!(out, "    types:\n      record:\n        seq:")?;
            fields(stream, "          ", out)?;
            texts(stream, "        ", out)?;
        } else {
            texts(stream, "    ", out)?;
        }
    }
    Ok(())
}

fn fields(stream: &StreamTable, indent: &str, out: &mut String) -> fmt::Result {
    // If a field may be absent, all fields after it may be absent too.
    let mut condition = None;
    for (place, field) in stream.fields.iter().enumerate() {
        let before = place.checked_sub(1).and_then(|place| stream.fields.get(place));
        let count = before.map_or("", |field| field.name);
        let after = stream.fields.get(place.saturating_add(1));
        writeln!(out, "{indent}- id: {}", field.name)?;
        writeln!(
            out,
            "{indent}  doc: {}",
            quoted(&format!("{} ({})", field.meaning, field.clause))
        )?;
        match field.size {
            SizeTable::FixedOnSuccess { .. } if condition.is_none() => {
                condition = Some(format!("{count} == 0 or not _io.eof"));
            }
            SizeTable::OptionalFixed { .. } => condition = Some("_io.size > 0".to_owned()),
            _ => {}
        }
        if let Some(condition) = &condition {
            writeln!(out, "{indent}  if: {condition}")?;
        }
        for line in attributes(field, count) {
            writeln!(out, "{indent}  {line}")?;
        }
        if let Some(FieldTable { size: SizeTable::Items { max, .. }, .. }) = after {
            writeln!(out, "{indent}  valid:\n{indent}    max: {max}")?;
        }
        if let Some(tail) = tail(&field.size) {
            writeln!(out, "{indent}- id: {}_tail", field.name)?;
            tail.iter().try_for_each(|line| writeln!(out, "{indent}  {line}"))?;
        }
    }
    Ok(())
}

/// Writes an instance `NAME_text` for each STRING field: the field's bytes as a string, which the
/// reader converts on access.
fn texts(stream: &StreamTable, indent: &str, out: &mut String) -> fmt::Result {
    let mut texts = stream.fields.iter().filter(|field| field.ty == "STRING").peekable();
    if texts.peek().is_some() {
        writeln!(out, "{indent}instances:")?;
    }
    texts.try_for_each(|field| {
        let name = field.name;
        writeln!(out, "{indent}  {name}_text:\n{indent}    value: {name}.to_s('windows-1252')")
    })
}

/// The type and length of a field in YAML; `count` is the name of the preceding field, which
/// contains the number of items if the field consists of items.
fn attributes(field: &FieldTable, count: &str) -> Vec<String> {
    let number = |bytes: u32| match (field.ty.as_str(), bytes) {
        ("REAL64", 8) => "type: f8".to_owned(),
        ("UNS08" | "UNS16" | "UNS32" | "BOOLEAN", 1 | 2 | 4) => format!("type: u{bytes}"),
        _ => format!("size: {bytes}"),
    };
    let line = |line: &str| line.to_owned();
    match field.size {
        SizeTable::Fixed { bytes }
        | SizeTable::FixedOnSuccess { bytes }
        | SizeTable::OptionalFixed { bytes } => vec![number(bytes)],
        SizeTable::NonZero { bytes } => {
            vec![number(bytes), line("valid:"), line("  expr: _ != 0")]
        }
        SizeTable::Padded { bytes } => vec![format!("size: {bytes}"), line("terminator: 0")],
        SizeTable::Items { each: 1, .. } => vec![format!("size: {count}")],
        SizeTable::Items { each, .. } => {
            vec![number(each), line("repeat: expr"), format!("repeat-expr: {count}")]
        }
        SizeTable::CStringPrefix { max } => {
            vec![line("terminator: 0"), line("valid:"), format!("  expr: _.length < {max}")]
        }
        SizeTable::CString { optional: false, .. } => vec![line("terminator: 0")],
        SizeTable::CString { optional: true, .. } => {
            vec![line("if: not _io.eof"), line("terminator: 0")]
        }
        SizeTable::OptionalNul { .. } => vec![
            line("terminator: 0"),
            line("eos-error: false"),
            line("valid:"),
            format!("  expr: _io.size > {}", field.offset),
        ],
        SizeTable::TextAndTail { .. } => vec![line("terminator: 0"), line("eos-error: false")],
        SizeTable::UnsignedRest { .. } => {
            ["type:", "  switch-on: _io.size", "  cases:", "    1: u1", "    2: u2", "    _: u4"]
                .map(line)
                .to_vec()
        }
        SizeTable::Rest { min: 0, .. } => vec![line("size-eos: true")],
        SizeTable::Rest { min, .. } => {
            vec![line("size-eos: true"), line("valid:"), format!("  expr: _.length >= {min}")]
        }
    }
}

/// The YAML for the bytes that follow a text, up to the end of the stream; `None` if the field is
/// not such a text.
fn tail(size: &SizeTable) -> Option<&'static [&'static str]> {
    match size {
        SizeTable::CString { .. } | SizeTable::OptionalNul { .. } => {
            Some(&["doc: NULs", "type: u1", "repeat: eos", "valid: 0"])
        }
        SizeTable::TextAndTail { .. } => {
            Some(&["doc: bytes after the NUL, without a meaning", "size-eos: true"])
        }
        _ => None,
    }
}

/// Formats a text as a YAML string in double quotes.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
