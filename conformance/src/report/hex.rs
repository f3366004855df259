//! Bytes as people read them.

use std::fmt::Write as _;

use ads_cnc::layout::Stream;

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

/// One line for each field: offset, bytes, field; up to the fault, if there is one.
pub(crate) fn annotated(stream: Option<&str>, bytes: &[u8]) -> Vec<String> {
    let Some(stream) = stream.and_then(Stream::by_name) else {
        return lines(0, bytes, "");
    };
    let mut all = Vec::new();
    let mut end = 0_usize;
    let walked = stream.walk(bytes, |segment| {
        let at = usize::try_from(segment.offset).unwrap_or(usize::MAX);
        end = at.saturating_add(segment.bytes.len());
        all.extend(lines(at, segment.bytes, segment.field.name()));
    });
    if let Err(error) = walked {
        all.extend(lines(end, bytes.get(end..).unwrap_or_default(), "?"));
        all.push(format!("      ! {error}"));
    }
    all
}

fn lines(at: usize, bytes: &[u8], field: &str) -> Vec<String> {
    if bytes.is_empty() {
        return Vec::new();
    }
    let chunks = (at..).step_by(LINE).zip(bytes.chunks(LINE)).enumerate();
    chunks
        .map(|(line, (at, chunk))| {
            let field = if line == 0 { field } else { "" };
            let text: String = chunk
                .iter()
                .map(|&byte| if byte.is_ascii_graphic() { char::from(byte) } else { '·' })
                .collect();
            format!("{at:6}  {:<47}  {text:<16}  {field}", plain(chunk)).trim_end().to_owned()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is shown of a broken stream goes up to its fault and names it.
    #[test]
    fn a_fault_is_shown_where_it_is() {
        let shown = annotated(Some("variable-handle-read"), &[1, 0, 0, 2, 9, 0, 0, 0, 4]);
        assert_eq!(
            shown,
            [
                "     0  01 00 00 02                                      ····              handle",
                "     4  09 00 00 00                                      ····              index_count",
                "     8  04                                               ·                 ?",
                "      ! variable-handle-read: index_count at offset 4: too many, at most 0 expected, 9 found",
            ]
        );
    }
}
