//! The conformance statement, which says for each requirement whether it is claimed and verified.

use std::collections::HashSet;
use std::io::{self, Write};

use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};
use serde::Serialize;

use super::console::describe;
use super::document::{AreaReport, Report, RequirementReport, SubjectReport};
use super::failures::list;
use super::html::claims;
use super::junit::in_words;
use super::markdown::plain;
use super::{FoundReport, PROTOCOL_TITLE};
use crate::exit::Exit;
use crate::judge::{Verdict, about};

const TEMPLATE: &str = include_str!("statement.html");

#[derive(Serialize)]
struct Statement {
    name: String,
    facts: Vec<(String, String)>,
    subjects: Vec<SubjectStatement>,
}

#[derive(Serialize)]
struct SubjectStatement {
    name: &'static str,
    areas: Vec<AreaStatement>,
}

#[derive(Serialize)]
struct AreaStatement {
    area: String,
    about: &'static str,
    verified: usize,
    clauses: Vec<ClauseStatement>,
}

#[derive(Serialize)]
struct ClauseStatement {
    id: String,
    title: String,
    level: String,
    claimed: &'static str,
    result: String,
    /// The verdict, which selects the style.
    verdict: Verdict,
}

impl Statement {
    fn new(report: &Report) -> Self {
        let mut facts = vec![
            ("Result".to_owned(), result(report)),
            ("Subject".to_owned(), describe(&report.target)),
            ("Suite".to_owned(), format!("ads-cnc {}, vectors {}", report.suite, report.vectors)),
            ("Editions".to_owned(), report.editions.join(", ")),
            ("Run".to_owned(), format!("{}, seed {}", report.time, report.seed)),
        ];
        let more = [
            ("Device", report.target.device.as_ref().map(ToString::to_string)),
            ("Profile", report.profile.as_ref().map(|profile| profile.name.clone())),
            ("Selection", Some(report.only.join(", ")).filter(|only| !only.is_empty())),
            ("Found", report.found.as_ref().map(FoundReport::summary)),
            ("Sampled", report.found.as_ref().and_then(FoundReport::sampled)),
            ("Wrote", Some(report.written.join(", ")).filter(|written| !written.is_empty())),
            ("Ended early", report.ended.clone()),
        ];
        facts.extend(more.into_iter().filter_map(|(name, fact)| Some((name.to_owned(), fact?))));
        let left = report.left_changed.iter().map(ToString::to_string);
        facts.extend(left.map(|left| ("Not restored".to_owned(), left)));
        let rejected = report.rejected.iter().cloned();
        facts.extend(rejected.map(|why| ("Rejected for safety".to_owned(), why)));
        facts.extend(report.waivers.iter().map(|waiver| ("Waiver".to_owned(), in_words(waiver))));
        // If queries of the device determined what was judged, the device claims nothing.
        let word = if is_found(report) { "Judged" } else { "Claims" };
        for (name, claim) in report.profile.iter().flat_map(claims) {
            if !claim.is_empty() {
                facts.push((format!("{word}, {name}"), claim));
            }
        }
        let subjects = report.subjects.iter().map(|one| subject(report, one)).collect();
        Self { name: report.target.name.clone(), facts, subjects }
    }
}

/// Whether queries of the device, instead of a profile, determined what was judged.
fn is_found(report: &Report) -> bool {
    report.found.as_ref().is_some_and(FoundReport::is_by_queries)
}

/// The result on one line: whether the run passed, and the requirements that are not met, that
/// deviate, or that were not verified.
fn result(report: &Report) -> String {
    let all = report.subjects.iter().flat_map(|subject| &subject.areas);
    let all: Vec<&RequirementReport> = all.flat_map(|area| &area.requirements).collect();
    let named = |wanted: &[Verdict], waived: bool, most: usize| {
        let ids = all.iter().filter(|one| wanted.contains(&one.verdict) && one.waived == waived);
        let ids = ids.map(|one| one.requirement.as_str());
        // Name a clause only once, because several subjects may have the same clause.
        let mut seen = HashSet::new();
        list(ids.filter(|id| seen.insert(*id)), most)
    };
    let mut open = vec![Verdict::Inconclusive, Verdict::Interrupted, Verdict::HarnessError];
    // With a selection, it is intended that other requirements were not run, so they are not
    // listed.
    if report.only.is_empty() {
        open.push(Verdict::NotRun);
    }
    let failed = [Verdict::Fail, Verdict::Vacuous];
    let deviating = [Verdict::Warning, Verdict::Differs];
    let parts = [
        ("not met", named(&failed, false, usize::MAX)),
        ("not met, waived", named(&failed, true, usize::MAX)),
        ("deviates", named(&deviating, false, usize::MAX)),
        ("deviates, waived", named(&deviating, true, usize::MAX)),
        ("not verified", named(&open, false, NOT_VERIFIED_MAX)),
        ("not verified, waived", named(&open, true, NOT_VERIFIED_MAX)),
    ];
    let parts = parts.iter().filter(|(_, ids)| !ids.is_empty());
    let parts: Vec<String> = parts.map(|(what, ids)| format!("{what}: {ids}")).collect();
    let passed = if report.exit() == Exit::Success { "passed" } else { "not passed" };
    if parts.is_empty() { passed.to_owned() } else { format!("{passed}; {}", parts.join("; ")) }
}

/// Maximum number of unverified clauses on the line of the result; the tables contain all.
const NOT_VERIFIED_MAX: usize = 12;

fn subject(report: &Report, subject: &SubjectReport) -> SubjectStatement {
    let areas = subject.areas.iter().map(|AreaReport { area, requirements, .. }| AreaStatement {
        area: area.clone(),
        about: about(area),
        verified: requirements.iter().filter(|one| one.verdict == Verdict::Pass).count(),
        clauses: requirements.iter().map(|one| clause(report, subject, one)).collect(),
    });
    SubjectStatement { name: subject.subject.name(), areas: areas.collect() }
}

fn clause(report: &Report, subject: &SubjectReport, one: &RequirementReport) -> ClauseStatement {
    let RequirementReport { requirement: id, verdict, waived } = one;
    let known = ads_cnc_vectors::requirement(id);
    let cases = report.cases.iter().filter(|case| case.subject == subject.subject);
    let judging = cases.filter(|case| case.requirements.iter().any(|one| one.requirement == *id));
    let note = |wanted: Verdict| {
        let mut all = judging.clone().filter(|case| case.verdict == wanted);
        all.find_map(|case| case.note.as_ref()).map_or_else(String::new, |why| format!(": {why}"))
    };
    let yes = if is_found(report) { "found" } else { "yes" };
    let (claimed, result) = match verdict {
        Verdict::Pass => (yes, "verified".to_owned()),
        Verdict::Fail | Verdict::Vacuous => (yes, "not met".to_owned()),
        Verdict::Warning => (yes, "deviates from the online help".to_owned()),
        Verdict::Differs => (yes, "undocumented, and not as assumed".to_owned()),
        Verdict::NotApplicable => ("no", format!("not claimed{}", note(*verdict))),
        Verdict::NotObserved if judging.clone().next().is_none() => {
            let name = subject.subject.name();
            let is_elsewhere = report
                .cases
                .iter()
                .any(|case| case.requirements.iter().any(|one| one.requirement == *id));
            let elsewhere = || format!("not verifiable with the {name} alone");
            ("-", if is_elsewhere { elsewhere() } else { "not verifiable from outside".to_owned() })
        }
        Verdict::NotObserved => (yes, "not verified: no case of this run tested it".to_owned()),
        Verdict::NotRun => (yes, format!("not verified{}", note(*verdict))),
        verdict => (yes, format!("not verified, {verdict}{}", note(*verdict))),
    };
    ClauseStatement {
        id: id.clone(),
        title: known.map_or(PROTOCOL_TITLE, |known| known.title.as_str()).to_owned(),
        level: known.map_or_else(String::new, |known| format!("{:?}", known.level).to_lowercase()),
        claimed,
        result: if *waived { result + ", waived" } else { result },
        verdict: *verdict,
    }
}

/// Writes the conformance statement as Markdown.
pub fn to_statement(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let Statement { name, facts, subjects } = Statement::new(report);
    writeln!(out, "# Conformance statement: {}\n\n| | |\n|---|---|", plain(&name))?;
    facts
        .iter()
        .try_for_each(|(name, fact)| writeln!(out, "| {} | {} |", plain(name), plain(fact)))?;
    for SubjectStatement { name, areas } in subjects {
        writeln!(out, "\n## The {name}")?;
        for AreaStatement { area, about, verified, clauses } in areas {
            let all = clauses.len();
            writeln!(out, "\n### {}: {about} ({verified} of {all} verified)\n", plain(&area))?;
            writeln!(out, "| clause | | level | claimed | result |\n|---|---|---|---|---|")?;
            for ClauseStatement { id, title, level, claimed, result, .. } in clauses {
                let [id, title, result] = [id, title, result].map(|text| plain(&text));
                writeln!(out, "| {id} | {title} | {level} | {claimed} | {result} |")?;
            }
        }
    }
    Ok(())
}

/// Writes the conformance statement as HTML.
///
/// # Errors
/// An error of `out` or of the template.
pub fn to_statement_html(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    let html = environment.render_str(TEMPLATE, Serde(Statement::new(report)));
    out.write_all(html.map_err(io::Error::other)?.as_bytes())?;
    writeln!(out)
}
