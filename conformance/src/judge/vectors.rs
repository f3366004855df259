//! Cases for a codec, made from golden vectors and NC texts.

use std::collections::HashSet;

use ads_cnc_vectors::{
    Context, Sequence, SequenceInput, Vector, sequence, sequences, vector, vectors,
};

use super::{Body, Case, CaseSubject, Needs};
use crate::value_format::{ValueFormat, type_by_name};

/// A case for each vector, and for each NC text that is split into packets or checked.
pub(crate) fn codec_cases() -> Vec<Case> {
    let vectors = vectors().iter().map(|one| case_of(one, "vec", Needs::Codec, Body::Vector(one)));
    let texts = sequences().iter().filter(|one| is_text(one)).map(of_text);
    vectors.chain(texts).collect()
}

fn is_text(sequence: &Sequence) -> bool {
    matches!(sequence.given, SequenceInput::NcText(_) | SequenceInput::NcCheck(_))
}

fn of_text(sequence: &'static Sequence) -> Case {
    Case {
        id: format!("seq-{}", sequence.id),
        title: sequence.title.clone(),
        subject: CaseSubject::Codec,
        requirements: sequence.cited().into_iter().map(|one| one.id.as_str()).collect(),
        needs: Needs::Codec,
        body: Body::Sequence(sequence),
    }
}

/// The accepted siblings of the rejected vectors and NC texts of these cases, except those that are
/// among the cases.
pub fn siblings_of(cases: &[Case]) -> Vec<Case> {
    let mut known: HashSet<&str> = HashSet::new();
    let mut wanted: Vec<&str> = Vec::new();
    for case in cases.iter().filter(|case| case.needs == Needs::Codec) {
        let (id, sibling) = match &case.body {
            Body::Vector(vector) => (&vector.id, vector.sibling.as_deref()),
            Body::Sequence(sequence) => (&sequence.id, sequence.sibling.as_deref()),
            _ => continue,
        };
        known.insert(id);
        wanted.extend(sibling);
    }
    let mut missing = Vec::new();
    for id in wanted {
        if known.insert(id) {
            let of_vector = |one| case_of(one, "vec", Needs::Codec, Body::Vector(one));
            missing.extend(vector(id).map(of_vector).or_else(|| sequence(id).map(of_text)));
        }
    }
    missing
}

/// The case of a vector.
pub(crate) fn case_of(vector: &Vector, prefix: &str, needs: Needs, body: Body) -> Case {
    Case {
        id: format!("{prefix}-{}", vector.id),
        title: vector.title.clone(),
        subject: if needs == Needs::Codec { CaseSubject::Codec } else { CaseSubject::Target },
        requirements: vector.cited().into_iter().map(|one| one.id.as_str()).collect(),
        needs,
        body,
    }
}

/// The format with which a report decodes the value of a vector.
pub(crate) fn typed(context: &Context) -> ValueFormat {
    let ty = context.kind.and_then(|kind| type_by_name(kind.name()).ok());
    ValueFormat { ty, dimensions: context.dimensions.clone().unwrap_or_default() }
}
