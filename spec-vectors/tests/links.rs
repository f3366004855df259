//! Every reference between the data files names an existing entry.

use ads_cnc_vectors::{
    Basis, Direction, Expect, Level, Observable, ProvenanceKind, Sequence, Value, Vector, clause,
    documents, errata, erratum, requirement, requirements, sequence, sequences, vector, vectors,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

#[test]
fn ids_are_unique() {
    let unique = |what: &str, ids: Vec<&str>| {
        let mut seen = BTreeSet::new();
        for id in ids {
            assert!(seen.insert(id), "{what} {id} exists twice");
        }
    };
    unique("document", documents().iter().map(|x| x.document.as_str()).collect());
    unique("requirement", requirements().iter().map(|x| x.id.as_str()).collect());
    unique("erratum", errata().iter().map(|x| x.id.as_str()).collect());
    unique("vector", vectors().iter().map(|x| x.id.as_str()).collect());
}

#[test]
fn requirements_are_numbered_without_gaps() {
    let mut found: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
    for r in requirements() {
        let (area, number) = r.id.split_once('-').expect("area and number");
        assert_eq!(area, r.area, "{}", r.id);
        found.entry(area).or_default().push(number.parse().expect("a number"));
    }
    for (area, mut numbers) in found {
        numbers.sort_unstable();
        let all: Vec<u32> = (1..).take(numbers.len()).collect();
        assert_eq!(numbers, all, "{area} has gaps");
    }
}

/// The level of a clause is `must` if the documents state the clause or it follows from them,
/// `should` if only the help pages state it, and `info` if it is assumed. A requirement with a
/// stricter level has a ruling; clauses with a weaker level are listed here.
#[test]
fn levels_follow_the_basis() {
    // For STM-17, the manual itself says "should". STM-6.1 only describes a sample program, which is not
    // binding.
    const WEAKER: [(&str, Level); 2] = [("STM-17", Level::Should), ("STM-6.1", Level::Info)];
    let level = |id: &str, basis| match basis {
        _ if WEAKER.iter().any(|(one, _)| *one == id) => {
            WEAKER.iter().find(|(one, _)| *one == id).map(|(_, level)| *level).unwrap()
        }
        Basis::Stated | Basis::Edition | Basis::Derived => Level::Must,
        Basis::Online => Level::Should,
        Basis::Assumed => Level::Info,
    };
    let rulings = requirements().iter().filter(|r| r.ruling.is_some());
    let rulings: Vec<&str> = rulings.map(|r| r.id.as_str()).collect();
    assert_eq!(rulings, ["GEN-1", "ADR-9", "VAR-24", "ADS-5"]);
    for r in requirements() {
        match r.ruling {
            Some(_) => assert_eq!(r.level, Level::Must, "{}", r.id),
            None => assert_eq!(r.level, level(&r.id, r.basis), "{}", r.id),
        }
        for (number, part) in (1..).zip(&r.parts) {
            assert_eq!(part.id, format!("{}.{number}", r.id));
            assert_eq!(part.level, level(&part.id, part.basis), "{}", part.id);
        }
        if matches!(r.basis, Basis::Stated | Basis::Edition) {
            assert!(!r.sources.is_empty(), "{} has no source", r.id);
        }
    }
}

#[test]
fn vectors_cite_existing_entries() {
    for v in vectors() {
        assert!(!v.requirements.is_empty(), "{} cites no requirement", v.id);
        for id in &v.requirements {
            assert!(clause(id).is_some(), "{} cites {id}", v.id);
        }
        for id in &v.errata {
            assert!(erratum(id).is_some(), "{} cites {id}", v.id);
        }
        if let Some(request) = &v.context.request {
            let request = vector(request).unwrap_or_else(|| panic!("{} answers {request}", v.id));
            assert!(request.is_accepted(), "{} answers {}", v.id, request.id);
            if v.context.service.is_some() {
                let stated = (v.context.index_group, v.context.index_offset);
                assert_eq!(address(request), stated, "{} answers {}", v.id, request.id);
            }
        }
    }
}

/// Group and offset of a request: from its context, or from its fields if the stream is a whole ADS
/// request.
fn address(request: &Vector) -> (Option<u32>, Option<u32>) {
    if request.context.service.is_some() {
        return (request.context.index_group, request.context.index_offset);
    }
    let Expect::Accept(accept) = &request.expect else {
        return (None, None);
    };
    // In a frame, the record of the ADS request contains group and offset.
    let part = accept.value.iter().find_map(|(name, value)| match value {
        Value::Record(fields) if name.ends_with("_request") => Some(fields),
        _ => None,
    });
    let fields = part.unwrap_or(&accept.value);
    let field = |name: &str| u32::try_from(fields.get(name)?.tagged()?.integer()?).ok();
    (field("index_group"), field("index_offset"))
}

#[test]
fn every_erratum_is_cited() {
    let mut cited: BTreeSet<&str> = BTreeSet::new();
    for r in requirements() {
        for id in &r.errata {
            assert!(erratum(id).is_some(), "{} cites {id}", r.id);
            cited.insert(id);
        }
    }
    cited.extend(vectors().iter().flat_map(|v| v.errata.iter().map(String::as_str)));
    cited.extend(sequences().iter().flat_map(|case| case.errata.iter().map(String::as_str)));
    for e in errata() {
        assert!(cited.contains(e.id.as_str()), "nothing cites {}", e.id);
    }
}

/// `check.py` checks the other properties of a sibling.
#[test]
fn siblings_have_the_same_direction() {
    for v in vectors() {
        if let Some(sibling) = v.sibling.as_deref().and_then(vector) {
            assert_eq!(sibling.direction, v.direction, "{}", v.id);
        }
    }
}

#[test]
fn every_stream_has_both_verdicts() {
    let mut verdicts: BTreeMap<&str, (u32, u32)> = BTreeMap::new();
    for v in vectors() {
        let counts = verdicts.entry(&v.stream).or_default();
        if v.is_accepted() { counts.0 += 1 } else { counts.1 += 1 }
    }
    for (stream, (accepted, rejected)) in verdicts {
        assert!(accepted > 0 && rejected > 0, "{stream}: {accepted} accepted, {rejected} rejected");
    }
}

#[test]
fn streams_have_segments() {
    for v in vectors() {
        assert!(!v.segments.is_empty(), "{}", v.id);
        // Only the last field may be empty.
        let (_, before) = v.segments.split_last().expect("not empty");
        for segment in before {
            assert!(!segment.hex.is_empty(), "{}: {}", v.id, segment.field);
        }
        // Two accepted vectors of the same stream and bytes would be duplicates.
        if v.is_accepted() {
            let same = |w: &&Vector| {
                w.id != v.id && w.is_accepted() && w.stream == v.stream && w.bytes() == v.bytes()
            };
            for other in vectors().iter().filter(same) {
                assert_ne!(other.context, v.context, "{} and {}", v.id, other.id);
            }
        }
    }
}

/// A requirement that can be judged from bytes has accepted vectors or sequences; it also has
/// rejected ones, unless it states why no bytes violate it. An excluded requirement has neither.
#[test]
fn requirements_about_bytes_have_both_verdicts() {
    let cited = |accepted: bool| -> BTreeSet<&str> {
        let vectors = vectors().iter().filter(|v| v.is_accepted() == accepted);
        let sequences = sequences().iter().filter(|case| case.is_accepted() == accepted);
        let cited = vectors.map(Vector::cited).chain(sequences.map(Sequence::cited));
        cited.flatten().map(|r| r.id.as_str()).collect()
    };
    let (accepted, rejected) = (cited(true), cited(false));
    for r in requirements() {
        let id = r.id.as_str();
        let about_bytes = r.observable.contains(&Observable::Codec);
        let (shown, broken) = (accepted.contains(id), rejected.contains(id));
        assert!(about_bytes || r.no_reject.is_none(), "{id} is not about bytes");
        assert!(!broken || r.no_reject.is_none(), "{id} has `no_reject` and a rejected vector");
        assert!(!(shown || broken) || r.excluded.is_none(), "{id} is excluded and has vectors");
        if about_bytes && r.excluded.is_none() {
            assert!(shown, "{id} has no accepted vector");
            assert!(broken || r.no_reject.is_some(), "{id} has no rejected vector");
        }
    }
    assert!(requirement("DYN-8").is_some_and(|r| r.excluded.is_some()));
}

/// A frame that carries another vector ends with the stream of that vector. The frame of a request
/// has the address of the carried vector; the frame of a reply names the frame of its request.
#[test]
fn frames_carry_the_named_vector() {
    for v in vectors() {
        let Some(id) = &v.context.carries else { continue };
        assert_eq!(v.stream, "ams-frame", "{}", v.id);
        let carried = vector(id).unwrap_or_else(|| panic!("{} carries {id}", v.id));
        assert!(carried.is_accepted(), "{} carries {id}", v.id);
        assert_eq!(carried.direction, v.direction, "{} carries {id}", v.id);
        assert!(v.bytes().ends_with(&carried.bytes()), "{} does not carry {id}", v.id);
        match (v.direction, &v.context.request) {
            (Direction::Reply, Some(request)) => {
                let asked = vector(request).and_then(|request| request.context.carries.as_ref());
                if carried.stream.starts_with("variable-") {
                    assert_eq!(asked, carried.context.request.as_ref(), "{}", v.id);
                }
            }
            (Direction::Reply, None) => panic!("{} answers nothing", v.id),
            _ => {
                let stated = (carried.context.index_group, carried.context.index_offset);
                assert_eq!(address(v), stated, "{} carries {id}", v.id);
            }
        }
    }
}

#[test]
fn printed_examples_are_accepted() {
    for v in vectors().iter().filter(|v| v.provenance.kind == ProvenanceKind::Manual) {
        assert!(v.is_accepted(), "{}", v.id);
    }
}

/// The JSON examples in the README are equal to entries of the data.
#[test]
fn readme_shows_real_entries() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).expect("a README");
    let shown: Vec<serde_json::Value> = readme
        .split("```json\n")
        .skip(1)
        .map(|rest| rest.split("```").next().expect("an end"))
        .map(|text| serde_json::from_str(text).expect("JSON"))
        .collect();
    assert_eq!(shown.len(), 4);
    for example in shown {
        let id = example["id"].as_str().expect("an ID");
        let real = if let Some(found) = vector(id) {
            serde_json::to_value(found)
        } else if let Some(found) = sequence(id) {
            serde_json::to_value(found)
        } else if let Some(found) = requirement(id) {
            serde_json::to_value(found)
        } else {
            serde_json::to_value(erratum(id).unwrap_or_else(|| panic!("{id} does not exist")))
        };
        assert_eq!(example, real.expect("serializes"), "{id}");
    }
}
