//! Formats bytes as lines, field by field.

use super::bytes::ShownField;
use super::{BytesReport, FieldReport};
use crate::text::hex;
use crate::value_format::ValueFormat;

/// The lines of bytes, without marks and without omissions.
pub(crate) fn annotated(stream: Option<&str>, bytes: &[u8]) -> Vec<String> {
    all_lines(&BytesReport::new(stream, bytes, None, &ValueFormat::default()), false)
}

/// The lines of each field, with at most 16 bytes on a line: offset, bytes, characters, name. Then
/// a line for each error. A line with a marked byte begins with an exclamation mark. Items of long
/// lists and long runs of zeros are omitted.
pub(super) fn lines(bytes: &BytesReport) -> Vec<String> {
    all_lines(bytes, true)
}

fn all_lines(bytes: &BytesReport, fold: bool) -> Vec<String> {
    let of_shown = |shown| match shown {
        ShownField::Field(field) => of_field(field, fold),
        ShownField::More(more) => vec![format!("     …  {more} more")],
    };
    let mut all: Vec<String> = if fold {
        bytes.visible_fields().into_iter().flat_map(of_shown).collect()
    } else {
        bytes.fields.iter().flat_map(|field| of_field(field, fold)).collect()
    };
    all.extend(bytes.faults.iter().map(|fault| format!("{FAULT}{fault}")));
    all
}

const FAULT: &str = "      ! ";

/// Whether a line describes an error in the preceding bytes.
pub(super) fn is_fault(line: &str) -> bool {
    line.starts_with(FAULT)
}

/// Like [`lines`], but only the lines with a marked byte.
pub(super) fn marked(bytes: &BytesReport) -> Vec<String> {
    lines(bytes).into_iter().filter(|line| line.starts_with('!')).collect()
}

fn of_field(field: &FieldReport, fold: bool) -> Vec<String> {
    let bytes = field.bytes();
    let (mut all, mut zeros) = (Vec::new(), 0_usize);
    for (begin, chunk) in (0_usize..).step_by(hex::LINE).zip(bytes.chunks(hex::LINE)) {
        let end = begin + hex::LINE;
        let differs = field.differs.iter().any(|place| (begin..end).contains(place));
        // Long padding would hide the fields after it.
        if fold && begin > 0 && !differs && chunk.iter().all(|&byte| byte == 0) {
            zeros += chunk.len();
            continue;
        }
        fill(&mut all, &mut zeros);
        let mark = if differs { '!' } else { ' ' };
        let at = field.offset + begin;
        let name = if begin == 0 { field.field.as_str() } else { "" };
        all.push(hex::line(mark, at, chunk, name));
    }
    fill(&mut all, &mut zeros);
    all
}

/// Adds a line for the omitted zeros.
fn fill(lines: &mut Vec<String>, zeros: &mut usize) {
    if *zeros > 0 {
        lines.push(format!("     …  {zeros} × 00"));
        *zeros = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An invalid stream is split into fields up to the error, which names the field.
    #[test]
    fn an_error_names_its_field() {
        let bytes = [1, 0, 0, 2, 9, 0, 0, 0, 4];
        let stream = Some("variable-handle-read");
        let report = BytesReport::new(stream, &bytes, None, &ValueFormat::default());
        assert_eq!(
            lines(&report),
            [
                "     0  01 00 00 02                                      ····              handle",
                "     4  09 00 00 00                                      ····              index_count",
                "     8  04                                               ·                 ?",
                "      ! index_count at offset 4: too many, expected at most 0 in the bytes that follow, found 9",
            ]
        );
    }

    #[test]
    fn differing_lines_are_marked() {
        let (bytes, mut other) = ([0x41; 20], [0x41; 20]);
        other[17] = 0;
        let report = BytesReport::new(None, &bytes, Some(&other), &ValueFormat::default());
        let marks: Vec<char> =
            lines(&report).iter().filter_map(|line| line.chars().next()).collect();
        assert_eq!(marks, [' ', '!']);
    }
}
