//! Parses hex in the usual notations.

use std::fmt;

/// An invalid character in hex text, or a byte with only one digit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HexError {
    /// The line, starting at 1.
    pub line: usize,
    /// The column in characters, starting at 1.
    pub column: usize,
    /// The character that is not a hex digit; `None` if a byte has only one digit.
    pub found: Option<char>,
}

impl fmt::Display for HexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, found } = self;
        match found {
            Some(found) => write!(f, "line {line}, column {column}: {found:?} is not a hex digit"),
            None => write!(f, "line {line}, column {column}: a byte must have two hex digits"),
        }
    }
}

impl std::error::Error for HexError {}

/// Parses hex: two digits for each byte. Bytes may be separated by white space, commas, semicolons,
/// colons or hyphens; at the beginning and after a separator, `0x` may precede the digits.
///
/// ```
/// use ads_cnc_conformance::explain::parse_hex;
///
/// for text in ["0200000a", "0x02 0x00, 0x00 0x0A", "02:00:00:0a", "0x0200\n000A"] {
///     assert_eq!(parse_hex(text)?, [2, 0, 0, 10]);
/// }
/// assert_eq!(parse_hex("02 0g").unwrap_err().to_string(), "line 1, column 5: 'g' is not a hex digit");
/// # Ok::<(), ads_cnc_conformance::explain::HexError>(())
/// ```
///
/// # Errors
/// The first character that is not a hex digit, or the first byte with only one digit.
pub fn parse_hex(text: &str) -> Result<Vec<u8>, HexError> {
    let mut bytes = Vec::with_capacity(text.len().checked_div(2).unwrap_or(0));
    let (mut line, mut column) = (1_usize, 0_usize);
    // The first digit of a byte with its position, and whether a word starts there.
    let mut open: Option<(u8, HexError, bool)> = None;
    let mut begins = true;
    for found in text.chars() {
        column = column.saturating_add(1);
        let here = HexError { line, column, found: Some(found) };
        let digit = found.to_digit(16).and_then(|digit| u8::try_from(digit).ok());
        match (open, digit) {
            (Some((high, ..)), Some(low)) => {
                bytes.push(high << 4 | low);
                (open, begins) = (None, false);
            }
            (None, Some(high)) => {
                open = Some((high, HexError { found: None, ..here }, begins));
            }
            (Some((0, _, true)), None) if matches!(found, 'x' | 'X') => {
                (open, begins) = (None, false);
            }
            (_, None) if found.is_whitespace() || matches!(found, ',' | ';' | ':' | '-') => {
                if let Some((_, alone, _)) = open {
                    return Err(alone);
                }
                begins = true;
                if found == '\n' {
                    (line, column) = (line.saturating_add(1), 0);
                }
            }
            (_, None) => return Err(here),
        }
    }
    open.map_or(Ok(bytes), |(_, alone, _)| Err(alone))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_invalid_digit_is_reported_with_its_position() {
        for (text, why) in [
            ("02 0", "line 1, column 4: a byte must have two hex digits"),
            ("02 0 03", "line 1, column 4: a byte must have two hex digits"),
            ("02\n0x0x", "line 2, column 4: 'x' is not a hex digit"),
            ("020x00", "line 1, column 4: 'x' is not a hex digit"),
            ("02 ä", "line 1, column 4: 'ä' is not a hex digit"),
        ] {
            assert_eq!(parse_hex(text).unwrap_err().to_string(), why, "{text:?}");
        }
        assert_eq!(parse_hex(""), Ok(Vec::new()));
    }
}
