//! The checks of a text that comes packet by packet.

use core::fmt;

use super::labels::{self, Labels};
use super::scan::{Carry, Place, Scan, Token, Word};
use super::{Finding, FindingKind, ProgramEnd};

/// Checks a program as the CNC gets it: some lines, later some more.
///
/// It finds what [`Findings`](super::Findings) finds in the whole text, by the same rules, and
/// tells where a program ends. Comment blocks, labels, program ends and line numbers go over from
/// one lot of lines to the next. Two things it cannot see: lines that are still to come, and what
/// is long gone.
/// - A jump goes back if its label is in its own line or above, and not below *in the lines that
///   came with it* (assumed). If those are cut elsewhere, a label that is both above and below may
///   make a difference; nothing else does.
/// - At least the last [`LABELS_KNOWN`](Self::LABELS_KNOWN) labels are known, as long as they have
///   no more than [`CHARACTERS_KNOWN`](Self::CHARACTERS_KNOWN) characters together. A jump back to
///   one that is forgotten is not found.
///
/// It does not mind line ends, the length of a line or characters that are not ASCII:
/// [`StreamingInterface::read`](super::StreamingInterface::read) checks the first, [`NcText`](super::NcText) all.
///
/// Manual: `stream-en`, sections 2.2, 2.3.3, 2.3.4 and 2.3.6 (STM-8, STM-9, STM-10).
///
/// ```
/// use ads_cnc::streaming::{Checker, Found, ProgramEnd};
///
/// let mut checker = Checker::new();
/// assert_eq!(checker.check(b"#COMMENT BEGIN\r\n").next(), None);
/// assert_eq!(checker.check(b"$FOR\r\nM30\r\n#COMMENT END\r\nN10: X1\r\n").next(), None);
///
/// let lines = b"N20 $GOTO N10\r\nN30 M30\r\nN40 X2\r\n";
/// let mut found = checker.check(lines);
/// let Some(Found::Finding(jump)) = found.next() else { panic!() };
/// assert_eq!(jump.to_string(), "line 6, column 5: $GOTO back to line 5 (STM-8)");
/// assert!(jump.kind.ends_streaming());
/// let Some(Found::End { end, line, column }) = found.next() else { panic!() };
/// assert_eq!((end, line, column), (ProgramEnd::M30, 7, 5));
/// assert_eq!(found.below(), b"N40 X2\r\n"); // was read with the program end and is discarded
/// ```
#[derive(Clone)]
pub struct Checker {
    carry: Carry,
    labels: Labels,
    /// The program end behind which no line with code has been seen.
    end: Option<(ProgramEnd, u32)>,
}

/// What a [`Checker`] finds; shown there.
///
/// ```
/// use ads_cnc::streaming::{Checker, Found, ProgramEnd};
///
/// let end = Checker::new().check(b"N10 X1\r\nN20 M30\r\n").next();
/// assert_eq!(end, Some(Found::End { end: ProgramEnd::M30, line: 2, column: 5 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Found {
    /// What streaming does not permit, or what would be lost.
    Finding(Finding),
    /// The program ends with this line, and streaming with it. What the CNC has read with it and
    /// is below is discarded; what is still in the interface stays (STM-10).
    End {
        /// The word.
        end: ProgramEnd,
        /// The line, from 1.
        line: u32,
        /// The column, from 1.
        column: u32,
    },
}

impl Found {
    /// The line, from 1.
    pub const fn line(&self) -> u32 {
        match self {
            Self::Finding(finding) => finding.line,
            Self::End { line, .. } => *line,
        }
    }
}

impl Checker {
    /// So many labels are known at least.
    pub const LABELS_KNOWN: usize = labels::LABELS;

    /// If they have no more characters together than this.
    pub const CHARACTERS_KNOWN: usize = labels::CHARACTERS;

    /// Begins with the first line of a program.
    pub fn new() -> Self {
        Self { carry: Carry::START, labels: Labels::default(), end: None }
    }

    /// Goes on with these lines: what is found in them, in their order.
    ///
    /// They are whole; an open one counts as if it were ended. They count as checked, even if not
    /// all that is found is asked for.
    pub fn check<'c>(&'c mut self, lines: &'c [u8]) -> CheckedLines<'c> {
        self.labels.keep(self.carry.program);
        let scan = Scan::behind(self.carry, lines);
        let mut ahead = scan.clone();
        while let Some((label, line)) = ahead.next_label() {
            self.labels.pass(&label, line);
        }
        self.carry = ahead.carry();
        CheckedLines { scan, labels: &self.labels, end: &mut self.end }
    }

    /// How many lines were checked.
    pub const fn lines(&self) -> u32 {
        self.carry.lines
    }

    /// The comment block that is open: a finding if no more lines come.
    pub fn open_comment(&self) -> Option<Finding> {
        let Place { line, column } = self.carry.block?;
        Some(Finding { line, column, kind: FindingKind::OpenComment })
    }
}

impl Default for Checker {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for Checker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Checker({} lines)", self.carry.lines)
    }
}

/// What a [`Checker`] finds in some lines; shown there.
///
/// ```
/// use ads_cnc::streaming::Checker;
///
/// let mut checker = Checker::new();
/// let mut found = checker.check(b"N10 X1\r\nN20 M30\r\nN30 X2\r\n");
/// assert_eq!(found.next().map(|found| found.line()), Some(2));
/// assert_eq!(found.below(), b"N30 X2\r\n");
/// ```
pub struct CheckedLines<'c> {
    scan: Scan<'c>,
    labels: &'c Labels,
    end: &'c mut Option<(ProgramEnd, u32)>,
}

impl<'c> CheckedLines<'c> {
    /// The lines below the one in which something was found last; all before the first.
    pub const fn below(&self) -> &'c [u8] {
        self.scan.below()
    }

    fn judge(
        &mut self,
        Token { place: Place { line, column }, word }: &Token<'_>,
    ) -> Option<Found> {
        let kind = match word {
            Word::Code => {
                let (end, of) = self.end.take()?;
                FindingKind::BehindEnd { end, of }
            }
            Word::Label(_) => return None,
            Word::Goto(label) => {
                let to = self.labels.last(label).filter(|last| last <= line)?;
                FindingKind::BackwardJump { to }
            }
            Word::Loop(word) => FindingKind::Loop(*word),
            Word::End(end) => {
                self.end.get_or_insert((*end, *line));
                return Some(Found::End { end: *end, line: *line, column: *column });
            }
        };
        Some(Found::Finding(Finding { line: *line, column: *column, kind }))
    }
}

impl Iterator for CheckedLines<'_> {
    type Item = Found;

    fn next(&mut self) -> Option<Found> {
        while let Some(token) = self.scan.next() {
            if let Some(found) = self.judge(&token) {
                return Some(found);
            }
        }
        None
    }
}

/// Looks at the lines that are left: a program end in them matters for those to come.
impl Drop for CheckedLines<'_> {
    fn drop(&mut self) {
        while self.next().is_some() {}
    }
}

impl fmt::Debug for CheckedLines<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CheckedLines").finish_non_exhaustive()
    }
}
