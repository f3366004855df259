//! The level at which a wrong answer of a testee is judged. A wrong answer that only contradicts an
//! assumption of a vector is judged at level *info*.

use ads_cnc::layout::{FieldSpec, Stream, Type};
use ads_cnc_vectors::{About, Assumption, Expect, Level, Sequence, Vector, sequence, vector};

use super::blame::WrongFields;
use super::plan::forms;
use super::{TesteeReaction, compare};
use crate::codec::message::{Answer, Output};
use crate::judge::{Body, Verdict};
use crate::values::until_nul;

/// The level at which a wrong answer to a case is judged. If a rejection proves nothing because the
/// accepted sibling failed (`Vacuous`), this is the weaker of the levels of the case and of the
/// sibling.
pub(super) fn level(body: &Body, verdict: Verdict, op: &str, reaction: &TesteeReaction) -> Level {
    let (own, sibling) = match body {
        Body::Vector(one) if one.is_accepted() => (accepted_level(one, op, reaction), None),
        Body::Vector(one) => {
            (one.level(), one.sibling.as_deref().and_then(vector).map(Vector::level))
        }
        Body::Sequence(one) => {
            (one.level(), one.sibling.as_deref().and_then(sequence).map(Sequence::level))
        }
        _ => (Level::Must, None),
    };
    match sibling {
        Some(sibling) if verdict == Verdict::Vacuous => own.max(sibling),
        _ => own,
    }
}

/// The wrong fields of an answer to an accepted vector; `None` for any other vector, and if they
/// cannot be determined, for example because the answer has other fields than expected.
pub(super) fn wrong_fields(vector: &Vector, output: &Output, strict: bool) -> Option<WrongFields> {
    let Expect::Accept(accept) = &vector.expect else { return None };
    let stream = Stream::by_name(&vector.stream)?;
    match (&output.value, &output.hex) {
        (Some(value), _) => WrongFields::of_value(stream, &accept.value, value, strict),
        (None, Some(bytes)) => WrongFields::of_bytes(stream, &vector.bytes(), bytes),
        (None, None) => None,
    }
}

/// The level at which a wrong answer to an accepted vector is judged.
fn accepted_level(vector: &Vector, op: &str, reaction: &TesteeReaction) -> Level {
    let Expect::Accept(accept) = &vector.expect else { return vector.level() };
    let TesteeReaction::Answer(Answer::Ok(output)) = reaction else { return vector.level() };
    let decides = |one: &&Assumption| one.decides || one.encodes && op == "encode";
    let has_other_end = || match (&output.value, &output.hex) {
        (Some(value), _) => {
            !matches!(compare::compare(&accept.value, value), Some(compare::Difference::Other(_)))
        }
        (None, Some(bytes)) => {
            forms(vector, accept).iter().any(|form| has_end_alone(vector, form, bytes))
        }
        (None, None) => false,
    };
    // For example, a number of another width changes the number of bytes.
    let has_other_length = || {
        let same =
            |bytes: &Vec<u8>| forms(vector, accept).iter().any(|one| one.len() == bytes.len());
        output.hex.as_ref().is_some_and(|bytes| !same(bytes))
    };
    let deciding: Vec<&Assumption> = vector.assumed.iter().filter(decides).collect();
    // `None` for example if the answer has other fields than expected: then every field may be
    // wrong.
    let wrong = wrong_fields(vector, output, false);
    let rests_whole = |one: &&Assumption| match one.about {
        Some(About::End) => has_other_end(),
        Some(About::Acceptance) => has_other_length(),
        Some(About::Characters | About::Codes) => wrong.is_none(),
        _ => true,
    };
    let rests = |row: &FieldSpec| {
        deciding.iter().any(|one| match one.about {
            Some(About::Characters) => row.ty == Type::String,
            Some(About::Codes) => ["type", "access"].contains(&row.name),
            _ => false,
        })
    };
    if deciding.is_empty() {
        vector.level()
    } else if deciding.iter().any(rests_whole) || wrong.is_some_and(|wrong| wrong.are_all(rests)) {
        Level::Info
    } else {
        vector.stated_level()
    }
}

/// Whether bytes differ from the expected bytes only in the ends of texts: in the bytes after the
/// first NUL of a text field, or in the number of NULs at the end of the stream.
fn has_end_alone(vector: &Vector, expected: &[u8], found: &[u8]) -> bool {
    let trimmed = |bytes: &[u8]| {
        let len =
            bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last.saturating_add(1));
        bytes.get(..len).unwrap_or_default().to_vec()
    };
    if trimmed(expected) == trimmed(found) {
        return true;
    }
    let Some(stream) = Stream::by_name(&vector.stream) else { return false };
    let (mut rest, mut is_same) = (found, expected.len() == found.len());
    let walked = stream.walk(expected, |segment| {
        let Some((part, left)) = rest.split_at_checked(segment.bytes.len()) else { return };
        rest = left;
        let is_text = segment.field.spec().is_some_and(|row| row.ty == Type::String);
        is_same &= part == segment.bytes || is_text && until_nul(part) == until_nul(segment.bytes);
    });
    walked.is_ok() && is_same
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The level of an answer to `encode` in which the bytes at these offsets are wrong.
    fn level_with(changed: &[usize]) -> Level {
        let vector = vector("description-cp1252-name").unwrap();
        let mut bytes = vector.bytes();
        changed.iter().for_each(|&at| bytes[at] ^= 1);
        let output = Output { hex: Some(bytes), ..Output::default() };
        accepted_level(vector, "encode", &TesteeReaction::Answer(Answer::Ok(output)))
    }

    /// A size that is wrong together with the name is judged at level *must*: the vector has
    /// assumptions only about the name.
    #[test]
    fn an_assumption_excuses_only_the_fields_that_it_is_about() {
        const SIZE: usize = 12;
        const NAME: usize = 25;
        assert_eq!(level_with(&[NAME]), Level::Info);
        assert_eq!(level_with(&[SIZE]), Level::Must);
        assert_eq!(level_with(&[SIZE, NAME]), Level::Must);
    }
}
