//! The suite detects a wrong field in the streams that these tests name, both by vectors and,
//! except for the defects in `UNSEEN`, by cases against a CNC.

use std::sync::Arc;

use ads_cnc::layout::{Field, Stream};
use ads_cnc_conformance::edition::Edition;
use ads_cnc_conformance::faults::{Faulty, FieldChange, FieldDefect, SeededDefect};
use ads_cnc_conformance::judge::{Case, CaseOutcome, Judgement, Needs, Verdict};
use ads_cnc_conformance::profile::Profile;
use ads_cnc_conformance::selftest::UNSEEN;
use ads_cnc_conformance::session::Session;
use ads_cnc_conformance::simulator::{Cnc, DEFAULT_MODEL, Model, Settings};
use ads_cnc_conformance::suite::{self, TargetState};

/// Runs the wanted cases with this defect: vectors against the codec, other cases against a simulated
/// CNC.
fn run(defect: Option<&FieldDefect>, wanted: impl Fn(&Case) -> bool) -> Vec<CaseOutcome> {
    run_against(Cnc::with_default_model().unwrap(), profile(), defect, wanted)
}

fn profile() -> Profile {
    let model = Model::default_model().unwrap();
    Profile { printed_examples: true, ..model.profile() }
}

fn run_against(
    cnc: Cnc,
    profile: Profile,
    defect: Option<&FieldDefect>,
    wanted: impl Fn(&Case) -> bool,
) -> Vec<CaseOutcome> {
    let cases = suite::cases().into_iter().filter(wanted).collect();
    let seeded = defect.cloned().map(SeededDefect::from);
    let faulty = Faulty::new(cnc.with_stopped_clock(), seeded.as_ref());
    let (client, _) = Session::in_process_to_try(Arc::new(faulty)).unwrap().into_parts();
    let mut session = TargetState::new(client, profile);
    suite::run(cases, Some(&mut session), seeded.as_ref(), 0)
}

/// The IDs of the cases with a failure, a warning, or a failure that follows from another clause.
fn failed(outcomes: &[CaseOutcome]) -> Vec<&str> {
    let failed = outcomes.iter().filter(|outcome| {
        let mut judged = outcome.verdicts.iter().flat_map(|one| &one.judgements);
        judged.any(|one| {
            matches!(one.verdict, Verdict::Fail | Verdict::Warning) || one.follows.is_some()
        })
    });
    failed.map(|outcome| outcome.case.id.as_str()).collect()
}

/// The two defects of a field that change its bytes whatever the bytes are.
fn defects(field: Field) -> impl Iterator<Item = FieldDefect> {
    let all = field
        .stream()
        .into_iter()
        .flat_map(FieldDefect::of_stream)
        .filter(move |one| one.field == field);
    all.filter(|defect| matches!(defect.change, FieldChange::FlipLow | FieldChange::Invert))
}

/// Checks that with each of the two [`defects`] of every field of `stream`, a vector fails and a
/// case of the target that is not a printed example fails or has a warning. For the fields in
/// `only_printed`, a printed example suffices; for the defects in `UNSEEN`, no case of the target
/// need fail.
fn every_field_is_seen(stream: Stream, only_printed: &[&str]) {
    for defect in stream.fields().flat_map(defects) {
        // Runs only the cases of the field's area, such as VAR. Fields of frames (ADS) concern all areas.
        let spec = defect.field.spec().map_or("", |spec| spec.clause);
        let area = spec.split('-').next().unwrap().to_owned();
        let near =
            |case: &Case| area == "ADS" || case.requirements.iter().any(|id| id.starts_with(&area));
        let vectors = run(Some(&defect), |case| case.needs == Needs::Codec && near(case));
        // A vector must fail when its bytes are decoded; that it fails when encoded does not suffice.
        let by_vectors = vectors.iter().filter(|outcome| outcome.verdict() == Verdict::Fail);
        let misread = by_vectors.flat_map(|outcome| &outcome.verdicts).any(|judged| {
            let failed = |one: &Judgement| {
                one.evidence.as_ref().is_some_and(|evidence| evidence.call.starts_with("decode"))
            };
            judged.judgements.iter().any(failed)
        });
        assert!(misread, "{}: no vector fails", defect.id);
        let cases = run(Some(&defect), |case| case.needs != Needs::Codec && near(case));
        let by_cases = failed(&cases);
        let telling = by_cases.iter().any(|id| !id.starts_with("printed-"));
        let printed = only_printed.contains(&defect.field.name());
        let is_unseen = UNSEEN.contains(&defect.id.as_str());
        let seen = telling || is_unseen || printed && !by_cases.is_empty();
        assert!(seen, "{}: {by_cases:?}", defect.id);
        let broken = cases.iter().find(|case| case.verdict() == Verdict::HarnessError);
        assert!(broken.is_none(), "{}: {:?}", defect.id, broken.map(|case| &case.note));
    }
}

#[test]
fn every_field_of_the_description_is_seen() {
    every_field_is_seen(Stream::VariableDescription, &["access"]);
}

#[test]
fn every_field_of_the_descriptor_is_seen() {
    // For the number, the name, the type and the unassigned bytes of a descriptor, a printed
    // example suffices.
    let printed = ["id", "not_assigned", "name", "type"];
    every_field_is_seen(Stream::ObjectDescriptor, &printed);
}

#[test]
fn every_field_of_the_handle_header_is_seen() {
    every_field_is_seen(Stream::VariableHandleRead, &[]);
}

#[test]
fn every_field_of_object_addresses_is_seen() {
    every_field_is_seen(Stream::ObjectAddressQuery, &[]);
    every_field_is_seen(Stream::ObjectAddress, &[]);
}

#[test]
fn every_attribute_of_elements_is_seen() {
    every_field_is_seen(Stream::ElementCount, &[]);
    every_field_is_seen(Stream::ElementLength, &[]);
    every_field_is_seen(Stream::ElementWriteFlag, &[]);
    // For the text of a name, a type or a unit, a printed example suffices.
    every_field_is_seen(Stream::ElementText, &["text"]);
}

#[test]
fn every_field_of_dynamic_parameters_is_seen() {
    every_field_is_seen(Stream::DynamicCount, &[]);
    every_field_is_seen(Stream::DynamicIndex, &[]);
    every_field_is_seen(Stream::DynamicName, &[]);
    every_field_is_seen(Stream::DynamicNameRequest, &[]);
    // The value by name and the value by index are equally wrong, so a printed example suffices.
    every_field_is_seen(Stream::DynamicValue, &["value"]);
}

#[test]
fn every_field_of_the_extended_description_is_seen() {
    every_field_is_seen(Stream::VariableExtendedDescription, &[]);
    every_field_is_seen(Stream::VariableIndexKind, &[]);
}

#[test]
fn every_field_of_writes_by_handle_is_seen() {
    every_field_is_seen(Stream::VariableHandleWrite, &[]);
}

#[test]
fn every_field_of_writes_by_name_is_seen() {
    every_field_is_seen(Stream::VariableNameWrite, &[]);
}

#[test]
fn every_field_of_writes_is_seen() {
    every_field_is_seen(Stream::WriteRequest, &[]);
    every_field_is_seen(Stream::WriteReply, &[]);
}

#[test]
fn every_field_of_the_program_stream_is_seen() {
    every_field_is_seen(Stream::ProgramStream, &[]);
}

/// The description by name (VAR-28) has level *should*, so a wrong field is a warning.
#[test]
fn every_field_of_the_description_by_name_is_seen() {
    for defect in Stream::VariableDescriptionByName.fields().flat_map(defects) {
        let cases = run(Some(&defect), |case| case.requirements.contains(&"VAR-28"));
        let of_target = cases.iter().filter(|outcome| outcome.case.needs != Needs::Codec);
        let seen = of_target.filter(|outcome| outcome.verdict() == Verdict::Warning);
        assert!(seen.count() > 0, "{}", defect.id);
    }
}

/// Without a defect, every case passes, except three cases that are not applicable.
#[test]
fn the_simulated_cnc_passes() {
    for outcome in run(None, |_| true) {
        let verdict = outcome.verdict();
        // One printed example contradicts another, and only the German edition documents V.P, V.L and
        // V.S.
        let other =
            ["printed-value-printed-name-element", "var-dynamic-by-name", "write-dynamic-by-name"];
        let other = other.contains(&outcome.case.id.as_str());
        let expected = if other { Verdict::NotApplicable } else { Verdict::Pass };
        assert_eq!(verdict, expected, "{}: {:?}", outcome.case.id, outcome.verdicts);
        for judged in &outcome.verdicts {
            assert_eq!(judged.verdict, expected, "{} {}", outcome.case.id, judged.requirement);
        }
    }
}

/// In the German edition, the variables include V.P, V.L and V.S, without handles.
#[test]
fn a_cnc_of_the_german_edition_passes() {
    let edition = Edition::German;
    let settings = Settings { edition: Some(edition), version: None };
    let model = Model::with_settings(DEFAULT_MODEL, "default", settings).unwrap();
    let profile = Profile { edition, ..profile() };
    let cases = |case: &Case| case.needs != Needs::Codec;
    let outcomes = run_against(Cnc::new(model), profile, None, cases);
    let raised = outcomes
        .iter()
        .filter(|one| !matches!(one.verdict(), Verdict::Pass | Verdict::NotApplicable));
    assert_eq!(raised.map(|one| one.case.id.as_str()).collect::<Vec<_>>(), [""; 0]);
    let own = outcomes.iter().find(|one| one.case.id == "var-dynamic-by-name").unwrap();
    assert_eq!(own.verdict(), Verdict::Pass, "{:?}", own.note);
}
