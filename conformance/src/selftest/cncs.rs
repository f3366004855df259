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

/// A CNC version that has the function at offset 0x4C and all kinds of dynamic parameters.
const NEWEST: &str = "V4.29.0";

pub(super) fn candidates() -> Vec<Candidate> {
    faults::all().iter().filter(|seed| seed.is_for_cnc()).map(of_seed).collect()
}

fn of_seed(seed: &'static SeededDefect) -> Candidate {
    let is_right = seed.kind == DefectKind::Different;
    Candidate {
        id: seed.id.clone(),
        group: if is_right { SelfTestGroup::Different } else { SelfTestGroup::Cnc },
        what: seed.what.clone(),
        targets: seed.requirements.clone(),
        run: Box::new(move || against(seed)),
    }
}

/// Runs the cases of a target against a simulated CNC with the seed: with the default model, and
/// with a version that has all features.
///
/// The cases with a requirement that the defect breaks run first: if they catch the defect, the other
/// cases are not run. The result is `None` if the defect changed no byte.
fn against(seed: &SeededDefect) -> Result<Option<Vec<CaseOutcome>>, ToolError> {
    let by_default = Settings { edition: seed.edition, version: None };
    let newest = Settings { edition: Some(Edition::German), version: NEWEST.parse().ok() };
    let is_caught =
        |outcomes: &[CaseOutcome]| judge(&seed.requirements, outcomes).1 == TrialResult::Caught;
    let targeted = |case: &Case| seed.requirements.iter().any(|id| case.requirements.contains(id));
    if !seed.requirements.is_empty() {
        let (outcomes, _) = run(seed, by_default, targeted)?;
        if is_caught(&outcomes) {
            return Ok(Some(outcomes));
        }
    }
    let (mut outcomes, mut has_shown) = run(seed, by_default, |_| true)?;
    if seed.edition.is_none() && !is_caught(&outcomes) {
        let (more, has_shown_there) = run(seed, newest, |_| true)?;
        outcomes.extend(more);
        has_shown |= has_shown_there;
    }
    Ok(has_shown.then_some(outcomes))
}

/// The outcomes of the wanted cases, and whether the defect changed any byte.
fn run(
    seed: &SeededDefect,
    settings: Settings,
    wanted: impl Fn(&Case) -> bool,
) -> Result<(Vec<CaseOutcome>, bool), ToolError> {
    let internal = |error| ToolError::Internal(format!("the default model: {error}"));
    let model = Model::with_settings(DEFAULT_MODEL, "the default model", settings);
    let cnc = Cnc::new(model.map_err(internal)?).with_stopped_clock();
    let faulty = Arc::new(Faulty::new(cnc, Some(seed)));
    let profile = faulty.cnc().model().profile();
    let profile = Profile { printed_examples: seed.printed, ..profile };
    let session = Session::in_process_to_try(Arc::<Faulty>::clone(&faulty))?;
    let (client, _) = session.into_parts();
    let mut session = TargetState::new(client, profile);
    let of_target = |case: &Case| case.needs != Needs::Codec && wanted(case);
    let cases = suite::cases().into_iter().filter(of_target).collect();
    let outcomes = suite::run(cases, Some(&mut session), None, 1);
    Ok((outcomes, faulty.has_shown()))
}
