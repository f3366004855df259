//! The check for constructs that streaming does not permit, lot by lot; a lot is some lines of a
//! program.

use ads_cnc::streaming::{DiagnosticKind, NcText};

use crate::common::checker::{CheckedLots, check_any_lots};
use crate::common::findings::{DiagnosticsMutation, check_findings};
use crate::{Defect, Outcome};

/// The byte that ends a lot. It is not a character of NC text.
const CUT: u8 = 0xFF;

/// Maximum number of lots in an input; the last lot may contain more bytes [`CUT`].
const LOTS: usize = 12;

/// Input: NC text, in which each of the first eleven bytes 0xFF ends a lot of lines.
///
/// With any line ends, the check of a lot has the same findings as a check of the text up to the
/// end of the lot has in the lines of the lot. They are in the order of the text. Text that cannot
/// be streamed is checked without a panic.
pub(crate) fn lots(data: &[u8], defect: Defect) -> Outcome {
    let lots: Vec<&[u8]> = data.splitn(LOTS, |&byte| byte == CUT).collect();
    check_any_lots(lots.iter().copied());
    // Adds missing line ends, so that each lot consists of whole lines.
    let lots: Vec<Vec<u8>> = lots
        .iter()
        .map(|lot| if lot.ends_with(b"\n") { lot.to_vec() } else { [lot, &b"\n"[..]].concat() })
        .collect();
    let text = lots.concat();
    if let Err(error) = NcText::new(&text) {
        return Outcome::rejected((error.line(), error.column(), error.kind()));
    }
    let mutation = mutation(defect);
    let mut checked = CheckedLots::new(mutation);
    for lot in &lots {
        checked.lot(lot);
    }
    let found = check_findings(&text, mutation);
    Outcome::accepted(found.iter().map(|finding| finding.to_string()).collect::<Vec<_>>())
}

pub(crate) const DEFECTS: &[&str] = &[
    "line numbers start again in each lot",
    "a backward jump to a line of an earlier lot is not found",
    "lines after the program end of an earlier lot are not found",
    "a loop keyword after the tenth line is not found if there is another finding",
    "two findings are swapped",
];

fn mutation(defect: Defect) -> DiagnosticsMutation {
    let defects: [DiagnosticsMutation; 5] = [
        |found, before| found.iter_mut().for_each(|finding| finding.line -= before),
        |found, before| {
            let is = |kind| matches!(kind, DiagnosticKind::BackwardJump { to } if to <= before);
            found.retain(|finding| !is(finding.kind));
        },
        |found, before| {
            let is = |kind| matches!(kind, DiagnosticKind::AfterEnd { of, .. } if of <= before);
            found.retain(|finding| !is(finding.kind));
        },
        |found, _| {
            if found.len() > 1 {
                found.retain(|at| at.line <= 10 || !matches!(at.kind, DiagnosticKind::Loop(_)));
            }
        },
        |found, before| {
            if found.len() > 1 && before == 0 {
                found.swap(0, 1);
            }
        },
    ];
    let chosen = (1..).zip(defects).find(|&(number, _)| defect.is(number));
    chosen.map_or(|_, _| (), |(_, mutation)| mutation)
}
