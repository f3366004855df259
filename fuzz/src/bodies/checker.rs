//! What streaming does not permit in a program, packet by packet.

use ads_cnc::streaming::{DiagnosticKind, NcText};

use crate::common::checker::{CheckedLots, check_any_lots};
use crate::common::findings::{FindingsBend, check_findings};
use crate::{Defect, Outcome};

/// What ends a lot: no character of a text.
const CUT: u8 = 0xFF;

/// More lots are more of the same, and take their time.
const LOTS: usize = 12;

/// NC text; a byte 0xFF ends the lines that come together.
///
/// Lot by lot the same is found as in all that came so far, whole; findings are in the text and in
/// its order, and line ends do not matter. Text that cannot be streamed is checked all the same.
pub(crate) fn lots(data: &[u8], defect: Defect) -> Outcome {
    let lots: Vec<&[u8]> = data.splitn(LOTS, |&byte| byte == CUT).collect();
    check_any_lots(lots.iter().copied());
    // Whole lines, which no lot behind them can join.
    let lots: Vec<Vec<u8>> = lots
        .iter()
        .map(|lot| if lot.ends_with(b"\n") { lot.to_vec() } else { [lot, &b"\n"[..]].concat() })
        .collect();
    let text = lots.concat();
    if let Err(error) = NcText::new(&text) {
        return Outcome::refused((error.line(), error.column(), error.kind()));
    }
    let bend = bend(defect);
    let mut checked = CheckedLots::new(bend);
    for lot in &lots {
        checked.lot(lot);
    }
    let found = check_findings(&text, bend);
    Outcome::accepted(found.iter().map(|finding| finding.to_string()).collect::<Vec<_>>())
}

pub(crate) const DEFECTS: &[&str] = &[
    "lines are counted anew in each lot",
    "a jump back to a line that came before is overlooked",
    "what is behind the program end of an earlier lot is overlooked",
    "a loop word behind the tenth line is overlooked if there is another finding",
    "two findings change places",
];

fn bend(defect: Defect) -> FindingsBend {
    let defects: [FindingsBend; 5] = [
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
    chosen.map_or(|_, _| (), |(_, bend)| bend)
}
