//! Diagnostics of an NC text.

use core::fmt;

use super::words::{LoopWord, ProgramEnd};

/// A construct that is not permitted in a stream, a line after a program end, or a comment block
/// that does not end.
///
/// Manual: `stream-en`, sections 2.2, 2.3.3, 2.3.4 and 2.3.6.
///
/// ```
/// use ads_cnc::streaming::{DiagnosticKind, LoopWord, NcText};
///
/// let text = NcText::new(b"N10 G0 X0\nN20 $FOR P1=0,10,1 (ten times)\n")?;
/// let diagnostic = text.diagnostics().next().unwrap();
/// assert_eq!((diagnostic.line, diagnostic.column), (2, 5));
/// assert_eq!(diagnostic.kind, DiagnosticKind::Loop(LoopWord::For));
/// assert_eq!(diagnostic.to_string(), "line 2, column 5: $FOR in a stream (STM-8)");
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Diagnostic {
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1, in bytes.
    pub column: u32,
    /// The class of the diagnostic.
    pub kind: DiagnosticKind,
}

/// The class of a [`Diagnostic`].
///
/// ```
/// use ads_cnc::streaming::{DiagnosticKind, NcText};
///
/// let text = NcText::new(b"N10: G0 X0\nN20 $GOTO N10\n")?;
/// let kind = text.diagnostics().next().unwrap().kind;
/// assert_eq!(kind, DiagnosticKind::BackwardJump { to: 1 });
/// assert_eq!((kind.clause(), kind.ends_streaming()), ("STM-8", true));
/// assert_eq!(kind.to_string(), "$GOTO back to line 1");
/// # Ok::<(), ads_cnc::streaming::LineError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DiagnosticKind {
    /// A word of a loop (STM-8).
    Loop(LoopWord),
    /// `$GOTO` to a label that is in the same or an earlier line, but in no later line that was
    /// checked together with it (STM-8).
    BackwardJump {
        /// The line of the label.
        to: u32,
    },
    /// The first line after a program end that is neither blank nor a comment. If the CNC has read
    /// the line together with the program end, the line is lost; otherwise it stays in the
    /// interface and precedes the next program (STM-10).
    AfterEnd {
        /// The program end.
        end: ProgramEnd,
        /// The line of the program end.
        of: u32,
    },
    /// `#COMMENT BEGIN` without `#COMMENT END`: the rest of the text is a comment (STM-9).
    OpenComment,
}

impl DiagnosticKind {
    /// The ID of the requirement behind the diagnostic.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Loop(_) | Self::BackwardJump { .. } => "STM-8",
            Self::AfterEnd { .. } => "STM-10",
            Self::OpenComment => "STM-9",
        }
    }

    /// Whether the CNC reports an error and ends streaming (STM-8).
    pub const fn ends_streaming(self) -> bool {
        matches!(self, Self::Loop(_) | Self::BackwardJump { .. })
    }
}

/// Displays a short description of the class.
impl fmt::Display for DiagnosticKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Loop(word) => write!(f, "{word} in a stream"),
            Self::BackwardJump { to } => write!(f, "$GOTO back to line {to}"),
            Self::AfterEnd { end, of } => write!(f, "text after the {end} of line {of}"),
            Self::OpenComment => f.write_str("#COMMENT BEGIN without #COMMENT END"),
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, kind } = self;
        write!(f, "line {line}, column {column}: {kind} ({})", kind.clause())
    }
}
