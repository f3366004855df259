//! The traceability matrix: the sources of each requirement, and the tests that verify it.
//!
//! ```
//! use ads_cnc_conformance::matrix::matrix;
//!
//! let rows = matrix();
//! let row = rows.iter().find(|row| row.id == "VAR-11").unwrap();
//! assert!(row.accepted.iter().any(|id| id == "handle-read-printed-element"));
//! assert!(!row.rejected.is_empty() && !row.cases.is_empty());
//! assert!(row.fuzz_targets.contains("variable_bytes"));
//! ```

mod fuzzed;
mod sections;
mod simulated;
mod types;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;
use ads_cnc_vectors::{
    Erratum, Interpretation, Requirement, SequenceInput, erratum, requirements, sequences, vectors,
};
use serde::Serialize;

use crate::client_suite;
use crate::judge::{Case, Needs};
use crate::rules::captured_cases;
use crate::suite;
use crate::text::wrap;

pub use sections::to_sections;
pub use simulated::{SEQUENCES, SIMULATOR_CHECKS};

/// A requirement with its sources, and the vectors, cases, tests and fuzz targets that verify it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct RequirementRow {
    /// The ID of the requirement.
    pub id: String,
    /// A short title.
    pub title: String,
    /// The text of the requirement.
    pub text: String,
    /// The parts of the requirement that have a basis and a level of their own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<PartRow>,
    /// The basis: stated, edition, derived, online or assumed.
    pub basis: String,
    /// The level: must, should or info.
    pub level: String,
    /// Why nothing judges the requirement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub excluded: Option<String>,
    /// Document, edition and section.
    pub sources: Vec<String>,
    /// Errata (contradictions and open questions of the manuals) that concern the requirement.
    pub errata: Vec<String>,
    /// The rulings on these errata.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rulings: Vec<RulingRow>,
    /// Vectors and sequences that must be accepted.
    pub accepted: Vec<String>,
    /// Vectors and sequences that must be rejected.
    pub rejected: Vec<String>,
    /// Cases of the suite for a target or captured traffic, and scenarios for a client. A case for
    /// a codec is listed as its vector or sequence, in `accepted` or `rejected`.
    pub cases: Vec<String>,
    /// Tests of the simulated CNC, in `tests/simulator`.
    pub tests: Vec<&'static str>,
    /// Fuzz targets for the streams and sequences of `accepted` and `rejected`; also those for the
    /// dispatch of functions, if the requirement defines a function or one of these streams is the
    /// request of a function.
    pub fuzz_targets: BTreeSet<&'static str>,
}

/// A part of a requirement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct PartRow {
    pub text: String,
    pub basis: String,
    pub level: String,
}

/// The ruling on an erratum.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RulingRow {
    pub erratum: String,
    pub title: String,
    pub ruling: String,
}

/// The cases of the suite, the scenarios for clients, and the cases of captured traffic.
pub(crate) fn cases() -> Vec<Case> {
    let mut cases = suite::cases();
    cases.extend(client_suite::scenarios().iter().map(client_suite::Scenario::case));
    cases.extend(captured_cases());
    cases
}

/// All requirements, in the order of the catalogue.
pub fn matrix() -> Vec<RequirementRow> {
    let cases = cases();
    requirements().iter().map(|requirement| row(requirement, &cases)).collect()
}

fn row(requirement: &Requirement, cases: &[Case]) -> RequirementRow {
    let id = requirement.id.as_str();
    let (mut accepted, mut rejected) = (Vec::new(), Vec::new());
    let (mut streams, mut names) = (BTreeSet::new(), BTreeSet::new());
    for vector in vectors().iter().filter(|vector| vector.cited().contains(&requirement)) {
        let list = if vector.is_accepted() { &mut accepted } else { &mut rejected };
        list.push(vector.id.clone());
        streams.extend(Stream::by_name(&vector.stream));
        names.insert(vector.stream.as_str());
    }
    let checks =
        SIMULATOR_CHECKS.iter().filter(|(_, clauses)| clauses.iter().any(|one| one.as_str() == id));
    let mut tests: Vec<&str> = checks.map(|(name, _)| *name).collect();
    for sequence in sequences().iter().filter(|one| one.cited().contains(&requirement)) {
        let has_steps =
            matches!(sequence.given, SequenceInput::Streaming(_) | SequenceInput::Service(_));
        if has_steps && !tests.contains(&SEQUENCES) {
            tests.push(SEQUENCES);
        }
        let list = if sequence.is_accepted() { &mut accepted } else { &mut rejected };
        list.push(sequence.id.clone());
        names.insert(sequence.kind());
    }
    let of_target = cases.iter().filter(|case| case.needs != Needs::Codec);
    let judging = of_target.filter(|case| case.requirements.contains(&id));
    let called = Function::ALL.iter().map(|function| function.spec());
    let dispatched = called.filter(|spec| {
        spec.clause == id || spec.request.is_some_and(|stream| streams.contains(&stream))
    });
    let mut fuzz_targets = fuzzed::targets(names);
    if dispatched.count() > 0 {
        fuzz_targets.extend(fuzzed::FUNCTIONS);
    }
    RequirementRow {
        id: requirement.id.clone(),
        title: requirement.title.clone(),
        text: requirement.text.clone(),
        parts: requirement
            .parts
            .iter()
            .map(|part| PartRow {
                text: part.text.clone(),
                basis: format!("{:?}", part.basis).to_lowercase(),
                level: format!("{:?}", part.level).to_lowercase(),
            })
            .collect(),
        basis: format!("{:?}", requirement.basis).to_lowercase(),
        level: format!("{:?}", requirement.level).to_lowercase(),
        excluded: requirement.excluded.clone(),
        sources: requirement
            .sources
            .iter()
            .map(|source| {
                let words = [&source.document, &source.edition, "§"].join(" ");
                format!("{}{}", words.replace("  ", " "), source.section)
            })
            .collect(),
        errata: requirement.errata.clone(),
        rulings: requirement.errata.iter().filter_map(|id| ruling(id)).collect(),
        accepted,
        rejected,
        cases: judging.map(|case| case.id.clone()).collect(),
        tests,
        fuzz_targets,
    }
}

fn ruling(id: &str) -> Option<RulingRow> {
    let found = erratum(id)?;
    let (title, ruling) = (found.title.clone(), found.ruling.clone());
    Some(RulingRow { erratum: id.to_owned(), title, ruling })
}

/// Maximum width in characters of a line of text, without the name before it.
const WIDTH: usize = 88;

fn joined(names: &BTreeSet<&str>, between: &str) -> String {
    names.iter().copied().collect::<Vec<_>>().join(between)
}

fn paragraph(out: &mut String, name: &str, words: &str) {
    for (place, line) in wrap(words, WIDTH).iter().enumerate() {
        let name = if place == 0 { name } else { "" };
        let _ = writeln!(out, "  {name:<8}  {line}");
    }
}

/// Formats an erratum as text: its readings, the ruling, the open question, and the requirements,
/// vectors and sequences that cite the erratum.
pub fn erratum_to_text(erratum: &Erratum) -> String {
    let Erratum { id, title, readings, ruling, status, question } = erratum;
    let mut text = format!("{id}  {title} ({})\n", format!("{status:?}").to_lowercase());
    for Interpretation { document, edition, section, reading } in readings {
        let place = [document.as_str(), edition].join(" ");
        paragraph(&mut text, "reading", &format!("{} §{section}: {reading}", place.trim_end()));
    }
    paragraph(&mut text, "ruling", ruling);
    paragraph(&mut text, "question", question.as_deref().unwrap_or_default());
    let citing = requirements().iter().filter(|one| one.errata.contains(id)).map(|one| &one.id);
    let vectors = vectors().iter().filter(|one| one.errata.contains(id)).map(|one| &one.id);
    let sequences = sequences().iter().filter(|one| one.errata.contains(id)).map(|one| &one.id);
    let citing: Vec<&str> = citing.chain(vectors).chain(sequences).map(String::as_str).collect();
    paragraph(&mut text, "cited by", &citing.join(", "));
    text
}

/// Formats the matrix as text, with the lists of each requirement below it.
pub fn to_text(rows: &[RequirementRow]) -> String {
    let mut text = String::new();
    for row in rows {
        // Writing to a String does not fail.
        let _ = writeln!(text, "{}  {} ({}, {})", row.id, row.title, row.level, row.basis);
        paragraph(&mut text, "text", &row.text);
        for part in &row.parts {
            let PartRow { text: words, basis, level } = part;
            paragraph(&mut text, "part", &format!("{words} ({level}, {basis})"));
        }
        for RulingRow { erratum, title, ruling } in &row.rulings {
            paragraph(&mut text, "ruling", &format!("{erratum} {title}: {ruling}"));
        }
        if let Some(why) = &row.excluded {
            paragraph(&mut text, "excluded", why);
        }
        for (name, list) in [
            ("sources", &row.sources),
            ("accepted", &row.accepted),
            ("rejected", &row.rejected),
            ("cases", &row.cases),
        ] {
            paragraph(&mut text, name, &list.join(", "));
        }
        paragraph(&mut text, "tests", &row.tests.join(", "));
        paragraph(&mut text, "fuzzed", &joined(&row.fuzz_targets, ", "));
    }
    text
}

/// Formats the matrix as a Markdown table with the numbers of vectors, cases and tests.
pub fn to_markdown(rows: &[RequirementRow]) -> String {
    let mut text = String::from(
        "| requirement | level | basis | sources | errata | accepted | rejected | cases | tests | fuzzed |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows {
        let count = |len: usize| if len == 0 { String::new() } else { len.to_string() };
        let title = row.title.replace('|', "\\|");
        let excluded = row.excluded.as_ref().map_or("", |_| " (excluded)");
        let _ = writeln!(
            text,
            "| {} {title}{excluded} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            row.id,
            row.level,
            row.basis,
            row.sources.join("<br>"),
            row.errata.join(" "),
            count(row.accepted.len()),
            count(row.rejected.len()),
            count(row.cases.len()),
            count(row.tests.len()),
            joined(&row.fuzz_targets, " "),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each requirement that is observable in a codec has an accepted vector or sequence, a case, a
    /// test of the simulated CNC, or a reason why it is excluded.
    #[test]
    fn every_requirement_is_verified_or_excluded() {
        let rows = matrix();
        assert_eq!(rows.len(), requirements().len());
        let listed: usize = rows.iter().map(|row| row.accepted.len() + row.rejected.len()).sum();
        let vectors: usize = vectors().iter().map(|vector| vector.cited().len()).sum();
        let sequences: usize = sequences().iter().map(|one| one.cited().len()).sum();
        assert_eq!(listed, vectors + sequences);
        for row in &rows {
            let by_bytes =
                !row.accepted.is_empty() || !row.cases.is_empty() || !row.tests.is_empty();
            let live = requirements().iter().any(|one| {
                one.id == row.id && !one.observable.contains(&ads_cnc_vectors::Observable::Codec)
            });
            assert!(by_bytes || row.excluded.is_some() || live, "{}", row.id);
        }
    }

    /// All formats have all requirements, and the sections have all functions and the types of all
    /// streams.
    #[test]
    fn all_formats_have_all_rows() {
        let rows = matrix();
        let (text, table, sections) = (to_text(&rows), to_markdown(&rows), to_sections(&rows));
        let words: BTreeSet<&str> = sections.split([' ', '`']).collect();
        for row in &rows {
            assert!(text.contains(&format!("{}  {}", row.id, row.title)), "{}", row.id);
            assert!(table.contains(&format!("| {} ", row.id)), "{}", row.id);
            assert!(words.contains(&*row.id), "{}", row.id);
        }
        assert_eq!(table.lines().count(), rows.len() + 2);
        for function in Function::ALL {
            assert!(words.contains(&*format!("{function:?}")), "{function:?}");
        }
        for stream in Stream::all() {
            let types = types::of_stream(stream);
            assert!(types.iter().all(|name| words.contains(name)), "{stream}");
        }
    }
}
