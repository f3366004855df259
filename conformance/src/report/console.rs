//! The report as text.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

use ads_cnc_vectors::requirement;
use anstyle::AnsiColor;

use super::display::{Detail, DisplayOptions, NAMES_MAX, RESULT_MAX, worded};
use super::document::{
    CaseReport, FailureReport, Report, RequirementReport, SubjectReport, TargetReport, Totals,
    tally,
};
use super::failures::{blocks, list};
use crate::exit::Exit;
use crate::judge::{CLIENT, CaseSubject, HELLO, NOT_CLAIMED, TESTEE, Verdict, WaiverReport};
use crate::text::{plural, shorten};

/// Maximum number of notes of cases printed for a subject, and of requirements printed by
/// [`orphans`].
const REASONS_MAX: usize = 4;

/// Writes the report as text, with the detail and the colours of `display`.
pub fn print(report: &Report, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    let verbose = match display.detail {
        Detail::Quiet => return last_line(report, display, out),
        detail => detail == Detail::Verbose,
    };
    head(report, display, out)?;
    if let Some(failure) = unanswered(report) {
        unstarted(report, failure, display, out)?;
        return last_line(report, display, out);
    }
    for subject in &report.subjects {
        if verbose {
            cases(report, subject.subject, out)?;
        }
    }
    if verbose {
        areas(report, out)?;
    }
    parts(report, out)?;
    waivers(&report.waivers, out)?;
    blocks(report, display, out)?;
    if verbose || !report.waivers.is_empty() {
        waivable(report, out)?;
    }
    tail(report, display, out)
}

/// The failure of a testee or client that did not answer `hello` correctly. The answer to `hello`
/// is the first step of both protocols, so nothing else was judged.
fn unanswered(report: &Report) -> Option<&FailureReport> {
    let mut all = report.cases.iter().flat_map(|case| &case.failures);
    all.find(|one| [TESTEE, CLIENT].contains(&one.requirement.as_str()) && one.expected == HELLO)
}

/// Writes the reaction of a testee or client that did not answer `hello` correctly, the likely
/// cause, and the command or document that helps.
fn unstarted(
    report: &Report,
    failure: &FailureReport,
    display: DisplayOptions,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (kind, protocol) = match failure.requirement.as_str() {
        TESTEE => ("testee", "README.md"),
        _ => ("client", "CLIENTS.md"),
    };
    let verdict = display.verdict(failure.verdict, failure.waived);
    let found = failure.found.trim_start_matches("a crash: ");
    let garbled = found.strip_prefix("invalid answer: ");
    let what = match garbled {
        Some(why) => format!("the {kind}'s answer to hello is wrong: {why}"),
        None => format!("the {kind} did not answer hello: {found}"),
    };
    writeln!(out, "{verdict}  {}", shorten(&what, RESULT_MAX.saturating_mul(2)))?;
    let stderr = report.target.stderr.as_deref().unwrap_or_default();
    let last = stderr.lines().rev().find(|line| !line.trim().is_empty());
    // If the testee has ended, `found` already contains the end of its stderr, which may be any
    // text.
    let (reaction, own) = found.split_once("; its stderr ends with: ").unwrap_or((found, ""));
    if let Some(last) = last.filter(|_| own.is_empty()) {
        writeln!(out, "  stderr: {}", shorten(last, RESULT_MAX))?;
    }
    let cause = if garbled.is_some() {
        "No other case was run."
    } else if reaction.contains("no answer within ") {
        "Check that each line ends with a line feed and is flushed (Python: print(..., flush=True))."
    } else if reaction.ends_with("exit status: 127") {
        "Check that the shell finds the command in this folder."
    } else {
        "Check that the command runs by itself in this folder."
    };
    let next = match (&report.again, kind) {
        (Some(again), "testee") => format!("To see each line: {again} --check-protocol"),
        _ => format!("For the protocol, see conformance/adapters/{protocol}"),
    };
    writeln!(out, "  {cause} {next}")
}

/// Writes the head of a report: versions, editions, seed, target, device, profile, the result of
/// the queries before the cases, and selection.
fn head(report: &Report, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    let Report { suite, vectors, editions, seed, only, target, profile, found, .. } = report;
    let editions = editions.join(" and ");
    // The seed does not affect a capture.
    let seed = if target.file.is_none() { format!(", seed {seed}") } else { String::new() };
    writeln!(out, "ads-cnc {suite}, vectors {vectors}, by {editions}{seed}")?;
    writeln!(out, "target   {}", describe(target))?;
    if let Some(device) = &target.device {
        writeln!(out, "device   {device}")?;
    }
    if let Some(profile) = profile {
        let channels = profile.claims.get("channels").and_then(|list| list.as_array());
        let channels = channels.into_iter().flatten().map(ToString::to_string);
        let channels: Vec<String> = channels.collect();
        if channels.is_empty() {
            writeln!(out, "profile  {}", profile.name)?
        } else {
            writeln!(out, "profile  {}: channels {}", profile.name, channels.join(", "))?
        }
    }
    if let Some(found) = found.as_ref().filter(|_| !display.found_shown) {
        writeln!(out, "found    {}", found.summary())?;
        found.sampled().iter().try_for_each(|sampled| writeln!(out, "sampled  {sampled}"))?;
    }
    if !only.is_empty() {
        writeln!(out, "only     {}", only.join(", "))?;
    }
    writeln!(out)
}

/// The target, testee, client or capture on one line.
pub(super) fn describe(target: &TargetReport) -> String {
    let TargetReport { name, version, language, command, address, net_id, file, .. } = target;
    let mut text = name.clone();
    let parts = [
        (" ", version),
        (", in ", language),
        (" at ", address),
        (", AMS NetId ", net_id),
        (", started by ", command),
        (", ", file),
    ];
    for (before, part) in parts {
        text.extend(part.iter().flat_map(|part| [before, part.as_str()]));
    }
    text
}

pub(super) const fn heading(subject: CaseSubject) -> &'static str {
    match subject {
        CaseSubject::Codec => "The codec against the golden vectors",
        CaseSubject::Testee => "The testee against the golden vectors",
        CaseSubject::Target => "The target over AMS/TCP",
        CaseSubject::Client => "The client over AMS/TCP",
        CaseSubject::CapturedClient => "The clients in the captured traffic",
        CaseSubject::CapturedCnc => "The CNCs in the captured traffic",
    }
}

/// Writes the cases of a subject; vectors and sequences are grouped by stream.
fn cases(report: &Report, judged_subject: CaseSubject, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", heading(judged_subject))?;
    let sorted = report.sorted();
    let mine = || sorted.iter().copied().filter(|case| case.subject == judged_subject);
    let mut streams: BTreeMap<&str, Vec<&CaseReport>> = BTreeMap::new();
    for case in mine() {
        if let Some(stream) = &case.stream {
            streams.entry(stream).or_default().push(case);
        }
    }
    let width = streams.keys().map(|stream| stream.len()).max().unwrap_or_default().min(WIDTH_MAX);
    for (stream, cases) in streams {
        let waived = cases.iter().filter(|case| case.waived).count();
        writeln!(out, "  {stream:<width$}  {}", counts(&of_cases(&cases), waived))?;
        cases.iter().try_for_each(|case| line(case, out))?;
    }
    mine().filter(|case| case.stream.is_none()).try_for_each(|case| line(case, out))?;
    writeln!(out)
}

fn of_cases(cases: &[&CaseReport]) -> Totals {
    tally(cases.iter().map(|case| case.verdict))
}

/// Writes a line for each subject, each followed by the most common notes of its cases.
fn parts(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let width = report.subjects.iter().map(|one| one.subject.name().len()).max();
    let width = width.unwrap_or_default();
    for SubjectReport { subject, milliseconds, .. } in &report.subjects {
        let mine: Vec<&CaseReport> =
            report.cases.iter().filter(|case| case.subject == *subject).collect();
        let waived = mine.iter().filter(|case| case.waived).count();
        let counts = counts(&of_cases(&mine), waived);
        let number = plural(mine.len(), "case");
        let time = milliseconds.map_or_else(String::new, |all| {
            let (seconds, tenths) = (all / 1000, all % 1000 / 100);
            format!("   {seconds}.{tenths} s")
        });
        writeln!(out, "  {subject:<width$}  {number:>10}   {counts}{time}")?;
        reasons(&mine, out)?;
    }
    writeln!(out)
}

/// Writes the notes of cases, which are usually the reasons why the cases were not judged, the most
/// common note first.
fn reasons(cases: &[&CaseReport], out: &mut dyn Write) -> io::Result<()> {
    let mut all: BTreeMap<(Verdict, &str), (usize, BTreeSet<&str>)> = BTreeMap::new();
    for case in cases {
        if let Some(note) = &case.note {
            // All missing actions count as one reason, and so do all missing streams.
            let parts = LACKS.iter().find_map(|lacks| Some((*lacks, note.strip_prefix(lacks)?)));
            let (reason, name) = parts.map_or((note.as_str(), None), |(all, one)| (all, Some(one)));
            let (number, names) = all.entry((case.verdict, reason)).or_default();
            *number += 1;
            names.extend(name);
        }
    }
    let mut all: Vec<_> = all.into_iter().collect();
    all.sort_by_key(|(_, (number, _))| std::cmp::Reverse(*number));
    let more = all.len().saturating_sub(REASONS_MAX);
    for ((verdict, note), (number, names)) in all.into_iter().take(REASONS_MAX) {
        let names = names.into_iter().collect::<Vec<_>>().join(", ");
        // A case that passed was judged: its note is not a reason.
        let of = match (number, verdict) {
            (1, Verdict::Pass) => "note".to_owned(),
            _ => format!("{number} {verdict}"),
        };
        writeln!(out, "    {of}: {}", shorten(&format!("{note}{names}"), RESULT_MAX))?;
    }
    match more {
        0 => Ok(()),
        _ => writeln!(
            out,
            "    and {} (-v shows the reason of each case)",
            plural(more, "other reason")
        ),
    }
}

/// The beginnings of notes about an action that a client does not have, or about streams that a
/// testee does not claim.
const LACKS: [&str; 2] = ["the client has no ", NOT_CLAIMED];

fn line(case: &CaseReport, out: &mut dyn Write) -> io::Result<()> {
    let requirements: Vec<&str> =
        case.requirements.iter().map(|one| one.requirement.as_str()).collect();
    let verdict = worded(case.verdict, case.waived);
    let CaseReport { id, title, .. } = case;
    writeln!(out, "  {verdict:<14}  {id}: {title}  [{}]", requirements.join(" "))?;
    match &case.note {
        Some(note) => writeln!(out, "  {:<14}    {note}", ""),
        None => Ok(()),
    }
}

/// Maximum width of the first column, whose names may be those of a foreign report.
const WIDTH_MAX: usize = 40;

fn areas(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for subject in &report.subjects {
        writeln!(out, "Requirements by area, the {}", subject.subject)?;
        let width = subject.areas.iter().map(|area| area.area.len()).max();
        let width = width.unwrap_or_default().min(WIDTH_MAX);
        for area in &subject.areas {
            let total: usize = area.totals.values().sum();
            let waived = area.requirements.iter().filter(|one| one.waived).count();
            let counts = counts(&area.totals, waived);
            writeln!(out, "  {:<width$}  {total:3}: {counts}", area.area)?;
            for verdict in Verdict::ALL.into_iter().filter(|verdict| *verdict != Verdict::Pass) {
                let mine = area.requirements.iter().filter(|one| one.verdict == verdict);
                let ids: Vec<&str> = mine.map(|one| one.requirement.as_str()).collect();
                if !ids.is_empty() {
                    writeln!(out, "            {verdict}: {}", ids.join(" "))?;
                }
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn waivers(waivers: &[WaiverReport], out: &mut dyn Write) -> io::Result<()> {
    if waivers.is_empty() {
        return Ok(());
    }
    writeln!(out, "Waivers")?;
    for WaiverReport { test, requirement, verdict, reason, expires, state, found } in waivers {
        let found = found.filter(|found| found != verdict);
        let found = found.map_or_else(String::new, |found| format!(", found {found}"));
        writeln!(out, "  {}: {test} [{requirement}], {verdict} expected{found}", state.name())?;
        writeln!(out, "    until {expires}: {reason}")?;
    }
    writeln!(out)
}

/// Maximum number of suggested waivers that are printed.
const WAIVABLE_MAX: usize = 20;

/// Prints a waiver for each failure of a requirement of the catalogue that is not waived, or,
/// without such a failure, for each such inconclusive verdict; at most [`WAIVABLE_MAX`] waivers.
fn waivable(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let sorted = report.sorted();
    let with = |wanted: &[Verdict]| -> Vec<(&str, &RequirementReport)> {
        let all = sorted
            .iter()
            .flat_map(|case| case.requirements.iter().map(|one| (case.id.as_str(), one)));
        let known = |one: &RequirementReport| requirement(&one.requirement).is_some();
        all.filter(|(_, one)| !one.waived && wanted.contains(&one.verdict) && known(one)).collect()
    };
    let mut open = with(&[Verdict::Fail, Verdict::Vacuous]);
    if open.is_empty() {
        open = with(&[Verdict::Inconclusive]);
    }
    if open.is_empty() {
        return Ok(());
    }
    writeln!(out, "To accept the remaining failures, add to the file of --waivers:\n")?;
    let expires = next_year(&report.time);
    for (case, RequirementReport { requirement, verdict, .. }) in open.iter().take(WAIVABLE_MAX) {
        writeln!(
            out,
            "[[waiver]]\ntest = \"{case}\"\nrequirement = \"{requirement}\"\nverdict = \"{verdict}\"\n\
             reason = \"?\"\nexpires = {expires}\n"
        )?;
    }
    match open.len().saturating_sub(WAIVABLE_MAX) {
        0 => Ok(()),
        more => writeln!(out, "and {}\n", plural(more, "other waiver")),
    }
}

/// The same day of the next year, or 28 February instead of 29 February; `time` is in the format of
/// a report.
fn next_year(time: &str) -> String {
    let day = time.split('T').next().unwrap_or_default();
    let (year, rest) = day.split_once('-').unwrap_or((day, "01-01"));
    let year = year.parse::<u32>().unwrap_or_default().saturating_add(1);
    let rest = if rest == "02-29" { "02-28" } else { rest };
    format!("{year}-{rest}")
}

fn tail(report: &Report, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    let Report { checks, frames, left_out, .. } = report;
    let cases = report.cases.len();
    let left_out = if *left_out > 0 { format!(", {left_out} not selected") } else { String::new() };
    explain(report, out)?;
    let written = list(report.written.iter().map(String::as_str), NAMES_MAX);
    if !written.is_empty() {
        let is_left = !report.left_changed.is_empty();
        let end = if is_left { "restored, except those LEFT CHANGED" } else { "restored" };
        writeln!(out, "wrote     {written} ({end})")?;
    }
    let (cases, code) = (plural(cases, "case"), report.exit_code);
    writeln!(
        out,
        "{cases}{left_out}, {}, {}; exit code {code}",
        plural(*checks, "check"),
        plural(*frames, "frame")
    )?;
    last_line(report, display, out)
}

/// Writes the last line, after the values left changed, the stale waivers, the requirements whose
/// cause this run does not judge, and the rejected requests.
fn last_line(report: &Report, display: DisplayOptions, out: &mut dyn Write) -> io::Result<()> {
    report.left_changed.iter().try_for_each(|left| writeln!(out, "{left}"))?;
    for waiver in report.waivers.iter().filter(|waiver| waiver.state.is_stale()) {
        let WaiverReport { test, requirement, state, .. } = waiver;
        let word = display.paint(AnsiColor::Red, "STALE WAIVER");
        writeln!(out, "{word}  {test} [{requirement}]: {}", state.name())?;
    }
    orphans(report, out)?;
    let rejected = display.paint(AnsiColor::Red, "REJECTED");
    report.rejected.iter().try_for_each(|why| writeln!(out, "{rejected}  {why}"))?;
    let (color, verdict) = match report.exit() {
        Exit::Success => (AnsiColor::Green, "PASSED"),
        _ => (AnsiColor::Red, "NOT PASSED"),
    };
    let totals = report.subjects.iter().map(|one| {
        let counts = named_counts(&one.totals, one.waived, |verdict| {
            let all = one.areas.iter().flat_map(|area| &area.requirements);
            let is_named = verdict.fails_run() && verdict != Verdict::Interrupted;
            let failed = all.filter(|one| is_named && one.verdict == verdict);
            list(failed.map(|one| one.requirement.as_str()), NAMES_MAX)
        });
        format!("{}: {counts}", one.subject)
    });
    let totals = totals.collect::<Vec<_>>().join("; ");
    let ended = report.ended.iter().map(|why| format!("; ended early: {why}"));
    let ended: String = ended.collect();
    writeln!(out, "{}  {totals}{ended}", display.paint(color, verdict))
}

/// Writes, in a run with `--only`, the requirements whose failure follows from a requirement that
/// this selection does not judge.
fn orphans(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.only.is_empty() {
        return Ok(());
    }
    let failures = || report.cases.iter().flat_map(|case| &case.failures);
    let failed = failures().filter(|one| one.verdict.fails_run() && one.follows.is_none());
    let failed: BTreeSet<&str> = failed.map(|one| one.requirement.as_str()).collect();
    let mut all = BTreeSet::new();
    for one in failures() {
        if let Some(cause) = one.follows.as_deref().filter(|cause| !failed.contains(cause)) {
            all.insert((one.requirement.as_str(), cause));
        }
    }
    let mut all = all.into_iter();
    for (requirement, cause) in all.by_ref().take(REASONS_MAX) {
        writeln!(
            out,
            "{requirement} follows from {cause}, which this run does not judge: add --only {cause}"
        )?;
    }
    match all.count() {
        0 => Ok(()),
        more => writeln!(out, "the same holds for {}", plural(more, "other requirement")),
    }
}

/// Explains the verdicts in the report that are not self-explanatory.
fn explain(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let known = |verdict: Verdict| {
        report.subjects.iter().any(|subject| subject.totals.contains_key(&verdict))
    };
    for (verdict, meaning) in [
        (Verdict::Warning, "known from help pages only, and not met; not a failure"),
        (Verdict::Differs, "undocumented, and not as this project assumes; not a failure"),
        (
            Verdict::Vacuous,
            "correctly rejected, but the matching valid vector is rejected too; a failure",
        ),
        (Verdict::Inconclusive, "not decided by the replies, or follows from another failure"),
        (Verdict::NotObserved, "no case that was run tested it"),
        (Verdict::Interrupted, "the run ended before the case was complete"),
    ] {
        if known(verdict) {
            writeln!(out, "{verdict}: {meaning}")?;
        }
    }
    Ok(())
}

/// Verdicts with their counts, in the order of [`Verdict::ALL`].
pub(super) fn counts(totals: &Totals, waived: usize) -> String {
    named_counts(totals, waived, |_| String::new())
}

/// Like [`counts`], with the names of each verdict after its count.
fn named_counts(totals: &Totals, waived: usize, names: impl Fn(Verdict) -> String) -> String {
    let named = totals.iter().map(|(verdict, number)| match names(*verdict) {
        names if names.is_empty() => format!("{number} {verdict}"),
        names => format!("{number} {verdict} ({names})"),
    });
    let waived = (waived > 0).then(|| format!("{waived} of them waived"));
    named.chain(waived).collect::<Vec<_>>().join(", ")
}
