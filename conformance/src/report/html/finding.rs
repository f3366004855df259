//! A check that did not pass and its bytes, in the form that the template needs.

use serde::Serialize;

use crate::judge::Verdict;
use crate::report::bytes::ShownField;
use crate::report::display::worded;
use crate::report::document::{EvidenceReport, FailureReport};
use crate::report::{BytesReport, FieldReport};
use crate::text::hex::{character, compact};
use crate::text::shorten;

#[derive(Serialize)]
pub(super) struct FailureView {
    verdict: Verdict,
    word: String,
    clauses: Vec<FailureReport>,
    expected: String,
    found: String,
    more: usize,
    evidence: Option<EvidenceView>,
}

#[derive(Serialize)]
struct EvidenceView {
    call: String,
    result: String,
    sent: Option<BytesView>,
    received: Option<BytesView>,
    expected: Option<BytesView>,
    /// The headers and service fields of the request and the reply, if the check is about the
    /// frames; otherwise empty.
    frames: Vec<Vec<BytesView>>,
    frame_sent: String,
    frame_received: String,
}

#[derive(Serialize)]
struct BytesView {
    stream: Option<String>,
    length: usize,
    rows: Vec<RowView>,
    faults: Vec<String>,
}

#[derive(Serialize, Default)]
struct RowView {
    /// Number of omitted items; if not 0, all other fields are empty.
    more: usize,
    offset: usize,
    bytes: Vec<ByteView>,
    /// Number of omitted zeros after the bytes.
    zeros: usize,
    field: String,
    value: String,
    meaning: String,
    differs: bool,
    /// The expected field.
    instead: Option<Box<RowView>>,
}

#[derive(Serialize)]
struct ByteView {
    hex: String,
    character: char,
    differs: bool,
}

pub(super) fn finding(all: &[&FailureReport]) -> Option<FailureView> {
    let first = *all.first()?;
    let is_of_frames = all.iter().any(|one| one.is_of_frames());
    Some(FailureView {
        verdict: first.verdict,
        word: worded(first.verdict, first.waived),
        clauses: all
            .iter()
            .map(|&failure| FailureReport { evidence: None, ..failure.clone() })
            .collect(),
        expected: shorten(&first.expected, TEXT_MAX),
        found: shorten(&first.found, TEXT_MAX),
        more: first.more,
        evidence: first.evidence.as_ref().map(|one| evidence(one, is_of_frames)),
    })
}

/// Maximum number of characters of an expected and of an actual result.
const TEXT_MAX: usize = 400;

fn evidence(evidence: &EvidenceReport, is_of_frames: bool) -> EvidenceView {
    let EvidenceReport {
        call, result, sent, received, expected, frame_sent, frame_received, ..
    } = evidence;
    // If the received and the expected fields have the same offsets, show each expected field that
    // differs below the received field.
    let fits = received.as_ref().zip(expected.as_ref()).is_some_and(|(received, expected)| {
        let places = |bytes: &BytesReport| -> Vec<usize> {
            bytes.fields.iter().map(|field| field.offset).collect()
        };
        places(received) == places(expected)
    });
    let is_same =
        sent.as_ref().map(BytesReport::bytes) == received.as_ref().map(BytesReport::bytes);
    let below = expected.as_ref().filter(|_| fits);
    let frame = |parts: Vec<BytesReport>| parts.iter().map(|part| view(part, None)).collect();
    EvidenceView {
        call: call.clone(),
        result: result.clone(),
        sent: sent.as_ref().filter(|_| !is_same).map(|bytes| view(bytes, None)),
        received: received.as_ref().map(|bytes| view(bytes, below)),
        expected: expected.as_ref().filter(|_| !fits).map(|bytes| view(bytes, None)),
        frames: if is_of_frames { evidence.frames().map(frame).into() } else { Vec::new() },
        frame_sent: frame_sent.clone(),
        frame_received: frame_received.clone(),
    }
}

fn view(bytes: &BytesReport, expected: Option<&BytesReport>) -> BytesView {
    let instead = |field: &FieldReport| {
        let fields = expected.map(|expected| expected.fields.as_slice()).unwrap_or_default();
        let mut there = fields.iter().filter(|one| one.offset == field.offset);
        there.find(|one| !one.differs.is_empty() || !field.differs.is_empty())
    };
    let row_of = |shown| match shown {
        ShownField::More(more) => RowView { more, ..RowView::default() },
        ShownField::Field(field) => {
            RowView { instead: instead(field).map(|one| Box::new(row(one))), ..row(field) }
        }
    };
    BytesView {
        stream: bytes.stream.clone(),
        length: bytes.length,
        rows: bytes.visible_fields().into_iter().map(row_of).collect(),
        faults: bytes.faults.clone(),
    }
}

/// Maximum number of unmarked zeros shown at the end of a field.
const ZEROS: usize = 8;

fn row(field: &FieldReport) -> RowView {
    let bytes = field.bytes();
    let used = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
    let marked = field.differs.iter().max().map_or(0, |last| last + 1);
    let shown = used.max(marked) + ZEROS;
    RowView {
        more: 0,
        offset: field.offset,
        zeros: bytes.len().saturating_sub(shown),
        bytes: bytes
            .iter()
            .take(shown)
            .enumerate()
            .map(|(place, &byte)| ByteView {
                hex: compact::show(&[byte]),
                character: character(byte),
                differs: field.differs.contains(&place),
            })
            .collect(),
        field: field.field.clone(),
        value: field.value.clone(),
        meaning: field.meaning.clone(),
        differs: !field.differs.is_empty(),
        instead: None,
    }
}
