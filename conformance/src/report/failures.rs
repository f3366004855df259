//! Shows the checks that did not pass as text: on the console, in groups, and in parts of the
//! formats HTML, JUnit and Markdown.

use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::io::{self, Write};

use ads_cnc_vectors::Level;
use anstyle::AnsiColor;

use super::BytesReport;
use super::display::{Detail, DisplayOptions, NAMES_MAX, RESULT_MAX, WIDTH};
use super::document::{EvidenceReport, FailureReport, Report};
use super::groups::{Group, groups};
use super::lines::{is_fault, lines, marked};
use crate::judge::{CLIENT, CaseSubject, TESTEE};
use crate::text::{plural, shorten, wrap};

/// Maximum number of groups of failures that are printed in normal detail.
const GROUPS_MAX: usize = 6;
/// Maximum number of other groups, such as warnings and differences, that are printed before
/// failures in normal detail.
const NOTES_MAX: usize = 3;
/// Maximum number of lines of bytes in normal detail, and maximum number of these lines before the
/// first wrong byte.
const BYTES_MAX: usize = 9;
const BEFORE_MARK: usize = 2;
/// Maximum number of cases that follow from a group, in normal detail.
const FOLLOWERS_MAX: usize = 8;
/// Maximum number of lines of a clause in normal detail.
const CLAUSE_MAX: usize = 3;

/// Prints the groups of checks that did not pass: first each group that is not a failure, such as a
/// warning, on one line, and then the failures.
pub(super) fn blocks(
    report: &Report,
    display: DisplayOptions,
    out: &mut dyn Write,
) -> io::Result<()> {
    let all = groups(report);
    let (failed, others): (Vec<&Group<'_>>, Vec<&Group<'_>>) =
        all.iter().partition(|group| group.is_failure());
    let verbose = display.detail == Detail::Verbose;
    // If there are failures, show fewer warnings and differences, but all groups that fail the run or
    // from which other checks follow.
    let (others, notes): (Vec<_>, Vec<_>) = others.into_iter().partition(|group| {
        !group.followers.is_empty() || group.verdict.fails_run() && !group.waived
    });
    let shown = if verbose || failed.is_empty() { usize::MAX } else { NOTES_MAX };
    for group in notes.iter().take(shown).chain(&others) {
        brief(group, display, out)?;
        if let Some(location) = report.target.file.as_ref().and_then(|_| location(group)) {
            writeln!(out, "  {location}")?;
        }
    }
    if let Some(more) = notes.get(shown..).filter(|more| !more.is_empty()) {
        let names: BTreeSet<&str> = more.iter().map(|group| group.requirement()).collect();
        let number = plural(more.len(), "other deviation");
        writeln!(out, "{number} (-v shows all): {}", list(names, usize::MAX))?;
    }
    if !(notes.is_empty() && others.is_empty()) {
        writeln!(out)?;
    }
    let most = if verbose { usize::MAX } else { GROUPS_MAX };
    let (protocol, mut failed): (Vec<_>, Vec<_>) =
        failed.into_iter().partition(|group| group.is_of_protocol());
    failed.sort_by_key(|group| Reverse(group.followers.len()));
    let more = failed.split_off(failed.len().min(most.saturating_sub(protocol.len())));
    // Print the cause of most other failures after the other causes, near the prompt. Only failures
    // of a protocol follow.
    failed.sort_by_key(|group| group.followers.len());
    if !more.is_empty() {
        let names: BTreeSet<&str> = more.iter().map(|group| group.requirement()).collect();
        let number = plural(more.len(), "other failure");
        writeln!(out, "{number} (-v shows all): {}\n", list(names, usize::MAX))?;
    }
    for group in failed.into_iter().chain(protocol) {
        block(report, group, display, out)?;
        writeln!(out)?;
    }
    Ok(())
}

/// Prints a group on one line.
fn brief(group: &Group<'_>, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    let Some((case, failure)) = group.example() else { return Ok(()) };
    let verdict = display.verdict(group.verdict, group.waived);
    let clauses = list(group.requirements.iter().copied(), NAMES_MAX);
    let sentence = sentence(failure, RESULT_MAX);
    writeln!(out, "{verdict}  {clauses}  {}{}: {sentence}", case.id, alike(group))?;
    followers(group, display, out)
}

/// Prints the cases with checks that follow from a group, if there are such cases.
fn followers(group: &Group<'_>, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    if group.followers.is_empty() {
        return Ok(());
    }
    let names = group
        .followers
        .iter()
        .map(|(case, clauses)| format!("{case} ({})", list(clauses.iter().copied(), usize::MAX)));
    let names: Vec<String> = names.collect();
    let most = if display.detail == Detail::Verbose { usize::MAX } else { FOLLOWERS_MAX };
    let names = list(names.iter().map(String::as_str), most);
    let text = wrap(&format!("follows from it: {names}"), WIDTH);
    text.iter().try_for_each(|line| writeln!(out, "  {line}"))
}

/// The location of the example of a group in a capture: the last line of its call.
fn location<'r>(group: &Group<'r>) -> Option<&'r str> {
    let (_, failure) = group.example()?;
    failure.evidence.as_ref()?.call.lines().last().map(str::trim_start)
}

/// The text for the number of checks of a group besides its example; empty without other checks.
pub(super) fn alike(group: &Group<'_>) -> String {
    match group.checks().saturating_sub(1) {
        0 => String::new(),
        more => format!(" and {more} similar"),
    }
}

/// A sentence with the variable or object, the expected result and the actual result. Each result
/// is shortened to `most` characters.
pub(super) fn sentence(failure: &FailureReport, most: usize) -> String {
    let [expected, found] = [&failure.expected, &failure.found].map(|text| shorten(text, most));
    let subject = failure.evidence.as_ref().and_then(|evidence| evidence.subject.as_deref());
    let subject = subject.map_or_else(String::new, |subject| format!("{subject}: "));
    // The text of a differing field already contains the expected value.
    if differing_field(&found).is_some() {
        return format!("{subject}{found}");
    }
    if let Some(differing) = failure.evidence.as_ref().and_then(differing) {
        return format!("{subject}{differing}");
    }
    let found = if found.is_empty() { "nothing" } else { found.as_str() };
    format!("{subject}expected {expected}; found {found}")
}

/// The path of the field in the text of a difference, such as "size: 24 is expected, not 25".
pub(super) fn differing_field(text: &str) -> Option<&str> {
    let (path, difference) = text.split_once(": ")?;
    (!path.contains(' ') && difference.contains(" is expected")).then_some(path)
}

/// Describes the first field with a marked byte and the expected field; `None` if their values are
/// equal or unknown, the received bytes are invalid, or the numbers of received and expected fields
/// differ.
fn differing(evidence: &EvidenceReport) -> Option<String> {
    let (received, expected) = evidence.received.as_ref().zip(evidence.expected.as_ref())?;
    if !received.faults.is_empty() || received.fields.len() != expected.fields.len() {
        return None;
    }
    let mut pairs = received.fields.iter().zip(&expected.fields);
    let (is, instead) = pairs.find(|(is, _)| !is.differs.is_empty())?;
    let has_values = !is.value.is_empty() && !instead.value.is_empty();
    (has_values && is.value != instead.value)
        .then(|| format!("{}: {} where {} is expected", is.field, is.value, instead.value))
}

/// Prints a whole group: clause, example with its bytes, number of other checks, checks that follow
/// from the group, and the command that runs the example again.
pub(super) fn block(
    report: &Report,
    group: &Group<'_>,
    display: DisplayOptions,
    out: &mut dyn Write,
) -> io::Result<()> {
    let Some((case, failure)) = group.example() else { return Ok(()) };
    let verbose = display.detail == Detail::Verbose;
    let verdict = display.verdict(group.verdict, group.waived);
    let clauses = list(group.requirements.iter().copied(), NAMES_MAX);
    writeln!(out, "{verdict}  {clauses}  {}", sources(failure))?;
    let clause = wrap(&failure.clause, WIDTH);
    let shown = if verbose { usize::MAX } else { CLAUSE_MAX };
    clause.iter().take(shown).try_for_each(|line| writeln!(out, "  {line}"))?;
    if clause.len() > shown {
        writeln!(out, "  ... (ads-cnc requirements {})", failure.requirement)?;
    }
    let most = if verbose { usize::MAX } else { RESULT_MAX };
    let text = format!("{}: {}", case.id, sentence(failure, most));
    wrap(&text, WIDTH).iter().try_for_each(|line| writeln!(out, "  {line}"))?;
    if let Some(evidence) = &failure.evidence {
        let shown = frames_shown(failure, case.subject);
        bytes(evidence, shown, display, out)?;
    }
    let cases = group.cases();
    match (group.checks().saturating_sub(1), cases.len()) {
        (0, _) => {}
        (more, 1) => writeln!(out, "  {more} similar in this case")?,
        (more, _) => {
            let others = cases.iter().copied().filter(|one| *one != case.id);
            let names = list(others, if verbose { usize::MAX } else { NAMES_MAX });
            let text = wrap(&format!("{more} similar, also in {names}"), WIDTH);
            text.iter().try_for_each(|line| writeln!(out, "  {line}"))?;
        }
    }
    followers(group, display, out)?;
    if let Some(again) = &report.again {
        // The cases of a protocol cannot be selected.
        let what = match failure.requirement.as_str() {
            TESTEE | CLIENT if case.id.ends_with("-manners") => format!("--seed {}", report.seed),
            _ => format!("--only {} --seed {}", case.id, report.seed),
        };
        writeln!(out, "  again: {again} {what}")?;
    }
    Ok(())
}

/// The first `most` names of a list, and the number of others.
pub(super) fn list<'n>(names: impl IntoIterator<Item = &'n str>, most: usize) -> String {
    let mut names: Vec<&str> = names.into_iter().collect();
    let more = names.len().saturating_sub(most);
    names.truncate(most);
    let names = names.join(", ");
    if more > 0 { format!("{names} and {more} more") } else { names }
}

/// Prints a check that did not pass, and its requirements.
pub(super) fn finding(
    subject: CaseSubject,
    all: &[&FailureReport],
    out: &mut dyn Write,
) -> io::Result<()> {
    let Some(failure) = all.first() else { return Ok(()) };
    for one in all {
        clause(one, out)?;
    }
    writeln!(out, "  expected  {}", failure.expected)?;
    writeln!(out, "  found     {}", failure.found)?;
    // If the check follows from another clause, the failed check of that clause shows the bytes.
    if let Some(evidence) = failure.evidence.as_ref().filter(|_| failure.follows.is_none()) {
        let display = DisplayOptions { detail: Detail::Verbose, ..DisplayOptions::default() };
        bytes(evidence, frames_shown(failure, subject), display, out)?;
    }
    if failure.more > 0 {
        writeln!(out, "  and {} more like this in the same case", failure.more)?;
    }
    Ok(())
}

fn clause(failure: &FailureReport, out: &mut dyn Write) -> io::Result<()> {
    if let Some(cause) = &failure.follows {
        return writeln!(out, "  {:<8}  follows from {cause}, which fails", failure.requirement);
    }
    let level = failure.level.map_or_else(String::new, |level| format!("{level:?}").to_lowercase());
    writeln!(out, "  {:<8}  {level}: {}", failure.requirement, failure.clause)?;
    writeln!(out, "            {}", sources(failure))
}

/// The sources of a clause. A clause without sources is assumed, or a binding ruling.
fn sources(failure: &FailureReport) -> String {
    match (failure.sources.is_empty(), failure.level) {
        (false, _) => failure.sources.join("; "),
        (true, Some(Level::Info) | None) => {
            "not in the manuals: an assumption of this project".to_owned()
        }
        (true, Some(_)) => "not in the manuals: a binding ruling of this project".to_owned(),
    }
}

/// Whether the request is shown as a frame with its headers instead of only its data, and the same
/// for the reply.
fn frames_shown(failure: &FailureReport, subject: CaseSubject) -> [bool; 2] {
    let is_of_frames = failure.is_of_frames();
    // A client is judged by its requests.
    let is_client = matches!(subject, CaseSubject::Client | CaseSubject::CapturedClient);
    [is_of_frames && is_client, is_of_frames]
}

fn bytes(
    evidence: &EvidenceReport,
    [request, reply]: [bool; 2],
    display: DisplayOptions,
    out: &mut dyn Write,
) -> io::Result<()> {
    let EvidenceReport { call, result, sent, received, expected, frame_sent, .. } = evidence;
    let show = |lines: Vec<String>, out: &mut dyn Write| {
        cut(lines, display.detail).iter().try_for_each(|line| {
            let wrong = line.starts_with('!');
            let line = if wrong { display.paint(AnsiColor::Red, line) } else { line.clone() };
            writeln!(out, "    {line}")
        })
    };
    let most = if display.detail == Detail::Verbose { usize::MAX } else { RESULT_MAX };
    // In a capture, bytes that are not an exchange may come from either side.
    let who = if result.is_empty() && frame_sent.is_empty() { "captured" } else { "sent" };
    // Do not shorten the location in a capture, which follows on the next lines.
    let (call, location) = call.split_at(call.find('\n').unwrap_or(call.len()));
    let (call, location) = match location {
        "" if who == "captured" => (call.to_owned(), ""),
        _ => (shorten(call, most), location),
    };
    writeln!(out, "  {who:<8}  {call}{location}")?;
    let frame = |parts: &[BytesReport]| parts.iter().flat_map(lines).collect();
    let frames = reply.then(|| evidence.frames());
    match &frames {
        Some([sent, _]) if request && !sent.is_empty() => show(frame(sent), out)?,
        _ => show(sent.as_ref().map(lines).unwrap_or_default(), out)?,
    }
    if received.is_some() || !frame_sent.is_empty() {
        writeln!(out, "  received  {}", shorten(result, most))?;
    }
    if let Some([_, received]) = &frames
        && !received.is_empty()
    {
        return show(frame(received), out);
    }
    let is_same =
        sent.as_ref().map(BytesReport::bytes) == received.as_ref().map(BytesReport::bytes);
    let received = received.as_ref().map(if is_same { marked } else { lines });
    show(received.unwrap_or_default(), out)?;
    let expected = expected.as_ref().map(marked).filter(|lines| !lines.is_empty());
    if let Some(expected) = expected {
        writeln!(out, "  instead of")?;
        show(expected, out)?;
    }
    Ok(())
}

/// The lines to print: in normal detail, at most [`BYTES_MAX`] lines, which begin shortly before
/// the first marked line or error, and the numbers of omitted lines.
fn cut(mut lines: Vec<String>, detail: Detail) -> Vec<String> {
    if detail == Detail::Verbose || lines.len() <= BYTES_MAX {
        return lines;
    }
    let marked = lines.iter().position(|line| line.starts_with('!'));
    let wrong = marked.or_else(|| lines.iter().position(|line| is_fault(line))).unwrap_or_default();
    let (before, all) = (wrong.saturating_sub(BEFORE_MARK), lines.len());
    let mut shown: Vec<String> = lines.drain(before..).take(BYTES_MAX).collect();
    let after = all.saturating_sub(before).saturating_sub(shown.len());
    if before > 0 {
        shown.insert(0, format!("     ... {}", plural(before, "line")));
    }
    if after > 0 {
        shown.push(format!("     ... {}", plural(after, "line")));
    }
    shown
}
