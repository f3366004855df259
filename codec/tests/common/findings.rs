//! Laws of the diagnostics of a program.

use ads_cnc::streaming::{Diagnostic, DiagnosticKind, NcText};

use super::streaming::reference_lines;

/// A fault that is added to diagnostics, to verify that the laws detect it. The second argument is
/// the number of lines before the checked lines.
pub(crate) type DiagnosticsMutation = fn(&mut Vec<Diagnostic>, u32);

pub(crate) fn findings_of(text: &[u8]) -> Vec<Diagnostic> {
    NcText::new(text).expect("a text that can be streamed").diagnostics().collect()
}

/// Checks that the diagnostics of a text are at its lines and columns, and do not depend on the
/// line ends. They must be in the order of the text, except that of an open comment block. Returns
/// the diagnostics.
pub(crate) fn check_findings(text: &[u8], mutation: DiagnosticsMutation) -> Vec<Diagnostic> {
    let mut all = findings_of(text);
    mutation(&mut all, 0);
    let lines = reference_lines(text);
    for finding in &all {
        let line = &lines[finding.line as usize - 1];
        let at = &line[finding.column as usize - 1..];
        let is = match finding.kind {
            DiagnosticKind::Loop(_) | DiagnosticKind::BackwardJump { .. } => at[0] == b'$',
            DiagnosticKind::OpenComment => at[0] == b'#',
            _ => !b" \t(;".contains(&at[0]),
        };
        assert!(is, "{finding}");
    }
    let places = || {
        let in_order = all.iter().filter(|at| at.kind != DiagnosticKind::OpenComment);
        in_order.map(|at| (at.line, at.column))
    };
    assert!(places().is_sorted());
    for end in ["\n", "\r\n", "\r"] {
        let ended: Vec<u8> =
            lines.iter().flat_map(|line| [line, end.as_bytes()].concat()).collect();
        assert_eq!(findings_of(&ended), all);
    }
    all
}
