//! Bytes as people read them.

use std::fmt::Write as _;

use super::{BytesReport, FieldReport};
use crate::explain::Values;

/// Bytes of a field shown on one line.
const LINE: usize = 16;

/// Bytes in hex with a space between two.
pub(crate) fn plain(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().saturating_mul(3));
    for (place, byte) in bytes.iter().enumerate() {
        let gap = if place == 0 { "" } else { " " };
        // Writing to a string cannot fail.
        let _ = write!(text, "{gap}{byte:02x}");
    }
    text
}

/// A byte as a character, if it is one.
pub(super) fn character(byte: u8) -> char {
    if byte.is_ascii_graphic() { char::from(byte) } else { '·' }
}

/// The lines of bytes that are held against nothing.
pub(crate) fn annotated(stream: Option<&str>, bytes: &[u8]) -> Vec<String> {
    lines(&BytesReport::new(stream, bytes, None, &Values::default()))
}

/// One line for each field: offset, bytes, characters, name; up to the fault, if there is one. A
/// line with a byte that is not the expected one begins with an exclamation mark.
pub(super) fn lines(bytes: &BytesReport) -> Vec<String> {
    let mut all: Vec<String> = bytes.fields.iter().flat_map(of_field).collect();
    all.extend(bytes.faults.iter().map(|fault| format!("      ! {fault}")));
    all
}

fn of_field(field: &FieldReport) -> Vec<String> {
    let bytes: Vec<u8> = field.bytes().collect();
    let begins = (0_usize..).step_by(LINE);
    let line = |(begin, chunk): (usize, &[u8])| {
        let end = begin.saturating_add(LINE);
        let differs = field.differs.iter().any(|place| (begin..end).contains(place));
        let mark = if differs { '!' } else { ' ' };
        let at = field.offset.saturating_add(begin);
        let text: String = chunk.iter().copied().map(character).collect();
        let name = if begin == 0 { field.field.as_str() } else { "" };
        format!("{mark}{at:5}  {:<47}  {text:<16}  {name}", plain(chunk)).trim_end().to_owned()
    };
    begins.zip(bytes.chunks(LINE)).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is shown of a broken stream goes up to its fault and names it.
    #[test]
    fn a_fault_is_shown_where_it_is() {
        let bytes = [1, 0, 0, 2, 9, 0, 0, 0, 4];
        let stream = Some("variable-handle-read");
        let report = BytesReport::new(stream, &bytes, None, &Values::default());
        assert_eq!(
            lines(&report),
            [
                "     0  01 00 00 02                                      ····              handle",
                "     4  09 00 00 00                                      ····              index_count",
                "     8  04                                               ·                 ?",
                "      ! index_count at offset 4: too many, at most 0 expected, 9 found",
            ]
        );
    }

    /// What differs is marked, on its line.
    #[test]
    fn differing_lines_are_marked() {
        let (bytes, mut other) = ([0x41; 20], [0x41; 20]);
        other[17] = 0;
        let report = BytesReport::new(None, &bytes, Some(&other), &Values::default());
        let marks: Vec<char> =
            lines(&report).iter().filter_map(|line| line.chars().next()).collect();
        assert_eq!(marks, [' ', '!']);
    }
}
