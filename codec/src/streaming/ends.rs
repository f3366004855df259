//! Line ends.

use super::{LineError, LineErrorKind};
use crate::bytes::to_u32;

pub(super) const CR: u8 = b'\r';
pub(super) const LF: u8 = b'\n';

pub(super) const fn is_end(byte: u8) -> bool {
    matches!(byte, CR | LF)
}

/// Splits a text into its first line and the rest, which begins with the line end if there is one.
pub(super) fn split_at_end(bytes: &[u8]) -> (&[u8], &[u8]) {
    let len = bytes.iter().position(|&byte| is_end(byte)).unwrap_or(bytes.len());
    bytes.split_at_checked(len).unwrap_or((bytes, &[]))
}

/// The text without the line end at its start, if there is one.
pub(super) const fn after_end(bytes: &[u8]) -> &[u8] {
    match bytes {
        [LF, rest @ ..] | [CR, LF, rest @ ..] | [CR, rest @ ..] => rest,
        _ => bytes,
    }
}

/// Checks that each line of received data ends in CR LF, as a CNC does when it reads its stream.
///
/// Use this function in a server. The text that a client sends may have other line ends, which are
/// replaced by CR LF in its [`packets`](super::NcText::packets).
///
/// Manual: `stream-en`, section 4.1 (STM-5).
///
/// ```
/// use ads_cnc::streaming::check_line_ends;
///
/// assert_eq!(check_line_ends(b"N10 G0 X0\r\nN20 M30\r\n"), Ok(()));
/// assert_eq!(
///     check_line_ends(b"N30 G0 X0\n").unwrap_err().to_string(),
///     "line 1, column 10: CR LF expected, LF alone found (STM-5)"
/// );
/// ```
///
/// # Errors
/// The first line that does not end in CR LF, for which a CNC reports
/// [`LINE_END_ERROR`](super::LINE_END_ERROR).
pub fn check_line_ends(data: &[u8]) -> Result<(), LineError> {
    let (mut rest, mut number) = (data, 0_u32);
    while !rest.is_empty() {
        number = number.saturating_add(1);
        let (line, end) = split_at_end(rest);
        let kind = match end {
            [CR, LF, ..] => {
                rest = after_end(end);
                continue;
            }
            [LF, ..] => LineErrorKind::BareLf,
            [CR, ..] => LineErrorKind::BareCr,
            _ => LineErrorKind::NoLineEnd,
        };
        return Err(LineError::new(number, to_u32(line.len()).saturating_add(1), kind));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_split_at_every_length() {
        for len in (0..50).step_by(if cfg!(miri) { 17 } else { 1 }) {
            for end in ["", "\n", "\r\n", "\rX", "\nM30 and twenty bytes more"] {
                let line = b"X".repeat(len);
                let text = [&line[..], end.as_bytes()].concat();
                assert_eq!(split_at_end(&text), (&line[..], end.as_bytes()));
            }
        }
    }
}
