//! Laws of `Checker`, which reports the diagnostics of a program that arrives packet by packet.

use ads_cnc::streaming::{CheckEvent, Checker, Diagnostic, DiagnosticKind, NcText, ProgramEnd};

use super::findings::{DiagnosticsMutation, findings_of};
use super::streaming::reference_lines;

/// Passes lines to the checker. Returns the reported diagnostics, and the reported program ends
/// with line and column. A comment block that is open after the lines is not among the diagnostics.
pub(crate) fn check_lines(
    checker: &mut Checker,
    lines: &[u8],
) -> (Vec<Diagnostic>, Vec<(ProgramEnd, u32, u32)>) {
    let (mut findings, mut ends) = (Vec::new(), Vec::new());
    for found in checker.check(lines) {
        match found {
            CheckEvent::Diagnostic(finding) => findings.push(finding),
            CheckEvent::ProgramEnd { end, line, column } => ends.push((end, line, column)),
        }
    }
    (findings, ends)
}

/// The first program end of a text, and its line. The first `AfterEnd` diagnostic of the text with
/// an appended line names both, unless a comment block is open at the end of the text.
fn first_end(text: &[u8]) -> Option<(ProgramEnd, u32)> {
    findings_of(&[text, b"\r\nX0\r\n"].concat()).into_iter().find_map(|finding| {
        match finding.kind {
            DiagnosticKind::AfterEnd { end, of } => Some((end, of)),
            _ => None,
        }
    })
}

/// Passes a text to a checker part by part. The diagnostics of each part must equal the diagnostics
/// that the text so far has in the lines of the part, without that of an open comment block.
pub(crate) struct CheckedLots {
    checker: Checker,
    so_far: Vec<u8>,
    ended: Option<(ProgramEnd, u32)>,
    mutation: DiagnosticsMutation,
}

impl CheckedLots {
    pub(crate) fn new(mutation: DiagnosticsMutation) -> Self {
        Self { checker: Checker::new(), so_far: Vec::new(), ended: None, mutation }
    }

    /// Passes the next part to the checker. The part must consist of whole lines that can be
    /// streamed. Returns the diagnostics of the part.
    pub(crate) fn lot(&mut self, lot: &[u8]) -> Vec<Diagnostic> {
        let before = self.checker.lines();
        self.so_far.extend_from_slice(lot);
        let (mut findings, ends) = check_lines(&mut self.checker, lot);
        (self.mutation)(&mut findings, before);
        let mut wanted = findings_of(&self.so_far);
        let open = wanted.iter().find(|found| found.kind == DiagnosticKind::OpenComment).copied();
        assert_eq!(self.checker.open_comment(), open);
        wanted.retain(|finding| Some(*finding) != open);
        wanted.retain(|finding| finding.line > before);
        assert_eq!(findings, wanted, "{:?}", String::from_utf8_lossy(&self.so_far));
        assert!(ends.is_sorted_by_key(|(_, line, column)| (*line, *column)));
        self.ended = self.ended.or(ends.first().map(|(end, line, _)| (*end, *line)));
        if open.is_none() {
            assert_eq!(self.ended, first_end(&self.so_far));
        }
        let lines = NcText::new(&self.so_far).unwrap().line_count();
        assert_eq!(self.checker.lines() as usize, lines);
        findings
    }
}

/// Checks parts of any bytes: the diagnostics of each part, and its program ends, must be in the
/// order of the text, their lines must exist, and lines must be counted.
pub(crate) fn check_any_lots<'l>(lots: impl IntoIterator<Item = &'l [u8]>) {
    let (mut checker, mut lines) = (Checker::new(), 0);
    for lot in lots {
        let (findings, ends) = check_lines(&mut checker, lot);
        lines += reference_lines(lot).len();
        assert_eq!(checker.lines() as usize, lines);
        assert!(findings.is_sorted_by_key(|at| (at.line, at.column)));
        assert!(ends.is_sorted_by_key(|(_, line, column)| (*line, *column)));
        let places = findings.iter().map(|at| at.line).chain(ends.iter().map(|(_, line, _)| *line));
        assert!(places.into_iter().all(|line| line as usize <= lines));
        assert!(checker.open_comment().is_none_or(|at| at.line as usize <= lines));
    }
}
