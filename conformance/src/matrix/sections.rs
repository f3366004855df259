//! The matrix by section of the manuals.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;
use ads_cnc_vectors::{Document, Requirement, documents, requirements};

use super::types::{self, AREAS};
use super::{RequirementRow, joined};
use crate::judge::about;

const HEAD: &str = "| section | requirements | functions | types | vectors | cases | fuzz targets |\n\
                    |---|---|---|---|---|---|---|\n";

/// Formats a table of the areas, a table of the sections of each manual, and a table of the
/// requirements that cite no document.
///
/// Both editions of the manual on ADS access share one table, because their sections have the same
/// numbers.
pub fn to_sections(rows: &[RequirementRow]) -> String {
    let mut text =
        String::from("# Requirements, vectors and cases of each section of the manuals\n\n");
    text += "Written by `ads-cnc requirements --format sections` from the requirements, the vectors, the \
             codec's tables\nand the suite's cases. A vector or case is counted in each section to which it \
             refers. Vectors include sequences;\nthe number after `+` counts the vectors that must be \
             rejected. Sections that specify neither bytes nor behaviour\nare omitted.\n\n";
    text += &areas(rows);
    for document in documents().iter().filter(|document| document.document != "ads-de") {
        let editions =
            documents().iter().filter(|one| manual(&one.document) == manual(&document.document));
        let title = editions.map(titled).collect::<Vec<_>>().join(" and ");
        // Writing to a String does not fail.
        let _ = write!(text, "\n## {title}\n\n{HEAD}");
        for section in &document.sections {
            let is_source = |requirement: &Requirement| {
                requirement.sources.iter().any(|source| {
                    manual(&source.document) == manual(&document.document)
                        && source.section == *section
                })
            };
            text += &line(section, &document.document, rows, is_source);
        }
    }
    let _ = write!(text, "\n## In no document: assumed\n\n{HEAD}");
    text += &line("–", "", rows, |requirement| requirement.sources.is_empty());
    text
}

/// The table of the areas, which is also in the README.
fn areas(rows: &[RequirementRow]) -> String {
    let mut text = String::from(
        "| area | about | manual | types | requirements | vectors | cases | fuzz targets |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for one in AREAS {
        let prefix = format!("{}-", one.area);
        let found = SectionCoverage::of(rows.iter().filter(|row| row.id.starts_with(&prefix)));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} |",
            one.area,
            about(one.area),
            one.chapters,
            one.modules,
            found.ids.len(),
            found.vectors(),
            found.cases(),
            found.fuzz_targets.len(),
        );
    }
    text
}

fn titled(document: &Document) -> String {
    format!("{} {}", document.document, document.edition).trim_end().to_owned()
}

/// The name of a document; for the manual on ADS access, without its language.
fn manual(document: &str) -> &str {
    document.strip_prefix("ads-").map_or(document, |_| "ads")
}

/// A set of requirements, and the vectors, cases and fuzz targets that cover them, each once.
#[derive(Default)]
struct SectionCoverage<'r> {
    ids: Vec<&'r str>,
    accepted: BTreeSet<&'r str>,
    rejected: BTreeSet<&'r str>,
    cases: BTreeSet<&'r str>,
    fuzz_targets: BTreeSet<&'r str>,
}

impl<'r> SectionCoverage<'r> {
    fn of(rows: impl Iterator<Item = &'r RequirementRow>) -> Self {
        let mut found = Self::default();
        for row in rows {
            found.ids.push(&row.id);
            found.accepted.extend(row.accepted.iter().map(String::as_str));
            found.rejected.extend(row.rejected.iter().map(String::as_str));
            found.cases.extend(row.cases.iter().map(String::as_str));
            found.fuzz_targets.extend(&row.fuzz_targets);
        }
        found
    }

    fn vectors(&self) -> String {
        match (self.accepted.len(), self.rejected.len()) {
            (0, 0) => String::new(),
            (accepted, rejected) => format!("{accepted} + {rejected}"),
        }
    }

    fn cases(&self) -> String {
        match self.cases.len() {
            0 => String::new(),
            count => count.to_string(),
        }
    }
}

fn line(
    section: &str,
    document: &str,
    rows: &[RequirementRow],
    is_source: impl Fn(&Requirement) -> bool,
) -> String {
    let sourced: BTreeSet<&str> = requirements()
        .iter()
        .filter(|requirement| is_source(requirement))
        .map(|requirement| requirement.id.as_str())
        .collect();
    let found = SectionCoverage::of(rows.iter().filter(|row| sourced.contains(row.id.as_str())));
    if found.ids.is_empty() {
        return String::new();
    }
    let functions = Function::ALL.iter().filter(|function| is_in(function, document, section));
    let functions: Vec<String> = functions.map(|function| format!("`{function:?}`")).collect();
    format!(
        "| {section} | {} | {} | {} | {} | {} | {} |\n",
        found.ids.join(" "),
        functions.join(" "),
        types_of(&found.ids),
        found.vectors(),
        found.cases(),
        joined(&found.fuzz_targets, " "),
    )
}

/// Whether the function is documented in this section.
fn is_in(function: &Function, document: &str, section: &str) -> bool {
    let place = function.spec().section;
    match (place.split_once(" … "), place.split_once(' ')) {
        (Some((first, last)), _) => manual(document) == "ads" && (first..=last).contains(&section),
        (None, Some((named, place))) => named == document && place == section,
        (None, None) => place == document || manual(document) == "ads" && place == section,
    }
}

/// The Rust types of the streams that these requirements define or that have fields of these
/// requirements; without such a stream, the modules of the requirements' areas.
fn types_of(ids: &[&str]) -> String {
    let is_about = |stream: &Stream| {
        let layout = stream.layout();
        let mut clauses = layout.fields.iter().map(|field| field.clause).chain([layout.clause]);
        clauses.any(|clause| ids.contains(&clause))
    };
    let streams = Stream::all().filter(is_about).flat_map(types::of_stream);
    let names: Vec<String> = streams.map(|name| format!("`{name}`")).collect();
    if !names.is_empty() {
        return names.join(" ");
    }
    let has = |area: &str| ids.iter().any(|id| id.split('-').next() == Some(area));
    let modules = AREAS.iter().filter(|one| has(one.area)).map(|one| one.modules);
    modules.collect::<Vec<_>>().join(", ")
}
