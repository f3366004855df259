//! Tests the suite with simulated CNCs that have a defect, and with valid variants of a CNC.

use std::sync::Arc;

use super::trial::{Candidate, SelfTestGroup, TrialResult, judge};
use crate::edition::Edition;
use crate::faults::{self, DefectKind, Faulty, SeededDefect};
use crate::judge::{Case, CaseOutcome, Needs};
use crate::profile::Profile;
use crate::session::{Session, ToolError};
use crate::simulator::{Cnc, DEFAULT_MODEL, Model, Settings};
use crate::suite::{self, TargetState};

/// A CNC version with all features: the description by name (VAR-28), V.P, V.L and V.S on the
/// channel interface (VAR-19), and the Service Interface (SVC-11).
const NEWEST: &str = "V4.29.0";

pub(super) fn candidates() -> Vec<Candidate> {
    faults::all().iter().filter(|defect| defect.is_for_cnc()).map(of_defect).collect()
}

fn of_defect(defect: &'static SeededDefect) -> Candidate {
    let is_right = defect.kind == DefectKind::Different;
    Candidate {
        id: defect.id.clone(),
        group: if is_right { SelfTestGroup::Different } else { SelfTestGroup::Cnc },
        what: defect.what.clone(),
        targets: defect.requirements.clone(),
        run: Box::new(move || against(defect)),
    }
}

/// Runs the cases of a target against a simulated CNC with the defect. The CNC has the default
/// model, unless the defect is a variant with its own model.
///
/// The cases with a requirement that the defect breaks run first. If they do not catch the defect,
/// all cases run. If these do not catch the defect either, and the defect is for both editions, all
/// cases run again with the German edition and the version [`NEWEST`]. The result is `None` if a
/// field defect changed no byte.
fn against(defect: &SeededDefect) -> Result<Option<Vec<CaseOutcome>>, ToolError> {
    let by_default = Settings { edition: defect.edition, version: None };
    let newest = Settings { edition: Some(Edition::German), version: NEWEST.parse().ok() };
    let is_caught =
        |outcomes: &[CaseOutcome]| judge(&defect.requirements, outcomes).1 == TrialResult::Caught;
    let targeted =
        |case: &Case| defect.requirements.iter().any(|id| case.requirements.contains(id));
    if !defect.requirements.is_empty() {
        let (outcomes, _) = run(defect, by_default, targeted)?;
        if is_caught(&outcomes) {
            return Ok(Some(outcomes));
        }
    }
    let (mut outcomes, mut has_shown) = run(defect, by_default, |_| true)?;
    if defect.edition.is_none() && !is_caught(&outcomes) {
        let (more, has_shown_there) = run(defect, newest, |_| true)?;
        outcomes.extend(more);
        has_shown |= has_shown_there;
    }
    Ok(has_shown.then_some(outcomes))
}

/// The outcomes of the wanted cases, and whether a field defect changed any byte; true for other
/// defects.
fn run(
    defect: &SeededDefect,
    settings: Settings,
    wanted: impl Fn(&Case) -> bool,
) -> Result<(Vec<CaseOutcome>, bool), ToolError> {
    let internal = |error| ToolError::Internal(format!("the default model: {error}"));
    let model = Model::with_settings(DEFAULT_MODEL, "the default model", settings);
    let cnc = Cnc::new(model.map_err(internal)?).with_stopped_clock();
    let faulty = Arc::new(Faulty::new(cnc, Some(defect)));
    let profile = faulty.cnc().model().profile();
    let profile = Profile { printed_examples: defect.printed, ..profile };
    let session = Session::in_process_to_try(Arc::<Faulty>::clone(&faulty))?;
    let (client, _) = session.into_parts();
    let mut session = TargetState::new(client, profile);
    let of_target = |case: &Case| case.needs != Needs::Codec && wanted(case);
    let cases = suite::cases().into_iter().filter(of_target).collect();
    let outcomes = suite::run(cases, Some(&mut session), None, 1);
    Ok((outcomes, faulty.has_shown()))
}
