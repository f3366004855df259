//! Areas and IDs are complete, and every cited section is a section of a known edition.

use ads_cnc_vectors::{
    Basis, ClauseId, Requirement, documents, errata, requirements, sequences, vectors,
};
use std::collections::BTreeSet;

/// The sections of `document` that the requirement cites.
fn sections<'a>(requirement: &'a Requirement, document: &str) -> BTreeSet<&'a str> {
    let cited = requirement.sources.iter().filter(|s| s.document == document);
    cited.map(|s| s.section.as_str()).collect()
}

#[test]
fn every_area_has_requirements() {
    let areas: BTreeSet<&str> = requirements().iter().map(|r| r.area.as_str()).collect();
    let all = ["ADR", "ADS", "COM", "DYN", "GEN", "OBJ", "SDA", "STM", "SVC", "VAR"];
    assert_eq!(areas, BTreeSet::from(all));
}

/// The build script, which searches the JSON as text, finds exactly the IDs in the parsed JSON.
#[test]
fn ids_known_to_the_compiler_are_those_of_the_requirements() {
    let parts = |one: &'static Requirement| one.parts.iter().map(|part| part.id.as_str());
    let ids = requirements().iter().flat_map(|one| [one.id.as_str()].into_iter().chain(parts(one)));
    let known = ClauseId::all().iter().map(|id| id.as_str());
    assert_eq!(known.collect::<Vec<_>>(), ids.collect::<Vec<_>>());
}

#[test]
fn errata_are_numbered_without_gaps() {
    for (number, erratum) in (1..).zip(errata()) {
        assert_eq!(erratum.id, format!("E-{number:02}"));
    }
}

/// Every citation names a document, its edition and one of its sections. A requirement cites one
/// section per source.
#[test]
fn cited_sections_exist() {
    let exists = |id: &str, document: &str, edition: &str, section: &str| {
        let known = documents().iter().find(|d| d.document == document && d.edition == edition);
        let known = known.unwrap_or_else(|| panic!("{id}: no document {document} {edition}"));
        let is_section = known.sections.iter().any(|one| one == section);
        assert!(is_section, "{id}: {document} has no section {section}");
    };
    for r in requirements() {
        for source in &r.sources {
            exists(&r.id, &source.document, &source.edition, &source.section);
        }
    }
    for e in errata() {
        for reading in &e.readings {
            for section in reading.section.split(", ") {
                exists(&e.id, &reading.document, &reading.edition, section);
            }
        }
    }
    let of_vectors = vectors().iter().map(|v| (&v.id, &v.provenance));
    for (id, place) in of_vectors.chain(sequences().iter().map(|s| (&s.id, &s.provenance))) {
        for source in &place.sources {
            for section in source.section.split(", ") {
                exists(id, &source.document, &source.edition, section);
            }
        }
    }
}

#[test]
fn nothing_is_cited_twice() {
    for r in requirements() {
        let places: BTreeSet<_> = r.sources.iter().map(|s| (&s.document, &s.section)).collect();
        assert_eq!(places.len(), r.sources.len(), "{} cites a section twice", r.id);
    }
    for e in errata() {
        let readings: BTreeSet<_> =
            e.readings.iter().map(|r| (&r.document, &r.section, &r.reading)).collect();
        assert_eq!(readings.len(), e.readings.len(), "{} has a reading twice", e.id);
    }
}

/// The two editions of a manual have the same sections, so a requirement cites both editions. If only one
/// edition states the requirement, its basis is `edition`, or the requirement is listed here.
#[test]
fn both_editions_are_cited() {
    // Only one edition contains the note on the HLD (SDA-13) and the chapter on cycles (SVC-8, SVC-12).
    const ONE_ONLY: [&str; 3] = ["SDA-13", "SVC-8", "SVC-12"];
    for r in requirements() {
        let same = sections(r, "ads-en") == sections(r, "ads-de")
            && sections(r, "service-en") == sections(r, "service-de");
        if ONE_ONLY.contains(&r.id.as_str()) {
            assert!(!same, "{} is in both", r.id);
        } else if r.basis != Basis::Edition {
            assert!(same, "{} cites only one edition for a section", r.id);
        }
    }
}
