//! The report as a badge.

use std::io::{self, Write};

use serde::Serialize;

use super::document::Report;
use crate::exit::Exit;
use crate::judge::{UnrestoredValue, Verdict};
use crate::text::{json, plural, shorten};

/// The JSON that shields.io reads from an endpoint. Shields.io rejects other keys.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Badge {
    schema_version: u32,
    label: String,
    message: String,
    color: &'static str,
    is_error: bool,
}

/// Writes a badge for shields.io: the version of the suite, the result, the editions and, if
/// greater than 0, the numbers of requirements with the verdict fail (waived or not), with the
/// verdict warning, and with a waived verdict. Of the values that were not restored, the badge
/// names the first and counts the others.
pub fn to_badge(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let (word, color) = match report.exit() {
        Exit::Success if report.only.is_empty() => ("passed", "brightgreen"),
        Exit::Success => ("selection passed", "green"),
        Exit::Failure => ("failed", "red"),
        Exit::Stale => ("stale waiver", "orange"),
        Exit::Nothing => ("inconclusive", "lightgrey"),
        Exit::NotPermitted => ("rejected for safety", "orange"),
        Exit::UnrestoredValue => ("left changed", "red"),
        Exit::Usage | Exit::Internal => ("error", "red"),
    };
    let of = |verdict: Verdict| -> usize {
        report.subjects.iter().filter_map(|subject| subject.totals.get(&verdict)).sum()
    };
    let waived: usize = report.subjects.iter().map(|subject| subject.waived).sum();
    let numbers = [
        (of(Verdict::Fail), "requirement", " failed"),
        (of(Verdict::Warning), "warning", ""),
        (waived, "verdict", " waived"),
    ];
    let numbers = numbers.into_iter().filter(|(number, ..)| *number > 0);
    let numbers = numbers.map(|(number, noun, what)| format!(", {}{what}", plural(number, noun)));
    let numbers: String = numbers.collect();
    let left = match report.left_changed.as_slice() {
        [] => String::new(),
        [only] => format!(": {}", describe(only)),
        [first, more @ ..] => format!(": {} and {} more", describe(first), more.len()),
    };
    let badge = Badge {
        schema_version: 1,
        label: format!("ads-cnc {}", report.suite),
        message: format!("{word}{left}{numbers} ({})", report.editions.join(", ")),
        color,
        is_error: report.exit() == Exit::Internal,
    };
    json::write(&badge, out)
}

/// The name of a value, its original value and its present value, each truncated to fit a badge.
fn describe(left: &UnrestoredValue) -> String {
    let cut = |text: &str| shorten(text, 40);
    let is = left.is.as_deref().map_or_else(|| "unknown".to_owned(), cut);
    format!("{}, was {}, is {is}", cut(&left.name), cut(&left.was))
}
