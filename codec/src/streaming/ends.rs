//! Where lines end.

use super::{LineError, LineErrorKind};
use crate::bytes::{to_len, to_u32};

pub(super) const CR: u8 = b'\r';
pub(super) const LF: u8 = b'\n';

pub(super) const fn is_end(byte: u8) -> bool {
    matches!(byte, CR | LF)
}

/// The first line, and what follows it from its end on.
pub(super) fn split_at_end(bytes: &[u8]) -> (&[u8], &[u8]) {
    let mut rest = bytes;
    while let Some((word, behind)) = rest.split_first_chunk() {
        let ends = ends(word);
        if ends != 0 {
            rest = rest.get(to_len(ends.trailing_zeros() / 8)..).unwrap_or_default();
            break;
        }
        rest = behind;
    }
    while let [byte, behind @ ..] = rest {
        if is_end(*byte) {
            break;
        }
        rest = behind;
    }
    bytes.split_at_checked(bytes.len().saturating_sub(rest.len())).unwrap_or((bytes, &[]))
}

/// Bytes looked at together.
pub(super) const WORD: usize = 16;

const fn repeat(byte: u8) -> u128 {
    u128::from_le_bytes([byte; WORD])
}

/// The highest bit of each byte from LF to CR, VT and FF among them.
///
/// No byte carries into the next: without its highest bit each is below 0x80. The highest bit of a
/// byte is set in the sum if it is LF or above, in the difference if it is CR or below.
#[inline(always)]
pub(super) fn ends(word: &[u8; WORD]) -> u128 {
    let bytes = u128::from_le_bytes(*word);
    let low = bytes & repeat(0x7F);
    let above = low.wrapping_add(repeat(0x80 - LF));
    let below = repeat(0x80 + CR).wrapping_sub(low);
    above & below & !bytes & repeat(0x80)
}

/// What follows the line end that is here, if one is.
pub(super) const fn behind_end(bytes: &[u8]) -> &[u8] {
    match bytes {
        [LF, rest @ ..] | [CR, LF, rest @ ..] | [CR, rest @ ..] => rest,
        _ => bytes,
    }
}

/// Checks that each line of received data ends in CR LF, as a CNC does when it reads its stream.
///
/// Use it on the CNC's side: a client's text may have other line ends, which
/// [`NcText::packets`](super::NcText::packets) replaces.
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
                rest = behind_end(end);
                continue;
            }
            [LF, ..] => LineErrorKind::LfAlone,
            [CR, ..] => LineErrorKind::CrAlone,
            _ => LineErrorKind::NoLineEnd,
        };
        return Err(LineError::new(number, to_u32(line.len()).saturating_add(1), kind));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever is around it, the first byte from LF to CR is found, and no other.
    #[test]
    fn ends_are_found_in_a_word() {
        // Miri is slow, and what it looks for does not hang on which byte it is.
        for around in (0..=u8::MAX).step_by(if cfg!(miri) { 85 } else { 1 }) {
            for byte in (0..=u8::MAX).step_by(if cfg!(miri) { 5 } else { 1 }) {
                for at in 0..WORD {
                    let mut word = [around; WORD];
                    word[at] = byte;
                    let first = word.iter().position(|byte| (LF..=CR).contains(byte));
                    let found = ends(&word).trailing_zeros() as usize / 8;
                    assert_eq!(found, first.unwrap_or(WORD), "{word:?}");
                }
            }
        }
    }

    /// A line is split where it ends.
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
