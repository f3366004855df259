//! The report as one HTML file.

use std::collections::BTreeSet;
use std::io::{self, Write};

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};
use serde::Serialize;

use super::FoundReport;
use super::console::describe;
use super::document::{ProfileReport, Report, SubjectReport};
use crate::exit::Exit;
use crate::judge::{Verdict, about};
use cause::{CauseView, causes};
use subject::{SubjectView, areas, subject};

mod cause;
mod finding;
mod subject;

const TEMPLATE: &str = include_str!("report.html");
const STYLE: &str = include_str!("report.css");
const SCRIPT: &str = include_str!("report.js");

/// Writes the report as one HTML file without external resources. Only the filter, links to hidden
/// or collapsed parts and the preparation for printing use JavaScript.
///
/// # Errors
/// An error of `out` or of the template.
pub fn to_html(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let syntax = SyntaxConfig::builder().trim_blocks(true).lstrip_blocks(true).build();
    let mut environment = Environment::new();
    environment.set_syntax(syntax.map_err(io::Error::other)?);
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    let html = environment.render_str(TEMPLATE, Serde(ReportView::new(report)));
    let html = html.map_err(io::Error::other)?;
    out.write_all(html.as_bytes())?;
    writeln!(out)
}

/// The meaning of the result of the run in words, unless the failed requirements say it, and the
/// failed requirements that are not waived.
fn meaning(report: &Report) -> (String, Vec<FailedView>) {
    let failed: Vec<FailedView> = report
        .subjects
        .iter()
        .flat_map(|subject| {
            let all = subject.areas.iter().flat_map(|area| &area.requirements);
            let failed = all.filter(|one| {
                !one.waived && matches!(one.verdict, Verdict::Fail | Verdict::Vacuous)
            });
            let subject = subject.subject.name();
            failed.map(move |one| FailedView { subject, id: one.requirement.clone() })
        })
        .collect();
    let words = match report.exit() {
        Exit::Success => match report.subjects.iter().all(is_clean) {
            true => "All judged requirements are met.",
            false => "No requirement fails, except those that are waived or only deviate.",
        },
        Exit::Failure if !failed.is_empty() => "",
        Exit::Failure => "A requirement is not met.",
        Exit::Usage => "The command line was invalid.",
        Exit::Nothing => {
            "Nothing was judged, a result is inconclusive, or the run was interrupted."
        }
        Exit::UnrestoredValue => "A value was changed and could not be restored.",
        Exit::NotPermitted => {
            "Requests were rejected for safety, so the target was not judged completely."
        }
        Exit::Stale => "Nothing fails, but a waiver is no longer valid.",
        Exit::Internal => "An internal error of the suite occurred.",
    };
    let ended = report.ended.as_ref().map(|why| format!(" The run ended early: {why}."));
    (words.to_owned() + ended.as_deref().unwrap_or_default(), failed)
}

/// Whether no requirement of the subject is waived or deviates.
fn is_clean(subject: &SubjectReport) -> bool {
    let deviating = [Verdict::Warning, Verdict::Differs];
    subject.waived == 0 && !deviating.iter().any(|verdict| subject.totals.contains_key(verdict))
}

/// A requirement that fails.
#[derive(Serialize)]
struct FailedView {
    subject: &'static str,
    id: String,
}

pub(super) fn claims(profile: &ProfileReport) -> Vec<(String, String)> {
    let word = |value: &serde_json::Value| match value {
        serde_json::Value::Null => "not specified".to_owned(),
        serde_json::Value::String(text) => text.clone(),
        serde_json::Value::Array(items) => {
            let items: Vec<String> = items
                .iter()
                .map(|item| item.as_str().map_or_else(|| item.to_string(), str::to_owned))
                .collect();
            items.join(", ")
        }
        other => other.to_string(),
    };
    let claims = profile.claims.iter();
    let claims = claims.map(|(name, value)| (name.replace('_', " "), word(value)));
    claims.filter(|(_, claim)| !claim.is_empty()).collect()
}

#[derive(Serialize)]
struct ReportView<'r> {
    style: &'static str,
    script: &'static str,
    /// The report without its subjects and cases, which `subjects` contains.
    report: Report,
    cases: usize,
    passed: bool,
    meaning: String,
    failed: Vec<FailedView>,
    causes: Vec<CauseView>,
    /// Whether the seed determined the order of the cases; false for a capture.
    is_ordered: bool,
    target: String,
    device: Option<String>,
    claims: Option<Vec<(String, String)>>,
    found: Option<String>,
    sampled: Option<String>,
    left_changed: Vec<String>,
    verdicts: Vec<Verdict>,
    areas: BTreeSet<(&'r str, &'static str)>,
    subjects: Vec<SubjectView>,
    waivers: Vec<(&'static str, bool)>,
    stale: usize,
}

impl<'r> ReportView<'r> {
    fn new(report: &'r Report) -> Self {
        let cases = &report.cases;
        let occurs = |verdict: &Verdict| cases.iter().any(|case| case.verdict == *verdict);
        let (meaning, failed) = meaning(report);
        let states = report.waivers.iter().map(|one| (one.state.name(), one.state.is_stale()));
        Self {
            style: STYLE,
            script: SCRIPT,
            report: Report { cases: Vec::new(), subjects: Vec::new(), ..report.clone() },
            cases: cases.len(),
            passed: report.exit() == Exit::Success,
            meaning,
            failed,
            causes: causes(report),
            is_ordered: report.target.file.is_none(),
            target: describe(&report.target),
            device: report.target.device.as_ref().map(ToString::to_string),
            claims: report.profile.as_ref().map(claims),
            found: report.found.as_ref().map(FoundReport::summary),
            sampled: report.found.as_ref().and_then(FoundReport::sampled),
            left_changed: report.left_changed.iter().map(ToString::to_string).collect(),
            verdicts: Verdict::ALL.into_iter().filter(occurs).collect(),
            areas: cases.iter().flat_map(areas).map(|area| (area, about(area))).collect(),
            subjects: report.subjects.iter().map(|one| subject(report, one.subject)).collect(),
            stale: report.waivers.iter().filter(|one| one.state.is_stale()).count(),
            waivers: states.collect(),
        }
    }
}
