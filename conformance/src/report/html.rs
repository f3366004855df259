//! The report as one HTML file.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};

use minijinja::syntax::SyntaxConfig;
use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};
use serde::Serialize;

use super::bytes::Shown;
use super::console::{counts, describe, heading, worded};
use super::hex::character;
use super::model::{CaseReport, EvidenceReport, FailureReport, ProfileReport, Report};
use super::{BytesReport, FieldReport};
use crate::suite::Subject;
use crate::verdict::{Exit, Verdict};

const TEMPLATE: &str = include_str!("report.html");
const STYLE: &str = include_str!("report.css");
const SCRIPT: &str = include_str!("report.js");

/// Writes the report as one HTML file that needs nothing else: no network, and no JavaScript but to
/// filter.
///
/// # Errors
/// Those of `out`, and a template that does not fit the report.
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

const fn meaning(exit: Exit) -> &'static str {
    match exit {
        Exit::Success => "Everything judged is in order.",
        Exit::Failure => "Something required is not met.",
        Exit::Usage => "The command line was wrong.",
        Exit::Nothing => "Nothing was judged, or what came back does not tell.",
        Exit::Refused => "Something was refused for safety, so the target was not judged whole.",
        Exit::Stale => "Nothing fails, but a waiver no longer holds.",
        Exit::Internal => "The suite itself failed.",
    }
}

/// Claims in words.
fn claims(profile: &ProfileReport) -> Vec<(String, String)> {
    let word = |value: &serde_json::Value| match value {
        serde_json::Value::Null => "not said".to_owned(),
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
    profile.claims.iter().map(|(name, value)| (name.replace('_', " "), word(value))).collect()
}

#[derive(Serialize)]
struct ReportView<'r> {
    style: &'static str,
    script: &'static str,
    /// Without the cases, which are with the subjects.
    report: Report,
    cases: usize,
    passed: bool,
    meaning: &'static str,
    target: String,
    device: Option<String>,
    claims: Option<Vec<(String, String)>>,
    verdicts: Vec<Verdict>,
    areas: BTreeSet<&'r str>,
    subjects: Vec<SubjectView>,
    waivers: Vec<(&'static str, bool)>,
    stale: usize,
}

impl<'r> ReportView<'r> {
    fn new(report: &'r Report) -> Self {
        let cases = &report.cases;
        let occurs = |verdict: &Verdict| cases.iter().any(|case| case.verdict == *verdict);
        let states = report.waivers.iter().map(|one| (one.state.name(), one.state.is_stale()));
        Self {
            style: STYLE,
            script: SCRIPT,
            report: Report { cases: Vec::new(), subjects: Vec::new(), ..report.clone() },
            cases: cases.len(),
            passed: report.exit() == Exit::Success,
            meaning: meaning(report.exit()),
            target: describe(&report.target),
            device: report.target.device.as_ref().map(ToString::to_string),
            claims: report.profile.as_ref().map(claims),
            verdicts: Verdict::ALL.into_iter().filter(occurs).collect(),
            areas: cases.iter().flat_map(areas).collect(),
            subjects: report.subjects.iter().map(|one| subject(report, one.subject)).collect(),
            stale: report.waivers.iter().filter(|one| one.state.is_stale()).count(),
            waivers: states.collect(),
        }
    }
}

#[derive(Serialize)]
struct SubjectView {
    name: &'static str,
    heading: &'static str,
    counts: String,
    areas: Vec<AreaView>,
    groups: Vec<GroupView>,
}

#[derive(Serialize)]
struct AreaView {
    area: String,
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
}

/// Cases that belong together: a stream's vectors, or those of one area.
#[derive(Serialize)]
struct GroupView {
    title: String,
    counts: Vec<Chip>,
    /// Whether it is folded up at first.
    folded: bool,
    cases: Vec<CaseView>,
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
    findings: Vec<FindingView>,
}

#[derive(Serialize)]
struct FindingView {
    verdict: Verdict,
    word: String,
    clauses: Vec<FailureReport>,
    expected: String,
    found: String,
    more: usize,
    evidence: Option<EvidenceView>,
}

#[derive(Serialize)]
struct EvidenceView {
    call: String,
    result: String,
    sent: Option<BytesView>,
    received: Option<BytesView>,
    expected: Option<BytesView>,
    frame_sent: String,
    frame_received: String,
}

#[derive(Serialize)]
struct BytesView {
    stream: Option<String>,
    length: usize,
    rows: Vec<RowView>,
    faults: Vec<String>,
}

#[derive(Serialize, Default)]
struct RowView {
    /// Items that are passed over; then there is nothing else.
    more: usize,
    offset: usize,
    bytes: Vec<ByteView>,
    /// Zeros behind the bytes that are not shown.
    zeros: usize,
    field: String,
    value: String,
    meaning: String,
    differs: bool,
    /// What should be there.
    instead: Option<Box<RowView>>,
}

#[derive(Serialize)]
struct ByteView {
    hex: String,
    character: char,
    differs: bool,
}

fn subject(report: &Report, who: Subject) -> SubjectView {
    let mut groups: BTreeMap<(bool, String), Vec<&CaseReport>> = BTreeMap::new();
    for case in report.cases.iter().filter(|case| case.subject == who) {
        let group = match &case.stream {
            Some(stream) => (true, stream.clone()),
            None => (false, case.id.split('-').next().unwrap_or_default().to_owned()),
        };
        groups.entry(group).or_default().push(case);
    }
    let (mut counted, mut listed) = (String::new(), Vec::new());
    for subject in report.subjects.iter().filter(|one| one.subject == who) {
        counted = counts(&subject.totals, subject.waived);
        listed.extend(subject.areas.iter().map(|area| {
            AreaView {
                area: area.area.clone(),
                counts: chips(area.requirements.iter().map(|one| (one.verdict, one.waived))),
                total: area.requirements.len(),
                requirements: area
                    .requirements
                    .iter()
                    .map(|one| RequirementView {
                        id: one.requirement.clone(),
                        title: ads_cnc_vectors::requirement(&one.requirement).map_or_else(
                            || "The protocol with the suite".to_owned(),
                            |requirement| requirement.title.clone(),
                        ),
                        verdict: one.verdict,
                        waived: one.waived,
                    })
                    .collect(),
            }
        }));
    }
    SubjectView {
        name: who.name(),
        heading: heading(who),
        counts: counted,
        areas: listed,
        groups: {
            let groups = groups.into_iter().map(|((_, title), cases)| group(title, cases));
            let (folded, open): (Vec<_>, Vec<_>) = groups.partition(|group| group.folded);
            open.into_iter().chain(folded).collect()
        },
    }
}

fn group(title: String, mut cases: Vec<&CaseReport>) -> GroupView {
    // What needs attention first.
    cases.sort_by(|one, other| {
        let rank =
            |case: &CaseReport| (case.waived, u8::MAX.saturating_sub(case.verdict.gravity()));
        rank(one).cmp(&rank(other)).then_with(|| one.id.cmp(&other.id))
    });
    let counts = chips(cases.iter().map(|case| (case.verdict, case.waived)));
    let folded = cases.iter().all(|case| case.waived || !case.verdict.is_trouble());
    let cases = cases.into_iter().map(case).collect();
    GroupView { title, counts, folded, cases }
}

/// Class and text of a number of verdicts.
type Chip = (String, String);

fn chips(verdicts: impl Iterator<Item = (Verdict, bool)>) -> Vec<Chip> {
    let mut totals: BTreeMap<(Verdict, bool), usize> = BTreeMap::new();
    for key in verdicts {
        let number = totals.entry(key).or_default();
        *number = number.saturating_add(1);
    }
    let chip = |((verdict, waived), number): ((Verdict, bool), usize)| {
        let class = if waived { format!("{verdict} waived") } else { verdict.to_string() };
        (class, format!("{number} {}", worded(verdict, waived)))
    };
    totals.into_iter().map(chip).collect()
}

fn areas(case: &CaseReport) -> BTreeSet<&str> {
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

fn finding(all: &[&FailureReport]) -> Option<FindingView> {
    let first = *all.first()?;
    Some(FindingView {
        verdict: first.verdict,
        word: worded(first.verdict, first.waived),
        clauses: all
            .iter()
            .map(|&failure| FailureReport { evidence: None, ..failure.clone() })
            .collect(),
        expected: first.expected.clone(),
        found: first.found.clone(),
        more: first.more,
        evidence: first.evidence.as_ref().map(evidence),
    })
}

fn evidence(evidence: &EvidenceReport) -> EvidenceView {
    let EvidenceReport { call, result, sent, received, expected, frame_sent, frame_received } =
        evidence;
    // With the same fields, what was expected stands below what was received instead.
    let fits = received.as_ref().zip(expected.as_ref()).is_some_and(|(received, expected)| {
        let places = |bytes: &BytesReport| -> Vec<usize> {
            bytes.fields.iter().map(|field| field.offset).collect()
        };
        places(received) == places(expected)
    });
    let is_same =
        sent.as_ref().map(BytesReport::bytes) == received.as_ref().map(BytesReport::bytes);
    let below = expected.as_ref().filter(|_| fits);
    EvidenceView {
        call: call.clone(),
        result: result.clone(),
        sent: sent.as_ref().filter(|_| !is_same).map(|bytes| view(bytes, None)),
        received: received.as_ref().map(|bytes| view(bytes, below)),
        expected: expected.as_ref().filter(|_| !fits).map(|bytes| view(bytes, None)),
        frame_sent: frame_sent.clone(),
        frame_received: frame_received.clone(),
    }
}

fn view(bytes: &BytesReport, expected: Option<&BytesReport>) -> BytesView {
    let instead = |field: &FieldReport| {
        let fields = expected.map(|expected| expected.fields.as_slice()).unwrap_or_default();
        let mut there = fields.iter().filter(|one| one.offset == field.offset);
        there.find(|one| !one.differs.is_empty() || !field.differs.is_empty())
    };
    let row_of = |shown| match shown {
        Shown::More(more) => RowView { more, ..RowView::default() },
        Shown::Field(field) => {
            RowView { instead: instead(field).map(|one| Box::new(row(one))), ..row(field) }
        }
    };
    BytesView {
        stream: bytes.stream.clone(),
        length: bytes.length,
        rows: bytes.shown().into_iter().map(row_of).collect(),
        faults: bytes.faults.clone(),
    }
}

/// Zeros at the end of a field that are shown.
const ZEROS: usize = 8;

fn row(field: &FieldReport) -> RowView {
    let bytes: Vec<u8> = field.bytes().collect();
    let used = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last.saturating_add(1));
    let marked = field.differs.iter().max().map_or(0, |last| last.saturating_add(1));
    let shown = used.max(marked).saturating_add(ZEROS);
    RowView {
        more: 0,
        offset: field.offset,
        zeros: bytes.len().saturating_sub(shown),
        bytes: bytes
            .iter()
            .take(shown)
            .enumerate()
            .map(|(place, &byte)| ByteView {
                hex: format!("{byte:02x}"),
                character: character(byte),
                differs: field.differs.contains(&place),
            })
            .collect(),
        field: field.field.clone(),
        value: field.value.clone(),
        meaning: field.meaning.clone(),
        differs: !field.differs.is_empty(),
        instead: None,
    }
}
