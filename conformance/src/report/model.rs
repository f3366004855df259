//! The report's data.

use std::collections::BTreeMap;

use ads_cnc_vectors::{Level, Requirement, requirement, requirements};
use serde::Serialize;

use crate::profile::Profile;
use crate::suite::{Body, Evidence, Judgement, Outcome, gravest};
use crate::verdict::{Exit, Verdict};

/// A whole run.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Version of this structure.
    pub format: u32,
    /// Version of the suite.
    pub suite: &'static str,
    /// Version of the vectors.
    pub vectors: &'static str,
    /// Who was judged.
    pub target: TargetReport,
    /// What it claims.
    pub profile: Profile,
    /// The exit code this run ends with.
    pub exit_code: u8,
    #[serde(skip)]
    exit: Exit,
    /// Checks made.
    pub checks: usize,
    /// Frames exchanged.
    pub frames: usize,
    /// The codec and the target, each judged for itself.
    pub subjects: Vec<SubjectReport>,
    /// Every case in the order it was run.
    pub cases: Vec<CaseReport>,
}

/// Who was judged.
#[derive(Clone, Debug, Serialize)]
pub struct TargetReport {
    /// What it is.
    pub name: String,
    /// Where it listens.
    pub address: String,
    /// Its AMS NetId.
    pub net_id: String,
}

/// What is said of one who was judged.
#[derive(Debug, Serialize)]
pub struct SubjectReport {
    /// `codec` or `target`.
    pub subject: &'static str,
    /// Verdicts of its requirements, each once and by its gravest.
    pub totals: BTreeMap<&'static str, usize>,
    /// By area.
    pub areas: Vec<AreaReport>,
}

/// One area of requirements.
#[derive(Debug, Serialize)]
pub struct AreaReport {
    /// The area's letters.
    pub area: String,
    /// Verdicts of its requirements, each once and by its gravest.
    pub totals: BTreeMap<&'static str, usize>,
    /// The requirements, in their order.
    pub requirements: Vec<RequirementReport>,
}

/// The verdict on one requirement.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RequirementReport {
    /// The requirement.
    pub requirement: &'static str,
    /// The gravest verdict on it.
    pub verdict: Verdict,
}

/// One case.
#[derive(Debug, Serialize)]
pub struct CaseReport {
    /// The case's slug.
    pub id: String,
    /// What it tries.
    pub title: String,
    /// The gravest of its verdicts.
    pub verdict: Verdict,
    /// The verdict on each of its requirements.
    pub requirements: Vec<RequirementReport>,
    /// Checks made.
    pub checks: usize,
    /// Why it did not run, or not to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Checks that were not passed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<FailureReport>,
    /// Whether the codec was judged, without a target.
    pub codec: bool,
    #[serde(skip)]
    pub(super) outcome: Outcome,
}

/// A check that was not passed.
#[derive(Debug, Serialize)]
pub struct FailureReport {
    /// The requirement.
    pub requirement: &'static str,
    /// The level it was judged at; that of an assumed part may be lower than the whole's.
    pub level: Option<Level>,
    /// What it says, or the parts of that level.
    pub clause: String,
    /// Where it stands: document, edition, section.
    pub sources: Vec<String>,
    /// The verdict.
    pub verdict: Verdict,
    /// What was expected.
    pub expected: String,
    /// What was there.
    pub found: String,
    /// Checks with the same verdict that are not shown.
    pub more: usize,
    /// Where the request went.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub call: Option<String>,
    /// Data of the request in hex.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sent: Option<String>,
    /// Data of the reply in hex.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub received: Option<String>,
    /// The whole frame sent in hex.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_sent: Option<String>,
    /// The whole frame received in hex.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frame_received: Option<String>,
}

impl Report {
    /// Puts the outcomes of a run together.
    pub fn new(
        target: TargetReport,
        profile: Profile,
        frames: usize,
        outcomes: Vec<Outcome>,
    ) -> Self {
        let exit = Exit::of(
            outcomes
                .iter()
                .flat_map(|outcome| outcome.verdicts.iter().map(|judged| judged.verdict)),
        );
        // The embedded CNC refuses nothing; a device for which the gate closed was not judged whole.
        let refused = outcomes.iter().any(|outcome| outcome.refused);
        let exit = if refused && exit != Exit::Internal { Exit::Refused } else { exit };
        let judged = |codec: bool| {
            let mine = outcomes.iter().filter(move |one| is_codec(one) == codec);
            mine.collect::<Vec<_>>()
        };
        let subjects = [("codec", judged(true)), ("target", judged(false))];
        let subjects = subjects.into_iter().filter(|(_, outcomes)| !outcomes.is_empty());
        let subjects = subjects.map(|(name, outcomes)| SubjectReport::new(name, &outcomes));
        let subjects = subjects.collect();
        Self {
            format: 1,
            suite: env!("CARGO_PKG_VERSION"),
            vectors: ads_cnc_vectors::VERSION,
            target,
            profile,
            exit_code: exit.code(),
            exit,
            checks: outcomes.iter().map(|outcome| outcome.checks).sum(),
            frames,
            subjects,
            cases: outcomes.into_iter().map(CaseReport::new).collect(),
        }
    }

    /// How the process ends.
    pub const fn exit(&self) -> Exit {
        self.exit
    }
}

impl SubjectReport {
    fn new(subject: &'static str, outcomes: &[&Outcome]) -> Self {
        let verdicts = by_requirement(outcomes);
        let mut areas: Vec<AreaReport> = Vec::new();
        for (id, verdict) in &verdicts {
            let area = id.split('-').next().unwrap_or_default();
            if areas.last().is_none_or(|last| last.area != area) {
                areas.push(AreaReport {
                    area: area.to_owned(),
                    totals: BTreeMap::new(),
                    requirements: Vec::new(),
                });
            }
            if let Some(last) = areas.last_mut() {
                last.requirements.push(RequirementReport { requirement: id, verdict: *verdict });
            }
        }
        for area in &mut areas {
            area.totals = totals(area.requirements.iter().map(|one| one.verdict));
        }
        let totals = totals(verdicts.iter().map(|(_, verdict)| *verdict));
        Self { subject, totals, areas }
    }
}

fn is_codec(outcome: &Outcome) -> bool {
    matches!(outcome.case.body, Body::Vector(_))
}

fn totals(verdicts: impl Iterator<Item = Verdict>) -> BTreeMap<&'static str, usize> {
    let mut totals = BTreeMap::new();
    for verdict in verdicts {
        let number: &mut usize = totals.entry(verdict.name()).or_default();
        *number = number.saturating_add(1);
    }
    totals
}

/// Each requirement once, in the catalogue's order; those no case touches are not observed.
fn by_requirement(outcomes: &[&Outcome]) -> Vec<(&'static str, Verdict)> {
    let verdict = |requirement: &Requirement| {
        let judged = outcomes.iter().flat_map(|outcome| &outcome.verdicts);
        let mine = judged.filter(|judged| judged.requirement == requirement.id);
        gravest(mine.map(|judged| judged.verdict)).unwrap_or(Verdict::NotObserved)
    };
    requirements()
        .iter()
        .map(|requirement| (requirement.id.as_str(), verdict(requirement)))
        .collect()
}

impl CaseReport {
    fn new(outcome: Outcome) -> Self {
        let verdicts = &outcome.verdicts;
        Self {
            id: outcome.case.id.clone(),
            title: outcome.case.title.clone(),
            verdict: outcome.verdict(),
            requirements: verdicts
                .iter()
                .map(|one| RequirementReport { requirement: one.requirement, verdict: one.verdict })
                .collect(),
            checks: outcome.checks,
            note: outcome.note.clone(),
            failures: verdicts
                .iter()
                .flat_map(|judged| &judged.judgements)
                .map(FailureReport::new)
                .collect(),
            codec: is_codec(&outcome),
            outcome,
        }
    }

    /// The stream of a case of the codec.
    pub(super) fn stream(&self) -> Option<&'static str> {
        match self.outcome.case.body {
            Body::Vector(vector) => Some(vector.stream.as_str()),
            _ => None,
        }
    }

    /// The bytes behind the case's failed checks.
    pub(super) fn judgements(&self) -> impl Iterator<Item = &Judgement> {
        self.outcome.verdicts.iter().flat_map(|judged| &judged.judgements)
    }
}

impl FailureReport {
    fn new(judgement: &Judgement) -> Self {
        let clause = requirement(judgement.requirement);
        let evidence = judgement.evidence.as_ref();
        let hex = |bytes: fn(&Evidence) -> &[u8]| {
            evidence.map(bytes).filter(|bytes| !bytes.is_empty()).map(super::hex::plain)
        };
        Self {
            requirement: judgement.requirement,
            level: judgement.level,
            clause: clause.map(|clause| text(clause, judgement.level)).unwrap_or_default(),
            sources: clause.map(|clause| sources(clause, judgement.level)).unwrap_or_default(),
            verdict: judgement.verdict,
            expected: judgement.expected.clone(),
            found: judgement.found.clone(),
            more: judgement.more,
            call: evidence.map(|evidence| evidence.call.clone()),
            sent: hex(|evidence| &evidence.sent),
            received: hex(|evidence| evidence.received.as_deref().unwrap_or_default()),
            frame_sent: hex(|evidence| &evidence.frame_sent),
            frame_received: hex(|evidence| &evidence.frame_received),
        }
    }
}

/// What a requirement says at a level: the whole of it, or its parts of that level.
fn text(requirement: &Requirement, level: Option<Level>) -> String {
    let parts = requirement.parts.iter().filter(|part| Some(part.level) == level);
    let parts: Vec<&str> = parts.map(|part| part.text.as_str()).collect();
    match level == Some(requirement.level) || parts.is_empty() {
        true => requirement.text.clone(),
        false => parts.join(" "),
    }
}

/// Where a requirement stands; an assumed part of it stands nowhere.
fn sources(requirement: &Requirement, level: Option<Level>) -> Vec<String> {
    if level == Some(Level::Info) {
        return Vec::new();
    }
    let sources = requirement.sources.iter().map(|source| match source.edition.as_str() {
        "" => format!("{}, {}", source.document, source.section),
        edition => format!("{} {edition} §{}", source.document, source.section),
    });
    sources.collect()
}
