//! NC text that can be streamed, and its lines.

use core::fmt;

#[cfg(feature = "alloc")]
use super::Findings;
use super::ends::{CR, LF, behind_end, is_end, split_at_end};
use super::{LineError, LineErrorKind, Packets};
use crate::bytes::to_u32;
use crate::limits::NC_LINE_MAX;

/// So many bytes are counted in a byte before the count is added up.
const BLOCK: usize = 128;

/// NC text in which every line can be streamed.
///
/// A line ends in LF, in CR LF, or in CR without LF (the last is assumed: so no CR ever stands
/// within a line that is sent). The last line may be open. A line without characters is a line
/// and is streamed; text without bytes has no line.
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
    /// Looks through the whole text, so that nothing can go wrong once a packet is out.
    ///
    /// # Errors
    /// The first line over 990 characters, byte that is not ASCII, or NUL.
    pub fn new(bytes: &'a [u8]) -> Result<Self, LineError> {
        let Counts { bits, cr, lf } = count(bytes);
        let pairs = if cr == 0 { 0 } else { count_pairs(bytes) };
        if !bits.is_ascii() || !lines_fit(bytes) {
            return Err(first_error(bytes));
        }
        let ends = cr.saturating_add(lf);
        let open = usize::from(bytes.last().is_some_and(|&byte| !is_end(byte)));
        let lines = ends.saturating_sub(pairs).saturating_add(open);
        let characters = bytes.len().saturating_sub(ends);
        let wire_len = characters.saturating_add(lines.saturating_mul(2));
        Ok(Self { bytes, lines, wire_len, crlf: cr == lf && lf == pairs })
    }

    /// The bytes of the text, as given.
    pub const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// Number of lines.
    pub const fn line_count(&self) -> usize {
        self.lines
    }

    /// Bytes of all packets together: of the text with CR LF behind each line.
    pub const fn wire_len(&self) -> usize {
        self.wire_len
    }

    /// Whether the text is what is sent, byte for byte: each line ends in CR LF, the last too.
    pub const fn is_wire(&self) -> bool {
        self.crlf && self.wire_len == self.bytes.len()
    }

    /// The lines, without their ends.
    pub const fn lines(&self) -> Lines<'a> {
        Lines(self.bytes)
    }

    /// The packets, as full as whole lines can make them.
    pub const fn packets(&self) -> Packets<'a> {
        Packets::new(self.bytes, self.crlf)
    }

    /// What streaming does not permit in the text, or what would be lost.
    #[cfg(feature = "alloc")]
    pub fn findings(&self) -> Findings<'a> {
        Findings::new(*self)
    }
}

impl fmt::Debug for NcText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "NcText({} lines, {} bytes)", self.lines, self.bytes.len())
    }
}

/// The lines of a text, without their ends.
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

impl<'a> Lines<'a> {
    pub(super) const fn of(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        if self.0.is_empty() {
            return None;
        }
        let (line, rest) = split_at_end(self.0);
        self.0 = behind_end(rest);
        Some(line)
    }
}

pub(super) struct Counts {
    /// Of all bytes, and of all bytes less one: a NUL or a byte that is not ASCII sets the
    /// highest bit.
    bits: u8,
    cr: usize,
    pub(super) lf: usize,
}

pub(super) fn count(bytes: &[u8]) -> Counts {
    let mut counts = Counts { bits: 0, cr: 0, lf: 0 };
    let mut blocks = bytes.chunks_exact(BLOCK);
    blocks.by_ref().filter_map(<[u8]>::first_chunk).for_each(|block| counts.add(block));
    let mut last = [b' '; BLOCK];
    last.iter_mut().zip(blocks.remainder()).for_each(|(last, &byte)| *last = byte);
    counts.add(&last);
    counts
}

impl Counts {
    /// Of a block whose length the compiler knows, many bytes at a time.
    fn add(&mut self, block: &[u8; BLOCK]) {
        let (mut bits, mut cr, mut lf) = (0_u8, 0_u8, 0_u8);
        for &byte in block {
            bits |= byte | byte.wrapping_sub(1);
            cr = cr.wrapping_add(u8::from(byte == CR));
            lf = lf.wrapping_add(u8::from(byte == LF));
        }
        self.bits |= bits;
        self.cr = self.cr.saturating_add(cr.into());
        self.lf = self.lf.saturating_add(lf.into());
    }
}

/// How often LF follows CR.
fn count_pairs(bytes: &[u8]) -> usize {
    let mut pairs = 0_usize;
    let mut rest = bytes;
    while let (Some(block), Some(next)) =
        (rest.first_chunk(), rest.get(1..).and_then(<[u8]>::first_chunk))
    {
        pairs = pairs.saturating_add(pairs_of(block, next).into());
        rest = rest.get(BLOCK..).unwrap_or_default();
    }
    let last = rest.iter().zip(rest.iter().skip(1));
    pairs.saturating_add(last.filter(|&(&byte, &next)| byte == CR && next == LF).count())
}

fn pairs_of(block: &[u8; BLOCK], next: &[u8; BLOCK]) -> u8 {
    let pairs = block.iter().zip(next);
    pairs.fold(0, |pairs, (&byte, &next)| pairs.wrapping_add(u8::from(byte == CR && next == LF)))
}

/// Whether no line is too long: from the start of a line on, a line end is within reach. The
/// last one there is looked for, so that most bytes are skipped.
fn lines_fit(mut rest: &[u8]) -> bool {
    while let Some(reach) = rest.get(..=NC_LINE_MAX) {
        let Some(end) = reach.iter().rposition(|&byte| is_end(byte)) else {
            return false;
        };
        rest = behind_end(rest.get(end..).unwrap_or_default());
    }
    true
}

/// The first error of a text that has one.
#[cold]
fn first_error(bytes: &[u8]) -> LineError {
    let mut number = 0_u32;
    for line in Lines::of(bytes) {
        number = number.saturating_add(1);
        for (column, &byte) in (1_u32..).zip(line) {
            let kind = match byte {
                _ if column > to_u32(NC_LINE_MAX) => {
                    LineErrorKind::TooLong { length: to_u32(line.len()) }
                }
                0 => LineErrorKind::Nul,
                0x80.. => LineErrorKind::NotAscii { byte },
                _ => continue,
            };
            return LineError::new(number, column, kind);
        }
    }
    // Not reached: the error that was seen is in one of the lines.
    LineError::new(number, 0, LineErrorKind::Nul)
}
