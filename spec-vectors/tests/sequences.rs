//! Properties of the sequences that their schema cannot express.

use ads_cnc_vectors::{
    ProvenanceKind, Sequence, SequenceInput, clause, erratum, requirement, requirements, sequence,
    sequences, vector, vectors,
};
use std::collections::{BTreeMap, BTreeSet};

#[test]
fn ids_are_unique() {
    let mut seen = BTreeSet::new();
    for case in sequences() {
        assert!(seen.insert(&case.id), "{} exists twice", case.id);
        assert!(vector(&case.id).is_none(), "{} is a vector too", case.id);
        let mut steps = BTreeSet::new();
        for id in step_ids(case) {
            assert!(steps.insert(id), "{}: {id} exists twice", case.id);
        }
    }
}

fn step_ids(case: &Sequence) -> Vec<&str> {
    match &case.given {
        SequenceInput::Streaming(given) => {
            given.steps.iter().map(|step| step.id.as_str()).collect()
        }
        SequenceInput::Service(given) => given.steps.iter().map(|step| step.id.as_str()).collect(),
        SequenceInput::NcText(_) | SequenceInput::NcCheck(_) => Vec::new(),
    }
}

#[test]
fn sequences_cite_existing_entries() {
    for case in sequences() {
        assert!(!case.requirements.is_empty(), "{}", case.id);
        for id in &case.requirements {
            assert!(clause(id).is_some(), "{} cites {id}", case.id);
        }
        for id in &case.errata {
            assert!(erratum(id).is_some(), "{} cites {id}", case.id);
        }
        if case.provenance.kind == ProvenanceKind::Manual {
            assert!(case.is_accepted(), "{}: a printed example is accepted", case.id);
        }
    }
}

/// The steps of a rejected case, by their IDs, are the first steps of its sibling, with at most one
/// step left out.
#[test]
fn siblings_have_the_same_steps() {
    for case in sequences() {
        let Some(sibling) = case.sibling.as_deref().and_then(sequence) else { continue };
        let (ids, others) = (step_ids(case), step_ids(sibling));
        let same = ids.iter().zip(&others).take_while(|(id, other)| id == other).count();
        let rest = &ids[same..];
        let follows = |from: usize| others.get(from..).is_some_and(|all| all.starts_with(rest));
        assert!(rest.is_empty() || follows(same + 1), "{}", case.id);
    }
}

#[test]
fn every_kind_has_both_verdicts() {
    let mut verdicts: BTreeMap<&str, (u32, u32)> = BTreeMap::new();
    for case in sequences() {
        let counts = verdicts.entry(case.kind()).or_default();
        if case.is_accepted() { counts.0 += 1 } else { counts.1 += 1 }
    }
    assert_eq!(verdicts.len(), 4);
    for (kind, (accepted, rejected)) in verdicts {
        assert!(accepted > 0 && rejected > 0, "{kind}: {accepted} accepted, {rejected} rejected");
    }
}

/// Requirements that have no case, although the catalogue does not exclude them, with the reason.
const UNSHOWN: [(&str, &str); 2] = [
    ("STM-21", "the NC language defines the other errors"),
    ("SVC-11", "no stream of these areas has a version"),
];

/// Requirements without a rejected case, because no text or step can show a violation, with the reason.
const ONLY_ACCEPTED: [(&str, &str); 2] = [
    ("STM-16", "no stream shows that motion stops"),
    ("STM-18", "no stream shows whether the subroutine is executed"),
];

/// Each requirement of the areas STM and SVC has an accepted and a rejected vector or sequence.
/// Exceptions are those that the catalogue excludes, those in `UNSHOWN` and `ONLY_ACCEPTED`, and
/// those with a reason why nothing violates them (`no_reject`).
#[test]
fn requirements_have_both_verdicts() {
    let (mut accepted, mut rejected) = (BTreeSet::new(), BTreeSet::new());
    let verdicts = vectors().iter().map(|v| (v.is_accepted(), v.cited()));
    for (holds, cited) in verdicts.chain(sequences().iter().map(|s| (s.is_accepted(), s.cited()))) {
        let set = if holds { &mut accepted } else { &mut rejected };
        set.extend(cited.iter().map(|r| r.id.as_str()));
    }
    let of_areas = requirements().iter().filter(|r| r.area == "STM" || r.area == "SVC");
    for r in of_areas.filter(|r| r.excluded.is_none()) {
        let id = r.id.as_str();
        let listed = |list: &[(&str, &str)]| list.iter().any(|(one, _)| *one == id);
        let shown = !listed(&UNSHOWN);
        if shown {
            assert!(accepted.contains(id), "{id} has no accepted case");
        }
        let can_be_broken = shown && !listed(&ONLY_ACCEPTED) && r.no_reject.is_none();
        assert_eq!(
            rejected.contains(id),
            can_be_broken,
            "{id}: a rejected case or a reason, not both"
        );
    }
    for (id, _) in UNSHOWN.iter().chain(&ONLY_ACCEPTED) {
        assert!(requirement(id).is_some(), "{id} does not exist");
    }
}
