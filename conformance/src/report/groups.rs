//! Groups the checks that did not pass by their causes.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use ads_cnc::layout::Stream;
use ads_cnc_vectors::{sequence, vector};

use super::document::{CaseReport, FailureReport, Report, tally};
use crate::judge::{CLIENT, CaseSubject, TESTEE, Verdict, clauses_of};

/// Checks with the same verdict that did not pass for the same clause, in the same field of vectors
/// of one stream, or because the testee ended or did not answer.
#[derive(Debug)]
pub(super) struct Group<'r> {
    pub(super) verdict: Verdict,
    pub(super) waived: bool,
    /// The clauses, the clause with most checks first.
    pub(super) requirements: Vec<&'r str>,
    /// The case and one failure of each check.
    checks: Vec<(&'r CaseReport, &'r FailureReport)>,
    /// The cases with checks that follow from these failures, each with the clauses of these
    /// checks.
    pub(super) followers: BTreeMap<&'r str, BTreeSet<&'r str>>,
}

impl Report {
    /// The cases, sorted by subject, stream, first requirement and ID, so that the order does not
    /// depend on the seed.
    pub(super) fn sorted(&self) -> Vec<&CaseReport> {
        let position = self.positions();
        let mut all: Vec<&CaseReport> = self.cases.iter().collect();
        all.sort_by_cached_key(|case| {
            let first = case.requirements.first().map(|one| one.requirement.as_str());
            let position = first.and_then(|id| position.get(id).copied()).unwrap_or(usize::MAX);
            (case.subject, case.stream.clone(), position, case.id.clone())
        });
        all
    }

    /// A number for each requirement, which ascends in the order of the catalogue.
    fn positions(&self) -> BTreeMap<&str, usize> {
        let all = self.subjects.iter().flat_map(|one| &one.areas);
        let all = all.flat_map(|area| &area.requirements).enumerate();
        all.map(|(position, one)| (one.requirement.as_str(), position)).collect()
    }
}

/// The groups, sorted by verdict, with the most severe verdict last, and then by [`GroupKey`].
pub(super) fn groups(report: &Report) -> Vec<Group<'_>> {
    let positions = report.positions();
    let position = |id: &str| positions.get(id).copied().unwrap_or(usize::MAX);
    let mut all: BTreeMap<GroupKey<'_>, Group<'_>> = BTreeMap::new();
    let (mut followers, mut vacuous) = (Vec::new(), Vec::new());
    let failed = failed(report);
    for case in report.sorted() {
        for finding in case.findings() {
            let Some(first) = finding.first() else { continue };
            if let Some(cause) = &first.follows {
                followers.extend(finding.iter().map(|one| (cause.as_str(), *one, case)));
                continue;
            }
            // The verdict is vacuous because the valid sibling fails, too: the check follows from
            // the failure of the sibling.
            if first.verdict == Verdict::Vacuous
                && let Some(cause) = sibling(case).filter(|id| failed.contains(id.as_str()))
            {
                vacuous.extend(finding.iter().map(|one| (cause.clone(), *one, case)));
                continue;
            }
            // If a testee ends or does not answer, the failures of all streams probably have one
            // cause, so put them into one group.
            let stream = case.stream.as_deref();
            let lost =
                stream.and_then(|_| LOST.into_iter().find(|kind| first.found.starts_with(kind)));
            let stream = stream.filter(|_| lost.is_none());
            let key = GroupKey {
                severity: first.verdict.severity(),
                waived: !first.waived,
                subject: case.subject,
                position: match (lost, stream) {
                    (Some(_), _) => usize::MAX,
                    (None, Some(_)) => 0,
                    (None, None) => position(&first.requirement),
                },
                stream,
                field: lost.or_else(|| stream.map(|_| field(first))),
            };
            let group = all.entry(key).or_insert_with(|| Group {
                verdict: first.verdict,
                waived: first.waived,
                requirements: Vec::new(),
                checks: Vec::new(),
                followers: BTreeMap::new(),
            });
            group.requirements.extend(finding.iter().map(|one| one.requirement.as_str()));
            group.checks.push((case, *first));
        }
    }
    let mut all: Vec<Group<'_>> = all.into_values().collect();
    for group in &mut all {
        let numbers = tally(group.requirements.iter().copied());
        let mut sorted: Vec<(&str, usize)> = numbers.into_iter().collect();
        sorted.sort_by_key(|(clause, number)| (std::cmp::Reverse(*number), position(clause)));
        group.requirements = sorted.into_iter().map(|(clause, _)| clause).collect();
    }
    // The index of the first failed group of each clause of a subject, and of each case. Waived groups
    // come last; a waiver for a cause does not accept the checks that follow from it.
    let (mut of_clause, mut of_case) = (HashMap::new(), HashMap::new());
    let failed = all.iter().enumerate().filter(|(_, group)| group.verdict.is_failure());
    let (waived, open): (Vec<_>, Vec<_>) = failed.partition(|(_, group)| group.waived);
    for (index, group) in open.into_iter().chain(waived) {
        for clause in &group.requirements {
            of_clause.entry((group.subject(), *clause)).or_insert(index);
        }
        for case in group.cases() {
            of_case.entry(case).or_insert(index);
        }
    }
    for (cause, failure, case) in followers {
        if let Some(&index) = of_clause.get(&(Some(case.subject), cause)) {
            all[index].add_follower(case, failure);
        }
    }
    for (sibling, failure, case) in vacuous {
        if let Some(&index) = of_case.get(sibling.as_str()) {
            all[index].add_follower(case, failure);
        }
    }
    all
}

/// The IDs of the cases with a failed check that is not waived.
fn failed(report: &Report) -> BTreeSet<&str> {
    let fails = |case: &&CaseReport| {
        case.failures.iter().any(|one| one.verdict == Verdict::Fail && !one.waived)
    };
    report.cases.iter().filter(fails).map(|case| case.id.as_str()).collect()
}

/// The ID of the case of the accepted sibling of a rejected vector or sequence.
fn sibling(case: &CaseReport) -> Option<String> {
    let (kind, id) = case.id.split_once('-')?;
    let sibling = match kind {
        "vec" => vector(id)?.sibling.as_deref(),
        _ => sequence(id)?.sibling.as_deref(),
    };
    sibling.map(|sibling| format!("{kind}-{sibling}"))
}

/// The beginnings of [`FailureReport::found`] for a testee that ended or did not answer.
const LOST: [&str; 2] = ["a crash", "no answer within"];

/// The common properties of the checks in a group. Groups are sorted by these properties.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct GroupKey<'r> {
    severity: u8,
    waived: bool,
    subject: CaseSubject,
    position: usize,
    stream: Option<&'r str>,
    field: Option<&'r str>,
}

/// The name of the first field of the reply with a marked byte; without such a field, the text of
/// the actual result up to its first colon.
fn field(failure: &FailureReport) -> &str {
    let received = failure.evidence.as_ref().and_then(|evidence| evidence.received.as_ref());
    let differs = received.and_then(|bytes| {
        let mut fields = bytes.fields.iter();
        fields.find(|field| !field.differs.is_empty()).map(|field| field.field.as_str())
    });
    let kind = || failure.found.split(':').next().unwrap_or_default();
    differs.unwrap_or_else(kind)
}

/// Whether the clause of the check defines a stream or a field in the data of the request or the
/// reply.
fn is_of_own_stream(failure: &FailureReport) -> bool {
    let evidence = failure.evidence.iter();
    let bytes = evidence.flat_map(|evidence| evidence.sent.iter().chain(&evidence.received));
    let mut streams = bytes.filter_map(|bytes| Stream::by_name(bytes.stream.as_deref()?));
    streams.any(|stream| clauses_of(stream).any(|clause| clause == failure.requirement))
}

impl<'r> Group<'r> {
    fn add_follower(&mut self, case: &'r CaseReport, failure: &'r FailureReport) {
        self.followers.entry(&case.id).or_default().insert(&failure.requirement);
    }

    /// Whether the group is a failure, of the product under test or of the suite, that is not
    /// waived.
    pub(super) const fn is_failure(&self) -> bool {
        self.verdict.is_failure() && !self.waived
    }

    /// Whether the group is about the protocol with a testee or client. If the protocol is
    /// violated, the other groups may be consequences of the violation.
    pub(super) fn is_of_protocol(&self) -> bool {
        self.requirements.iter().any(|id| [TESTEE, CLIENT].contains(id))
    }

    /// The clause with most checks.
    pub(super) fn requirement(&self) -> &'r str {
        self.requirements.first().copied().unwrap_or_default()
    }

    /// The subject of the cases.
    pub(super) fn subject(&self) -> Option<CaseSubject> {
        self.checks.first().map(|(case, _)| case.subject)
    }

    /// The number of checks, including those that were not stored.
    pub(super) fn checks(&self) -> usize {
        self.checks.iter().map(|(_, failure)| failure.more.saturating_add(1)).sum()
    }

    /// The IDs of the cases, each once.
    pub(super) fn cases(&self) -> Vec<&'r str> {
        let mut cases: Vec<&str> = self.checks.iter().map(|(case, _)| case.id.as_str()).collect();
        cases.dedup();
        cases
    }

    /// The check that shows the fault best: preferably a check of the first clause, about a stream
    /// that this clause defines. Of the checks of vectors, the check with the smallest total length
    /// of texts and bytes.
    pub(super) fn example(&self) -> Option<(&'r CaseReport, &'r FailureReport)> {
        let size = |failure: &FailureReport| {
            let evidence = failure.evidence.as_ref();
            let parts = evidence.map(|one| [&one.sent, &one.received].map(Option::as_ref));
            let bytes: usize =
                parts.into_iter().flatten().flatten().map(|bytes| bytes.length).sum();
            failure.expected.len().saturating_add(failure.found.len()).saturating_add(bytes)
        };
        let of_clause = |failure: &FailureReport| failure.requirement == self.requirement();
        let simplest = self.checks.iter().min_by_key(|(case, failure)| {
            let is_vector = case.stream.is_some();
            // Prefer other cases to the cases about all replies: to run such a case again, the
            // suite must also run all query cases.
            let is_of_replies = case.id.starts_with("replies-");
            // Without a vector or sequence, the size is 0: the first check is chosen, which is
            // usually the closest to the cause.
            let size = if is_vector { size(failure) } else { 0 };
            (!of_clause(failure), !is_of_own_stream(failure), is_of_replies, size)
        });
        simplest.copied()
    }
}
