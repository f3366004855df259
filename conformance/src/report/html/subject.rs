//! A subject's requirements and cases, in the form that the template needs.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use super::finding::{FailureView, finding};
use crate::judge::{CaseSubject, Verdict, about};
use crate::report::PROTOCOL_TITLE;
use crate::report::console::{counts, heading};
use crate::report::display::worded;
use crate::report::document::{CaseReport, Report, tally};

#[derive(Serialize)]
pub(super) struct SubjectView {
    name: &'static str,
    heading: &'static str,
    counts: String,
    areas: Vec<AreaView>,
    groups: Vec<GroupView>,
}

#[derive(Serialize)]
struct AreaView {
    area: String,
    about: &'static str,
    counts: Vec<Chip>,
    total: usize,
    requirements: Vec<RequirementView>,
}

#[derive(Serialize)]
struct RequirementView {
    id: String,
    title: String,
    verdict: Verdict,
    waived: bool,
    /// The cases to link to, the most severe first.
    cases: Vec<String>,
    /// Number of other cases.
    more: usize,
}

/// Maximum number of cases that a requirement links to.
const LINKED_MAX: usize = 8;

/// The IDs of at most [`LINKED_MAX`] cases of a requirement, the most severe first, and the number of
/// omitted cases.
fn linked(report: &Report, judged_subject: CaseSubject, id: &str) -> (Vec<String>, usize) {
    let verdict = |case: &CaseReport| {
        let mut mine = case.requirements.iter().filter(|one| one.requirement == id);
        mine.next().map(|one| std::cmp::Reverse(one.verdict.severity()))
    };
    let mine = report.cases.iter().filter(|case| case.subject == judged_subject);
    let mut cases: Vec<_> = mine.filter_map(|case| Some((verdict(case)?, &case.id))).collect();
    cases.sort();
    let more = cases.len().saturating_sub(LINKED_MAX);
    (cases.into_iter().take(LINKED_MAX).map(|(_, id)| id.clone()).collect(), more)
}

/// A group of cases: the vectors or sequences of a stream, or the cases whose IDs begin with the
/// same word.
#[derive(Serialize)]
struct GroupView {
    title: String,
    counts: Vec<Chip>,
    /// Whether the group is initially collapsed.
    folded: bool,
    /// The severity of the most severe verdict that is not waived.
    #[serde(skip)]
    severity: u8,
    /// In a folded group, all cases; otherwise the cases with a check that did not pass, or with a
    /// verdict that fails the run.
    cases: Vec<CaseView>,
    /// The other cases.
    rest: Vec<CaseView>,
}

#[derive(Serialize)]
struct CaseView {
    id: String,
    title: String,
    verdict: Verdict,
    word: String,
    waived: bool,
    areas: String,
    requirements: Vec<String>,
    note: Option<String>,
    findings: Vec<FailureView>,
}

pub(super) fn subject(report: &Report, judged_subject: CaseSubject) -> SubjectView {
    let mut groups: BTreeMap<(bool, String), Vec<&CaseReport>> = BTreeMap::new();
    for case in report.cases.iter().filter(|case| case.subject == judged_subject) {
        let group = match &case.stream {
            Some(stream) => (true, stream.clone()),
            None => (false, case.id.split('-').next().unwrap_or_default().to_owned()),
        };
        groups.entry(group).or_default().push(case);
    }
    let (mut counted, mut listed) = (String::new(), Vec::new());
    for subject in report.subjects.iter().filter(|one| one.subject == judged_subject) {
        counted = counts(&subject.totals, subject.waived);
        listed.extend(subject.areas.iter().map(|area| {
            AreaView {
                area: area.area.clone(),
                about: about(&area.area),
                counts: chips(area.requirements.iter().map(|one| (one.verdict, one.waived))),
                total: area.requirements.len(),
                requirements: area
                    .requirements
                    .iter()
                    .map(|one| {
                        let (cases, more) = linked(report, judged_subject, &one.requirement);
                        RequirementView {
                            id: one.requirement.clone(),
                            title: ads_cnc_vectors::requirement(&one.requirement)
                                .map_or(PROTOCOL_TITLE, |requirement| requirement.title.as_str())
                                .to_owned(),
                            verdict: one.verdict,
                            waived: one.waived,
                            cases,
                            more,
                        }
                    })
                    .collect(),
            }
        }));
    }
    SubjectView {
        name: judged_subject.name(),
        heading: heading(judged_subject),
        counts: counted,
        areas: listed,
        groups: {
            let groups = groups.into_iter().map(|((_, title), cases)| group(title, cases));
            let mut groups: Vec<GroupView> = groups.collect();
            // The sort keeps the order of groups with equal severity.
            groups.sort_by_key(|group| (group.folded, std::cmp::Reverse(group.severity)));
            groups
        },
    }
}

fn group(title: String, mut cases: Vec<&CaseReport>) -> GroupView {
    // Cases that are not waived first, then the most severe cases, then the vectors with the fewest
    // bytes.
    cases.sort_by_cached_key(|case| {
        let evidence = case.failures.first().and_then(|failure| failure.evidence.as_ref());
        let parts = evidence.map(|one| [&one.sent, &one.received]).into_iter().flatten();
        let bytes: usize = parts.flatten().map(|part| part.length).sum();
        let size = if case.stream.is_some() { bytes } else { 0 };
        let severity = std::cmp::Reverse(case.verdict.severity());
        (case.waived, severity, size, case.id.clone())
    });
    let counts = chips(cases.iter().map(|case| (case.verdict, case.waived)));
    let folded = cases.iter().all(|case| case.waived || !case.verdict.fails_run());
    let fails =
        |case: &&CaseReport| folded || !case.failures.is_empty() || case.verdict.fails_run();
    let (cases, rest): (Vec<&CaseReport>, Vec<&CaseReport>) = cases.into_iter().partition(fails);
    let open = cases.iter().filter(|case| !case.waived).map(|case| case.verdict.severity());
    let severity = open.max().unwrap_or_default();
    let [cases, rest] = [cases, rest].map(|cases| cases.into_iter().map(case).collect());
    GroupView { title, counts, folded, severity, cases, rest }
}

/// CSS class and text of a count.
type Chip = (String, String);

fn chips(verdicts: impl Iterator<Item = (Verdict, bool)>) -> Vec<Chip> {
    let chip = |((verdict, waived), number): ((Verdict, bool), usize)| {
        let class = if waived { format!("{verdict} waived") } else { verdict.to_string() };
        (class, format!("{number} {}", worded(verdict, waived)))
    };
    tally(verdicts).into_iter().map(chip).collect()
}

pub(super) fn areas(case: &CaseReport) -> BTreeSet<&str> {
    let ids = case.requirements.iter().map(|one| one.requirement.as_str());
    ids.filter_map(|id| id.split('-').next()).collect()
}

fn case(case: &CaseReport) -> CaseView {
    CaseView {
        id: case.id.clone(),
        title: case.title.clone(),
        verdict: case.verdict,
        word: worded(case.verdict, case.waived),
        waived: case.waived,
        areas: areas(case).into_iter().collect::<Vec<_>>().join(" "),
        requirements: case.requirements.iter().map(|one| one.requirement.clone()).collect(),
        note: case.note.clone(),
        findings: case.findings().into_iter().filter_map(|all| finding(&all)).collect(),
    }
}
