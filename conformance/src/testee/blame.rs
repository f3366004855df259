//! Attributes a failed vector to the requirements of its wrong fields.
//!
//! A vector cites several requirements, such as those of its fields, and general requirements about
//! bytes and texts. If one field is wrong, the answer violates only some of these requirements; the
//! others fail as a consequence of the violated ones.

use std::collections::BTreeSet;

use ads_cnc::layout::{FieldSpec, Stream, Type};
use ads_cnc_vectors::ids::{GEN_1, GEN_2, GEN_3, GEN_5};
use ads_cnc_vectors::{ClauseId, Fields, Level, Value, clause};
use serde_json::Value as Json;

use super::compare;

/// Says which fields of a stream are wrong in an answer.
pub(super) struct WrongFields {
    stream: Stream,
    /// One entry for each field in the table of the stream's fields.
    is_wrong: Vec<bool>,
    /// Whether the bytes of at least one wrong number are the expected bytes in reverse order.
    is_reversed: bool,
}

impl WrongFields {
    fn none(stream: Stream) -> Self {
        Self { stream, is_wrong: vec![false; stream.layout().fields.len()], is_reversed: false }
    }

    /// The wrong fields of a decoded value; `None` if the value has other fields, or lists of
    /// another length, than expected. Unless `strict`, the testee may omit the bytes after a text.
    pub(super) fn of_value(
        stream: Stream,
        expected: &Fields,
        found: &Json,
        strict: bool,
    ) -> Option<Self> {
        let mut wrong = Self::none(stream);
        wrong.add_record(expected, found, strict)?;
        Some(wrong)
    }

    /// The clauses of the wrong fields.
    pub(super) fn clauses(&self) -> impl Iterator<Item = &'static str> {
        self.wrong().map(|row| row.clause)
    }

    /// The wrong fields of encoded bytes; `None` if the number of bytes differs from the expected
    /// number, or the expected bytes do not match the table of the stream.
    pub(super) fn of_bytes(stream: Stream, expected: &[u8], found: &[u8]) -> Option<Self> {
        let mut wrong = Self::none(stream);
        if expected.len() != found.len() {
            return None;
        }
        let mut rest = found;
        let walked = stream.walk(expected, |segment| {
            let Some((part, left)) = rest.split_at_checked(segment.bytes.len()) else { return };
            rest = left;
            if part != segment.bytes {
                let is_reversed = part.iter().rev().eq(segment.bytes);
                wrong.add(segment.field.name(), is_reversed);
            }
        });
        walked.is_ok().then_some(wrong)
    }

    fn add(&mut self, name: &str, is_reversed: bool) -> Option<()> {
        let (place, row) = self.rows().enumerate().find(|(_, row)| row.name == name)?;
        let is_number = matches!(row.ty, Type::Uns16 | Type::Uns32 | Type::Real64);
        self.is_reversed |= is_reversed && is_number;
        *self.is_wrong.get_mut(place)? = true;
        Some(())
    }

    fn add_record(&mut self, expected: &Fields, found: &Json, strict: bool) -> Option<()> {
        let given = found.as_object()?;
        if given.len() != expected.len() {
            return None;
        }
        for (name, expected) in expected {
            let found = given.get(name)?;
            match compare::one(name, expected, found) {
                None => continue,
                Some(compare::Difference::Omitted(_)) if !strict => continue,
                Some(_) => {}
            }
            if self.rows().any(|row| row.name == name) {
                self.add(name, is_reversed(expected, found))?;
                continue;
            }
            // The value is not a field of the table, but a record or a list of records with such
            // fields.
            match (expected, found.as_array()) {
                (Value::Record(fields), _) => self.add_record(fields, found, strict)?,
                (Value::List(items), Some(given)) if items.len() == given.len() => {
                    for (item, found) in items.iter().zip(given) {
                        let Value::Record(fields) = item else { return None };
                        self.add_record(fields, found, strict)?;
                    }
                }
                _ => return None,
            }
        }
        Some(())
    }

    fn rows(&self) -> impl Iterator<Item = &'static FieldSpec> + use<> {
        self.stream.layout().fields.iter()
    }

    fn wrong(&self) -> impl Iterator<Item = &'static FieldSpec> + '_ {
        self.rows().zip(&self.is_wrong).filter(|(_, is_wrong)| **is_wrong).map(|(row, _)| row)
    }

    /// Whether at least one field is wrong, and `are` returns true for all wrong fields.
    pub(super) fn are_all(&self, are: impl Fn(&FieldSpec) -> bool) -> bool {
        self.wrong().next().is_some() && self.wrong().all(are)
    }

    /// Whether all fields from the first wrong field on, at least two, are wrong, as if bytes were
    /// missing or inserted.
    fn is_shifted(&self) -> bool {
        let first = self.is_wrong.iter().position(|is_wrong| *is_wrong).unwrap_or_default();
        let from_first = self.is_wrong.get(first..).unwrap_or_default();
        from_first.len() > 1 && from_first.iter().all(|is_wrong| *is_wrong)
    }

    /// The violated clause from which the failure of a requirement follows; `None` if the answer
    /// violates the requirement itself, or no violated clause is in `cited` or `broken`. `cited`
    /// are the requirements of the vector, `broken` the clauses of the wrong fields of all vectors.
    pub(super) fn cause_of(
        &self,
        requirement: &str,
        cited: &[&'static str],
        broken: &BTreeSet<&'static str>,
    ) -> Option<&'static str> {
        let mine = self.clauses().find(|id| cited.contains(id));
        let cause = mine.or_else(|| self.clauses().find(|id| broken.contains(id)))?;
        if self.clauses().any(|id| id == requirement) {
            return None;
        }
        let is = |clause: ClauseId| clause.as_str() == requirement;
        let has = |types: &[Type]| self.wrong().any(|row| types.contains(&row.ty));
        let follows = if is(GEN_1) {
            !self.is_reversed
        } else if is(GEN_2) {
            !self.is_shifted()
        } else if is(GEN_3) {
            !has(&[Type::String])
        } else if is(GEN_5) {
            !self.is_shifted() && !has(&[Type::Boolean, Type::Unsigned, Type::Bytes])
        } else {
            let layout = self.stream.layout();
            let is_assumed = clause(requirement).is_some_and(|one| one.level() == Level::Info);
            // If a stream repeats its record, a wrong field may also violate the clause of the
            // stream, which specifies the order of the fields.
            is_assumed
                || layout.clause == requirement && !layout.repeats
                || self.rows().any(|row| row.clause == requirement)
        };
        follows.then_some(cause)
    }
}

/// Whether the bytes of a number are those of the expected number in reverse order.
fn is_reversed(expected: &Value, found: &Json) -> bool {
    let Value::One(expected) = expected else { return false };
    let bits = |text: Option<&str>| u64::from_str_radix(text?.strip_prefix("0x")?, 16).ok();
    let of_real =
        bits(found.get("bits").and_then(Json::as_str)).zip(bits(expected.bits.as_deref()));
    if let Some((found, expected)) = of_real {
        return found == expected.swap_bytes();
    }
    let number = |text: Option<&str>| text.and_then(|text| text.parse::<u32>().ok());
    let found = number(found.get("value").and_then(Json::as_str));
    number(expected.value.as_deref()).zip(found).is_some_and(|(expected, found)| {
        let in_16_bits = u16::try_from(expected).map(|number| u32::from(number.swap_bytes()));
        found == expected.swap_bytes() || in_16_bits == Ok(found)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A description: handle at offset 0, type at 4, access at 8, size at 12, no dimensions, and
    /// the name "V.E.a".
    const BYTES: &[u8] = b"\x01\0\0\0\x06\0\0\0\x02\0\0\0\x04\0\0\0\0\0\0\0V.E.a\0";
    const CITED: &[&str] =
        &["VAR-4", "VAR-5", "VAR-6", "VAR-8", "GEN-1", "GEN-2", "GEN-3", "GEN-5", "VAR-24"];

    fn failing(change: impl Fn(&mut Vec<u8>)) -> Vec<&'static str> {
        let mut found = BYTES.to_vec();
        change(&mut found);
        let wrong = WrongFields::of_bytes(Stream::VariableDescription, BYTES, &found).unwrap();
        CITED
            .iter()
            .filter(|id| wrong.cause_of(id, CITED, &BTreeSet::new()).is_none())
            .copied()
            .collect()
    }

    #[test]
    fn a_wrong_field_fails_by_its_clause() {
        assert_eq!(failing(|bytes| bytes[12] = 5), ["VAR-8", "VAR-24"]);
        let swapped = failing(|bytes| (bytes[8], bytes[12]) = (4, 2));
        assert_eq!(swapped, ["VAR-6", "VAR-8", "VAR-24"]);
    }

    #[test]
    fn reversed_bytes_also_violate_the_byte_order() {
        assert_eq!(failing(|bytes| bytes[12..16].reverse()), ["VAR-8", "GEN-1", "VAR-24"]);
    }

    #[test]
    fn wrong_texts_also_violate_the_code_page() {
        let failing = failing(|bytes| bytes[24] = b'b');
        assert!(failing.contains(&"GEN-3") && !failing.contains(&"GEN-1"), "{failing:?}");
    }

    #[test]
    fn a_vector_without_its_wrong_field_fails_by_another_vector() {
        let found = [&BYTES[..12], &[5], &BYTES[13..]].concat();
        let wrong = WrongFields::of_bytes(Stream::VariableDescription, BYTES, &found).unwrap();
        assert_eq!(wrong.cause_of("VAR-5", &["VAR-5"], &BTreeSet::new()), None);
        assert_eq!(wrong.cause_of("VAR-5", &["VAR-5"], &BTreeSet::from(["VAR-8"])), Some("VAR-8"));
    }

    #[test]
    fn an_unknown_field_has_no_cause() {
        let found = serde_json::json!({ "else": 1 });
        let expected = Fields::new();
        assert!(WrongFields::of_value(Stream::VariableHandle, &expected, &found, false).is_none());
        assert!(WrongFields::of_bytes(Stream::VariableDescription, BYTES, &BYTES[1..]).is_none());
    }
}
