//! What a text has that streaming does not permit, or that would be lost.

use core::fmt;

use super::NcText;
use super::jumps::Jumps;
use super::scan::{Place, Scan, Token, Word};
use super::words::{LoopWord, ProgramEnd};

/// Something in a text that streaming does not permit, or that would be lost.
///
/// Manual: `stream-en`, sections 2.2, 2.3.3, 2.3.4 and 2.3.6.
///
/// ```
/// use ads_cnc::streaming::{FindingKind, LoopWord, NcText};
///
/// let text = NcText::new(b"N10 G0 X0\nN20 $FOR P1=0,10,1 (ten times)\n")?;
/// let finding = text.findings().next().unwrap();
/// assert_eq!((finding.line, finding.column), (2, 5));
/// assert_eq!(finding.kind, FindingKind::Loop(LoopWord::For));
/// assert_eq!(finding.to_string(), "line 2, column 5: $FOR in a stream (STM-8)");
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Finding {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
    /// What is there.
    pub kind: FindingKind,
}

/// The class of a [`Finding`].
///
/// ```
/// use ads_cnc::streaming::{FindingKind, NcText};
///
/// let text = NcText::new(b"N10: G0 X0\nN20 $GOTO N10\n")?;
/// let kind = text.findings().next().unwrap().kind;
/// assert_eq!(kind, FindingKind::BackwardJump { to: 1 });
/// assert_eq!((kind.clause(), kind.ends_streaming()), ("STM-8", true));
/// assert_eq!(kind.to_string(), "$GOTO back to line 1");
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FindingKind {
    /// A word of a loop (STM-8).
    Loop(LoopWord),
    /// `$GOTO` to a label that is not below (STM-8).
    BackwardJump {
        /// The line of the label.
        to: u32,
    },
    /// The first line behind a program end. If the CNC has read it with the end it is lost, else
    /// it stays in the interface and comes before the next program (STM-10).
    BehindEnd {
        /// The end.
        end: ProgramEnd,
        /// The line of the end.
        of: u32,
    },
    /// `#COMMENT BEGIN` without `#COMMENT END`: all that follows is comment (STM-9).
    OpenComment,
}

impl FindingKind {
    /// The requirement it is about.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Loop(_) | Self::BackwardJump { .. } => "STM-8",
            Self::BehindEnd { .. } => "STM-10",
            Self::OpenComment => "STM-9",
        }
    }

    /// Whether the CNC answers with an error and ends streaming (STM-8).
    pub const fn ends_streaming(self) -> bool {
        matches!(self, Self::Loop(_) | Self::BackwardJump { .. })
    }
}

/// What is there, in a few words.
impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Loop(word) => write!(f, "{word} in a stream"),
            Self::BackwardJump { to } => write!(f, "$GOTO back to line {to}"),
            Self::BehindEnd { end, of } => write!(f, "text behind the {end} of line {of}"),
            Self::OpenComment => f.write_str("#COMMENT BEGIN without #COMMENT END"),
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, kind } = self;
        write!(f, "line {line}, column {column}: {kind} ({})", kind.clause())
    }
}

/// The findings in a text, in its order; an open comment block comes last.
///
/// What this manual leaves open is decided so; *online* is what the maker's public help for the NC
/// language says, *assumed* what nobody says:
/// - Words and labels compare without regard to case (assumed). A `$` word ends where its letters
///   end; nothing stands between `$` and the word (online).
/// - Parentheses nest (online). Text between two `"` in a line is neither code nor comment
///   (assumed).
/// - `#COMMENT BEGIN` and `END` count at the start of a line, behind `/` and the block number at
///   most; the blocks do not nest, and what else stands in them is not looked at (online: nesting
///   can be switched on).
/// - A label is `N40:` or `[NAME]` at the start of a line, behind `/` and, a name, behind the
///   block number; `N040:` is the same label (assumed), blanks before the colon are permitted
///   (the name and the blanks: online). Labels belong to the program they are in; one begins at
///   each line whose first character is `%` (online).
/// - A jump goes forward if its label is in any line below. It goes back if the label is in its
///   own line or above, and not below (assumed). A label that is nowhere is no finding: it may
///   be in a text that follows. A jump to an expression (`$GOTO NV.E.X`) is not judged.
/// - A program end is M2, M30, M17 or M29; leading zeros do not matter (M02: online, the others
///   assumed), what follows the digits must not be `.` or `_`. It counts even where `$IF` or a
///   jump may pass it by (assumed): if it is met, what follows is lost or left over.
/// - One finding for each line with a program end: the first line below that is neither blank
///   nor comment (assumed).
/// - A line joined to the next by `\` is checked as two (assumed).
///
/// The text is read once. For jumps to labels that were passed before and are not near below, it
/// is read again, once for 64 of them or more.
///
/// Manual: `stream-en`, sections 2.2, 2.3.3, 2.3.4 and 2.3.6.
///
/// ```
/// use ads_cnc::streaming::NcText;
///
/// let text = NcText::new(b"\
/// %back\n\
/// N40: G01 X40 (not $WHILE)\n\
/// N50 $GOTO N40\n\
/// N60 M30\n\
/// N70 G0 X0\n")?;
/// let findings: Vec<String> = text.findings().map(|finding| finding.to_string()).collect();
/// assert_eq!(findings, [
///     "line 3, column 5: $GOTO back to line 2 (STM-8)",
///     "line 5, column 1: text behind the M30 of line 4 (STM-10)",
/// ]);
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone)]
pub struct Findings<'a> {
    text: &'a [u8],
    scan: Scan<'a>,
    jumps: Jumps<'a>,
    /// The program end behind which no line with code has been seen.
    end: Option<(ProgramEnd, u32)>,
    done: bool,
}

impl<'a> Findings<'a> {
    pub(super) const fn new(text: NcText<'a>) -> Self {
        let text = text.bytes();
        Self { text, scan: Scan::new(text), jumps: Jumps::new(), end: None, done: false }
    }

    fn judge(&mut self, token: &Token<'a>) -> Option<FindingKind> {
        let line = token.place.line;
        match token.word {
            Word::Code => {
                let (end, of) = self.end.take()?;
                Some(FindingKind::BehindEnd { end, of })
            }
            Word::Label(label) => {
                self.jumps.pass(&label);
                None
            }
            Word::Goto(label) => {
                let to = self.jumps.back(label, line, self.text, &self.scan)?;
                Some(FindingKind::BackwardJump { to })
            }
            Word::Loop(word) => Some(FindingKind::Loop(word)),
            Word::End(end) => {
                self.end.get_or_insert((end, line));
                None
            }
        }
    }
}

impl Iterator for Findings<'_> {
    type Item = Finding;

    fn next(&mut self) -> Option<Finding> {
        while let Some(token) = self.scan.next() {
            if let Some(kind) = self.judge(&token) {
                let Place { line, column } = token.place;
                return Some(Finding { line, column, kind });
            }
        }
        if self.done {
            return None;
        }
        self.done = true;
        let Place { line, column } = self.scan.carry().block?;
        Some(Finding { line, column, kind: FindingKind::OpenComment })
    }
}

impl fmt::Debug for Findings<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Findings").finish_non_exhaustive()
    }
}
