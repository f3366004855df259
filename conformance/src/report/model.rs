//! The report's data, which survives a round trip through JSON. All formats are made from it alone.

use std::collections::BTreeMap;

use ads_cnc_vectors::Level;
use ads_cnc_vectors::ids::ADS_5;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{BytesReport, DeviceReport, FoundReport};
use crate::judge::{CaseSubject, Exit, LeftChanged, Verdict, WaiverReport};
use crate::text::hex::compact;
use crate::text::json_error;

/// Version of this structure.
pub const FORMAT: u32 = 1;

/// Number of each verdict that occurs.
pub type Totals = BTreeMap<Verdict, usize>;

/// The report of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Version of this structure: [`FORMAT`].
    pub format: u32,
    /// Values that were changed and not restored.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_changed: Vec<LeftChanged>,
    /// What was asked for and rejected for safety, each with the reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rejected: Vec<String>,
    /// Names of the values that were changed, and restored unless `left_changed` has them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub written: Vec<String>,
    pub suite: String,
    pub vectors: String,
    /// When the run began, in UTC.
    pub time: String,
    /// Editions of the manual that were judged by.
    pub editions: Vec<String>,
    /// The seed of the order of cases.
    pub seed: u32,
    /// The selection; empty for all.
    pub only: Vec<String>,
    pub target: TargetReport,
    /// Of a capture: what it has, and which part of it was not judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub traffic: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileReport>,
    /// What the queries before the cases found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<FoundReport>,
    /// Waivers and their states.
    pub waivers: Vec<WaiverReport>,
    /// The command that runs the same again, without a selection and without reports.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub again: Option<String>,
    /// The exit code this run ends with.
    pub exit_code: u8,
    pub checks: usize,
    pub frames: usize,
    /// Why the run ended before all its cases were run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ended: Option<String>,
    /// Number of cases that were not selected; they are not in `cases`.
    pub left_out: usize,
    /// Codec, target, testee or client, each by itself.
    pub subjects: Vec<SubjectReport>,
    /// All cases in the order they were run.
    pub cases: Vec<CaseReport>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetReport {
    pub name: String,
    /// Its version, as reported by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// Its programming language, as reported by itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<String>,
    /// The command that started it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// Its TCP address.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub address: Option<String>,
    /// Its AMS NetId.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub net_id: Option<String>,
    /// The device information of its COM task, if available.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<DeviceReport>,
    /// The end of its stderr; not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stderr: Option<String>,
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

/// The target, testee or client that was judged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SubjectReport {
    pub subject: CaseSubject,
    /// Number of requirements by gravest verdict.
    pub totals: Totals,
    /// How many of them are waived.
    pub waived: usize,
    /// How long its cases took.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub milliseconds: Option<u64>,
    /// By area.
    pub areas: Vec<AreaReport>,
}

/// One area of requirements, or the protocol with a testee or a client.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AreaReport {
    /// The letters of the area; for a protocol `TESTEE` or `CLIENT`.
    pub area: String,
    /// Number of requirements by gravest verdict.
    pub totals: Totals,
    pub requirements: Vec<RequirementReport>,
}

/// The verdict on one requirement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequirementReport {
    pub requirement: String,
    /// The gravest verdict on it.
    pub verdict: Verdict,
    /// Whether it is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CaseReport {
    /// The case's slug.
    pub id: String,
    pub title: String,
    pub subject: CaseSubject,
    /// The stream, if the case is a vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    /// The gravest of its verdicts.
    pub verdict: Verdict,
    /// Whether that is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    /// The verdict on each of its requirements.
    pub requirements: Vec<RequirementReport>,
    pub checks: usize,
    /// How long it took, if it was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub milliseconds: Option<u64>,
    /// Why it did not run, or not completely.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Checks that did not pass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<FailureReport>,
}

/// A check that did not pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FailureReport {
    pub requirement: String,
    /// The level it was judged at; lower than the requirement's for an assumed part.
    pub level: Option<Level>,
    /// The text of the requirement, or of its parts of that level.
    pub clause: String,
    /// Its sources: document, edition, section.
    pub sources: Vec<String>,
    pub verdict: Verdict,
    /// Whether it is waived.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    pub expected: String,
    pub found: String,
    /// Number of further checks with the same verdict, which are not shown.
    pub more: usize,
    /// The clause whose failure explains it, if it is inconclusive for that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub follows: Option<String>,
    /// The bytes it is based on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<EvidenceReport>,
}

/// The bytes that a check is based on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceReport {
    /// Address and service of the request.
    pub call: String,
    /// The variable or object that it is about.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// The result in a few words.
    pub result: String,
    /// Data of the request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sent: Option<BytesReport>,
    /// Data of the reply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub received: Option<BytesReport>,
    /// Expected data of the reply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<BytesReport>,
    /// The whole frame sent, in hex.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub frame_sent: String,
    /// The received frame, or the part of it that arrived, in hex.
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
    /// Invalid JSON, or a report of another format version.
    pub fn from_json(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct FormatNumber {
            format: u32,
        }
        let FormatNumber { format } =
            serde_json::from_str(text).map_err(|error| in_file(text, &error))?;
        if format != FORMAT {
            return Err(format!("a report of format {format}; this version reads {FORMAT}"));
        }
        let report: Self = serde_json::from_str(text).map_err(|error| in_file(text, &error))?;
        Ok(report.escaped())
    }
}

/// What is wrong with a report, with its place.
fn in_file(text: &str, error: &serde_json::Error) -> String {
    let words = json_error(text, error);
    match error.is_data() {
        true => format!("line {}, column {}: {words}", error.line(), error.column()),
        false => words,
    }
}

impl FailureReport {
    /// Whether it is about the frames: their headers, or a reply that is not a frame.
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
    /// The frames of the request and of the reply, each by its headers and the fields of its service.
    pub(super) fn frames(&self) -> [Vec<BytesReport>; 2] {
        let bytes = |hex: &str| compact::parse(hex).unwrap_or_default();
        let (sent, received) = (bytes(&self.frame_sent), bytes(&self.frame_received));
        [BytesReport::of_frame(&sent, None), BytesReport::of_frame(&received, Some(&sent))]
    }
}

impl CaseReport {
    /// The failures, grouped by evidence: one check may count for several requirements.
    pub(super) fn findings(&self) -> Vec<Vec<&FailureReport>> {
        fn check(one: &FailureReport) -> impl PartialEq + '_ {
            let seen = (&one.expected, &one.found, &one.evidence);
            (seen, one.verdict, one.waived, &one.follows)
        }
        let mut findings: Vec<Vec<&FailureReport>> = Vec::new();
        for failure in &self.failures {
            let same = findings
                .iter_mut()
                .find(|all| all.first().is_some_and(|first| check(first) == check(failure)));
            match same {
                Some(all) => all.push(failure),
                None => findings.push(vec![failure]),
            }
        }
        findings
    }
}
