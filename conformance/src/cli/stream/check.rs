//! Checks a program before it is sent.

use std::io::{self, Write};

use crate::text::plural;
use ads_cnc::streaming::{LineError, NcText};

/// Maximum number of messages that are printed; a file that is not a text would give many.
const SHOWN_MAX: usize = 100;

/// A text whose lines can all be sent.
pub(super) struct CheckedText<'a> {
    pub(super) text: NcText<'a>,
    /// Number of diagnostics about constructs that would end streaming.
    pub(super) ends: usize,
}

/// Checks a text. Prints a message for each line that cannot be sent or, if all lines can be sent,
/// for each diagnostic; at most [`SHOWN_MAX`] messages. Returns `None` if a line cannot be sent.
pub(super) fn check<'a>(
    bytes: &'a [u8],
    name: &str,
    out: &mut dyn Write,
) -> Option<CheckedText<'a>> {
    let mut messages = Messages { out, count: 0 };
    let Ok(text) = NcText::new(bytes) else {
        for (line, error) in line_errors(bytes) {
            let (column, kind, clause) = (error.column(), error.kind(), error.kind().clause());
            messages.write(format_args!("{name}:{line}:{column}: error: {kind} ({clause})"));
        }
        messages.end();
        return None;
    };
    let mut ends = 0_usize;
    for finding in text.diagnostics() {
        let (line, column) = (finding.line, finding.column);
        let level = if finding.kind.ends_streaming() { "error" } else { "warning" };
        ends = ends.saturating_add(usize::from(finding.kind.ends_streaming()));
        // Print the position in the format of compilers instead of the format of the diagnostic.
        let whole = finding.to_string();
        let place = format!("line {line}, column {column}: ");
        let what = whole.strip_prefix(&place).unwrap_or(&whole);
        messages.write(format_args!("{name}:{line}:{column}: {level}: {what}"));
    }
    messages.end();
    Some(CheckedText { text, ends })
}

struct Messages<'o> {
    out: &'o mut dyn Write,
    count: usize,
}

impl Messages<'_> {
    fn write(&mut self, message: std::fmt::Arguments<'_>) {
        self.count = self.count.saturating_add(1);
        if self.count <= SHOWN_MAX {
            let _unread: io::Result<()> = writeln!(self.out, "{message}");
        }
    }

    fn end(&mut self) {
        if let Some(more) = self.count.checked_sub(SHOWN_MAX).filter(|more| *more > 0) {
            let _unread: io::Result<()> =
                writeln!(self.out, "… and {}", plural(more, "more message"));
        }
    }
}

/// The first error of each line, with the line number.
fn line_errors(bytes: &[u8]) -> impl Iterator<Item = (u32, LineError)> {
    let mut rest = bytes;
    let lines = std::iter::from_fn(move || {
        let end = rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len());
        let (line, after) = rest.split_at_checked(end).filter(|_| !rest.is_empty())?;
        rest = match after {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => &[],
        };
        Some(line)
    });
    (1..).zip(lines).filter_map(|(number, line)| Some((number, NcText::new(line).err()?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output_of(bytes: &[u8]) -> (String, Option<usize>) {
        let mut out = Vec::new();
        let checked = check(bytes, "part.nc", &mut out);
        let ends = checked.map(|checked| checked.ends);
        (String::from_utf8(out).unwrap(), ends)
    }

    /// The number of the first reported line is the same as in the error of the codec.
    #[test]
    fn every_line_that_cannot_be_sent_is_reported() {
        let long = [&b"\r"[..], &[b'X'; 991]].concat();
        let bytes = [&b"N1 (\xE4 \xF6)\r\n\nN3\n\0N4\rN5 \x80"[..], &long].concat();
        let (output, ends) = output_of(&bytes);
        assert_eq!(
            output,
            "part.nc:1:5: error: ASCII character expected, byte 0xE4 found (STM-7)\n\
             part.nc:4:1: error: ASCII character expected, NUL found (STM-7)\n\
             part.nc:5:4: error: ASCII character expected, byte 0x80 found (STM-7)\n\
             part.nc:6:991: error: line of at most 990 characters expected, 991 found (STM-20)\n"
        );
        assert_eq!(ends, None);
        assert_eq!(NcText::new(&bytes).unwrap_err().line(), 1);
    }

    #[test]
    fn findings_are_errors_or_warnings() {
        let (output, ends) =
            output_of(b"N10: G0 X0\nN20 $GOTO N10\nN30 $WHILE 1\nN40 M30\nN50 X1\n");
        assert_eq!(
            output,
            "part.nc:2:5: error: $GOTO back to line 1 (STM-8)\n\
             part.nc:3:5: error: $WHILE in a stream (STM-8)\n\
             part.nc:5:1: warning: text after the M30 of line 4 (STM-10)\n"
        );
        assert_eq!(ends, Some(2));
    }

    #[test]
    fn messages_about_a_binary_file_are_limited() {
        let (output, _) = output_of(&b"\xFF\n".repeat(1000));
        assert_eq!(output.lines().count(), SHOWN_MAX + 1);
        assert!(output.ends_with("\n… and 900 more messages\n"), "{output}");
    }
}
