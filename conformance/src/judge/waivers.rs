//! Known failures and other verdicts that a run accepts: the file of `--waivers`.
//!
//! ```
//! use ads_cnc_conformance::judge::Waivers;
//!
//! let waivers = Waivers::from_toml(r#"
//!     [[waiver]]
//!     test = "var-descriptions"
//!     requirement = "VAR-8"
//!     verdict = "fail"
//!     reason = "sizes are rounded up to 4 until firmware 2.1"
//!     expires = 2027-01-31
//! "#)?;
//! assert_eq!(waivers.len(), 1);
//! # Ok::<(), ads_cnc_conformance::text::FileError>(())
//! ```
//!
//! A waiver is stale if it has expired, if no case has its ID and requirement, or if the verdict
//! differs. A stale waiver makes the run end with exit code 5, unless another exit code takes
//! precedence. A waiver whose case exists but was not run or was interrupted is stale only if the
//! waiver has expired.

use std::collections::HashSet;

use ads_cnc_vectors::requirement;
use serde::de::{Deserializer, Error as _};
use serde::{Deserialize, Serialize};
use toml::value::{Date, Datetime};
use toml::{Spanned, Value};

use super::{CaseOutcome, SkippedCase, Verdict};
use crate::text::{FileError, Moment, found, toml_error};

/// The waivers of a file.
#[derive(Clone, Debug, Default)]
pub struct Waivers(Vec<Waiver>);

/// A waiver and its state after a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaiverReport {
    pub test: String,
    pub requirement: String,
    pub verdict: Verdict,
    /// Why the verdict is accepted.
    pub reason: String,
    /// The first day on which the waiver is no longer valid.
    pub expires: String,
    pub state: WaiverState,
    /// The verdict on the requirement in this run; `None` if the case has no outcome for the
    /// requirement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub found: Option<Verdict>,
}

/// The state of a waiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum WaiverState {
    /// The verdict is the waived verdict.
    Used,
    /// The case was not run or was interrupted, or the requirement was not selected.
    NotRun,
    /// The waiver has expired. Stale.
    Expired,
    /// No case of the run or of the cases that were not selected has this ID and requirement.
    /// Stale.
    Unmatched,
    /// The verdict differs from the waived verdict. Stale.
    Otherwise,
}

impl WaiverState {
    /// Whether the file must be corrected.
    pub const fn is_stale(self) -> bool {
        matches!(self, Self::Expired | Self::Unmatched | Self::Otherwise)
    }

    pub const fn name(self) -> &'static str {
        match self {
            Self::Used => "used",
            Self::NotRun => "not run",
            Self::Expired => "stale: expired",
            Self::Unmatched => "stale: no such case or requirement was run",
            Self::Otherwise => "stale: another verdict was found",
        }
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Waiver {
    #[serde(deserialize_with = "test")]
    test: String,
    #[serde(deserialize_with = "known_requirement")]
    requirement: String,
    #[serde(deserialize_with = "waivable")]
    verdict: Verdict,
    #[serde(deserialize_with = "reason")]
    reason: String,
    #[serde(deserialize_with = "day")]
    expires: Date,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WaiverFile {
    #[serde(default)]
    waiver: Vec<Spanned<Waiver>>,
}

impl Waivers {
    /// Parses the text of a file.
    ///
    /// # Errors
    /// The line and its fault, such as invalid TOML, an unknown or missing key, an empty ID or
    /// reason, a requirement that does not exist, a verdict that cannot be waived, a date that is
    /// not a day, or a duplicate waiver.
    pub fn from_toml(text: &str) -> Result<Self, FileError> {
        let file: WaiverFile =
            toml::from_str(text).map_err(|error| FileError::new(toml_error(&error)))?;
        let mut known = HashSet::new();
        for waiver in &file.waiver {
            let Waiver { test, requirement, .. } = waiver.get_ref();
            if !known.insert((test, requirement)) {
                let before = &text.as_bytes()[..waiver.span().start];
                let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
                let why = format!("line {line}: duplicate waiver of {requirement} in {test}");
                return Err(FileError::new(why));
            }
        }
        Ok(Self(file.waiver.into_iter().map(Spanned::into_inner).collect()))
    }

    /// The IDs of the cases with a waiver.
    pub fn cases(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|waiver| waiver.test.as_str())
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn apply(
        &self,
        outcomes: &[CaseOutcome],
        left_out: &[SkippedCase],
        now: Moment,
    ) -> Vec<WaiverReport> {
        self.0.iter().map(|waiver| waiver.apply(outcomes, left_out, now)).collect()
    }
}

impl Waiver {
    fn apply(
        &self,
        outcomes: &[CaseOutcome],
        left_out: &[SkippedCase],
        now: Moment,
    ) -> WaiverReport {
        let Self { test, requirement, verdict, reason, expires } = self;
        let left = left_out
            .iter()
            .any(|left| left.id == *test && left.requirements.iter().any(|one| one == requirement));
        let verdicts = outcomes.iter().filter(|one| one.case.id == *test);
        let mut verdicts = verdicts.flat_map(|outcome| &outcome.verdicts);
        let found = verdicts.find(|one| one.requirement == requirement).map(|one| one.verdict);
        let over = Moment::from_date(*expires).is_none_or(|expires| now >= expires);
        let state = match found {
            _ if over => WaiverState::Expired,
            Some(found) if found == *verdict => WaiverState::Used,
            Some(Verdict::NotRun | Verdict::Interrupted) => WaiverState::NotRun,
            Some(_) => WaiverState::Otherwise,
            None if left => WaiverState::NotRun,
            None => WaiverState::Unmatched,
        };
        WaiverReport {
            test: test.clone(),
            requirement: requirement.clone(),
            verdict: *verdict,
            reason: reason.clone(),
            expires: expires.to_string(),
            state,
            found,
        }
    }
}

fn text<'de, D: Deserializer<'de>>(value: D, what: &str) -> Result<String, D::Error> {
    let text = String::deserialize(value)?;
    match text.trim() {
        "" => Err(D::Error::custom(what)),
        trimmed => Ok(trimmed.to_owned()),
    }
}

fn test<'de, D: Deserializer<'de>>(value: D) -> Result<String, D::Error> {
    text(value, "expected the ID of a case, as shown by run --list")
}

fn reason<'de, D: Deserializer<'de>>(value: D) -> Result<String, D::Error> {
    text(value, "a waiver needs a reason")
}

fn known_requirement<'de, D: Deserializer<'de>>(value: D) -> Result<String, D::Error> {
    let id = String::deserialize(value)?;
    match requirement(&id) {
        Some(_) => Ok(id),
        None => Err(D::Error::custom(format!("no such requirement: {id}"))),
    }
}

fn waivable<'de, D: Deserializer<'de>>(value: D) -> Result<Verdict, D::Error> {
    let name = String::deserialize(value)?;
    let waivable = Verdict::ALL.into_iter().filter(|verdict| verdict.is_waivable());
    waivable.clone().find(|verdict| verdict.name() == name).ok_or_else(|| {
        let names: Vec<&str> = waivable.map(Verdict::name).collect();
        D::Error::custom(format!("the verdict of a waiver must be one of {}", names.join(", ")))
    })
}

fn day<'de, D: Deserializer<'de>>(value: D) -> Result<Date, D::Error> {
    match Value::deserialize(value)? {
        Value::Datetime(Datetime { date: Some(date), time: None, offset: None }) => Ok(date),
        other => Err(D::Error::custom(format!(
            "expected a day as YYYY-MM-DD without quotes, such as 2027-01-31, found {}",
            found(&other)
        ))),
    }
}
