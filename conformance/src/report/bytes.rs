//! Bytes field by field, with marks on bytes such as those that differ from the expected bytes.

use ads_cnc::ads::{AmsHeader, FrameRef, StateFlags};
use ads_cnc::layout::Stream;
use ads_cnc::limits::AMS_TCP_HEADER_LEN;
use ads_cnc::{Decode as _, Encode as _};
use serde::{Deserialize, Serialize};

use crate::explain::{ExplainQuery, ExplainSubject, ExplainedStream, explain};
use crate::text::hex::{compact, spaced};
use crate::value_format::ValueFormat;

/// Bytes field by field.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BytesReport {
    /// Name of the stream; `None` if no stream is known for the bytes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    pub length: usize,
    /// The fields in order; together they contain all bytes.
    pub fields: Vec<FieldReport>,
    /// Errors that parsing the bytes found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<String>,
}

/// One field, or one item of a field with several items.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FieldReport {
    /// The offset in bytes in the data or, for the parts of a frame, in the frame.
    pub offset: usize,
    /// The bytes of the field in hex.
    pub hex: String,
    /// The name of the field; `?` for unreadable bytes, empty for bytes that no table describes.
    pub field: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub value: String,
    /// The meaning of the field.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub meaning: String,
    /// Offsets of the marked bytes within the field: the bytes in which the received and the
    /// expected bytes differ, or all bytes of a field that is known to be wrong.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differs: Vec<usize>,
}

impl BytesReport {
    /// Splits bytes into fields, and marks the differences from `other`.
    pub fn new(
        stream: Option<&str>,
        bytes: &[u8],
        other: Option<&[u8]>,
        values: &ValueFormat,
    ) -> Self {
        let of_stream = |stream| {
            let (subject, values) = (ExplainSubject::Stream(stream), values.clone());
            let parts = explain(&ExplainQuery { subject, values }, bytes).parts;
            parts.into_iter().next().map(Self::of_part)
        };
        let bare = || {
            let field = (!bytes.is_empty()).then(|| FieldReport::bare(0, spaced(bytes), ""));
            let (length, fields) = (bytes.len(), field.into_iter().collect());
            Self { stream: None, length, fields, faults: Vec::new() }
        };
        let mut report = stream.and_then(Stream::by_name).and_then(of_stream).unwrap_or_else(bare);
        if let Some(other) = other {
            report.mark(bytes, other);
        }
        report
    }

    /// The headers of a frame and, if the frame is short, the fields of its service, with offsets
    /// in the frame. Marks invalid fields and, for a reply to `request`, wrong bytes of the
    /// headers.
    pub(super) fn of_frame(frame: &[u8], request: Option<&[u8]>) -> Vec<Self> {
        if frame.is_empty() {
            return Vec::new();
        }
        let values = ValueFormat::default();
        let question = ExplainQuery { subject: ExplainSubject::Frames(None), values };
        let number = if frame.len() > SHORT_FRAME { FRAME_PARTS - 1 } else { FRAME_PARTS };
        let other = request.and_then(|request| with_headers_of_answer(request, frame));
        let parts = explain(&question, frame).parts.into_iter().take(number);
        let marked = |part: ExplainedStream| {
            let is_faulty: Vec<bool> = part.rows.iter().map(|row| row.faulty).collect();
            let mut part = Self::of_part(part);
            if let Some(other) = &other {
                part.mark(frame, other);
            }
            let fields = part.fields.iter_mut().zip(is_faulty);
            fields.filter(|(_, is_faulty)| *is_faulty).for_each(|(field, _)| field.mark_all());
            part
        };
        parts.map(marked).collect()
    }

    fn of_part(part: ExplainedStream) -> Self {
        let unread = part.unread;
        let rows = part.rows.into_iter().map(|row| FieldReport {
            offset: part.at.saturating_add(row.offset),
            hex: row.hex,
            field: row.field,
            value: row.value,
            meaning: row.meaning.to_owned(),
            differs: Vec::new(),
        });
        let unread = unread.map(|unread| {
            FieldReport::bare(part.at.saturating_add(unread.offset), unread.hex, "?")
        });
        Self {
            stream: part.stream.map(str::to_owned),
            length: part.length,
            fields: rows.chain(unread).collect(),
            faults: part.faults.into_iter().map(|fault| fault.text).collect(),
        }
    }

    /// Marks all bytes of the last field of a path such as `descriptors[1].size`.
    pub(super) fn mark_field(&mut self, path: &str) {
        let number = path.split(['[', ']']).nth(1).and_then(|number| number.parse().ok());
        let name = path.rsplit('.').next().unwrap_or(path);
        let name = name.split('[').next().unwrap_or(name);
        let mut fields = self.fields.iter_mut().filter(|field| field.field == name);
        if let Some(field) = fields.nth(number.unwrap_or_default()) {
            field.mark_all();
        }
    }

    /// Marks the fields that a clause defines, unless the clause defines the whole stream or all
    /// fields.
    pub(super) fn mark_clause(&mut self, clause: &str) {
        let Some(stream) = self.stream.as_deref().and_then(Stream::by_name) else { return };
        let layout = stream.layout();
        let defined = layout.fields.iter().filter(|field| field.clause == clause);
        let names: Vec<&str> = defined.map(|field| field.name).collect();
        if layout.clause == clause || names.len() == layout.fields.len() {
            return;
        }
        for field in self.fields.iter_mut().filter(|field| names.contains(&field.field.as_str())) {
            field.mark_all();
        }
    }

    fn mark(&mut self, bytes: &[u8], other: &[u8]) {
        for field in &mut self.fields {
            let mine = bytes.iter().enumerate().skip(field.offset).take(field.bytes().len());
            let differs = mine.filter(|(at, byte)| other.get(*at) != Some(byte));
            let begin = field.offset;
            field.differs = differs.map(|(at, _)| at.saturating_sub(begin)).collect();
        }
    }
}

/// Number of parts of a frame: the AMS/TCP header, the AMS header and the data of the service.
const FRAME_PARTS: usize = 3;
/// Maximum size in bytes of a frame whose data is shown.
const SHORT_FRAME: usize = 512;

/// The frame with the headers of a correct reply to the request.
fn with_headers_of_answer(request: &[u8], frame: &[u8]) -> Option<Vec<u8>> {
    let header = |frame: &[u8]| {
        AmsHeader::decode(frame.get(AMS_TCP_HEADER_LEN..FrameRef::HEADERS_LEN)?).ok()
    };
    let (asked, answered) = (header(request)?, header(frame)?);
    // Compare only the first frame: if its lengths are consistent, another frame may follow.
    let whole = FrameRef::split(frame, u32::MAX).ok().flatten().map(|(_, len)| len);
    let frame = whole.and_then(|whole| frame.get(..whole)).unwrap_or(frame);
    let expected = AmsHeader {
        target: asked.source,
        source: asked.target,
        command: asked.command,
        state_flags: StateFlags::RESPONSE,
        invoke_id: asked.invoke_id,
        ..answered
    };
    let frame = FrameRef::new(expected, frame.get(FrameRef::HEADERS_LEN..)?).ok()?;
    frame.encode_to_vec().ok()
}

/// A shown field, or a number of omitted items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ShownField<'r> {
    Field(&'r FieldReport),
    /// The number of omitted items of the preceding field.
    More(usize),
}

/// Number of items at the start of a long field that are always shown.
const ITEMS: usize = 6;

impl BytesReport {
    pub fn bytes(&self) -> Vec<u8> {
        self.fields.iter().flat_map(FieldReport::bytes).collect()
    }

    /// The fields to show: of a long list only the first items, the last item and the marked items.
    pub(super) fn visible_fields(&self) -> Vec<ShownField<'_>> {
        let (mut shown, mut more) = (Vec::new(), 0_usize);
        for list in self.fields.chunk_by(|one, next| one.field == next.field) {
            let last = list.len().saturating_sub(1);
            for (place, field) in list.iter().enumerate() {
                let is_like =
                    (ITEMS..last).contains(&place) && list.len() > ITEMS.saturating_add(2);
                if is_like && field.differs.is_empty() {
                    more += 1;
                    continue;
                }
                shown.extend((more > 0).then_some(ShownField::More(more)));
                more = 0;
                shown.push(ShownField::Field(field));
            }
        }
        shown
    }
}

impl FieldReport {
    fn mark_all(&mut self) {
        self.differs = (0..self.bytes().len()).collect();
    }

    fn bare(offset: usize, hex: String, field: &str) -> Self {
        let (value, meaning) = (String::new(), String::new());
        Self { offset, hex, field: field.to_owned(), value, meaning, differs: Vec::new() }
    }

    pub fn bytes(&self) -> Vec<u8> {
        compact::parse(&self.hex).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ads_cnc::ads::Command;

    const DESCRIPTION: &[u8] =
        b"\x02\0\0\x03\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

    /// The fields contain each byte once, and only differing bytes are marked.
    #[test]
    fn fields_contain_all_bytes() {
        let mut wrong = DESCRIPTION.to_vec();
        wrong[13] = 7;
        wrong[30] = b'_';
        let stream = Some("variable-description");
        let report = BytesReport::new(stream, &wrong, Some(DESCRIPTION), &ValueFormat::default());
        let bytes: Vec<u8> = report.fields.iter().flat_map(FieldReport::bytes).collect();
        assert_eq!(bytes, wrong);
        let marked: Vec<_> = report
            .fields
            .iter()
            .filter(|field| !field.differs.is_empty())
            .map(|field| (field.field.as_str(), field.differs.as_slice()))
            .collect();
        assert_eq!(marked, [("size", &[1][..]), ("name", &[6])]);
        assert_eq!(report.faults, [""; 0]);
    }

    fn marked(report: &BytesReport) -> Vec<(&str, usize)> {
        let fields = report.fields.iter().filter(|field| !field.differs.is_empty());
        fields.map(|field| (field.field.as_str(), field.offset)).collect()
    }

    /// Without expected bytes, the field of a failed check is marked by its path or its clause.
    #[test]
    fn a_field_is_marked_by_path_or_clause() {
        let values = ValueFormat::default();
        let stream = Some("variable-description");
        let mut report = BytesReport::new(stream, DESCRIPTION, None, &values);
        report.mark_clause("VAR-8");
        assert_eq!(marked(&report), [("size", 12)]);
        // A clause of the whole stream marks no field.
        let mut report = BytesReport::new(stream, DESCRIPTION, None, &values);
        report.mark_clause("VAR-4");
        assert_eq!(marked(&report), []);
        let two = [[1; 84], [2; 84]].concat();
        let mut report = BytesReport::new(Some("object-descriptors"), &two, None, &values);
        report.mark_field("descriptors[1].size");
        assert_eq!(marked(&report), [("size", 88)]);
    }

    /// In a frame, the bytes of the headers that do not match the request are marked.
    #[test]
    fn a_frame_is_compared_with_its_request() {
        let header = AmsHeader::decode(&[7; 32]).unwrap();
        let frame =
            |header: AmsHeader| FrameRef::new(header, &[0; 4]).unwrap().encode_to_vec().unwrap();
        let request = frame(AmsHeader { command: Command(3), ..header });
        let (source, target) = (header.target, header.source);
        let state_flags = StateFlags::RESPONSE;
        let answer = AmsHeader { command: Command(3), state_flags, source, target, ..header };
        let of_frame = |answer: AmsHeader| {
            let parts = BytesReport::of_frame(&frame(answer), Some(&request));
            let parts = parts.iter().flat_map(marked).map(|(field, at)| (field.to_owned(), at));
            parts.collect::<Vec<_>>()
        };
        assert_eq!(of_frame(answer), []);
        let wrong = AmsHeader { invoke_id: 8, ..answer };
        assert_eq!(of_frame(wrong), [("invoke_id".to_owned(), 34)]);
        // An inconsistent length, and an empty frame.
        let mut cut = request.clone();
        cut[26] = 9;
        let parts = BytesReport::of_frame(&cut, None);
        let parts: Vec<_> = parts.iter().flat_map(marked).collect();
        assert_eq!(parts, [("data_length", 26)]);
        assert_eq!(BytesReport::of_frame(&[], Some(&request)), []);
    }

    /// A byte that only one of the two sides contains is marked on this side.
    #[test]
    fn an_additional_byte_is_marked() {
        let values = ValueFormat::default();
        let long = BytesReport::new(None, &[1, 2, 3], Some(&[1, 2]), &values);
        assert_eq!(long.fields[0].differs, [2]);
        let short = BytesReport::new(None, &[1, 2], Some(&[1, 2, 3]), &values);
        assert_eq!(short.fields[0].differs, [0; 0]);
        assert_eq!(BytesReport::new(None, &[], None, &values).fields, []);
    }

    /// A long list is truncated, but its differing items are shown.
    #[test]
    fn long_lists_are_truncated() {
        let mut bytes = [1_u32.to_le_bytes(), 40_u32.to_le_bytes()].concat();
        bytes.extend([7; 160]);
        let mut other = bytes.clone();
        other[8 + 4 * 20] = 0;
        let stream = Some("variable-handle-read");
        let report = BytesReport::new(stream, &bytes, Some(&other), &ValueFormat::default());
        let shown = report.visible_fields();
        let more: Vec<_> = shown.iter().filter(|one| matches!(one, ShownField::More(_))).collect();
        if report.faults.is_empty() {
            assert_eq!(more, [&ShownField::More(14), &ShownField::More(18)]);
            assert_eq!(shown.len(), 2 + 6 + 1 + 1 + 1 + 1);
        }
        assert!(
            shown
                .iter()
                .any(|one| matches!(one, ShownField::Field(field) if !field.differs.is_empty()))
        );
    }
}
