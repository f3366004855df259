//! Builds the report from the outcomes of a run.

use std::collections::BTreeMap;
use std::time::Duration;

use ads_cnc_vectors::{Level, Requirement, requirement, requirements};

use super::display::NAMES_MAX;
use super::document::{
    AreaReport, CaseReport, EvidenceReport, FORMAT, FailureReport, ProfileReport, Report,
    RequirementReport, SubjectReport, TargetReport, Totals, tally,
};
use super::failures::{differing_field, list};
use super::{BytesReport, FoundReport};

use crate::edition::Edition;
use crate::evidence::Evidence;
use crate::exit::Exit;
use crate::explain;
use crate::judge::{
    CLIENT, CaseOutcome, CaseSubject, Judgement, SkippedCase, TESTEE, UnrestoredValue, Verdict,
    VerdictTally, WaiverReport, WaiverState, Waivers, names,
};
use crate::profile::Profile;
use crate::text::{Moment, hex};

/// The parameters of a run, and its results except the outcomes of the cases.
#[derive(Clone, Debug)]
pub struct RunInfo {
    /// The time at which the run began.
    pub time: Moment,
    /// The edition by which the run judges; `None` for both.
    pub edition: Option<Edition>,
    /// The seed of the order of the cases and of the samples of long lists; 0 for a capture.
    pub seed: u32,
    /// The selection (--only); empty if all cases were selected.
    pub only: Vec<String>,
    pub target: TargetReport,
    /// For a capture: its content, and the parts that were not judged.
    pub traffic: Vec<String>,
    /// For a capture: its first exchanges.
    pub exchanges: Vec<String>,
    pub profile: Option<Profile>,
    /// The result of the queries before the cases.
    pub found: Option<FoundReport>,
    /// The waivers for the run.
    pub waivers: Waivers,
    pub frames: usize,
    /// The command that repeats the run, without `--only`, `--seed`, `--waivers` and the options
    /// that write files or affect only the output; `None` for a capture.
    pub again: Option<String>,
    /// The measured durations of the cases, by subject.
    pub times: Vec<(CaseSubject, Duration)>,
    /// Values that were changed and not restored.
    pub left_changed: Vec<UnrestoredValue>,
    /// The reason why cases were not run, if the target stopped answering or `--max-fail` ended
    /// the run.
    pub ended: Option<String>,
}

impl Report {
    /// Builds the report of a run.
    pub fn new(about: RunInfo, outcomes: &[CaseOutcome], left_out: &[SkippedCase]) -> Self {
        let RunInfo {
            time,
            edition,
            seed,
            only,
            target,
            traffic,
            exchanges,
            profile,
            found,
            waivers,
            frames,
            again,
            times,
            left_changed,
            ended,
        } = about;
        let waivers = waivers.apply(outcomes, left_out, time);
        let cases: Vec<CaseReport> =
            outcomes.iter().map(|outcome| case(outcome, &waivers)).collect();
        let mut tally = VerdictTally::default();
        for one in cases.iter().flat_map(|case| &case.requirements) {
            // A pass of the protocol with a testee or client judges no requirement of the
            // catalogue.
            if one.verdict != Verdict::Pass || requirement(&one.requirement).is_some() {
                tally.add(one.verdict, one.waived);
            }
        }
        // A device was not judged completely if the gate rejected requests.
        tally.rejected = outcomes.iter().any(|outcome| outcome.rejected);
        if ended.is_some() {
            // The cases after the end are not judged.
            tally.add(Verdict::Interrupted, false);
        }
        tally.left_changed = !left_changed.is_empty();
        tally.stale = waivers.iter().any(|waiver| waiver.state.is_stale());
        let is_whole = |left: &&SkippedCase| !outcomes.iter().any(|one| one.case.id == left.id);
        let subjects: Vec<SubjectReport> = CaseSubject::ALL
            .into_iter()
            .filter_map(|subject| {
                let mine: Vec<_> = cases.iter().filter(|case| case.subject == subject).collect();
                let time = times.iter().find(|(one, _)| *one == subject);
                let milliseconds = time.map(|(_, time)| milliseconds(*time));
                (!mine.is_empty())
                    .then(|| SubjectReport { milliseconds, ..of_subject(subject, &mine, &only) })
            })
            .collect();
        Self {
            format: FORMAT,
            left_changed,
            rejected: rejected(outcomes),
            written: Vec::new(),
            suite: env!("CARGO_PKG_VERSION").to_owned(),
            vectors: ads_cnc_vectors::VERSION.to_owned(),
            time: time.to_string(),
            editions: edition
                .map_or(Edition::ALL.map(Edition::name).to_vec(), |one| vec![one.name()]),
            seed,
            only,
            target,
            traffic,
            exchanges,
            profile: profile.as_ref().map(ProfileReport::from),
            found,
            waivers,
            again,
            exit_code: tally.exit().code(),
            checks: outcomes.iter().map(|outcome| outcome.checks).sum(),
            frames,
            ended,
            left_out: left_out.iter().filter(is_whole).count(),
            subjects,
            cases,
        }
        .escaped()
    }

    /// Adds the rejected entries of the file of `--allow-write`, and the names of written values. A
    /// rejected entry prevents success, because a requested write was not tried.
    #[must_use]
    pub fn with_writes(mut self, rejected: Vec<String>, written: Vec<String>) -> Self {
        let decided = [Exit::Internal, Exit::UnrestoredValue, Exit::Usage].contains(&self.exit());
        if !rejected.is_empty() && !decided {
            self.exit_code = Exit::NotPermitted.code();
        }
        self.rejected.splice(0..0, rejected);
        self.written = written;
        self.escaped()
    }
}

/// The reasons why the gate rejected requests, each once, after the IDs of the first of its cases.
fn rejected(outcomes: &[CaseOutcome]) -> Vec<String> {
    let mut cases: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for outcome in outcomes.iter().filter(|outcome| outcome.rejected) {
        let why = outcome.note.as_deref().unwrap_or_default();
        cases.entry(why).or_default().push(&outcome.case.id);
    }
    let line = |(why, mut cases): (&str, Vec<&str>)| {
        cases.sort_unstable();
        format!("{}: {why}", list(cases, NAMES_MAX))
    };
    cases.into_iter().map(line).collect()
}

impl From<&Profile> for ProfileReport {
    fn from(profile: &Profile) -> Self {
        let claims = match serde_json::to_value(profile) {
            Ok(serde_json::Value::Object(claims)) => claims,
            _ => serde_json::Map::new(),
        };
        let claims = claims.into_iter().filter(|(name, _)| name != "name").collect();
        Self { name: profile.name.to_string(), claims }
    }
}

fn of_subject(subject: CaseSubject, cases: &[&CaseReport], only: &[String]) -> SubjectReport {
    let mut areas: Vec<AreaReport> = Vec::new();
    for requirement in requirements() {
        if areas.last().is_none_or(|last| last.area != requirement.area) {
            let (area, totals) = (requirement.area.clone(), Totals::new());
            areas.push(AreaReport { area, totals, requirements: Vec::new() });
        }
        if let Some(last) = areas.last_mut() {
            last.requirements.push(of_requirement(&requirement.id, cases, only));
        }
    }
    // The protocols are not in the catalogue, but their failures must be counted.
    for protocol in [TESTEE, CLIENT] {
        let all = cases.iter().flat_map(|case| &case.requirements);
        if all.into_iter().any(|one| one.requirement == protocol) {
            let (area, totals) = (protocol.to_owned(), Totals::new());
            let requirements = vec![of_requirement(protocol, cases, only)];
            areas.push(AreaReport { area, totals, requirements });
        }
    }
    for area in &mut areas {
        area.totals = totals(&area.requirements);
    }
    let all: Vec<_> = areas.iter().flat_map(|area| &area.requirements).cloned().collect();
    let waived = all.iter().filter(|one| one.waived).count();
    SubjectReport { subject, totals: totals(&all), waived, milliseconds: None, areas }
}

fn totals(requirements: &[RequirementReport]) -> Totals {
    tally(requirements.iter().map(|one| one.verdict))
}

/// The verdict on a requirement over all these cases. If no case has the requirement, the verdict
/// is "not observed", or "not run" if there are words in `only` and none of them names the
/// requirement.
fn of_requirement(id: &str, cases: &[&CaseReport], only: &[String]) -> RequirementReport {
    let all = cases.iter().flat_map(|case| &case.requirements);
    let mine: Vec<_> = all.filter(|one| one.requirement == id).collect();
    let wished = only.is_empty() || only.iter().any(|word| names(word, id));
    let (verdict, waived) = together(mine.iter().map(|one| (one.verdict, one.waived)))
        .unwrap_or((if wished { Verdict::NotObserved } else { Verdict::NotRun }, false));
    RequirementReport { requirement: id.to_owned(), verdict, waived }
}

/// The verdict of a group, and whether it is waived: a verdict that fails the run, otherwise a
/// warning or a difference, preferably one that is not waived; without these, the most severe
/// verdict.
fn together(verdicts: impl Iterator<Item = (Verdict, bool)>) -> Option<(Verdict, bool)> {
    verdicts.max_by_key(|(verdict, waived)| {
        let is_open = verdict.is_waivable() && !waived;
        (verdict.fails_run() && !waived, verdict.fails_run(), is_open, verdict.severity())
    })
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}

fn case(outcome: &CaseOutcome, waivers: &[WaiverReport]) -> CaseReport {
    let case = &outcome.case;
    let waived = |requirement: &str| {
        waivers.iter().any(|waiver| {
            waiver.state == WaiverState::Used
                && waiver.test == case.id
                && waiver.requirement == requirement
        })
    };
    let requirements: Vec<RequirementReport> = outcome
        .verdicts
        .iter()
        .map(|one| RequirementReport {
            requirement: one.requirement.to_owned(),
            verdict: one.verdict,
            waived: waived(one.requirement),
        })
        .collect();
    let (verdict, is_waived) = together(requirements.iter().map(|one| (one.verdict, one.waived)))
        .unwrap_or((Verdict::NotObserved, false));
    let failures = outcome.verdicts.iter().zip(&requirements).flat_map(|(one, requirement)| {
        one.judgements.iter().map(|judgement| failure(judgement, requirement.waived))
    });
    CaseReport {
        id: case.id.clone(),
        title: case.title.clone(),
        subject: case.subject,
        stream: case.stream().map(str::to_owned),
        verdict,
        waived: is_waived,
        requirements: requirements.clone(),
        checks: outcome.checks,
        milliseconds: outcome.time.map(milliseconds),
        note: outcome.note.clone(),
        failures: failures.collect(),
    }
}

fn failure(judgement: &Judgement, waived: bool) -> FailureReport {
    let clause = requirement(judgement.requirement);
    // An ID outside the catalogue belongs to a protocol.
    let protocol = match judgement.requirement {
        CLIENT => ("The protocol between the suite and a client.", "CLIENTS.md"),
        _ => ("The protocol between the suite and a testee.", "README.md"),
    };
    FailureReport {
        requirement: judgement.requirement.to_owned(),
        level: judgement.level,
        clause: match clause {
            Some(clause) => text(clause, judgement.level),
            None => protocol.0.to_owned(),
        },
        sources: match clause {
            Some(clause) => sources(clause, judgement.level),
            None => vec![format!("conformance/adapters/{}", protocol.1)],
        },
        verdict: judgement.verdict,
        waived,
        expected: judgement.expected.clone(),
        found: judgement.found.clone(),
        more: judgement.more,
        follows: judgement.follows.map(str::to_owned),
        evidence: judgement.evidence.as_ref().map(|evidence| marked(evidence.into(), judgement)),
    }
}

/// Marks the bytes of the field that made a check fail, if the expected bytes are unknown.
fn marked(mut evidence: EvidenceReport, judgement: &Judgement) -> EvidenceReport {
    let EvidenceReport { sent, received, expected, .. } = &mut evidence;
    if expected.is_some() || judgement.verdict != Verdict::Fail {
        return evidence;
    }
    if let Some(path) = differing_field(&judgement.found)
        && let Some(bytes) = received.as_mut().or(sent.as_mut())
    {
        bytes.mark_field(path);
    } else if let Some(received) = received {
        received.mark_clause(judgement.requirement);
    }
    evidence
}

impl From<&Evidence> for EvidenceReport {
    fn from(evidence: &Evidence) -> Self {
        let Evidence { request_stream, reply_stream, sent, received, expected, values, .. } =
            evidence;
        let reply = |bytes: &[u8], other: Option<&[u8]>| {
            BytesReport::new(*reply_stream, bytes, other, values)
        };
        let (received, expected) = (received.as_deref(), expected.as_deref());
        Self {
            call: evidence.call.clone(),
            subject: evidence.subject.clone(),
            result: evidence.result.clone(),
            sent: (!sent.is_empty()).then(|| BytesReport::new(*request_stream, sent, None, values)),
            received: received.map(|bytes| reply(bytes, expected)),
            expected: expected.map(|bytes| reply(bytes, received)),
            frame_sent: hex::spaced(&evidence.frame_sent),
            frame_received: hex::spaced(&evidence.frame_received),
        }
    }
}

/// The texts of the parts of a requirement with this level, after the text of the requirement
/// itself if the requirement has this level or no part has it.
fn text(requirement: &Requirement, level: Option<Level>) -> String {
    let parts = requirement.parts.iter().filter(|part| Some(part.level) == level);
    let parts = parts.map(|part| part.text.as_str());
    let whole = requirement.text.as_str();
    let is_whole = level == Some(requirement.level) || parts.clone().next().is_none();
    is_whole.then_some(whole).into_iter().chain(parts).collect::<Vec<_>>().join(" ")
}

/// The sources of a requirement; empty for the level *info*, because such a part is assumed.
fn sources(requirement: &Requirement, level: Option<Level>) -> Vec<String> {
    if level == Some(Level::Info) { Vec::new() } else { explain::sources(&requirement.id) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::RequirementVerdict;

    /// A waived verdict does not hide an unwaived verdict that fails the run, even if a third
    /// verdict is more severe than the unwaived one.
    #[test]
    fn a_verdict_that_fails_the_run_is_shown() {
        let verdicts =
            [(Verdict::Warning, false), (Verdict::Inconclusive, false), (Verdict::Fail, true)];
        assert_eq!(together(verdicts.into_iter()), Some((Verdict::Inconclusive, false)));
        let known = [(Verdict::Warning, false), (Verdict::Fail, true)];
        assert_eq!(together(known.into_iter()), Some((Verdict::Fail, true)));
        for open in [Verdict::Warning, Verdict::Differs] {
            let deviating = [(Verdict::Pass, false), (open, false), (Verdict::Warning, true)];
            assert_eq!(together(deviating.into_iter()), Some((open, false)));
        }
        let passed = [(Verdict::Warning, true), (Verdict::Pass, false)];
        assert_eq!(together(passed.into_iter()), Some((Verdict::Warning, true)));
    }

    /// A testee that follows the protocol, but claims no requirement, has not passed.
    #[test]
    fn a_correct_protocol_alone_judges_nothing() {
        let outcome = |requirement, verdict| {
            let case = crate::suite::cases().swap_remove(0);
            let judged = RequirementVerdict { requirement, verdict, judgements: Vec::new() };
            CaseOutcome {
                case,
                verdicts: vec![judged],
                checks: 1,
                note: None,
                rejected: false,
                time: None,
            }
        };
        let exit = |verdicts: &[(&'static str, Verdict)]| {
            let about = RunInfo {
                time: Moment::now(),
                edition: None,
                seed: 1,
                only: Vec::new(),
                target: TargetReport::default(),
                traffic: Vec::new(),
                exchanges: Vec::new(),
                profile: None,
                found: None,
                waivers: Waivers::default(),
                frames: 0,
                again: None,
                times: Vec::new(),
                left_changed: Vec::new(),
                ended: None,
            };
            let all: Vec<CaseOutcome> =
                verdicts.iter().map(|(id, one)| outcome(*id, *one)).collect();
            Report::new(about, &all, &[]).exit_code
        };
        let unclaimed = ("VAR-11", Verdict::NotApplicable);
        for protocol in ["TESTEE", "CLIENT"] {
            assert_eq!(exit(&[unclaimed, (protocol, Verdict::Pass)]), 3, "{protocol}");
            assert_eq!(exit(&[unclaimed, (protocol, Verdict::Fail)]), 1, "{protocol}");
            assert_eq!(exit(&[("VAR-11", Verdict::Pass), (protocol, Verdict::Pass)]), 0);
        }
    }
}
