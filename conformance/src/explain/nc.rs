//! Explains NC text in a stream line by line, with the rules of streaming.

use ads_cnc::layout::Segment;
use ads_cnc::streaming::{self, LineError, NcText, check_line_ends};

use super::codes::quoted;
use super::explanation::{ExplainedFault, ExplainedField, ExplainedStream};
use super::value::row;
use crate::number::to_usize;

/// A line: its offset in the data, and its bytes with the line end.
struct Line<'a> {
    at: usize,
    bytes: &'a [u8],
}

/// Adds a row for each line of NC text, and the faults and notes of the codec about the text. If
/// the codec can check the text, also adds a note about the limits of this check.
pub(super) fn add(part: &mut ExplainedStream, segment: &Segment<'_>) {
    let (data, whole) = (segment.bytes, row(segment));
    let lines = lines(data);
    for (number, line) in (1_u32..).zip(&lines) {
        let mut row = ExplainedField {
            item: number.saturating_sub(1),
            ty: "STRING".to_owned(),
            clause: whole.clause,
            ..ExplainedField::new(
                line.at,
                line.bytes,
                &format!("line {number}"),
                quoted(line.bytes),
            )
        };
        row.meaning = if number == 1 { whole.meaning } else { "" };
        part.rows.push(row);
    }
    // A CNC accepts these bytes, and detects a wrong line end only when it reads the line.
    if let Err(error) = check_line_ends(data) {
        let number = streaming::LINE_END_ERROR;
        fault(part, &lines, &error, &format!(": the CNC aborts with error {number}"));
    }
    match NcText::new(data) {
        Err(error) => fault(part, &lines, &error, ""),
        Ok(text) => {
            for finding in text.diagnostics() {
                let at = place(&lines, finding.line, finding.column);
                let line = format!("line {}", finding.line);
                if finding.kind.ends_streaming() {
                    part.push_fault(ExplainedFault {
                        class: "nc-word",
                        field: line,
                        offset: at,
                        expected: None,
                        found: None,
                        text: format!("{finding}: the CNC ends streaming"),
                    });
                } else if let Some(row) = part.rows.iter_mut().find(|row| row.field == line) {
                    row.notes.push(finding.to_string());
                }
            }
            part.faults.sort_by_key(|fault| fault.offset);
            part.notes.push(
                "checked as one text; jumps and comments may continue in another write".to_owned(),
            );
        }
    }
}

fn fault(part: &mut ExplainedStream, lines: &[Line<'_>], error: &LineError, what: &str) {
    part.push_fault(ExplainedFault {
        class: "nc-line",
        field: format!("line {}", error.line()),
        offset: place(lines, error.line(), error.column()),
        expected: None,
        found: None,
        text: format!("{error}{what}"),
    });
}

/// The offset in the data of a line and column, which count from 1.
fn place(lines: &[Line<'_>], line: u32, column: u32) -> usize {
    let back = |number: u32| to_usize(number.saturating_sub(1));
    lines.get(back(line)).map_or(0, |line| line.at.saturating_add(back(column)))
}

/// The lines with their line ends, as the codec counts them: LF, CR LF, or only CR.
fn lines(data: &[u8]) -> Vec<Line<'_>> {
    let (mut lines, mut at, mut rest) = (Vec::new(), 0_usize, data);
    while !rest.is_empty() {
        let text = rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len());
        let end = match rest.get(text..) {
            Some([b'\r', b'\n', ..]) => 2,
            Some([_, ..]) => 1,
            _ => 0,
        };
        let (bytes, after) = rest.split_at_checked(text.saturating_add(end)).unwrap_or((rest, &[]));
        lines.push(Line { at, bytes });
        (at, rest) = (at.saturating_add(bytes.len()), after);
    }
    lines
}
