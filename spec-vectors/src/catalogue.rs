//! Documents, requirements and errata, one type for each shape of their JSON. Unknown fields are errors.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A manual, or the vendors' public help pages, under the short name that sources use.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Short name, such as `ads-en`.
    pub document: String,
    /// Edition; empty if none is printed.
    pub edition: String,
    /// Title as printed.
    pub title: String,
    /// `en` or `de`.
    pub language: String,
    /// The sections that can be cited, in their order.
    pub sections: Vec<String>,
}

/// A place in a document.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section number, or a description where there are no numbers.
    pub section: String,
    /// Which example of the section; only in the provenance of a vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub example: Option<String>,
}

/// Where a statement comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Every edition that covers the subject says so.
    Stated,
    /// The editions differ, and the text says how.
    Edition,
    /// It follows from something stated or from a printed example.
    Derived,
    /// From the vendors' public help pages.
    Online,
    /// Nobody says; decided by this project.
    Assumed,
}

/// What not doing it means, from the gravest to the least.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// A failure.
    Must,
    /// A warning.
    Should,
    /// A difference worth naming, no more.
    Info,
}

/// How a requirement can be judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Observable {
    /// From bytes alone.
    Codec,
    /// In traffic.
    Wire,
    /// By asking a running CNC.
    Live,
}

/// A part of a requirement that stands on a basis of its own.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// ID of its requirement, a dot and a number, such as `VAR-4.2`. Never reused.
    pub id: String,
    /// What it says.
    pub text: String,
    /// Its own basis.
    pub basis: Basis,
    /// Its own level.
    pub level: Level,
}

/// One thing an implementation has to do.
///
/// ```
/// use ads_cnc_vectors::{Level, requirement};
///
/// let handle_read = requirement("VAR-11").unwrap();
/// assert_eq!((handle_read.area.as_str(), handle_read.level), ("VAR", Level::Must));
/// assert_eq!(handle_read.parts[0].level, Level::Info);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Area and number, such as `VAR-4`. Never reused.
    pub id: String,
    /// The part of the ID in front of the number.
    pub area: String,
    /// A few words.
    pub title: String,
    /// What is required, complete with offsets and limits.
    pub text: String,
    /// Where it stands; empty if it stands nowhere.
    pub sources: Vec<Source>,
    /// Basis of the text.
    pub basis: Basis,
    /// Level of the text.
    pub level: Level,
    /// Why it binds although no manual states it: a ruling of this project.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ruling: Option<String>,
    /// What belongs to the requirement on another basis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
    /// How it can be judged; at least one way.
    pub observable: Vec<Observable>,
    /// IDs of the errata that touch it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// The vectors for it are still to come.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pending: bool,
    /// Why no vector is refused for it although it can be judged from bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_reject: Option<String>,
    /// Why nothing judges it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excluded: Option<String>,
}

/// What a vector or a sequence cites: a requirement, or one of its parts.
///
/// ```
/// use ads_cnc_vectors::{Level, clause};
///
/// let nul = clause("VAR-9.1").unwrap();
/// assert_eq!((nul.requirement.id.as_str(), nul.level()), ("VAR-9", Level::Info));
/// assert_eq!(clause("VAR-9").unwrap().level(), Level::Must);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Clause {
    /// The requirement.
    pub requirement: &'static Requirement,
    /// The part; `None` if the text of the requirement itself is cited.
    pub part: Option<&'static Part>,
}

impl Clause {
    /// The ID as cited.
    pub fn id(&self) -> &'static str {
        self.part.map_or(&self.requirement.id, |part| &part.id)
    }

    /// What it says.
    pub fn text(&self) -> &'static str {
        self.part.map_or(&self.requirement.text, |part| &part.text)
    }

    /// Where it comes from.
    pub fn basis(&self) -> Basis {
        self.part.map_or(self.requirement.basis, |part| part.basis)
    }

    /// What not doing it means.
    pub fn level(&self) -> Level {
        self.part.map_or(self.requirement.level, |part| part.level)
    }
}

/// The ID of a requirement or of a part: one of the constants in [`ids`](crate::ids).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ClauseId(&'static str);

impl ClauseId {
    pub(crate) const fn new(id: &'static str) -> Self {
        Self(id)
    }

    /// Every ID, in the order of the catalogue.
    pub const fn all() -> &'static [Self] {
        crate::ids::EVERY
    }

    /// The ID as cited, such as `VAR-9.1`.
    pub const fn as_str(self) -> &'static str {
        self.0
    }
}

impl fmt::Display for ClauseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.0)
    }
}

/// What no document says but a vector or a sequence needs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assumption {
    /// The assumption.
    pub text: String,
    /// Whether the expected outcome rests on it; otherwise it only sets the scene.
    pub decides: bool,
    /// Whether the bytes that an encoder writes rest on it, though what a decoder reads does not.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub encodes: bool,
    /// What alone rests on it; `None` for the whole outcome.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<About>,
}

/// The part of an accepted vector's outcome that rests on an assumption.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum About {
    /// How texts end: whether a NUL ends them, and what follows it. Characters do not rest on it.
    End,
    /// Whether the bytes are accepted, and how many are written for a value: a number may have another width.
    /// The value of bytes that are accepted does not rest on it.
    Acceptance,
}

/// The weakest level of these clauses; [`Level::Info`] if an assumption decides.
pub(crate) fn level(cited: &[String], assumed: &[Assumption]) -> Level {
    if assumed.iter().any(|one| one.decides) {
        return Level::Info;
    }
    levels(cited).max().unwrap_or(Level::Info)
}

/// The weakest level of those of these clauses that a document states.
pub(crate) fn stated_level(cited: &[String]) -> Level {
    levels(cited).filter(|level| *level != Level::Info).max().unwrap_or(Level::Info)
}

fn levels(cited: &[String]) -> impl Iterator<Item = Level> {
    cited.iter().filter_map(|id| crate::clause(id)).map(|one| one.level())
}

/// The requirements of these clauses, each once.
pub(crate) fn requirements_of(cited: &[String]) -> Vec<&'static Requirement> {
    let mut all: Vec<&Requirement> = Vec::new();
    for clause in cited.iter().filter_map(|id| crate::clause(id)) {
        if !all.contains(&clause.requirement) {
            all.push(clause.requirement);
        }
    }
    all
}

/// One reading of a place that contradicts another, or itself.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section, or several.
    pub section: String,
    /// The fact in question, as that place has it.
    pub reading: String,
}

/// How firm a ruling is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Decided for the time being: only a running CNC can tell.
    Open,
    /// Decided.
    Ruled,
}

/// A contradiction in the documents, and what was decided.
///
/// ```
/// use ads_cnc_vectors::{Status, erratum};
///
/// let name_end = erratum("E-17").unwrap();
/// assert_eq!(name_end.status, Status::Open);
/// assert!(name_end.question.is_some());
/// assert!(name_end.readings.iter().any(|reading| reading.document == "ads-de"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// `E-` and a number. Never reused.
    pub id: String,
    /// A few words.
    pub title: String,
    /// Each reading with its place.
    pub readings: Vec<Reading>,
    /// What was decided.
    pub ruling: String,
    /// How firmly.
    pub status: Status,
    /// What a running CNC has to be asked; for those that are open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub question: Option<String>,
}
