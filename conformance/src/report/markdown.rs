//! The report as Markdown, for a pull request.

use std::io::{self, Write};

use super::FoundReport;
use super::console::{counts, describe};
use super::display::{DisplayOptions, NAMES_MAX, worded};
use super::document::Report;
use super::failures::{block, list, sentence};
use super::groups::groups;
use crate::exit::Exit;
use crate::judge::{Verdict, WaiverReport};
use crate::text::plural;

/// Maximum length in bytes of the texts of all groups of checks that did not pass, because a
/// comment on GitHub has at most 65 536 characters. The first group is printed even if it is
/// longer.
const FAILURES_MAX: usize = 48_000;
/// Maximum number of characters of the expected and of the actual result in a title.
const TITLE_MAX: usize = 60;

pub fn to_markdown(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let Report { suite, vectors, time, editions, seed, only, target, profile, found, .. } = report;
    let verdict = if report.exit() == Exit::Success { "passed" } else { "not passed" };
    for left in &report.left_changed {
        writeln!(out, "**{}**\n", plain(&left.to_string()))?;
    }
    for why in &report.rejected {
        writeln!(out, "**Rejected for safety: {}**\n", plain(why))?;
    }
    if let Some(why) = &report.ended {
        writeln!(out, "**Ended early: {}**\n", plain(why))?;
    }
    writeln!(out, "## ads-cnc: {} {verdict}\n", plain(&target.name))?;
    writeln!(out, "| | |\n|---|---|")?;
    let profile = profile.as_ref().map(|profile| profile.name.clone());
    for (name, value) in [
        ("suite", Some(format!("{suite}, vectors {vectors}"))),
        ("editions", Some(editions.join(", "))),
        ("target", Some(describe(target))),
        ("device", target.device.as_ref().map(ToString::to_string)),
        ("profile", profile),
        ("found", found.as_ref().map(FoundReport::summary)),
        ("sampled", found.as_ref().and_then(FoundReport::sampled)),
        ("only", Some(only.join(", "))),
        ("wrote", Some(report.written.join(", "))),
        ("run", Some(format!("{time}, seed {seed}, exit code {}", report.exit_code))),
    ] {
        if let Some(value) = value.filter(|value| !value.is_empty()) {
            writeln!(out, "| {name} | {} |", plain(&value))?;
        }
    }
    if !report.traffic.is_empty() {
        writeln!(out, "\n### Traffic\n")?;
        report.traffic.iter().try_for_each(|line| writeln!(out, "- {}", plain(line)))?;
    }
    totals(report, out)?;
    failures(report, out)?;
    waivers(&report.waivers, out)
}

fn totals(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for subject in &report.subjects {
        writeln!(out, "\n### Requirements, the {}\n", subject.subject)?;
        writeln!(out, "**{}**\n", counts(&subject.totals, subject.waived))?;
        writeln!(out, "| area | verdicts | not passed |\n|---|---|---|")?;
        for area in &subject.areas {
            let waived = area.requirements.iter().filter(|one| one.waived).count();
            let quiet = |verdict: Verdict| {
                let unseen = matches!(
                    verdict,
                    Verdict::NotRun | Verdict::NotObserved | Verdict::NotApplicable
                );
                !unseen && !matches!(verdict, Verdict::Pass | Verdict::Interrupted)
            };
            let named = area.requirements.iter().filter(|one| quiet(one.verdict));
            let named: Vec<String> = named
                .map(|one| {
                    let requirement = plain(&one.requirement);
                    format!("{requirement} {}", worded(one.verdict, one.waived))
                })
                .collect();
            let counts = counts(&area.totals, waived);
            writeln!(out, "| {} | {counts} | {} |", plain(&area.area), named.join("; "))?;
        }
    }
    Ok(())
}

fn failures(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let groups = groups(report);
    if groups.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### Not passed\n")?;
    let (mut length, mut shown) = (0_usize, 0_usize);
    // Begin with the most severe group, because not all groups may fit into a comment.
    for group in groups.iter().rev() {
        let mut text = Vec::new();
        block(report, group, DisplayOptions::default(), &mut text)?;
        let text = String::from_utf8_lossy(&text);
        length += text.len();
        if length > FAILURES_MAX && shown > 0 {
            break;
        }
        shown += 1;
        let title = group.example().map(|(case, failure)| {
            format!("<code>{}</code> {}", html(&case.id), html(&sentence(failure, TITLE_MAX)))
        });
        let title = title.unwrap_or_default();
        let verdict = worded(group.verdict, group.waived);
        let clauses = html(&list(group.requirements.iter().copied(), NAMES_MAX));
        let fence = fence(&text);
        writeln!(out, "<details><summary>{verdict}: {clauses} {title}</summary>\n")?;
        writeln!(out, "{fence}text\n{}{fence}\n\n</details>\n", end_line(&text))?;
    }
    match groups.len().saturating_sub(shown) {
        0 => Ok(()),
        more => writeln!(out, "And {}; HTML and JSON show all.", plural(more, "more finding")),
    }
}

fn waivers(waivers: &[WaiverReport], out: &mut dyn Write) -> io::Result<()> {
    if waivers.is_empty() {
        return Ok(());
    }
    writeln!(out, "\n### Waivers\n\n| case | requirement | expected | state | until | reason |")?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    for WaiverReport { test, requirement, verdict, reason, expires, state, .. } in waivers {
        let [test, requirement, reason, expires] =
            [test, requirement, reason, expires].map(|text| plain(text));
        let state = state.name();
        writeln!(out, "| {test} | {requirement} | {verdict} | {state} | {expires} | {reason} |")?;
    }
    Ok(())
}

/// Escapes text inside an HTML element, where the escapes of Markdown have no effect.
fn html(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Escapes Markdown.
pub(super) fn plain(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '>' => plain.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '@' => plain.extend(['\\', c]),
            '\n' | '\r' => plain.push(' '),
            c => plain.push(c),
        }
    }
    plain
}

fn end_line(text: &str) -> String {
    if text.ends_with('\n') { text.to_owned() } else { format!("{text}\n") }
}

/// A fence that does not occur in the text.
fn fence(text: &str) -> String {
    let longest = text.split(|one| one != '`').map(str::len).max().unwrap_or_default();
    "`".repeat(longest.saturating_add(1).max(3))
}
