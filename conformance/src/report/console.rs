//! The report for people.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::hex::annotated;
use super::model::{CaseReport, FailureReport, Report};
use crate::suite::{Evidence, Judgement};
use crate::verdict::{Exit, Verdict};

/// Writes the report. `verbose` shows the cases of the codec one by one too.
///
/// # Errors
/// Those of `out`.
pub fn print(report: &Report, verbose: bool, out: &mut impl Write) -> io::Result<()> {
    head(report, out)?;
    codec_cases(report, verbose, out)?;
    target_cases(report, out)?;
    for case in &report.cases {
        failures(case, out)?;
    }
    areas(report, out)?;
    tail(report, out)
}

fn head(report: &Report, out: &mut impl Write) -> io::Result<()> {
    let Report { suite, vectors, target, profile, .. } = report;
    writeln!(out, "ads-cnc {suite}, vectors {vectors}")?;
    writeln!(out, "target   {} at {}, AMS NetId {}", target.name, target.address, target.net_id)?;
    let channels: Vec<String> = profile.channels.iter().map(u32::to_string).collect();
    writeln!(out, "profile  {}: channels {}", profile.name, channels.join(", "))?;
    writeln!(out)
}

/// The cases of the codec: one line for each stream.
fn codec_cases(report: &Report, verbose: bool, out: &mut impl Write) -> io::Result<()> {
    let mut streams: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
    for case in report.cases.iter().filter(|case| case.codec) {
        let stream = case.stream().unwrap_or_default();
        let number = streams.entry(stream).or_default().entry(case.verdict.name()).or_default();
        *number = number.saturating_add(1);
    }
    if streams.is_empty() {
        return Ok(());
    }
    writeln!(out, "The codec against the golden vectors")?;
    for (stream, verdicts) in streams {
        writeln!(out, "  {stream:<22}  {}", counts(&verdicts))?;
        if verbose {
            let mine =
                report.cases.iter().filter(|case| case.codec && case.stream() == Some(stream));
            for case in mine {
                line(case, out)?;
            }
        }
    }
    writeln!(out)
}

fn target_cases(report: &Report, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "The target, asked over AMS/TCP")?;
    for case in report.cases.iter().filter(|case| !case.codec) {
        line(case, out)?;
    }
    writeln!(out)
}

fn line(case: &CaseReport, out: &mut impl Write) -> io::Result<()> {
    let requirements: Vec<&str> = case.requirements.iter().map(|one| one.requirement).collect();
    writeln!(out, "  {:<14}  {}  [{}]", case.verdict, case.title, requirements.join(" "))?;
    match &case.note {
        Some(note) => writeln!(out, "  {:<14}    {note}", ""),
        None => Ok(()),
    }
}

/// Each check that was not passed, with its clauses and its bytes.
fn failures(case: &CaseReport, out: &mut impl Write) -> io::Result<()> {
    let mut shown: Vec<(&FailureReport, &Judgement, Vec<&FailureReport>)> = Vec::new();
    for (failure, judgement) in case.failures.iter().zip(case.judgements()) {
        // One check may stand for several requirements: its bytes are shown once.
        let same = shown.iter_mut().find(|(first, ..)| {
            (&first.expected, &first.found, &first.sent, first.verdict)
                == (&failure.expected, &failure.found, &failure.sent, failure.verdict)
        });
        match same {
            Some((.., all)) => all.push(failure),
            None => shown.push((failure, judgement, vec![failure])),
        }
    }
    for (failure, judgement, all) in shown {
        writeln!(out, "{}  {}: {}", failure.verdict.name().to_uppercase(), case.id, case.title)?;
        for one in all {
            clause(one, out)?;
        }
        writeln!(out, "  expected  {}", failure.expected)?;
        writeln!(out, "  found     {}", failure.found)?;
        if let Some(evidence) = &judgement.evidence {
            bytes(evidence, out)?;
        }
        if failure.more > 0 {
            writeln!(out, "  and {} more like this in the same case", failure.more)?;
        }
        writeln!(out)?;
    }
    Ok(())
}

fn clause(failure: &FailureReport, out: &mut impl Write) -> io::Result<()> {
    let level = failure.level.map_or_else(String::new, |level| format!("{level:?}").to_lowercase());
    writeln!(out, "  {:<8}  {level}: {}", failure.requirement, failure.clause)?;
    match failure.sources.is_empty() {
        true => writeln!(out, "            in no document: assumed"),
        false => writeln!(out, "            {}", failure.sources.join("; ")),
    }
}

fn bytes(evidence: &Evidence, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "  sent      {}", evidence.call)?;
    for line in annotated(evidence.request_stream, &evidence.sent) {
        writeln!(out, "    {line}")?;
    }
    if evidence.received.is_some() || !evidence.frame_sent.is_empty() {
        writeln!(out, "  received  {}", evidence.result)?;
    }
    if let Some(received) = &evidence.received {
        for line in annotated(evidence.reply_stream, received) {
            writeln!(out, "    {line}")?;
        }
    }
    Ok(())
}

fn areas(report: &Report, out: &mut impl Write) -> io::Result<()> {
    for subject in &report.subjects {
        writeln!(out, "Requirements by area, the {}", subject.subject)?;
        for area in &subject.areas {
            let total: usize = area.totals.values().sum();
            writeln!(out, "  {}  {total:3}: {}", area.area, counts(&area.totals))?;
            for verdict in Verdict::ALL.into_iter().filter(|verdict| *verdict != Verdict::Pass) {
                let mine = area.requirements.iter().filter(|one| one.verdict == verdict);
                let ids: Vec<&str> = mine.map(|one| one.requirement).collect();
                if !ids.is_empty() {
                    writeln!(out, "            {verdict}: {}", ids.join(" "))?;
                }
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

fn tail(report: &Report, out: &mut impl Write) -> io::Result<()> {
    let Report { checks, frames, .. } = report;
    let cases = report.cases.len();
    let verdict = if report.exit() == Exit::Success { "PASSED" } else { "NOT PASSED" };
    let subjects = report.subjects.iter();
    let totals = subjects.map(|one| format!("{}: {}", one.subject, counts(&one.totals)));
    explain(report, out)?;
    writeln!(out, "{verdict}  {}", totals.collect::<Vec<_>>().join("; "))?;
    writeln!(out, "{cases} cases, {checks} checks, {frames} frames; exit code {}", report.exit_code)
}

/// What the verdicts mean that this report has and that do not say so themselves.
fn explain(report: &Report, out: &mut impl Write) -> io::Result<()> {
    let known = |verdict: Verdict| {
        report.subjects.iter().any(|subject| subject.totals.contains_key(verdict.name()))
    };
    for (verdict, meaning) in [
        (Verdict::Warning, "known from help pages only, and done otherwise: fails nobody"),
        (Verdict::Differs, "in no document, assumed, and done otherwise: fails nobody"),
        (Verdict::Vacuous, "refused as it should be, but so is what should be accepted: fails"),
        (Verdict::Inconclusive, "what came back does not tell"),
        (Verdict::NotObserved, "nothing in this run touches it"),
    ] {
        if known(verdict) {
            writeln!(out, "{verdict}: {meaning}")?;
        }
    }
    Ok(())
}

/// Verdicts with their numbers, in the order of [`Verdict::ALL`].
fn counts(verdicts: &BTreeMap<&str, usize>) -> String {
    let named = Verdict::ALL.into_iter().filter_map(|verdict| {
        let number = verdicts.get(verdict.name())?;
        Some(format!("{number} {verdict}"))
    });
    named.collect::<Vec<_>>().join(", ")
}
