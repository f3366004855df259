//! The files of `data/`, embedded in the crate and parsed once.

use crate::catalogue::{Clause, Document, Erratum, Requirement};
use crate::sequence::Sequence;
use crate::vector::Vector;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::HashMap;
use std::fmt;
use std::sync::OnceLock;

/// Version of the data, which every file states. It is also the version of the crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// All data of the crate.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Catalogue {
    /// The documents that sources and readings cite.
    pub documents: Vec<Document>,
    /// The requirements, grouped by area, and sorted by number in each area.
    pub requirements: Vec<Requirement>,
    /// The errata, sorted by number.
    pub errata: Vec<Erratum>,
    /// The vectors of all files.
    pub vectors: Vec<Vector>,
    /// The sequences of all files.
    pub sequences: Vec<Sequence>,
}

/// The error for a file of `data/` that does not match the types of this crate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadError {
    /// Path of the file in the crate.
    pub file: &'static str,
    /// The fault, with its line and column.
    pub message: String,
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file, self.message)
    }
}

impl std::error::Error for LoadError {}

/// All data of the crate.
///
/// If a file does not match the types of this crate, this function returns an error. The functions
/// that list or look up entries of the data, such as [`vectors()`] and [`vector()`], then return
/// empty lists or `None`. The tests of the crate verify that all files match.
///
/// ```
/// let catalogue = ads_cnc_vectors::catalogue()?;
/// assert!(catalogue.vectors.len() > 100);
/// # Ok::<(), &ads_cnc_vectors::LoadError>(())
/// ```
pub fn catalogue() -> Result<&'static Catalogue, &'static LoadError> {
    static CATALOGUE: OnceLock<Result<Catalogue, LoadError>> = OnceLock::new();
    CATALOGUE.get_or_init(read).as_ref()
}

/// The documents that sources and readings cite.
///
/// ```
/// assert!(ads_cnc_vectors::documents().iter().any(|d| d.document == "ads-en" && d.edition == "1.05"));
/// ```
pub fn documents() -> &'static [Document] {
    slice(|all| &all.documents)
}

/// All requirements.
///
/// ```
/// assert!(ads_cnc_vectors::requirements().iter().all(|r| r.id.starts_with(&r.area)));
/// ```
pub fn requirements() -> &'static [Requirement] {
    slice(|all| &all.requirements)
}

/// The requirement with this ID.
///
/// ```
/// assert_eq!(ads_cnc_vectors::requirement("VAR-7").unwrap().title, "Elementary variable");
/// assert!(ads_cnc_vectors::requirement("VAR-0").is_none());
/// ```
pub fn requirement(id: &str) -> Option<&'static Requirement> {
    // A map, because the conformance suite looks up requirements very often.
    static BY_ID: OnceLock<HashMap<&str, &Requirement>> = OnceLock::new();
    let by_id = || requirements().iter().map(|item| (item.id.as_str(), item)).collect();
    BY_ID.get_or_init(by_id).get(id).copied()
}

/// The cited clause: the requirement with this ID, or the part with this ID and its requirement.
///
/// ```
/// assert_eq!(ads_cnc_vectors::clause("VAR-7").unwrap().part, None);
/// assert_eq!(ads_cnc_vectors::clause("GEN-3.1").unwrap().requirement.title, "Code page");
/// assert!(ads_cnc_vectors::clause("GEN-3.0").is_none());
/// ```
pub fn clause(id: &str) -> Option<Clause> {
    let (of, _) = id.split_once('.').unwrap_or((id, ""));
    let requirement = requirement(of)?;
    let part = requirement.parts.iter().find(|part| part.id == id);
    (part.is_some() || of == id).then_some(Clause { requirement, part })
}

/// All errata.
///
/// ```
/// assert!(ads_cnc_vectors::errata().iter().all(|e| !e.ruling.is_empty()));
/// ```
pub fn errata() -> &'static [Erratum] {
    slice(|all| &all.errata)
}

/// The erratum with this ID.
///
/// ```
/// assert!(ads_cnc_vectors::erratum("E-07").unwrap().ruling.contains("bytes"));
/// ```
pub fn erratum(id: &str) -> Option<&'static Erratum> {
    errata().iter().find(|item| item.id == id)
}

/// All vectors.
///
/// ```
/// let printed = ads_cnc_vectors::vectors().iter().filter(|v| {
///     v.provenance.kind == ads_cnc_vectors::ProvenanceKind::Manual
/// });
/// assert!(printed.count() > 20);
/// ```
pub fn vectors() -> &'static [Vector] {
    slice(|all| &all.vectors)
}

/// The vector with this ID.
///
/// ```
/// let count = ads_cnc_vectors::vector("count-printed-123").unwrap();
/// assert_eq!(count.bytes(), [123, 0, 0, 0]);
/// ```
pub fn vector(id: &str) -> Option<&'static Vector> {
    vectors().iter().find(|item| item.id == id)
}

/// All sequences.
///
/// ```
/// use ads_cnc_vectors::{SequenceInput, sequences};
///
/// let texts = sequences().iter().filter(|case| matches!(case.given, SequenceInput::NcText(_)));
/// assert!(texts.count() > 20);
/// ```
pub fn sequences() -> &'static [Sequence] {
    slice(|all| &all.sequences)
}

/// The sequence with this ID.
///
/// ```
/// let longest = ads_cnc_vectors::sequence("line-990-lf").unwrap();
/// assert!(longest.is_accepted());
/// ```
pub fn sequence(id: &str) -> Option<&'static Sequence> {
    sequences().iter().find(|item| item.id == id)
}

fn slice<T>(part: impl Fn(&'static Catalogue) -> &'static Vec<T>) -> &'static [T] {
    catalogue().map_or(&[], |all| part(all))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RequirementFile {
    #[serde(rename = "$schema")]
    _schema: String,
    #[serde(rename = "version")]
    _version: String,
    documents: Vec<Document>,
    requirements: Vec<Requirement>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ErrataFile {
    #[serde(rename = "$schema")]
    _schema: String,
    #[serde(rename = "version")]
    _version: String,
    errata: Vec<Erratum>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct VectorFile {
    #[serde(rename = "$schema")]
    _schema: String,
    #[serde(rename = "version")]
    _version: String,
    vectors: Vec<Vector>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SequenceFile {
    #[serde(rename = "$schema")]
    _schema: String,
    #[serde(rename = "version")]
    _version: String,
    cases: Vec<Sequence>,
}

macro_rules! included {
    ($path:literal) => {
        ($path, include_str!(concat!("../", $path)))
    };
}

const REQUIREMENTS: (&str, &str) = included!("data/requirements.json");
const ERRATA: (&str, &str) = included!("data/errata.json");
/// The path and the text of each file of `data/vectors` and `data/sequences`, as `build.rs` lists them.
const VECTORS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/vectors.rs"));
const SEQUENCES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/sequences.rs"));

fn read() -> Result<Catalogue, LoadError> {
    let requirements: RequirementFile = parse(REQUIREMENTS)?;
    let errata: ErrataFile = parse(ERRATA)?;
    let mut vectors = Vec::new();
    for &file in VECTORS {
        vectors.extend(parse::<VectorFile>(file)?.vectors);
    }
    let mut sequences = Vec::new();
    for &file in SEQUENCES {
        sequences.extend(parse::<SequenceFile>(file)?.cases);
    }
    Ok(Catalogue {
        documents: requirements.documents,
        requirements: requirements.requirements,
        errata: errata.errata,
        vectors,
        sequences,
    })
}

fn parse<T: DeserializeOwned>((file, text): (&'static str, &str)) -> Result<T, LoadError> {
    serde_json::from_str(text).map_err(|error| LoadError { file, message: error.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_loads() {
        assert_eq!(catalogue().err(), None);
    }

    #[test]
    fn every_file_states_the_version() {
        let files = [VECTORS, SEQUENCES, &[REQUIREMENTS, ERRATA]];
        for &(file, text) in files.into_iter().flatten() {
            let data: serde_json::Value = serde_json::from_str(text).expect(file);
            assert_eq!(data["version"], VERSION, "{file}");
        }
    }

    #[test]
    fn a_broken_file_is_named() {
        let error = parse::<ErrataFile>(("data/broken.json", r#"{"errata":[],"extra":1}"#))
            .err()
            .expect("an unknown field");
        assert_eq!(error.file, "data/broken.json");
        assert!(error.message.contains("extra"), "{error}");
    }

    /// The types neither lose nor change a field of a sequence: serialising a parsed sequence gives
    /// the same JSON.
    #[test]
    fn sequences_survive_a_round_trip() {
        for &(file, text) in SEQUENCES {
            let raw: serde_json::Value = serde_json::from_str(text).expect(file);
            let typed = parse::<SequenceFile>((file, text)).expect("loads");
            let items = raw["cases"].as_array().expect("a list");
            assert_eq!(items.len(), typed.cases.len());
            for (item, case) in items.iter().zip(&typed.cases) {
                let again = serde_json::to_value(case).expect("serializes");
                assert_eq!(&again, item, "{}", case.id);
            }
        }
    }

    /// The types neither lose nor change a field of a vector: serialising a parsed vector gives the
    /// same JSON.
    #[test]
    fn vectors_survive_a_round_trip() {
        for &(file, text) in VECTORS {
            let raw: serde_json::Value = serde_json::from_str(text).expect(file);
            let typed = parse::<VectorFile>((file, text)).expect("loads");
            let items = raw["vectors"].as_array().expect("a list");
            assert_eq!(items.len(), typed.vectors.len());
            for (item, vector) in items.iter().zip(&typed.vectors) {
                let again = serde_json::to_value(vector).expect("serializes");
                assert_eq!(&again, item, "{}", vector.id);
            }
        }
    }
}
