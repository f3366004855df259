//! The report's data: plain, and the same when it is read back. Everything that is shown of a run
//! is made from it alone.

use std::collections::BTreeMap;

use ads_cnc_vectors::Level;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{BytesReport, DeviceReport};
use crate::judge::{CaseSubject, Exit, LeftChanged, Verdict, WaiverReport};

/// Number of this structure.
pub const FORMAT: u32 = 1;

/// Verdicts with their numbers; those that do not occur are left out.
pub type Totals = BTreeMap<Verdict, usize>;

/// A whole run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Report {
    /// Number of this structure: [`FORMAT`].
    pub format: u32,
    /// Values that were changed and could not be restored.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_changed: Vec<LeftChanged>,
    pub suite: String,
    pub vectors: String,
    /// When the run began, in UTC.
    pub time: String,
    /// Editions of the manual that were judged by.
    pub editions: Vec<String>,
    /// From which the order of the cases comes.
    pub seed: u32,
    /// What was selected; all if it is empty.
    pub only: Vec<String>,
    pub target: TargetReport,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<ProfileReport>,
    /// Failures that are known, and what became of each.
    pub waivers: Vec<WaiverReport>,
    /// The exit code this run ends with.
    pub exit_code: u8,
    pub checks: usize,
    pub frames: usize,
    /// Cases that were not selected; they are not among the cases.
    pub left_out: usize,
    /// Each who was judged, for itself.
    pub subjects: Vec<SubjectReport>,
    /// Every case in the order it was run.
    pub cases: Vec<CaseReport>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetReport {
    pub name: String,
    /// Its version, as it says itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
    /// In which language it is written, as it says itself.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<String>,
    /// How it was started.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
    /// Where it listens, or from where it connected.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub address: Option<String>,
    /// Its AMS NetId.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub net_id: Option<String>,
    /// What its COM task says of itself, if it does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device: Option<DeviceReport>,
    /// The last of what it wrote to stderr; not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stderr: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

/// What a target claims.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileReport {
    pub name: String,
    /// Each claim under its name.
    pub claims: BTreeMap<String, Value>,
}

/// The target, testee or client that was judged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SubjectReport {
    pub subject: CaseSubject,
    /// Verdicts of its requirements, each once and by its gravest.
    pub totals: Totals,
    /// How many of them are put up with.
    pub waived: usize,
    /// By area.
    pub areas: Vec<AreaReport>,
}

/// One area of requirements, or the protocol with a testee or a client.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AreaReport {
    /// The area's letters; of a protocol `TESTEE` or `CLIENT`.
    pub area: String,
    /// Verdicts of its requirements, each once and by its gravest.
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
    /// Whether it is put up with.
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
    /// The stream of a case that is a vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    /// The gravest of its verdicts.
    pub verdict: Verdict,
    /// Whether that is put up with.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    /// The verdict on each of its requirements.
    pub requirements: Vec<RequirementReport>,
    pub checks: usize,
    /// Why it did not run, or not to its end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Checks that were not passed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<FailureReport>,
}

/// A check that was not passed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FailureReport {
    pub requirement: String,
    /// The level it was judged at; that of an assumed part may be lower than the whole's.
    pub level: Option<Level>,
    /// What it says, or the parts of that level.
    pub clause: String,
    /// Its sources: document, edition, section.
    pub sources: Vec<String>,
    pub verdict: Verdict,
    /// Whether it is put up with.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub waived: bool,
    pub expected: String,
    pub found: String,
    /// Checks with the same verdict that are not shown.
    pub more: usize,
    /// The bytes it is based on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<EvidenceReport>,
}

/// The bytes that a check is based on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EvidenceReport {
    /// Where the request went.
    pub call: String,
    /// What came of it, in a few words.
    pub result: String,
    /// Data of the request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sent: Option<BytesReport>,
    /// Data of the reply.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub received: Option<BytesReport>,
    /// What should have been received.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<BytesReport>,
    /// The whole frame sent, in hex.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub frame_sent: String,
    /// The whole frame received, or as much as came, in hex.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub frame_received: String,
}

impl Report {
    /// How the process ends.
    pub fn exit(&self) -> Exit {
        Exit::from_code(self.exit_code).unwrap_or(Exit::Internal)
    }

    /// Reads a report.
    ///
    /// # Errors
    /// Text that is no report, or one of another format.
    pub fn from_json(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct FormatNumber {
            format: u32,
        }
        let FormatNumber { format } =
            serde_json::from_str(text).map_err(|error| error.to_string())?;
        if format != FORMAT {
            return Err(format!("a report of format {format}; this version reads {FORMAT}"));
        }
        let report: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        Ok(report.escaped())
    }
}

impl CaseReport {
    /// The failures, those with the same bytes together: one check may represent several
    /// requirements.
    pub(super) fn findings(&self) -> Vec<Vec<&FailureReport>> {
        let mut findings: Vec<Vec<&FailureReport>> = Vec::new();
        for failure in &self.failures {
            let same = findings.iter_mut().find(|all| {
                all.first().is_some_and(|first| {
                    (&first.expected, &first.found, &first.evidence, first.verdict, first.waived)
                        == (
                            &failure.expected,
                            &failure.found,
                            &failure.evidence,
                            failure.verdict,
                            failure.waived,
                        )
                })
            });
            match same {
                Some(all) => all.push(failure),
                None => findings.push(vec![failure]),
            }
        }
        findings
    }
}
