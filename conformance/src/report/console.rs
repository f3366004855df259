//! The report as text.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::BytesReport;
use super::lines::{lines, marked};
use super::model::{CaseReport, EvidenceReport, FailureReport, Report, TargetReport, Totals};
use crate::judge::{CaseSubject, Exit, Verdict, WaiverReport};

/// Writes the report. `verbose` shows the cases made of vectors one by one.
pub fn print(report: &Report, verbose: bool, out: &mut dyn Write) -> io::Result<()> {
    report.left_changed.iter().try_for_each(|left| writeln!(out, "{left}"))?;
    head(report, out)?;
    for subject in &report.subjects {
        cases(report, subject.subject, verbose, out)?;
    }
    for case in &report.cases {
        failures(case, out)?;
    }
    areas(report, out)?;
    waivers(&report.waivers, out)?;
    tail(report, out)
}

fn head(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let Report { suite, vectors, editions, seed, only, target, profile, found, .. } = report;
    let editions = editions.join(" and ");
    writeln!(out, "ads-cnc {suite}, vectors {vectors}, by {editions}, seed {seed}")?;
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
    if let Some(found) = found {
        writeln!(out, "found    {}", found.summary())?;
        found.sampled().iter().try_for_each(|sampled| writeln!(out, "sampled  {sampled}"))?;
    }
    if !only.is_empty() {
        writeln!(out, "only     {}", only.join(", "))?;
    }
    writeln!(out)
}

/// The subject on one line.
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
        CaseSubject::Target => "The target, asked over AMS/TCP",
        CaseSubject::Client => "The client, answered over AMS/TCP",
        CaseSubject::CapturedClient => "The clients in the captured traffic",
        CaseSubject::CapturedCnc => "The CNCs in the captured traffic",
    }
}

/// The cases of a subject; those of vectors on one line per stream.
fn cases(report: &Report, who: CaseSubject, verbose: bool, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", heading(who))?;
    let mine = || report.cases.iter().filter(|case| case.subject == who);
    let mut streams: BTreeMap<&str, Vec<&CaseReport>> = BTreeMap::new();
    for case in mine() {
        if let Some(stream) = &case.stream {
            streams.entry(stream).or_default().push(case);
        }
    }
    let width = streams.keys().map(|stream| stream.len()).max().unwrap_or_default();
    for (stream, cases) in streams {
        let mut totals = Totals::new();
        for case in &cases {
            let number = totals.entry(case.verdict).or_default();
            *number += 1;
        }
        let waived = cases.iter().filter(|case| case.waived).count();
        writeln!(out, "  {stream:<width$}  {}", counts(&totals, waived))?;
        if verbose {
            cases.iter().try_for_each(|case| line(case, out))?;
        }
    }
    let mut others: Vec<&CaseReport> = mine().filter(|case| case.stream.is_none()).collect();
    // The cases ran in random order; the report lists them by requirement.
    let places = places(report, who);
    others.sort_by_key(|case| {
        let first = case.requirements.first().map(|one| one.requirement.as_str());
        (first.and_then(|id| places.get(id)), case.id.as_str())
    });
    others.into_iter().try_for_each(|case| line(case, out))?;
    writeln!(out)
}

/// The position of each requirement in the catalogue.
fn places(report: &Report, who: CaseSubject) -> BTreeMap<&str, usize> {
    let mine = report.subjects.iter().filter(|one| one.subject == who);
    let all = mine.flat_map(|one| &one.areas).flat_map(|area| &area.requirements);
    all.enumerate().map(|(place, one)| (one.requirement.as_str(), place)).collect()
}

fn line(case: &CaseReport, out: &mut dyn Write) -> io::Result<()> {
    let requirements: Vec<&str> =
        case.requirements.iter().map(|one| one.requirement.as_str()).collect();
    let verdict = worded(case.verdict, case.waived);
    writeln!(out, "  {verdict:<14}  {}  [{}]", case.title, requirements.join(" "))?;
    match &case.note {
        Some(note) => writeln!(out, "  {:<14}    {note}", ""),
        None => Ok(()),
    }
}

/// A verdict, and whether it is waived.
pub(super) fn worded(verdict: Verdict, waived: bool) -> String {
    if waived { format!("{verdict}, waived") } else { verdict.to_string() }
}

/// Each check that did not pass, with requirements and bytes.
fn failures(case: &CaseReport, out: &mut dyn Write) -> io::Result<()> {
    for all in case.findings() {
        if let Some(failure) = all.first() {
            let verdict = worded(failure.verdict, failure.waived).to_uppercase();
            writeln!(out, "{verdict}  {}: {}", case.id, case.title)?;
            finding(&all, out)?;
            writeln!(out)?;
        }
    }
    Ok(())
}

/// A check that did not pass, and its requirements.
pub(super) fn finding(all: &[&FailureReport], out: &mut dyn Write) -> io::Result<()> {
    let Some(failure) = all.first() else { return Ok(()) };
    for one in all {
        clause(one, out)?;
    }
    writeln!(out, "  expected  {}", failure.expected)?;
    writeln!(out, "  found     {}", failure.found)?;
    // The clause that it follows from has the bytes.
    if let Some(evidence) = failure.evidence.as_ref().filter(|_| failure.follows.is_none()) {
        bytes(evidence, out)?;
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
    if failure.sources.is_empty() {
        writeln!(out, "            in no document: assumed")
    } else {
        writeln!(out, "            {}", failure.sources.join("; "))
    }
}

fn bytes(evidence: &EvidenceReport, out: &mut dyn Write) -> io::Result<()> {
    let EvidenceReport { call, result, sent, received, expected, frame_sent, .. } = evidence;
    writeln!(out, "  sent      {call}")?;
    show(sent.as_ref().map(lines), out)?;
    if received.is_some() || !frame_sent.is_empty() {
        writeln!(out, "  received  {result}")?;
    }
    let is_same =
        sent.as_ref().map(BytesReport::bytes) == received.as_ref().map(BytesReport::bytes);
    show(received.as_ref().map(if is_same { marked } else { lines }), out)?;
    let expected = expected.as_ref().map(marked).filter(|lines| !lines.is_empty());
    if expected.is_some() {
        writeln!(out, "  instead of")?;
    }
    show(expected, out)
}

fn show(lines: Option<Vec<String>>, out: &mut dyn Write) -> io::Result<()> {
    lines.unwrap_or_default().iter().try_for_each(|line| writeln!(out, "    {line}"))
}

fn areas(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for subject in &report.subjects {
        writeln!(out, "Requirements by area, the {}", subject.subject)?;
        let width = subject.areas.iter().map(|area| area.area.len()).max().unwrap_or_default();
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

fn tail(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let Report { checks, frames, left_out, .. } = report;
    let cases = report.cases.len();
    let left_out = if *left_out > 0 { format!(", {left_out} not selected") } else { String::new() };
    let verdict = if report.exit() == Exit::Success { "PASSED" } else { "NOT PASSED" };
    let subjects = report.subjects.iter();
    let totals =
        subjects.map(|one| format!("{}: {}", one.subject, counts(&one.totals, one.waived)));
    explain(report, out)?;
    writeln!(out, "{verdict}  {}", totals.collect::<Vec<_>>().join("; "))?;
    let code = report.exit_code;
    writeln!(out, "{cases} cases{left_out}, {checks} checks, {frames} frames; exit code {code}")
}

/// Explains the verdicts in the report that are not self-explanatory.
fn explain(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let known = |verdict: Verdict| {
        report.subjects.iter().any(|subject| subject.totals.contains_key(&verdict))
    };
    for (verdict, meaning) in [
        (Verdict::Warning, "known from help pages only, and done otherwise: fails nobody"),
        (Verdict::Differs, "in no document, assumed, and done otherwise: fails nobody"),
        (Verdict::Vacuous, "refused as it should be, but so is what should be accepted: fails"),
        (Verdict::Inconclusive, "the replies do not decide it, or it follows from another failure"),
        (Verdict::NotObserved, "nothing in this run touches it"),
        (Verdict::Interrupted, "the run was ended before it was done"),
    ] {
        if known(verdict) {
            writeln!(out, "{verdict}: {meaning}")?;
        }
    }
    Ok(())
}

/// Verdicts with their counts, in the order of [`Verdict::ALL`].
pub(super) fn counts(totals: &Totals, waived: usize) -> String {
    let named = totals.iter().map(|(verdict, number)| format!("{number} {verdict}"));
    let waived = (waived > 0).then(|| format!("{waived} of them waived"));
    named.chain(waived).collect::<Vec<_>>().join(", ")
}
