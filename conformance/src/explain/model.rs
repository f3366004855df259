//! What is asked, and what an explanation consists of.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::layout::{Field, Stream};
use ads_cnc::operation::Service;
use ads_cnc::{Error, ErrorKind};
use ads_cnc_vectors::requirement;
use serde::Serialize;

use crate::codec::class;
use crate::judge::Exit;
use crate::text::hex::spaced;
use crate::values::ValueFormat;

/// What the bytes are.
#[derive(Clone, Debug)]
pub struct ExplainQuery {
    /// A stream, data of a service, or frames.
    pub subject: ExplainSubject,
    /// How values and contents are to be read, which no stream says itself.
    pub values: ValueFormat,
}

/// What the bytes are.
#[derive(Clone, Debug)]
pub enum ExplainSubject {
    Stream(Stream),
    /// What goes in or comes out at this place.
    Place(ServiceAddress),
    /// There are none: what is at this place.
    Address(ServiceAddress),
    /// AMS/TCP frames, one after the other. The place is that of replies whose request is not
    /// among them.
    Frames(Option<ServiceAddress>),
}

/// Where a service is asked for, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub struct ServiceAddress {
    pub port: Option<AmsPort>,
    /// The service; without it, that of the function at this address.
    pub service: Option<Service>,
    pub group: IndexGroup,
    pub offset: IndexOffset,
    /// Whether the bytes are the answer.
    pub reply: bool,
}

/// Bytes, explained. As JSON it is one document, whose shape has a number.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// Number of this structure.
    pub format: u32,
    /// Bytes given.
    pub length: usize,
    pub outcome: ExplanationOutcome,
    /// Streams in the order of their bytes; what a service carries follows it.
    pub parts: Vec<ExplainedStream>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ExplanationOutcome {
    /// Every part is explained.
    Explained,
    /// Something is wrong with the bytes.
    Faulty,
    /// Nothing is wrong, but of the bytes nothing is known.
    Unknown,
}

impl ExplanationOutcome {
    /// How a process ends with it.
    pub const fn exit(self) -> Exit {
        match self {
            Self::Explained => Exit::Success,
            Self::Faulty => Exit::Failure,
            Self::Unknown => Exit::Nothing,
        }
    }
}

/// A stream.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ExplainedStream {
    pub title: String,
    /// The stream's name; none for bytes that no table describes.
    pub stream: Option<&'static str>,
    /// The requirement that defines it.
    pub clause: Option<&'static str>,
    /// Its sources: document, edition, section.
    pub sources: Vec<String>,
    /// Where the stream begins in the bytes given.
    pub at: usize,
    pub length: usize,
    /// Where it is sent to or from.
    pub address: Option<ExplainedAddress>,
    /// Its fields, up to the first fault.
    pub rows: Vec<ExplainedField>,
    pub faults: Vec<ExplainedFault>,
    /// The bytes from the fault on.
    pub unread: Option<Unread>,
    /// What else there is to say.
    pub notes: Vec<String>,
}

/// A field, or one item of a field with several.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedField {
    pub offset: usize,
    /// Number of bytes.
    pub length: usize,
    /// The bytes in hex.
    pub hex: String,
    /// The field's name.
    pub field: String,
    /// Which record of a stream of records, else 0.
    pub record: u32,
    /// Which item of a field with several, else 0.
    pub item: u32,
    /// Name of the type.
    #[serde(rename = "type")]
    pub ty: String,
    pub value: String,
    /// What the field says.
    pub meaning: &'static str,
    /// The requirement that defines the field.
    pub clause: &'static str,
    /// Whether a fault is here.
    pub faulty: bool,
    /// What the value says.
    pub notes: Vec<String>,
    /// The bytes are a part of their own.
    #[serde(skip)]
    pub below: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct ExplainedFault {
    /// Its class, as in vectors; `nc-line` and `nc-word` for NC text.
    pub class: &'static str,
    /// The field; `stream` for the stream as a whole.
    pub field: String,
    pub offset: usize,
    /// What was expected, in the unit of the class.
    pub expected: Option<u32>,
    pub found: Option<u32>,
    /// All of it in words.
    pub text: String,
}

/// Bytes that were not read.
#[derive(Clone, Debug, Serialize)]
pub struct Unread {
    pub offset: usize,
    /// Number of bytes.
    pub length: usize,
    /// The bytes in hex.
    pub hex: String,
}

/// Where a service is asked for, taken apart.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedAddress {
    /// The AMS port, if it is known.
    pub port: Option<u16>,
    /// The service, if it is known.
    pub service: Option<String>,
    pub index_group: u32,
    pub index_offset: u32,
    /// What the group addresses.
    pub group: String,
    /// What the offset addresses.
    pub offset: String,
    pub function: Option<FunctionReport>,
    /// Other meanings, and why there is no function.
    pub notes: Vec<String>,
}

/// A function of the CNC.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionReport {
    pub name: &'static str,
    /// The service it takes.
    pub service: String,
    /// The task that serves it.
    pub task: String,
    /// The task's AMS port.
    pub port: u16,
    /// What it does to the machine: `query`, `write` or `motion`.
    pub effect: String,
    /// The requirement that defines it.
    pub clause: &'static str,
    /// Its sources.
    pub section: String,
    /// The stream that goes in.
    pub request: Option<&'static str>,
    /// The stream that comes out.
    pub reply: Option<&'static str>,
}

impl Explanation {
    pub(super) fn new(length: usize, parts: Vec<ExplainedStream>) -> Self {
        let faulty = parts.iter().any(|part| !part.faults.is_empty());
        let known = parts.iter().any(|part| part.stream.is_some() || part.has_function());
        let outcome = match (faulty, known) {
            (true, _) => ExplanationOutcome::Faulty,
            (_, true) => ExplanationOutcome::Explained,
            _ => ExplanationOutcome::Unknown,
        };
        Self { format: 1, length, outcome, parts }
    }
}

impl ExplainedStream {
    pub(super) fn new(stream: Stream, at: usize, bytes: &[u8]) -> Self {
        let layout = stream.layout();
        Self {
            title: layout.title.to_owned(),
            stream: Some(layout.name),
            clause: Some(layout.clause),
            sources: sources(layout.clause),
            at,
            length: bytes.len(),
            ..Self::default()
        }
    }

    /// Bytes that no table describes.
    pub(super) fn opaque(title: String, at: usize, bytes: &[u8]) -> Self {
        let mut part = Self { title, at, length: bytes.len(), ..Self::default() };
        if !bytes.is_empty() {
            part.rows.push(ExplainedField::new(0, bytes, "data", String::new()));
        }
        part
    }

    fn has_function(&self) -> bool {
        self.address.as_ref().is_some_and(|address| address.function.is_some())
    }

    /// Adds a fault and marks the row it is in.
    pub(super) fn push_fault(&mut self, fault: ExplainedFault) {
        let at = fault.offset;
        let here = |row: &&mut ExplainedField| {
            row.offset == at
                || (row.offset < at && at < row.offset.saturating_add(row.length.max(1)))
        };
        if let Some(row) = self.rows.iter_mut().find(here) {
            row.faulty = true;
        }
        self.faults.push(fault);
    }

    /// What follows offset `end` of the stream was not read.
    pub(super) fn leave(&mut self, end: usize, bytes: &[u8]) {
        let rest = bytes.get(end..).unwrap_or_default();
        self.unread = (!rest.is_empty()).then(|| Unread {
            offset: end,
            length: rest.len(),
            hex: spaced(rest),
        });
    }
}

impl ExplainedField {
    pub(super) fn new(offset: usize, bytes: &[u8], field: &str, value: String) -> Self {
        Self {
            offset,
            length: bytes.len(),
            hex: spaced(bytes),
            field: field.to_owned(),
            record: 0,
            item: 0,
            ty: "BYTE[]".to_owned(),
            value,
            meaning: "",
            clause: "",
            faulty: false,
            notes: Vec::new(),
            below: false,
        }
    }
}

impl ExplainedFault {
    /// The codec's error; its offset counted from `base` bytes before the stream.
    pub(super) fn of(error: &Error, base: usize) -> Self {
        let field: Field = error.field();
        let offset = size(error.offset()).saturating_sub(base);
        // Without the stream, which the part names.
        let whole = error.to_string();
        let reason = whole.split_once(": ").map_or(whole.as_str(), |(_, rest)| rest);
        let reason = reason.split_once(": ").map_or(reason, |(_, rest)| rest);
        let name = field.name();
        let numbers = !matches!(error.kind(), ErrorKind::Missing);
        Self {
            class: class(error),
            field: name.to_owned(),
            offset,
            expected: numbers.then(|| error.expected()),
            found: numbers.then(|| error.found()),
            text: format!("{name} at offset {offset}: {reason}"),
        }
    }
}

/// A number of bytes as memory counts them.
pub(super) fn size(number: u32) -> usize {
    usize::try_from(number).unwrap_or(usize::MAX)
}

/// The sources of a requirement.
pub(crate) fn sources(clause: &str) -> Vec<String> {
    let Some(requirement) = requirement(clause) else { return Vec::new() };
    // One entry for each document, with all its sections.
    let mut all: Vec<(&str, String)> = Vec::new();
    for source in &requirement.sources {
        let (document, section) = (source.document.as_str(), source.section.as_str());
        let known = all.iter_mut().find(|(known, _)| *known == document);
        match (known, source.edition.as_str()) {
            (Some((_, text)), "") => text.push_str(&format!(", {section}")),
            (Some((_, text)), _) => text.push_str(&format!(", §{section}")),
            (None, "") => all.push((document, format!("{document}, {section}"))),
            (None, edition) => all.push((document, format!("{document} {edition} §{section}"))),
        }
    }
    all.into_iter().map(|(_, text)| text).collect()
}
