//! Defects of a codec, as middleware around the correct answers in the testee protocol.

mod address;
mod json;
mod nc;
mod packets;
mod row;
mod strict;
mod text;
mod value;

pub(crate) use row::CodecFault;
use row::is_number;

use std::collections::BTreeMap;

use ads_cnc::layout::Stream;
use ads_cnc_vectors::ids::*;
use ads_cnc_vectors::{Expect, Vector, vectors};

use super::seeded_defect::{DefectKind, Mechanism, SeededDefect};
use super::{FieldChange, FieldDefect};
use crate::codec;

fn defect(
    id: String,
    requirements: Vec<&'static str>,
    what: String,
    fault: CodecFault,
) -> SeededDefect {
    let how = Mechanism::Codec(fault);
    SeededDefect {
        id,
        requirements,
        what,
        kind: DefectKind::Codec,
        edition: None,
        printed: true,
        how,
    }
}

pub(super) fn defects() -> Vec<SeededDefect> {
    let mut defects = forgotten_checks();
    defects.extend(too_strict());
    defects.extend(swapped());
    defects.extend(turned());
    let rows = [address::ROWS, nc::ROWS, packets::ROWS, strict::ROWS, text::ROWS, value::ROWS];
    defects.extend(rows.into_iter().flatten().map(|row| {
        let requirements = row.breaks.iter().map(|id| id.as_str()).collect();
        defect(row.id.to_owned(), requirements, row.what.to_owned(), row.fault)
    }));
    defects
}

/// The IDs of the requirements, or of parts of requirements, that these vectors cite, sorted and
/// without duplicates.
fn broken<'v>(of: impl Iterator<Item = &'v Vector>) -> Vec<&'static str> {
    let known = |id: &String| ads_cnc_vectors::clause(id).map(|clause| clause.id());
    let mut all: Vec<&'static str> =
        of.flat_map(|vector| &vector.requirements).filter_map(known).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The vectors whose level is the strongest of all given vectors.
fn strongest(mut vectors: Vec<&'static Vector>) -> Vec<&'static Vector> {
    let level = vectors.iter().map(|vector| vector.level()).min();
    vectors.retain(|vector| Some(vector.level()) == level);
    vectors
}

/// The defects that omit a check: one for each pair of a stream and an error class of a rejected
/// vector. A pair is used only if the codec `ads_cnc` returns an error for at least one of its
/// vectors of the strongest level.
fn forgotten_checks() -> Vec<SeededDefect> {
    let mut pairs: BTreeMap<(&'static str, &'static str), Vec<&'static Vector>> = BTreeMap::new();
    for vector in vectors() {
        if let Expect::Reject(reject) = &vector.expect {
            pairs.entry((&vector.stream, &reject.class)).or_default().push(vector);
        }
    }
    let each = |((stream, class), those): ((&'static str, &'static str), Vec<&'static Vector>)| {
        let those = strongest(those);
        // The error class in a vector is advisory, so it may differ from the class that this codec
        // returns. The defect ignores errors of the class that this codec returns.
        let rejection = |vector: &&'static Vector| match codec::decode_stream(
            stream,
            &vector.context,
            &vector.bytes(),
        ) {
            Err(codec::CodecError::Error(error)) => Some(codec::class(&error)),
            _ => None,
        };
        let called = those.iter().find_map(rejection)?;
        let what = format!("{stream}: the codec accepts input with an error of the class {class}");
        let id = format!("codec.accepts.{class}.{stream}");
        Some(defect(id, broken(those.into_iter()), what, CodecFault::Accepts(called, stream)))
    };
    pairs.into_iter().filter_map(each).collect()
}

/// The defects that reject a stream of maximum length: one for each stream of variable length that
/// has an accepted vector of this length.
fn too_strict() -> Vec<SeededDefect> {
    let longest = |stream: &Stream| -> Vec<&'static Vector> {
        let layout = stream.layout();
        let all = vectors().iter().filter(|vector| vector.is_accepted());
        let all = all
            .filter(|vector| vector.stream == layout.name)
            .filter(|vector| u32::try_from(vector.bytes().len()) == Ok(layout.max))
            .collect();
        strongest(all)
    };
    let each = |stream: Stream| {
        let those = longest(&stream);
        let name = stream.layout().name;
        let any = !stream.layout().is_fixed() && !those.is_empty();
        any.then(|| {
            let what = format!("{name}: the codec rejects input of the maximum length");
            let id = format!("codec.refuses.longest.{name}");
            defect(id, broken(those.into_iter()), what, CodecFault::Longest(name))
        })
    };
    Stream::all().filter_map(each).collect()
}

/// The defects that exchange two fields: one for each pair of adjacent fields of the same type in a
/// stream without records, if the decoded value contains both.
fn swapped() -> Vec<SeededDefect> {
    let fields = Stream::all().filter(|stream| !stream.layout().repeats).flat_map(|stream| {
        let layout = stream.layout();
        let pairs = layout.fields.iter().zip(layout.fields.iter().skip(1));
        pairs
            .filter(|(one, other)| one.ty == other.ty)
            .map(move |(one, other)| (layout, one, other))
    });
    // Counters are fields of a stream, but not of the decoded value, so they cannot be exchanged.
    let is_value = |stream: &str, field: &str| {
        let accepted = |vector: &&Vector| vector.stream == stream && vector.is_accepted();
        vectors().iter().filter(accepted).any(|vector| match &vector.expect {
            Expect::Accept(accept) => accept.value.contains_key(field),
            Expect::Reject(_) => false,
        })
    };
    fields
        .filter(|(layout, one, other)| {
            is_value(layout.name, one.name) && is_value(layout.name, other.name)
        })
        .map(|(layout, one, other)| {
            let id = format!("codec.swaps.{}.{}-{}", layout.name, one.name, other.name);
            let what = format!(
                "{}: the codec exchanges the fields {} and {}",
                layout.name, one.name, other.name
            );
            let mut clauses = vec![layout.clause, one.clause, other.clause];
            clauses.sort_unstable();
            clauses.dedup();
            defect(id, clauses, what, CodecFault::Swaps(layout.name, one.name, other.name))
        })
        .collect()
}

/// The defects that read and write numbers with the most significant byte first: one for each
/// stream with numbers of several bytes, except the list of object descriptors.
fn turned() -> Vec<SeededDefect> {
    let each = |stream: Stream| {
        let layout = stream.layout();
        let all = FieldDefect::of_stream(stream);
        let any = all.iter().any(|one| one.change == FieldChange::SwapBytes && is_number(one));
        any.then(|| {
            let what = format!(
                "{}: the codec reads and writes numbers with the most significant byte first",
                layout.name
            );
            let id = format!("codec.big-endian.{}", layout.name);
            defect(id, vec![GEN_1.as_str(), layout.clause], what, CodecFault::BigEndian(stream))
        })
    };
    let streams = Stream::all().filter(|stream| *stream != Stream::ObjectDescriptors);
    streams.filter_map(each).collect()
}
