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

const HEAD: Style = Style::new().bold();
const NAME: Style = AnsiColor::Cyan.on_default();
const DIM: Style = Style::new().dimmed();
const FAULT: Style = AnsiColor::Red.on_default().bold();

/// The text in this style, if colour is on.
fn styled(color: bool, style: Style, text: &str) -> String {
    if color && !text.trim().is_empty() {
        format!("{style}{text}{style:#}")
    } else {
        text.to_owned()
    }
}

/// Writes an explanation; with `color`, it contains ANSI escape sequences for a terminal.
pub fn print(explanation: &Explanation, color: bool, out: &mut dyn Write) -> io::Result<()> {
    for (number, part) in explanation.parts.iter().enumerate() {
        if number > 0 {
            writeln!(out)?;
        }
        show_part(part, explanation.parts.len() > 1, color, out)?;
    }
    Ok(())
}

fn show_part(
    part: &ExplainedStream,
    several: bool,
    color: bool,
    out: &mut dyn Write,
) -> io::Result<()> {
    if let Some(address) = &part.address {
        show_address(address, color, out)?;
        if part.title.is_empty() {
            return Ok(());
        }
        writeln!(out)?;
    }
    let name = part.stream.map_or_else(String::new, |name| format!(": {name}"));
    let place = if several { format!(" from byte {}", part.at) } else { String::new() };
    let length = plural(part.length, "byte");
    writeln!(out, "{}, {length}{place}", styled(color, HEAD, &format!("{}{name}", part.title)))?;
    if let Some(clause) = part.clause {
        let sources = match part.sources.as_slice() {
            [] => "not in the manuals: an assumption of this project".to_owned(),
            sources => sources.join("; "),
        };
        writeln!(out, "  {}", styled(color, DIM, &format!("{clause}: {sources}")))?;
    }
    let width = |text: fn(&ExplainedField) -> usize, most: usize| {
        part.rows.iter().map(text).filter(|&width| width <= most).max().unwrap_or(0)
    };
    let field = width(|row| row.field.chars().count(), VALUE_MAX);
    let value = width(|row| row.value.chars().count(), VALUE_MAX);
    let (mut record, records) = (None, part.rows.iter().any(|row| row.record > 0));
    for row in &part.rows {
        if records && record != Some(row.record) {
            writeln!(out, "  {}", styled(color, DIM, &format!("record {}", row.record)))?;
        }
        record = Some(row.record);
        show_row(row, field, value, color, out)?;
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
            writeln!(out, "{}", styled(color, FAULT, &text))?;
        }
    }
    for fault in &part.faults {
        writeln!(out, "{}", styled(color, FAULT, &format!("  fault: {}", fault.text)))?;
    }
    for note in &part.notes {
        writeln!(out, "  {}", styled(color, DIM, &format!("note: {note}")))?;
    }
    Ok(())
}

fn show_row(
    row: &ExplainedField,
    field: usize,
    value: usize,
    color: bool,
    out: &mut dyn Write,
) -> io::Result<()> {
    let ExplainedField { offset, hex, clause, meaning, .. } = row;
    let hex = if row.below { "" } else { hex.as_str() };
    let mut lines = chunks(hex);
    let (mark, style) = if row.faulty { ("!", FAULT) } else { (" ", Style::new()) };
    let first = format!("{mark} {offset:6}  {:<23}", lines.next().unwrap_or_default());
    let (name, value) = (format!("{:<field$}", row.field), format!("{:<value$}", row.value));
    let line = format!(
        "{}  {}  {}  {}  {meaning}",
        styled(color, style, &first),
        styled(color, NAME, &name),
        styled(color, style, &value),
        styled(color, DIM, &format!("{clause:<6}")),
    );
    writeln!(out, "{}", line.trim_end())?;
    for (number, chunk) in (1_usize..).zip(lines) {
        let at = offset + number * LINE;
        writeln!(out, "{}", styled(color, style, &format!("{mark} {at:6}  {chunk}")))?;
    }
    for note in &row.notes {
        writeln!(out, "{:33}  {}", "", styled(color, DIM, &format!("= {note}")))?;
    }
    Ok(())
}

fn show_address(address: &ExplainedAddress, color: bool, out: &mut dyn Write) -> io::Result<()> {
    let service = address.service.as_deref().unwrap_or("Service");
    let port = address.port.map_or_else(String::new, |port| format!(" at port {port}"));
    let (group, offset) = (address.index_group, address.index_offset);
    writeln!(out, "{}", styled(color, HEAD, &format!("{service} {group:#x}, {offset:#x}{port}")))?;
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
            styled(color, NAME, function.name),
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
        writeln!(out, "  {:<8}  {}", "", styled(color, DIM, &text))?;
    }
    for note in &address.notes {
        writeln!(out, "  {:<8}  {}", "", styled(color, DIM, &format!("= {note}")))?;
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
