//! The query and the structure of an explanation.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::AmsPort;
use ads_cnc::layout::{Field, Stream};
use ads_cnc::operation::AdsService;
use ads_cnc::{Error, ErrorKind};
use ads_cnc_vectors::requirement;
use serde::Serialize;

use crate::codec::class;
use crate::exit::Exit;
use crate::number::to_usize;
use crate::text::hex::spaced;
use crate::value_format::ValueFormat;

/// The bytes or the address to explain, and the type of the values in the bytes.
#[derive(Clone, Debug)]
pub struct ExplainQuery {
    /// The kind of the bytes: a stream, data of a service, or frames; or an address without bytes.
    pub subject: ExplainSubject,
    /// The type of values and contents, which the streams do not contain.
    pub values: ValueFormat,
}

/// The kind of the bytes, or an address without bytes.
#[derive(Clone, Debug)]
pub enum ExplainSubject {
    Stream(Stream),
    /// The data of a request to this address, or of a reply from it.
    Place(ServiceAddress),
    /// An address without data.
    Address(ServiceAddress),
    /// Consecutive AMS/TCP frames, and the address for replies whose request is missing.
    Frames(Option<ServiceAddress>),
}

/// The address that an ADS service accesses, as far as it is known.
#[derive(Clone, Copy, Debug)]
pub struct ServiceAddress {
    pub port: Option<AmsPort>,
    /// The service; `None` for the service of the function at this address.
    pub service: Option<AdsService>,
    pub group: IndexGroup,
    pub offset: IndexOffset,
    /// Whether the bytes belong to the reply.
    pub reply: bool,
}

/// The explanation of bytes; in JSON, one document with a format version.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// Version of the JSON format.
    pub format: u32,
    /// Number of bytes of the input.
    pub length: usize,
    pub outcome: ExplanationOutcome,
    /// The streams in the order of their bytes; the data of a service follows the stream of the
    /// service.
    pub parts: Vec<ExplainedStream>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ExplanationOutcome {
    /// The bytes contain no error, and at least one part is a stream or has the address of a
    /// function.
    Explained,
    /// The bytes contain an error.
    Faulty,
    /// The bytes contain no error, but no part is a stream or has the address of a function.
    Unknown,
}

impl ExplanationOutcome {
    /// The exit code.
    pub const fn exit(self) -> Exit {
        match self {
            Self::Explained => Exit::Success,
            Self::Faulty => Exit::Failure,
            Self::Unknown => Exit::Nothing,
        }
    }
}

/// The explanation of a stream, of bytes that no table describes, or of an address without data.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ExplainedStream {
    pub title: String,
    /// The stream's name; `None` for bytes that no table describes, and without data.
    pub stream: Option<&'static str>,
    /// The requirement that defines the stream.
    pub clause: Option<&'static str>,
    /// The sources of the requirement: document, edition, section.
    pub sources: Vec<String>,
    /// Offset of the stream in the input in bytes.
    pub at: usize,
    pub length: usize,
    /// The address to which the stream is sent, or which returns it.
    pub address: Option<ExplainedAddress>,
    /// The fields that were read. NC text has a row for each line, and a value that fits the
    /// specified type one for each element. Bytes that no table describes have at most one row.
    pub rows: Vec<ExplainedField>,
    pub faults: Vec<ExplainedFault>,
    /// The bytes after the last field that was read, if an error in the stream ended the reading.
    pub unread: Option<Unread>,
    /// Notes about the whole stream.
    pub notes: Vec<String>,
}

/// A field, or one item of a field with several items.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedField {
    pub offset: usize,
    /// Number of bytes.
    pub length: usize,
    /// The bytes in hex.
    pub hex: String,
    /// The field's name.
    pub field: String,
    /// Index of the record in a stream of records, otherwise 0.
    pub record: u32,
    /// Index of the item, the element or the line in a field with several, otherwise 0.
    pub item: u32,
    /// Name of the type.
    #[serde(rename = "type")]
    pub ty: String,
    pub value: String,
    /// The meaning of the field; empty if no table describes the bytes, and after the first element
    /// or line.
    pub meaning: &'static str,
    /// The requirement that defines the field; empty if no table describes the bytes.
    pub clause: &'static str,
    /// Whether this field contains an error.
    pub faulty: bool,
    /// Notes about the value, such as its meaning.
    pub notes: Vec<String>,
    /// Whether the next part explains the bytes of this field as a separate stream.
    #[serde(skip)]
    pub below: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct ExplainedFault {
    /// The class of the error, as in vectors; `nc-line` or `nc-word` for an error in a line of NC
    /// text.
    pub class: &'static str,
    /// The name of the field; `stream` for the whole stream, `line 2` and so on for NC text.
    pub field: String,
    pub offset: usize,
    /// The expected number, whose unit depends on `class`, for example bytes; `None` if the error
    /// has no numbers.
    pub expected: Option<u32>,
    pub found: Option<u32>,
    /// The error as text.
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

/// The explanation of a service's address.
#[derive(Clone, Debug, Serialize)]
pub struct ExplainedAddress {
    /// The AMS port, if known.
    pub port: Option<u16>,
    /// The service, if known.
    pub service: Option<String>,
    pub index_group: u32,
    pub index_offset: u32,
    /// The meaning of the index group.
    pub group: String,
    /// The meaning of the index offset; may be empty.
    pub offset: String,
    pub function: Option<FunctionReport>,
    /// Notes, such as other meanings of the address, or the reason if no function has this address.
    pub notes: Vec<String>,
}

/// A function of the CNC.
#[derive(Clone, Debug, Serialize)]
pub struct FunctionReport {
    pub name: &'static str,
    /// The service that calls the function.
    pub service: String,
    /// The task that executes the function.
    pub task: String,
    /// The task's AMS port.
    pub port: u16,
    /// The effect of the function on the machine: `query`, `write` or `motion`.
    pub effect: String,
    /// The requirement that defines the function.
    pub clause: &'static str,
    /// The section of the manuals that documents the function, or the vendors' help pages.
    pub section: String,
    /// The name of the stream in the request; `None` if the request has no data.
    pub request: Option<&'static str>,
    /// The name of the stream in the reply; `None` if the reply has no data.
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

    /// A part for bytes that no table describes.
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

    /// Adds an error, and marks the first row that contains its offset, if any.
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

    /// Marks the bytes from offset `end` of the stream on as unread.
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
    /// Converts an error of the codec. The offset of `error` counts from `base` bytes before the
    /// stream, and the offset of the result from the start of the stream.
    pub(super) fn of(error: &Error, base: usize) -> Self {
        let field: Field = error.field();
        let offset = to_usize(error.offset()).saturating_sub(base);
        // Omit the name of the stream, because the part contains it.
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

/// The sources of a requirement: one text for each document, with edition and sections.
pub(crate) fn sources(clause: &str) -> Vec<String> {
    let Some(requirement) = requirement(clause) else { return Vec::new() };
    // Create one entry for each document, with all its sections.
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
