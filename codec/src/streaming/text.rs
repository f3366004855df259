//! NC text that can be streamed, and its lines.

use core::fmt;
use core::iter::FusedIterator;

#[cfg(feature = "alloc")]
use super::Diagnostics;
use super::ends::{CR, LF, after_end, split_at_end};
use super::{LineError, LineErrorKind, Packets};
use crate::bytes::to_u32;
use crate::limits::NC_LINE_MAX;

/// NC text whose lines can all be streamed.
///
/// A line ends in LF, CR LF, or CR without LF. (A CR alone is assumed to end a line, so that no CR is sent
/// within a line.) The last line may lack its line end. Empty lines are streamed; an empty text has no
/// lines.
///
/// Manual: `stream-en`, sections 2.2, 3.1 and 3.2 (STM-2, STM-4, STM-7, STM-20).
///
/// ```
/// use ads_cnc::streaming::NcText;
///
/// let text = NcText::new(b"N10 G0 X0\r\n\nN20 M30")?;
/// assert_eq!((text.line_count(), text.wire_len()), (3, 22));
/// assert!(text.lines().eq([&b"N10 G0 X0"[..], b"", b"N20 M30"]));
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct NcText<'a> {
    bytes: &'a [u8],
    lines: usize,
    wire_len: usize,
    crlf: bool,
}

impl<'a> NcText<'a> {
    /// Checks the length and the characters of all lines, so that each line fits into a packet. Use
    /// `diagnostics`, with the feature `alloc`, to check the NC words.
    ///
    /// # Errors
    /// The first fault: a line of more than 990 characters, a byte that is not ASCII, or a NUL.
    pub fn new(bytes: &'a [u8]) -> Result<Self, LineError> {
        let (mut lines, mut wire_len, mut crlf) = (0_usize, 0_usize, true);
        let mut rest = bytes;
        while !rest.is_empty() {
            let (line, end) = split_at_end(rest);
            lines = lines.saturating_add(1);
            check(line, lines)?;
            wire_len = wire_len.saturating_add(line.len()).saturating_add(2);
            crlf &= matches!(end, [] | [CR, LF, ..]);
            rest = after_end(end);
        }
        Ok(Self { bytes, lines, wire_len, crlf })
    }

    /// The original bytes of the text.
    pub const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The number of lines.
    pub const fn line_count(&self) -> usize {
        self.lines
    }

    /// The length of all packets together in bytes: the text with CR LF after each line.
    pub const fn wire_len(&self) -> usize {
        self.wire_len
    }

    /// Whether the text is sent unchanged: each line ends in CR LF, including the last.
    pub const fn is_wire(&self) -> bool {
        self.crlf && self.wire_len == self.bytes.len()
    }

    /// The lines, without line ends.
    pub const fn lines(&self) -> Lines<'a> {
        Lines(self.bytes)
    }

    /// The packets, each with as many whole lines as fit.
    pub const fn packets(&self) -> Packets<'a> {
        Packets::new(self.bytes, self.crlf)
    }

    /// The diagnostics of the text: constructs that are not permitted in a stream, lines after a
    /// program end, and a comment block that does not end.
    #[cfg(feature = "alloc")]
    pub fn diagnostics(&self) -> Diagnostics<'a> {
        Diagnostics::new(*self)
    }
}

impl fmt::Debug for NcText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "NcText({} lines, {} bytes)", self.lines, self.bytes.len())
    }
}

/// An iterator over the lines of a text, without line ends.
///
/// ```
/// use ads_cnc::streaming::NcText;
///
/// let text = NcText::new(b"N10 X1\rN20 X2\n")?;
/// assert_eq!(text.lines().last(), Some(&b"N20 X2"[..]));
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Lines<'a>(&'a [u8]);

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.0.is_empty() {
            return None;
        }
        let (line, rest) = split_at_end(self.0);
        self.0 = after_end(rest);
        Some(line)
    }
}

impl FusedIterator for Lines<'_> {}

/// Checks a line; returns its first error.
fn check(line: &[u8], number: usize) -> Result<(), LineError> {
    for (column, &byte) in (1_u32..).zip(line) {
        let kind = match byte {
            _ if column > to_u32(NC_LINE_MAX) => {
                LineErrorKind::TooLong { length: to_u32(line.len()) }
            }
            0 => LineErrorKind::Nul,
            0x80.. => LineErrorKind::NotAscii { byte },
            _ => continue,
        };
        return Err(LineError::new(to_u32(number), column, kind));
    }
    Ok(())
}
