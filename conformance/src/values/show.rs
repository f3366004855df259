//! Formats values.

use ads_cnc::Element;
use ads_cnc::text::cp1252_to_char;

use super::Type;
use crate::number::to_usize;
use crate::text::escape;

/// Maximum width of the elements on a line in characters; a single element may be wider.
const WIDTH: usize = 72;
/// Maximum number of numbers on a line.
const PER_LINE: usize = 10;

/// Escapes the control characters, separators and bidirectional controls of `crate::text::escape`.
pub fn printable(text: &str) -> String {
    escape(text)
}

/// Formats the whole value on one line; `None` if the type is unknown or the bytes do not match it.
/// [`parse`](super::parse()) accepts the line, except for example NaN, infinities, an array without
/// elements, and a text that does not fit with its escapes and a NUL. It parses escaped characters
/// literally.
pub fn plain(ty: &Type, bytes: &[u8]) -> Option<String> {
    let elements = ty.elements(bytes).ok().flatten()?;
    let several = !ty.dimensions.is_empty();
    let items = elements.iter().map(|element| match element {
        Element::String(text) if several => listed(&printable(&text.text().to_string())),
        Element::String(text) => printable(&text.text().to_string()),
        other => number(other),
    });
    Some(items.collect::<Vec<_>>().join(","))
}

/// Formats a text in a list. A text that contains a comma or a quote, or starts or ends with a
/// blank, is quoted.
fn listed(text: &str) -> String {
    if text.contains([',', '"']) || text != text.trim() {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Formats an element that is not a text, in the form that `parse` accepts if the number is finite.
pub(crate) fn number(element: Element<'_>) -> String {
    match element {
        // Unlike the display format, the debug format always has a decimal point or an exponent.
        Element::Real32(number) => format!("{number:?}"),
        Element::Real64(number) => format!("{number:?}"),
        other => other.to_string(),
    }
}

/// Formats an element for a reader. A STRING is quoted, and any text after its first NUL is added.
/// For a BOOLEAN other than 0 and 1, its byte is added.
fn display(element: Element<'_>) -> String {
    match element {
        Element::Boolean(flag) if flag.0 > 1 => format!("TRUE ({})", flag.0),
        Element::String(text) => {
            let quoted = |bytes: &[u8]| {
                let text: String = bytes.iter().copied().map(cp1252_to_char).collect();
                format!("{text:?}")
            };
            let bytes: Vec<u8> = text.text().bytes().collect();
            match text.tail() {
                Some(tail) if tail.iter().any(|&byte| byte != 0) => {
                    let end = tail.iter().rposition(|&byte| byte != 0).unwrap_or(0);
                    let tail = tail.get(..=end).unwrap_or(tail);
                    format!("{} and after its NUL {}", quoted(&bytes), quoted(tail))
                }
                _ => quoted(&bytes),
            }
        }
        other => number(other),
    }
}

/// Formats the value on lines. A single element has no indices. Each line of an array starts with
/// the indices of its first element, and contains one text, or as many numbers of the row as fit,
/// at most 10.
///
/// ```
/// use ads_cnc::value::DataType;
/// use ads_cnc_conformance::values::{Type, lines};
///
/// let matrix = Type::known(DataType::Uns08, vec![2, 3]);
/// let shown = lines(&matrix, &[1, 2, 3, 40, 5, 6]).unwrap();
/// assert_eq!(shown, ["[0][0]   1   2   3", "[1][0]  40   5   6"]);
/// ```
///
/// Returns `None` if the type is unknown or the bytes do not match it.
pub fn lines(ty: &Type, bytes: &[u8]) -> Option<Vec<String>> {
    let elements = ty.elements(bytes).ok().flatten()?;
    let texts: Vec<String> = elements.iter().map(display).collect();
    let Some(&row) = ty.dimensions.last() else { return Some(texts) };
    let row = to_usize(row).max(1);
    let widest = |texts: &[String]| texts.iter().map(|text| text.chars().count()).max();
    let (width, is_text) = (widest(&texts).unwrap_or(0), texts.iter().any(|t| t.starts_with('"')));
    let fit = WIDTH.checked_div(width.saturating_add(2)).unwrap_or(1).clamp(1, PER_LINE);
    let fit = if is_text { 1 } else { fit };
    let mut all: Vec<(String, String)> = Vec::new();
    for (number, chunk) in texts.chunks(row).enumerate() {
        for (part, items) in chunk.chunks(fit).enumerate() {
            let at = number.saturating_mul(row).saturating_add(part.saturating_mul(fit));
            let items: Vec<String> = items.iter().map(|item| format!("{item:>width$}")).collect();
            let items = if is_text { items.concat().trim().to_owned() } else { items.join("  ") };
            all.push((element_label(at, &ty.dimensions), items));
        }
    }
    let width = all.iter().map(|(label, _)| label.len()).max().unwrap_or(0);
    Some(all.into_iter().map(|(label, items)| format!("{label:<width$}  {items}")).collect())
}

/// The indices of the element at position `at`, in brackets; the last index changes fastest
/// (VAR-21, assumed).
pub(crate) fn element_label(at: usize, dimensions: &[u32]) -> String {
    let (mut left, mut all) = (at, Vec::new());
    for &len in dimensions.iter().rev() {
        let len = to_usize(len);
        all.push(left.checked_rem(len).unwrap_or(0));
        left = left.checked_div(len).unwrap_or(0);
    }
    all.iter().rev().map(|index| format!("[{index}]")).collect()
}

#[cfg(test)]
mod tests {
    use ads_cnc::value::DataType;

    use super::*;

    #[test]
    fn unusual_texts_are_shown_completely() {
        let ty = Type::hinted(DataType::String);
        assert_eq!(lines(&ty, b"L\xE4nge\0\0").unwrap(), ["\"Länge\""]);
        assert_eq!(lines(&ty, b"a\0b\0").unwrap(), ["\"a\" and after its NUL \"b\""]);
        assert_eq!(plain(&ty, b"\x1B[2J\0").unwrap(), "\\u{1b}[2J");
        let two = Type { dimensions: vec![2], ..ty };
        assert_eq!(plain(&two, b"a,b\0c\0\0\0").unwrap(), "\"a,b\",c");
        assert_eq!(lines(&two, b"a,b\0c\0\0\0").unwrap(), ["[0]  \"a,b\"", "[1]  \"c\""]);
    }

    #[test]
    fn long_rows_are_split() {
        let ty = Type::known(DataType::Uns08, vec![12]);
        let bytes: Vec<u8> = (0..12).collect();
        let shown = lines(&ty, &bytes).unwrap();
        assert_eq!(shown, ["[0]    0   1   2   3   4   5   6   7   8   9", "[10]  10  11"]);
    }

    #[test]
    fn invalid_bytes_have_no_lines() {
        assert_eq!(lines(&Type::known(DataType::Uns32, vec![]), &[1, 2]), None);
        assert_eq!(plain(&Type::UNKNOWN, &[1, 2]), None);
        let odd = Type::hinted(DataType::Boolean);
        assert_eq!(lines(&odd, &[2]).unwrap(), ["TRUE (2)"]);
    }
}
