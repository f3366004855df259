//! The checks of a text, whole or packet by packet.

use core::fmt;

use super::labels::{self, Labels};
use super::scan::{Carry, Place, Scan, Token, Word};
use super::{Finding, FindingKind, NcText, ProgramEnd};

/// Checks a program as the CNC gets it: some lines, later some more.
///
/// It finds what [`Findings`] has of the whole text, by the same rules, and tells where a program
/// ends. Comment blocks, labels, program ends and line numbers go over from
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
/// [`check_line_ends`](super::check_line_ends) checks the first, [`NcText`](super::NcText) all.
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
    judge: Judge,
}

/// What is known of the lines so far.
#[derive(Clone)]
struct Judge {
    labels: Labels,
    /// The program end after which no line with code has been seen.
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
        let labels = Labels::of_at_most(labels::LABELS, labels::CHARACTERS);
        Self { carry: Carry::START, judge: Judge { labels, end: None } }
    }

    /// Goes on with these lines: what is found in them, in their order.
    ///
    /// They are whole; an open one counts as if it were ended. They count as checked, even if not
    /// all that is found is asked for.
    pub fn check<'c>(&'c mut self, lines: &'c [u8]) -> CheckedLines<'c> {
        let scan = Scan::behind(self.carry, lines);
        self.carry = self.judge.look_ahead(scan.clone());
        CheckedLines { scan, judge: &mut self.judge }
    }

    /// How many lines were checked.
    pub const fn lines(&self) -> u32 {
        self.carry.lines
    }

    /// The comment block that is open: a finding if no more lines come.
    pub fn open_comment(&self) -> Option<Finding> {
        self.carry.open_comment()
    }
}

impl Carry {
    fn open_comment(self) -> Option<Finding> {
        let Place { line, column } = self.block?;
        Some(Finding { line, column, kind: FindingKind::OpenComment })
    }
}

impl Judge {
    /// Learns the labels of these lines; what carries over from them.
    fn look_ahead(&mut self, mut scan: Scan<'_>) -> Carry {
        self.labels.keep(scan.carry().program);
        while let Some((label, line)) = scan.next_label() {
            self.labels.pass(&label, line);
        }
        scan.carry()
    }

    /// What is found next in lines that were looked at ahead.
    fn next(&mut self, scan: &mut Scan<'_>) -> Option<Found> {
        scan.find_map(|token| self.word(&token))
    }

    fn word(&mut self, Token { place: Place { line, column }, word }: &Token<'_>) -> Option<Found> {
        let kind = match word {
            Word::Code => {
                let (end, of) = self.end.take()?;
                FindingKind::BehindEnd { end, of }
            }
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
    judge: &'c mut Judge,
}

impl<'c> CheckedLines<'c> {
    /// The lines below the one in which something was found last; all before the first.
    pub const fn below(&self) -> &'c [u8] {
        self.scan.below()
    }
}

impl Iterator for CheckedLines<'_> {
    type Item = Found;

    fn next(&mut self) -> Option<Found> {
        self.judge.next(&mut self.scan)
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
/// The text is read twice: for labels first, of which the last line of each is kept, then for words.
/// The memory is that of the labels: their names, and about 80 bytes for each.
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
    scan: Scan<'a>,
    judge: Judge,
    done: bool,
}

impl<'a> Findings<'a> {
    pub(super) fn new(text: NcText<'a>) -> Self {
        let scan = Scan::behind(Carry::START, text.bytes());
        let labels = Labels::of_at_most(usize::MAX, usize::MAX);
        let mut judge = Judge { labels, end: None };
        judge.look_ahead(scan.clone());
        Self { scan, judge, done: false }
    }
}

impl Iterator for Findings<'_> {
    type Item = Finding;

    fn next(&mut self) -> Option<Finding> {
        while let Some(found) = self.judge.next(&mut self.scan) {
            if let Found::Finding(finding) = found {
                return Some(finding);
            }
        }
        if self.done {
            return None;
        }
        self.done = true;
        self.scan.carry().open_comment()
    }
}

impl fmt::Debug for Findings<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Findings").finish_non_exhaustive()
    }
}
