//! Lines that a decoder has read together and then executes one by one.

use ads_cnc::streaming::{CheckEvent, Checker, Diagnostic, ProgramEnd};

use super::executed::lines;

/// Lines that were read together, and the line where execution stops, if any.
#[derive(Clone, Debug, Default)]
pub(crate) struct ProgramSegment {
    lines: Vec<u8>,
    at: usize,
    /// Number of the next line in the program, from 1.
    number: u32,
    stop: Option<SegmentEnd>,
}

#[derive(Clone, Copy, Debug)]
enum SegmentEnd {
    /// Execution ends after this line.
    End { end: ProgramEnd, line: u32 },
    /// Execution ends before the line of this error.
    Fault(Diagnostic),
}

/// The next event of a segment.
pub(super) enum Next<'a> {
    Line(&'a [u8]),
    End(ProgramEnd),
    Fault(Diagnostic),
    Nothing,
}

impl ProgramSegment {
    /// Creates a segment of lines after checking them with `checker`, which has processed the lines
    /// before them.
    pub(crate) fn new(checker: &mut Checker, read: &[u8]) -> Self {
        let number = checker.lines().saturating_add(1);
        Self::with_findings(read, number, checker.check(read))
    }

    /// Creates a segment of lines that are numbered from `number` on, with the events that the
    /// checker has found in them, in the order of the lines.
    pub(crate) fn with_findings(
        read: &[u8],
        number: u32,
        found: impl IntoIterator<Item = CheckEvent>,
    ) -> Self {
        let (mut end, mut fault) = (None, None);
        for found in found {
            match found {
                // Ignore events in lines after a program end, because these lines are not executed.
                _ if end.is_some_and(|(_, line)| line < found.line()) => break,
                CheckEvent::Diagnostic(finding) if finding.kind.ends_streaming() => {
                    fault = Some(SegmentEnd::Fault(finding));
                    break;
                }
                CheckEvent::ProgramEnd { end: word, line, .. } => {
                    end.get_or_insert((word, line));
                }
                CheckEvent::Diagnostic(_) => {}
            }
        }
        let stop = fault.or(end.map(|(end, line)| SegmentEnd::End { end, line }));
        Self { lines: read.to_vec(), at: 0, number, stop }
    }

    pub(super) fn next(&self) -> Next<'_> {
        match self.stop {
            Some(SegmentEnd::End { end, line }) if line < self.number => Next::End(end),
            Some(SegmentEnd::Fault(finding)) if finding.line <= self.number => Next::Fault(finding),
            _ => match lines(self.lines.get(self.at..).unwrap_or_default()).next() {
                Some(line) => Next::Line(line),
                None => Next::Nothing,
            },
        }
    }

    /// Marks the next line as executed.
    pub(super) fn pass(&mut self) {
        if let Next::Line(line) = self.next() {
            self.at = self.at.saturating_add(line.len());
            self.number = self.number.saturating_add(1);
        }
    }
}
