//! Documents, requirements and errata: one type for each JSON object. Unknown fields are errors.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A manual, or the public help pages of the vendors, with the short name that sources use.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Short name, such as `ads-en`.
    pub document: String,
    /// Edition; empty if the document prints no edition.
    pub edition: String,
    /// Title.
    pub title: String,
    /// Language: `en` or `de`.
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
    /// Edition of the document; empty if the document prints no edition.
    pub edition: String,
    /// Section number, or a description if the document has no numbers.
    pub section: String,
    /// The example within the section; only in the provenance of a vector or sequence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub example: Option<String>,
}

/// The origin of a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// Every edition that covers the subject contains the statement.
    Stated,
    /// The editions differ; the text of the requirement states how.
    Edition,
    /// The statement follows from a statement of the documents or from a printed example.
    Derived,
    /// Only the vendors' public help pages contain the statement.
    Online,
    /// No document contains the statement; this project has decided.
    Assumed,
}

/// The consequence of violating a clause, from the most to the least severe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Violating the clause is a failure.
    Must,
    /// Violating the clause is a warning.
    Should,
    /// Violating the clause is a difference, which never counts as a failure.
    Info,
}

/// How a requirement can be judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Observable {
    /// From bytes alone, by encoding or decoding them.
    Codec,
    /// From recorded traffic.
    Wire,
    /// By querying a running CNC.
    Live,
}

/// A statement that belongs to a requirement but has its own basis and level.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequirementPart {
    /// ID: that of the requirement, a dot and a number, such as `VAR-4.2`. An ID is never reused.
    pub id: String,
    /// The statement.
    pub text: String,
    /// Basis of the statement.
    pub basis: Basis,
    /// Level of the statement.
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
    /// ID: area and number, such as `VAR-4`. An ID is never reused.
    pub id: String,
    /// The part of the ID before the number.
    pub area: String,
    /// Title of a few words.
    pub title: String,
    /// The obligation, with its offsets and limits.
    pub text: String,
    /// The sections that state the requirement; for an assumed requirement, the passages that are
    /// interpreted, if any.
    pub sources: Vec<Source>,
    /// Basis of the text.
    pub basis: Basis,
    /// Level of the text.
    pub level: Level,
    /// The reason why the requirement is binding although no manual states it: a ruling of this project.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ruling: Option<String>,
    /// Statements that belong to the requirement; most of them have another basis.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<RequirementPart>,
    /// The ways in which the requirement can be judged; at least one.
    pub observable: Vec<Observable>,
    /// IDs of the errata that affect the requirement.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errata: Vec<String>,
    /// The reason why no bytes violate the requirement, although it can be judged from bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_reject: Option<String>,
    /// The reason why no check judges the requirement.
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
    pub part: Option<&'static RequirementPart>,
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
    /// Whether the expected outcome rests on the assumption. If not, the assumption only supplies a
    /// circumstance.
    pub decides: bool,
    /// Whether only the bytes that an encoder writes rest on the assumption, and not the value that a
    /// decoder reads.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub encodes: bool,
    /// The only part of the outcome that rests on the assumption; `None` if the whole outcome does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<About>,
}

/// The part of an accepted vector's outcome that rests on an assumption.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum About {
    /// How a text ends: whether a NUL ends the text, and which bytes follow the NUL. The characters of the
    /// text do not rest on the assumption.
    End,
    /// Whether the bytes are accepted, and how many bytes are written for a value: for example, a
    /// number may have another width. The value of accepted bytes does not rest on the
    /// assumption.
    Acceptance,
    /// Which characters the bytes of a text represent. Only the values of texts rest on the assumption.
    Characters,
    /// The meaning of an undocumented code of a type or an access, and whether the code is kept. Only the
    /// fields with these codes rest on the assumption.
    Codes,
}

/// The weakest level among the cited clauses; [`Level::Info`] if an assumption decides the outcome.
pub(crate) fn level(cited: &[String], assumed: &[Assumption]) -> Level {
    if assumed.iter().any(|one| one.decides) {
        return Level::Info;
    }
    levels(cited).max().unwrap_or(Level::Info)
}

/// The weakest level among the cited clauses that a document states.
pub(crate) fn stated_level(cited: &[String]) -> Level {
    levels(cited).filter(|level| *level != Level::Info).max().unwrap_or(Level::Info)
}

fn levels(cited: &[String]) -> impl Iterator<Item = Level> {
    cited.iter().filter_map(|id| crate::clause(id)).map(|one| one.level())
}

/// The requirements of the cited clauses, each only once.
pub(crate) fn requirements_of(cited: &[String]) -> Vec<&'static Requirement> {
    let mut all: Vec<&Requirement> = Vec::new();
    for clause in cited.iter().filter_map(|id| crate::clause(id)) {
        if !all.contains(&clause.requirement) {
            all.push(clause.requirement);
        }
    }
    all
}

/// A reading: what a document states about the question of an erratum.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Interpretation {
    /// Short name of the document.
    pub document: String,
    /// Edition of the document; empty if the document prints no edition.
    pub edition: String,
    /// The section, or a list of sections.
    pub section: String,
    /// The fact in question, as this section states it.
    pub reading: String,
}

/// Whether a ruling is final.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// The ruling is provisional: only a running CNC can decide the question.
    Open,
    /// The ruling is final.
    Ruled,
}

/// A place where the documents contradict each other or leave a question open, and the ruling on
/// it.
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
    /// ID: `E-` and a number. An ID is never reused.
    pub id: String,
    /// Title of a few words.
    pub title: String,
    /// The readings, each with its section.
    pub readings: Vec<Interpretation>,
    /// The decision between the readings.
    pub ruling: String,
    /// Whether the ruling is final.
    pub status: Status,
    /// The question for a running CNC; only for an open erratum.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub question: Option<String>,
}
