//! The data of a report, which can be written to JSON and read back. The other formats use no other
//! data of the run.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::Hash;

use ads_cnc_vectors::Level;
use ads_cnc_vectors::ids::ADS_5;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{BytesReport, DeviceReport, FoundReport};
use crate::exit::Exit;
use crate::judge::{CaseSubject, UnrestoredValue, Verdict, WaiverReport};
use crate::text::hex::compact;
use crate::text::{escape, json_error};

/// Version of the format.
pub const FORMAT: u32 = 1;

/// The number of occurrences of each verdict.
pub type Totals = BTreeMap<Verdict, usize>;

/// The number of occurrences of each key.
pub(super) fn tally<K: Ord>(keys: impl Iterator<Item = K>) -> BTreeMap<K, usize> {
    let mut numbers = BTreeMap::new();
    for key in keys {
        *numbers.entry(key).or_default() += 1;
    }
    numbers
}

/// The report of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of the format: [`FORMAT`].
    pub format: u32,
    /// Values that were changed and not restored.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_changed: Vec<UnrestoredValue>,
    /// Requests and entries that were rejected for safety, with the reasons.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rejected: Vec<String>,
    /// Names of the values that the run wrote or tried to write; those that are not in
    /// `left_changed` were restored, or change by themselves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub written: Vec<String>,
    /// The version of the suite.
    pub suite: String,
    /// The version of the vectors.
    pub vectors: String,
    /// The time at which the run began, in UTC and in the format of RFC 3339.
    pub time: String,
    /// Editions of the manual by which the run judged.
    pub editions: Vec<String>,
    /// The seed of the order of the cases and of the samples of long lists; 0 for a capture.
    pub seed: u32,
    /// The selection (--only); empty if all cases were selected.
    pub only: Vec<String>,
    pub target: TargetReport,
    /// For a capture: its content, and the parts that were not judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub traffic: Vec<String>,
    /// For a capture: its first exchanges, each a line with packet, function or address, and
    /// result.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub exchanges: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileReport>,
    /// The result of the queries before the cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<FoundReport>,
    /// Waivers and their states.
    pub waivers: Vec<WaiverReport>,
    /// The command that repeats the run, without `--only`, `--seed`, `--waivers` and the options
    /// that write files or affect only the output; `None` for a capture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub again: Option<String>,
    /// The exit code of the run.
    pub exit_code: u8,
    pub checks: usize,
    pub frames: usize,
    /// The reason why cases were not run, if the target stopped answering or `--max-fail` ended
    /// the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ended: Option<String>,
    /// Number of cases that were not selected; they are not in `cases`.
    pub left_out: usize,
    /// The judged subjects, each with the verdicts on all requirements.
    pub subjects: Vec<SubjectReport>,
    /// The selected cases, for a run in an order that the seed determines, and then the cases of
    /// the other edition.
    pub cases: Vec<CaseReport>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetReport {
    pub name: String,
    /// The version that the target reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// The programming language that the target reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<String>,
    /// The command that started the target.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// The TCP address.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub address: Option<String>,
    /// The AMS NetId.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub net_id: Option<String>,
    /// The device information of the COM task, if available.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<DeviceReport>,
    /// The end of the output on stderr, which is not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stderr: Option<String>,
    /// The path of the captured file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// The claims of a target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileReport {
    pub name: String,
    /// Claims by name.
    pub claims: BTreeMap<String, Value>,
}

/// A subject that was judged, and the verdicts on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SubjectReport {
    pub subject: CaseSubject,
    /// Number of requirements with each verdict.
    pub totals: Totals,
    /// Number of waived requirements.
    pub waived: usize,
    /// Duration of the cases, if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub milliseconds: Option<u64>,
    /// The requirements by area.
    pub areas: Vec<AreaReport>,
}

/// One area of requirements, or the protocol with a testee or a client.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AreaReport {
    /// The letters of the area; `TESTEE` or `CLIENT` for a protocol.
    pub area: String,
    /// Number of requirements with each verdict.
    pub totals: Totals,
    pub requirements: Vec<RequirementReport>,
}

/// The verdict on one requirement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequirementReport {
    pub requirement: String,
    /// In an area: the most severe verdict that fails the run and is not waived; without such a
    /// verdict, the most severe waived verdict; without a waived verdict, the most severe verdict.
    /// In a case: the most severe verdict of the checks; the end of the case determines the verdict
    /// without checks, and if all checks passed but the case did not end normally.
    pub verdict: Verdict,
    /// Whether the verdict is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseReport {
    /// The ID of the case.
    pub id: String,
    pub title: String,
    pub subject: CaseSubject,
    /// The stream of the vector, or the kind of the sequence, with which the case tests a codec;
    /// `None` for other cases.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    /// The verdict of the case, chosen as for [`RequirementReport::verdict`].
    pub verdict: Verdict,
    /// Whether that verdict is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    /// The verdict on each requirement of the case.
    pub requirements: Vec<RequirementReport>,
    pub checks: usize,
    /// Duration of the case, if measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub milliseconds: Option<u64>,
    /// The reason why the case was not run or not completed, or another note about the case.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The stored checks that did not pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<FailureReport>,
}

/// A check that did not pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FailureReport {
    pub requirement: String,
    /// The level of the check: for a part of the requirement, it can differ from the level of the
    /// requirement, and for a rule of a protocol it is must.
    pub level: Option<Level>,
    /// The text of the requirement, or of its parts of this level; for a protocol, a fixed
    /// sentence.
    pub clause: String,
    /// The sources of the clause: document, edition, section; for a protocol, the file that
    /// specifies the protocol.
    pub sources: Vec<String>,
    pub verdict: Verdict,
    /// Whether the verdict is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    pub expected: String,
    pub found: String,
    /// Number of other checks of the requirement in the same case with the same verdict and the
    /// same other clauses, which are not stored.
    pub more: usize,
    /// The clause whose failure explains this check, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub follows: Option<String>,
    /// The bytes on which the check is based.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<EvidenceReport>,
}

/// The bytes on which a check is based.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceReport {
    /// The request in words, for example its service and address.
    pub call: String,
    /// The variable or object that the exchange is about, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The result in a few words.
    pub result: String,
    /// Data of the request, or bytes that are not a request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sent: Option<BytesReport>,
    /// Data of the reply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub received: Option<BytesReport>,
    /// Expected data of the reply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<BytesReport>,
    /// The sent frame, in hex; at most its first 4096 bytes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub frame_sent: String,
    /// The received frame, or the part of it that arrived, in hex; at most the first 4096 bytes.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub frame_received: String,
}

impl Report {
    /// The exit code of the run.
    pub fn exit(&self) -> Exit {
        Exit::from_code(self.exit_code).unwrap_or(Exit::Internal)
    }

    /// Parses a report.
    ///
    /// # Errors
    /// A text that is not a report in JSON, or a report of another format version.
    pub fn from_json(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct FormatNumber {
            format: u32,
        }
        let FormatNumber { format } =
            serde_json::from_str(text).map_err(|error| in_file(text, &error))?;
        if format != FORMAT {
            return Err(format!("report format {format} instead of {FORMAT}"));
        }
        let report: Self = serde_json::from_str(text).map_err(|error| in_file(text, &error))?;
        report.check_subjects()?;
        Ok(report.escaped())
    }

    /// Checks that each subject occurs once, and each requirement once in a subject, because most
    /// formats list the cases of each of them.
    fn check_subjects(&self) -> Result<(), String> {
        let (mut subjects, mut requirements) = (HashSet::new(), HashSet::new());
        for SubjectReport { subject, areas, .. } in &self.subjects {
            if !subjects.insert(subject) {
                return Err(format!("subjects contains {subject} twice"));
            }
            for one in areas.iter().flat_map(|area| &area.requirements) {
                if !requirements.insert((subject, &one.requirement)) {
                    let id = escape(&one.requirement);
                    return Err(format!("the subject {subject} contains {id} twice"));
                }
            }
        }
        Ok(())
    }
}

/// The error in a report, with its position.
fn in_file(text: &str, error: &serde_json::Error) -> String {
    let words = json_error(text, error);
    match error.is_data() {
        true => format!("line {}, column {}: {words}", error.line(), error.column()),
        false => words,
    }
}

impl FailureReport {
    /// Whether the check is about the frames: it judges the headers (ADS-5), or the received bytes
    /// cannot be parsed as a frame of a service.
    pub(super) fn is_of_frames(&self) -> bool {
        let has_faults = |one: &EvidenceReport| {
            let [_, received] = one.frames();
            received.iter().any(|part| !part.faults.is_empty())
        };
        self.evidence
            .as_ref()
            .is_some_and(|one| self.requirement == ADS_5.as_str() || has_faults(one))
    }
}

impl EvidenceReport {
    /// The frames of the request and the reply, each as its headers and the fields of the service.
    pub(super) fn frames(&self) -> [Vec<BytesReport>; 2] {
        let bytes = |hex: &str| compact::parse(hex).unwrap_or_default();
        let (sent, received) = (bytes(&self.frame_sent), bytes(&self.frame_received));
        [BytesReport::of_frame(&sent, None), BytesReport::of_frame(&received, Some(&sent))]
    }
}

impl CaseReport {
    /// The failures, grouped by check, because one check may judge several requirements. Failures
    /// with the same texts, evidence, verdict, waiver and cause belong to the same check.
    pub(super) fn findings(&self) -> Vec<Vec<&FailureReport>> {
        fn check(one: &FailureReport) -> impl Eq + Hash + '_ {
            let seen = (&one.expected, &one.found, &one.evidence);
            (seen, one.verdict, one.waived, &one.follows)
        }
        let mut findings: Vec<Vec<&FailureReport>> = Vec::new();
        let mut indices = HashMap::new();
        for failure in &self.failures {
            let index = *indices.entry(check(failure)).or_insert(findings.len());
            match findings.get_mut(index) {
                Some(all) => all.push(failure),
                None => findings.push(vec![failure]),
            }
        }
        findings
    }
}
