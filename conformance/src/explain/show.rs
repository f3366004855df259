//! Prints an explanation, with or without colour.

use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use super::explanation::{ExplainedAddress, ExplainedField, ExplainedStream, Explanation};
use crate::text::plural;

/// Maximum number of bytes on a line.
const LINE: usize = 8;
/// Maximum width in characters of the columns of field names and of values; a longer cell shifts
/// the rest of its row.
const VALUE_MAX: usize = 40;

/// Whether to use colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// No colour: for pipes and files.
    Plain,
    /// ANSI escape sequences, for terminals.
    Colour,
}

const HEAD: Style = Style::new().bold();
const NAME: Style = AnsiColor::Cyan.on_default();
const DIM: Style = Style::new().dimmed();
const FAULT: Style = AnsiColor::Red.on_default().bold();

impl Paint {
    fn style(self, style: Style, text: &str) -> String {
        match self {
            Self::Plain => text.to_owned(),
            Self::Colour if text.trim().is_empty() => text.to_owned(),
            Self::Colour => format!("{style}{text}{style:#}"),
        }
    }
}

/// Writes an explanation.
pub fn print(explanation: &Explanation, paint: Paint, out: &mut impl Write) -> io::Result<()> {
    for (number, part) in explanation.parts.iter().enumerate() {
        if number > 0 {
            writeln!(out)?;
        }
        show_part(part, explanation.parts.len() > 1, paint, out)?;
    }
    Ok(())
}

fn show_part(
    part: &ExplainedStream,
    several: bool,
    paint: Paint,
    out: &mut impl Write,
) -> io::Result<()> {
    if let Some(address) = &part.address {
        show_address(address, paint, out)?;
        if part.title.is_empty() {
            return Ok(());
        }
        writeln!(out)?;
    }
    let name = part.stream.map_or_else(String::new, |name| format!(": {name}"));
    let place = if several { format!(" from byte {}", part.at) } else { String::new() };
    let length = plural(part.length, "byte");
    writeln!(out, "{}, {length}{place}", paint.style(HEAD, &format!("{}{name}", part.title)))?;
    if let Some(clause) = part.clause {
        let sources = match part.sources.as_slice() {
            [] => "in no document: assumed".to_owned(),
            sources => sources.join("; "),
        };
        writeln!(out, "  {}", paint.style(DIM, &format!("{clause}: {sources}")))?;
    }
    let width = |text: fn(&ExplainedField) -> usize, most: usize| {
        part.rows.iter().map(text).filter(|&width| width <= most).max().unwrap_or(0)
    };
    let field = width(|row| row.field.chars().count(), VALUE_MAX);
    let value = width(|row| row.value.chars().count(), VALUE_MAX);
    let (mut record, records) = (None, part.rows.iter().any(|row| row.record > 0));
    for row in &part.rows {
        if records && record != Some(row.record) {
            writeln!(out, "  {}", paint.style(DIM, &format!("record {}", row.record)))?;
        }
        record = Some(row.record);
        show_row(row, field, value, paint, out)?;
    }
    if let Some(unread) = &part.unread {
        for (number, chunk) in chunks(&unread.hex).enumerate() {
            let at = unread.offset + number * LINE;
            // Name the field whose bytes are missing.
            let mut cut = part.faults.iter().filter(|fault| fault.offset == at);
            let name =
                cut.next().map(|fault| fault.field.as_str()).filter(|name| *name != "stream");
            let (name, text) = (name.unwrap_or_default(), "not read");
            let text = format!("! {at:6}  {chunk:<23}  {name:<field$}  {text}");
            writeln!(out, "{}", paint.style(FAULT, &text))?;
        }
    }
    for fault in &part.faults {
        writeln!(out, "{}", paint.style(FAULT, &format!("  fault: {}", fault.text)))?;
    }
    for note in &part.notes {
        writeln!(out, "  {}", paint.style(DIM, &format!("note: {note}")))?;
    }
    Ok(())
}

fn show_row(
    row: &ExplainedField,
    field: usize,
    value: usize,
    paint: Paint,
    out: &mut impl Write,
) -> io::Result<()> {
    let ExplainedField { offset, hex, clause, meaning, .. } = row;
    let hex = if row.below { "" } else { hex.as_str() };
    let mut lines = chunks(hex);
    let (mark, style) = if row.faulty { ("!", FAULT) } else { (" ", Style::new()) };
    let first = format!("{mark} {offset:6}  {:<23}", lines.next().unwrap_or_default());
    let (name, value) = (format!("{:<field$}", row.field), format!("{:<value$}", row.value));
    let line = format!(
        "{}  {}  {}  {}  {meaning}",
        paint.style(style, &first),
        paint.style(NAME, &name),
        paint.style(style, &value),
        paint.style(DIM, &format!("{clause:<6}")),
    );
    writeln!(out, "{}", line.trim_end())?;
    for (number, chunk) in (1_usize..).zip(lines) {
        let at = offset + number * LINE;
        writeln!(out, "{}", paint.style(style, &format!("{mark} {at:6}  {chunk}")))?;
    }
    for note in &row.notes {
        writeln!(out, "{:33}  {}", "", paint.style(DIM, &format!("= {note}")))?;
    }
    Ok(())
}

fn show_address(address: &ExplainedAddress, paint: Paint, out: &mut impl Write) -> io::Result<()> {
    let service = address.service.as_deref().unwrap_or("Service");
    let port = address.port.map_or_else(String::new, |port| format!(" at port {port}"));
    let (group, offset) = (address.index_group, address.index_offset);
    writeln!(out, "{}", paint.style(HEAD, &format!("{service} {group:#x}, {offset:#x}{port}")))?;
    writeln!(out, "  {:<8}  {group:#x}: {}", "group", address.group)?;
    if !address.offset.is_empty() {
        writeln!(out, "  {:<8}  {offset:#x}: {}", "offset", address.offset)?;
    }
    if let Some(function) = &address.function {
        let effect = match function.effect.as_str() {
            "query" => "changes nothing",
            "write" => "changes a value",
            _ => "may move the machine",
        };
        writeln!(
            out,
            "  {:<8}  {}: {} of {}, port {}; {effect}",
            "function",
            paint.style(NAME, function.name),
            function.service,
            function.task,
            function.port,
        )?;
        let streams = match (function.request, function.reply) {
            (Some(request), Some(reply)) => format!("sends {request}, returns {reply}"),
            (Some(request), None) => format!("sends {request}"),
            (None, Some(reply)) => format!("returns {reply}"),
            (None, None) => "sends and returns no data".to_owned(),
        };
        writeln!(out, "  {:<8}  {streams}", "")?;
        let text = format!("{}: {}", function.clause, function.section);
        writeln!(out, "  {:<8}  {}", "", paint.style(DIM, &text))?;
    }
    for note in &address.notes {
        writeln!(out, "  {:<8}  {}", "", paint.style(DIM, &format!("= {note}")))?;
    }
    Ok(())
}

/// Splits hex with a space between bytes into lines of at most `LINE` bytes.
fn chunks(hex: &str) -> impl Iterator<Item = &str> {
    let width = LINE * 3;
    let mut rest = hex;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        let (line, after) = rest.split_at_checked(width).unwrap_or((rest, ""));
        rest = after;
        Some(line.trim_end())
    })
}
