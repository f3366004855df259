//! The checks of a text, as a whole or part by part.

use core::fmt;

use super::labels::{self, Labels};
use super::scan::{Position, Scan, ScanState, Token, Word};
use super::{Diagnostic, DiagnosticKind, NcText, ProgramEnd};

/// Checks a program that arrives in parts, such as the packets that a CNC receives.
///
/// A checker reports the same diagnostics as [`Diagnostics`] for the whole text, and also program
/// ends; it reports an open comment block only by [`open_comment`](Self::open_comment). It carries
/// comment blocks, labels, program ends and line numbers over from one part to the next. Because it
/// knows neither later lines nor all earlier lines, two differences remain:
/// - A jump goes back if its label is in the same or an earlier line, and not in a later line *of the
///   same part* (assumed). Apart from the next item, the split into parts therefore only affects a
///   jump whose label occurs both before and after it.
/// - The checker can miss a jump back to an old label. It remembers at least the labels of the
///   current program among the last [`LABELS_KNOWN`](Self::LABELS_KNOWN) different labels up to the
///   end of the part, if these have at most [`CHARACTERS_KNOWN`](Self::CHARACTERS_KNOWN) characters
///   together. Each label counts one character more than its digits or name.
///
/// A checker checks neither line ends, nor the length of lines, nor that all characters are ASCII.
/// [`check_line_ends`](super::check_line_ends) checks line ends; [`NcText`](super::NcText) accepts any line
/// ends, and checks the length of lines and the characters.
///
/// Manual: `stream-en`, sections 2.2, 2.3.3, 2.3.4 and 2.3.6 (STM-8, STM-9, STM-10).
///
/// ```
/// use ads_cnc::streaming::{Checker, CheckEvent, ProgramEnd};
///
/// let mut checker = Checker::new();
/// assert_eq!(checker.check(b"#COMMENT BEGIN\r\n").next(), None);
/// assert_eq!(checker.check(b"$FOR\r\nM30\r\n#COMMENT END\r\nN10: X1\r\n").next(), None);
///
/// let lines = b"N20 $GOTO N10\r\nN30 M30\r\nN40 X2\r\n";
/// let mut found = checker.check(lines);
/// let Some(CheckEvent::Diagnostic(jump)) = found.next() else { panic!() };
/// assert_eq!(jump.to_string(), "line 6, column 5: $GOTO back to line 5 (STM-8)");
/// assert!(jump.kind.ends_streaming());
/// let Some(CheckEvent::ProgramEnd { end, line, column }) = found.next() else { panic!() };
/// assert_eq!((end, line, column), (ProgramEnd::M30, 7, 5));
/// assert_eq!(found.remaining(), b"N40 X2\r\n"); // read with the program end, so discarded
/// ```
#[derive(Clone)]
pub struct Checker {
    state: ScanState,
    judge: CheckerState,
}

/// The state of the checks between lines.
#[derive(Clone)]
struct CheckerState {
    labels: Labels,
    /// The first program end of a line and the number of the line, if no line with code has
    /// followed.
    end: Option<(ProgramEnd, u32)>,
}

/// An event that a [`Checker`] reports. [`Checker`] has an example.
///
/// ```
/// use ads_cnc::streaming::{Checker, CheckEvent, ProgramEnd};
///
/// let end = Checker::new().check(b"N10 X1\r\nN20 M30\r\n").next();
/// assert_eq!(end, Some(CheckEvent::ProgramEnd { end: ProgramEnd::M30, line: 2, column: 5 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CheckEvent {
    /// A construct that is not permitted in a stream, or a line after a program end.
    Diagnostic(Diagnostic),
    /// A program end. When the CNC executes it, the program and streaming end. The CNC discards the
    /// later lines that it has already read; lines that are still in the interface stay there
    /// (STM-10).
    ProgramEnd {
        /// The word that ends the program.
        end: ProgramEnd,
        /// The line, from 1.
        line: u32,
        /// The column, from 1, in bytes.
        column: u32,
    },
}

impl CheckEvent {
    /// The line, from 1.
    pub const fn line(&self) -> u32 {
        match self {
            Self::Diagnostic(diagnostic) => diagnostic.line,
            Self::ProgramEnd { line, .. } => *line,
        }
    }
}

impl Checker {
    /// Among this number of recent different labels, a checker remembers at least those of the
    /// current program, if all have at most [`CHARACTERS_KNOWN`](Self::CHARACTERS_KNOWN) characters
    /// together.
    pub const LABELS_KNOWN: usize = labels::LABELS;

    /// The total number of characters up to which [`LABELS_KNOWN`](Self::LABELS_KNOWN) holds; each
    /// label counts one character more than its digits or name.
    pub const CHARACTERS_KNOWN: usize = labels::CHARACTERS;

    /// Creates a checker at the first line of a program.
    pub fn new() -> Self {
        let labels = Labels::with_limits(labels::LABELS, labels::CHARACTERS);
        Self { state: ScanState::START, judge: CheckerState { labels, end: None } }
    }

    /// Checks the next lines; returns their events in the order of the text.
    ///
    /// The lines must be complete; a last line without a line end counts as complete. All lines are
    /// checked, even if the iterator is dropped early.
    pub fn check<'c>(&'c mut self, lines: &'c [u8]) -> CheckEvents<'c> {
        let scan = Scan::resume(self.state, lines);
        self.state = self.judge.look_ahead(scan.clone());
        CheckEvents { scan, judge: &mut self.judge }
    }

    /// The number of lines that were passed to [`check`](Self::check) so far.
    pub const fn lines(&self) -> u32 {
        self.state.lines
    }

    /// The diagnostic for a comment block that is open, if there is one; call this function after
    /// the last line.
    pub fn open_comment(&self) -> Option<Diagnostic> {
        self.state.open_comment()
    }
}

impl ScanState {
    fn open_comment(self) -> Option<Diagnostic> {
        let Position { line, column } = self.block?;
        Some(Diagnostic { line, column, kind: DiagnosticKind::OpenComment })
    }
}

impl CheckerState {
    /// Records the labels of these lines, and returns the state after them.
    fn look_ahead(&mut self, mut scan: Scan<'_>) -> ScanState {
        self.labels.keep(scan.state().program);
        while let Some((label, line)) = scan.next_label() {
            self.labels.record(&label, line);
        }
        scan.state()
    }

    /// The next event in lines whose labels are recorded.
    fn next(&mut self, scan: &mut Scan<'_>) -> Option<CheckEvent> {
        scan.find_map(|token| self.word(&token))
    }

    fn word(
        &mut self,
        Token { position: Position { line, column }, word }: &Token<'_>,
    ) -> Option<CheckEvent> {
        let kind = match word {
            Word::Code => {
                let (end, of) = self.end.take()?;
                DiagnosticKind::AfterEnd { end, of }
            }
            Word::Goto(label) => {
                let to = self.labels.last(label).filter(|last| last <= line)?;
                DiagnosticKind::BackwardJump { to }
            }
            Word::Loop(word) => DiagnosticKind::Loop(*word),
            Word::End(end) => {
                self.end.get_or_insert((*end, *line));
                return Some(CheckEvent::ProgramEnd { end: *end, line: *line, column: *column });
            }
        };
        Some(CheckEvent::Diagnostic(Diagnostic { line: *line, column: *column, kind }))
    }
}

impl Default for Checker {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Debug for Checker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Checker({} lines)", self.state.lines)
    }
}

/// An iterator over the events of lines. [`Checker`] has an example.
///
/// ```
/// use ads_cnc::streaming::Checker;
///
/// let mut checker = Checker::new();
/// let mut found = checker.check(b"N10 X1\r\nN20 M30\r\nN30 X2\r\n");
/// assert_eq!(found.next().map(|found| found.line()), Some(2));
/// assert_eq!(found.remaining(), b"N30 X2\r\n");
/// ```
pub struct CheckEvents<'c> {
    scan: Scan<'c>,
    judge: &'c mut CheckerState,
}

impl<'c> CheckEvents<'c> {
    /// The lines after the line of the event that was returned last; before the first call of
    /// `next`, all lines; after `next` has returned `None`, no lines.
    pub const fn remaining(&self) -> &'c [u8] {
        self.scan.remaining()
    }
}

impl Iterator for CheckEvents<'_> {
    type Item = CheckEvent;

    fn next(&mut self) -> Option<CheckEvent> {
        self.judge.next(&mut self.scan)
    }
}

/// Checks the lines that were not iterated over, because a program end in them affects later lines.
impl Drop for CheckEvents<'_> {
    fn drop(&mut self) {
        while self.next().is_some() {}
    }
}

impl fmt::Debug for CheckEvents<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CheckEvents").finish_non_exhaustive()
    }
}

/// An iterator over the diagnostics of a text, in the order of the text; an open comment block comes
/// last.
///
/// The manual on data streaming does not contain all rules. *Online* marks rules from the vendor's
/// public help pages on the NC language, *assumed* marks rules without a source:
/// - Words and labels are compared without regard to case (assumed). A `$` word ends after its letters;
///   nothing may separate `$` and the word (online).
/// - Parentheses nest (online). Text between two `"` in a line contains no words and begins no
///   comment (assumed).
/// - `#COMMENT BEGIN` and `END` are recognised only at the start of a line, after an optional `/` and
///   block number. The blocks do not nest, and their other content is skipped (online: nesting can be
///   enabled).
/// - A label is `N40:` or `[NAME]` at the start of a line. `/` may precede it; a block number may
///   precede `[NAME]`. `N040:` is the same label as `N40:` (assumed). Blanks before the colon are
///   permitted (names and blanks: online). A label belongs to its program; each line outside a
///   comment block that begins with `%`, after an optional `/` and block number, begins a program
///   (online).
/// - A jump goes forward if its label is in any later line of its program. It goes back if the
///   label is in the same or an earlier line, and not in a later line (assumed). A missing label
///   causes no diagnostic, because a later text may contain it. A jump to an expression
///   (`$GOTO NV.E.X`) is not checked.
/// - A program end is M2, M30, M17 or M29, with any leading zeros (M02: online, the others
///   assumed), and no `.` or `_` after the digits, outside the names of variables, programs and
///   subroutines. It is recognised even if `$IF` or a jump may skip it (assumed), because the lines
///   after it are lost or remain when it is executed.
/// - Each line with a program end causes at most one [`AfterEnd`](DiagnosticKind::AfterEnd), for
///   the first later line that is neither blank nor a comment (assumed).
/// - A line that is joined to the next line by `\` is checked as two lines (assumed).
///
/// The text is read twice: first to record the last line of each label, then to find words. In a
/// text with many different labels, they need memory for their names, plus about 80 bytes each.
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
/// let shown: Vec<String> = text.diagnostics().map(|diagnostic| diagnostic.to_string()).collect();
/// assert_eq!(shown, [
///     "line 3, column 5: $GOTO back to line 2 (STM-8)",
///     "line 5, column 1: text after the M30 of line 4 (STM-10)",
/// ]);
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone)]
pub struct Diagnostics<'a> {
    scan: Scan<'a>,
    judge: CheckerState,
    done: bool,
}

impl<'a> Diagnostics<'a> {
    pub(super) fn new(text: NcText<'a>) -> Self {
        let scan = Scan::resume(ScanState::START, text.bytes());
        let labels = Labels::with_limits(usize::MAX, usize::MAX);
        let mut judge = CheckerState { labels, end: None };
        judge.look_ahead(scan.clone());
        Self { scan, judge, done: false }
    }
}

impl Iterator for Diagnostics<'_> {
    type Item = Diagnostic;

    fn next(&mut self) -> Option<Diagnostic> {
        while let Some(event) = self.judge.next(&mut self.scan) {
            if let CheckEvent::Diagnostic(diagnostic) = event {
                return Some(diagnostic);
            }
        }
        if self.done {
            return None;
        }
        self.done = true;
        self.scan.state().open_comment()
    }
}

impl fmt::Debug for Diagnostics<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Diagnostics").finish_non_exhaustive()
    }
}
