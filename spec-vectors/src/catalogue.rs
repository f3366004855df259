//! Documents, requirements and errata: one type for each JSON object. Unknown fields are errors.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A manual, or the public help pages of the vendors, with the short name that sources use.
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

/// A section of a document, cited as a source.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section number, or a description if the document has no numbers.
    pub section: String,
    /// The example within the section; only in the provenance of a vector or sequence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub example: Option<String>,
}

/// Where a statement comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Every edition that covers the subject states it.
    Stated,
    /// The editions differ; the text states how.
    Edition,
    /// It follows from a statement or from a printed example.
    Derived,
    /// From the vendors' public help pages.
    Online,
    /// No document states it; this project decided.
    Assumed,
}

/// The consequence of violating a clause, from the most to the least severe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// A failure.
    Must,
    /// A warning.
    Should,
    /// A difference, which never counts as a failure.
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
    /// By querying a running CNC.
    Live,
}

/// A statement that belongs to a requirement but has its own basis and level.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// The ID of the requirement, a dot and a number, such as `VAR-4.2`. Never reused.
    pub id: String,
    /// The statement.
    pub text: String,
    /// Its own basis.
    pub basis: Basis,
    /// Its own level.
    pub level: Level,
}

/// One obligation of an implementation.
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
    /// The part of the ID before the number.
    pub area: String,
    /// A few words.
    pub title: String,
    /// The obligation, with its offsets and limits.
    pub text: String,
    /// The sections that state it; empty if no document does.
    pub sources: Vec<Source>,
    /// Basis of the text.
    pub basis: Basis,
    /// Level of the text.
    pub level: Level,
    /// Why it is binding although no manual states it: a ruling of this project.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ruling: Option<String>,
    /// Statements that belong to the requirement but have another basis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
    /// How it can be judged; at least one way.
    pub observable: Vec<Observable>,
    /// IDs of the errata that affect it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// Its vectors have still to be added.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub pending: bool,
    /// Why no bytes break it, although it can be judged from bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_reject: Option<String>,
    /// Why nothing judges it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub excluded: Option<String>,
}

/// A requirement or a part of one, as vectors and sequences cite it.
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

    /// The text of the cited requirement or part.
    pub fn text(&self) -> &'static str {
        self.part.map_or(&self.requirement.text, |part| &part.text)
    }

    /// The basis of the cited requirement or part.
    pub fn basis(&self) -> Basis {
        self.part.map_or(self.requirement.basis, |part| part.basis)
    }

    /// The level of the cited requirement or part.
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

/// An assumption that a vector or a sequence needs and that no document states.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assumption {
    /// The assumption.
    pub text: String,
    /// Whether the expected outcome rests on it. If not, it only supplies a circumstance.
    pub decides: bool,
    /// Whether only the bytes that an encoder writes rest on it, and not the value that a decoder reads.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub encodes: bool,
    /// The only part of the outcome that rests on it; `None` for the whole outcome.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<About>,
}

/// The part of an accepted vector's outcome that rests on an assumption.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum About {
    /// How a text ends: whether a NUL ends it, and the bytes that follow. Its characters do not rest on this.
    End,
    /// Whether the bytes are accepted, and how many bytes are written for a value: for example, a
    /// number may have another width. The value of accepted bytes does not rest on this.
    Acceptance,
    /// Which characters the bytes of a text have. Only the texts rest on this.
    Characters,
    /// What an undocumented code of a type or an access means, and whether it is kept. Only the fields with
    /// these codes rest on this.
    Codes,
}

/// The weakest level among these clauses; [`Level::Info`] if an assumption decides.
pub(crate) fn level(cited: &[String], assumed: &[Assumption]) -> Level {
    if assumed.iter().any(|one| one.decides) {
        return Level::Info;
    }
    levels(cited).max().unwrap_or(Level::Info)
}

/// The weakest level among the clauses that a document states.
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

/// One of the readings that contradict each other.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Short name of the document.
    pub document: String,
    /// Its edition; empty if none is printed.
    pub edition: String,
    /// Section, or several.
    pub section: String,
    /// The fact in question, as this section states it.
    pub reading: String,
}

/// Whether a ruling is final.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Decided provisionally: only a running CNC can answer the question.
    Open,
    /// Decided.
    Ruled,
}

/// A contradiction in the documents, and the ruling on it.
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
    /// Each reading with its section.
    pub readings: Vec<Reading>,
    /// The decision.
    pub ruling: String,
    /// Whether the ruling is final.
    pub status: Status,
    /// The question for a running CNC; only for an open erratum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub question: Option<String>,
}
