//! Bytes field by field, with those marked that differ from the expected ones.

use ads_cnc::layout::Stream;
use serde::{Deserialize, Serialize};

use crate::explain::{ExplainQuery, ExplainSubject, ValueFormat, explain};
use crate::text::hex::{compact, spaced};

/// Bytes field by field.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BytesReport {
    /// Name of their stream; `None` if no table describes them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stream: Option<String>,
    pub length: usize,
    /// The fields in order; together they contain all bytes.
    pub fields: Vec<FieldReport>,
    /// Faults of the bytes themselves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub faults: Vec<String>,
}

/// One field, or one item of a field with several.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FieldReport {
    pub offset: usize,
    /// Its bytes in hex.
    pub hex: String,
    /// Its name; `?` for unreadable bytes, empty for bytes that no table describes.
    pub field: String,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub value: String,
    /// The meaning of the field.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub meaning: String,
    /// Offsets within the field of bytes that differ from the expected ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub differs: Vec<usize>,
}

impl BytesReport {
    /// Splits bytes into fields; `other` are the bytes to compare them with.
    pub fn new(
        stream: Option<&str>,
        bytes: &[u8],
        other: Option<&[u8]>,
        values: &ValueFormat,
    ) -> Self {
        let known = stream.and_then(Stream::by_name);
        let (mut fields, mut faults) = (Vec::new(), Vec::new());
        if let Some(stream) = known {
            let question =
                ExplainQuery { subject: ExplainSubject::Stream(stream), values: values.clone() };
            let part = explain(&question, bytes).parts.into_iter().next().unwrap_or_default();
            fields.extend(part.rows.into_iter().map(|row| FieldReport {
                offset: row.offset,
                hex: row.hex,
                field: row.field,
                value: row.value,
                meaning: row.meaning.to_owned(),
                differs: Vec::new(),
            }));
            fields.extend(
                part.unread.map(|unread| FieldReport::bare(unread.offset, unread.hex, "?")),
            );
            faults.extend(part.faults.into_iter().map(|fault| fault.text));
        } else if !bytes.is_empty() {
            fields.push(FieldReport::bare(0, spaced(bytes), ""));
        }
        let mut report = Self {
            stream: known.map(|stream| stream.layout().name.to_owned()),
            length: bytes.len(),
            fields,
            faults,
        };
        if let Some(other) = other {
            report.mark(bytes, other);
        }
        report
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

/// A shown field, or a number of omitted items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ShownField<'r> {
    Field(&'r FieldReport),
    /// The number of omitted items of the field above.
    More(usize),
}

/// Number of items of a field that are shown.
const ITEMS: usize = 6;

impl BytesReport {
    pub fn bytes(&self) -> Vec<u8> {
        self.fields.iter().flat_map(FieldReport::bytes).collect()
    }

    /// The fields, without most items of a long list; items that differ are always shown.
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

    const DESCRIPTION: &[u8] =
        b"\x02\0\0\x03\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

    /// The fields contain all bytes once, and exactly the differing ones are marked.
    #[test]
    fn fields_are_the_bytes() {
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

    /// A missing byte is marked on the side that has it.
    #[test]
    fn a_byte_too_many_differs() {
        let values = ValueFormat::default();
        let long = BytesReport::new(None, &[1, 2, 3], Some(&[1, 2]), &values);
        assert_eq!(long.fields[0].differs, [2]);
        let short = BytesReport::new(None, &[1, 2], Some(&[1, 2, 3]), &values);
        assert_eq!(short.fields[0].differs, [0; 0]);
        assert_eq!(BytesReport::new(None, &[], None, &values).fields, []);
    }

    /// A long list is truncated, but its differing items are shown.
    #[test]
    fn lists_are_shown_in_part() {
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

    /// A broken stream is shown up to its fault, with the name of the field.
    #[test]
    fn a_fault_is_shown_where_it_is() {
        let bytes = [1, 0, 0, 2, 9, 0, 0, 0, 4];
        let report =
            BytesReport::new(Some("variable-handle-read"), &bytes, None, &ValueFormat::default());
        let shown: Vec<_> =
            report.fields.iter().map(|one| (one.offset, one.field.as_str())).collect();
        assert_eq!(shown, [(0, "handle"), (4, "index_count"), (8, "?")]);
        assert_eq!(
            report.faults,
            [
                "index_count at offset 4: too many, expected at most 0 in the bytes that follow, found 9"
            ]
        );
    }
}
