//! The checks of a text, whole or packet by packet.

use core::fmt;

use super::labels::{self, Labels};
use super::scan::{Position, Scan, ScanState, Token, Word};
use super::{Diagnostic, DiagnosticKind, NcText, ProgramEnd};

/// Checks a program that arrives in parts, such as the packets that a CNC receives.
///
/// It reports the same diagnostics as [`Diagnostics`] of the whole text, and the ends of programs.
/// Comment blocks, labels, program ends and line numbers are carried over from one part to the next. Two
/// differences remain, as it knows neither later lines nor all earlier ones:
/// - A jump goes back if its label is in its own line or an earlier one, and not in a later line *of the
///   same part* (assumed). The split into parts changes the result only if a label is both before and after the
///   jump.
/// - At least the last [`LABELS_KNOWN`](Self::LABELS_KNOWN) labels are known, as long as they have
///   no more than [`CHARACTERS_KNOWN`](Self::CHARACTERS_KNOWN) characters together. A jump back to
///   an older label is not detected.
///
/// It does not check line ends, the length of a line or that characters are ASCII:
/// [`check_line_ends`](super::check_line_ends) checks the first, [`NcText`](super::NcText) all three.
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
/// assert_eq!(found.remaining(), b"N40 X2\r\n"); // was read with the program end and is discarded
/// ```
#[derive(Clone)]
pub struct Checker {
    state: ScanState,
    judge: Judge,
}

/// The state that the checks carry from line to line.
#[derive(Clone)]
struct Judge {
    labels: Labels,
    /// The last program end, if no line with code has followed.
    end: Option<(ProgramEnd, u32)>,
}

/// An event that a [`Checker`] reports; see the example there.
///
/// ```
/// use ads_cnc::streaming::{Checker, CheckEvent, ProgramEnd};
///
/// let end = Checker::new().check(b"N10 X1\r\nN20 M30\r\n").next();
/// assert_eq!(end, Some(CheckEvent::ProgramEnd { end: ProgramEnd::M30, line: 2, column: 5 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CheckEvent {
    /// A construct that streaming does not permit, or a line that would be lost.
    Diagnostic(Diagnostic),
    /// The program ends with this line, and streaming with it. The CNC discards the lines below
    /// that it has already read; those in the interface stay there (STM-10).
    ProgramEnd {
        /// The word.
        end: ProgramEnd,
        /// The line, from 1.
        line: u32,
        /// The column, from 1.
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
    /// The number of labels that are remembered at least.
    pub const LABELS_KNOWN: usize = labels::LABELS;

    /// The most characters that these labels may have together.
    pub const CHARACTERS_KNOWN: usize = labels::CHARACTERS;

    /// Begins with the first line of a program.
    pub fn new() -> Self {
        let labels = Labels::with_limits(labels::LABELS, labels::CHARACTERS);
        Self { state: ScanState::START, judge: Judge { labels, end: None } }
    }

    /// Checks the next lines; returns their events in the order of the text.
    ///
    /// The lines must be complete; a last line without its end is one, too. All are checked even if the
    /// iterator is dropped early.
    pub fn check<'c>(&'c mut self, lines: &'c [u8]) -> CheckEvents<'c> {
        let scan = Scan::resume(self.state, lines);
        self.state = self.judge.look_ahead(scan.clone());
        CheckEvents { scan, judge: &mut self.judge }
    }

    /// How many lines were checked.
    pub const fn lines(&self) -> u32 {
        self.state.lines
    }

    /// The comment block that is open: a diagnostic if no more lines come.
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

impl Judge {
    /// Records the labels of these lines, and returns the state after them.
    fn look_ahead(&mut self, mut scan: Scan<'_>) -> ScanState {
        self.labels.keep(scan.state().program);
        while let Some((label, line)) = scan.next_label() {
            self.labels.record(&label, line);
        }
        scan.state()
    }

    /// The next event in lines whose labels are known.
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

/// The events of some lines; see the example at [`Checker`].
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
    judge: &'c mut Judge,
}

impl<'c> CheckEvents<'c> {
    /// The lines below that of the last event; all lines before the first event.
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

/// Checks the lines that are left: a program end in them affects later lines.
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

/// The diagnostics of a text, in its order; an open comment block comes last.
///
/// Some rules are not in the manual on data streaming: *online* marks those of the vendor's public help
/// for the NC language, *assumed* those without a source:
/// - Words and labels compare without regard to case (assumed). A `$` word ends where its letters
///   end; nothing may be between `$` and the word (online).
/// - Parentheses nest (online). Text between two `"` in a line is neither code nor comment
///   (assumed).
/// - `#COMMENT BEGIN` and `END` are recognised at the start of a line only; `/` and a block number may
///   precede them. The blocks do not nest, and their other content is skipped (online: nesting
///   can be switched on).
/// - A label is `N40:` or `[NAME]` at the start of a line. `/` may precede it; a block number may
///   precede `[NAME]`. `N040:` is the same label (assumed), blanks before the colon are permitted
///   (the name and the blanks: online). Labels belong to the program they are in; one begins at
///   each line whose first character is `%` (online).
/// - A jump goes forward if its label is in any line below. It goes back if the label is in its
///   own line or above, and not below (assumed). A missing label gives no diagnostic: a later text
///   may have it. A jump to an expression (`$GOTO NV.E.X`) is not checked.
/// - A program end is M2, M30, M17 or M29; leading zeros do not matter (M02: online, the others
///   assumed), and no `.` or `_` follows the digits. It counts even if `$IF` or a jump may skip it
///   (assumed): when it is executed, the following lines are lost or remain.
/// - One diagnostic for each line with a program end: the first line below that is neither blank
///   nor comment (assumed).
/// - A line joined to the next by `\` is checked as two (assumed).
///
/// The text is read twice: first to record the last line of each label, then for words.
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
    judge: Judge,
    done: bool,
}

impl<'a> Diagnostics<'a> {
    pub(super) fn new(text: NcText<'a>) -> Self {
        let scan = Scan::resume(ScanState::START, text.bytes());
        let labels = Labels::with_limits(usize::MAX, usize::MAX);
        let mut judge = Judge { labels, end: None };
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
