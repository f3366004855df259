//! Defects of a codec, as middleware around the right answers to the testee protocol.

mod address;
mod json;
mod nc;
mod packets;
mod strict;
mod text;
mod value;

use std::collections::BTreeMap;

use ads_cnc::layout::Stream;
use ads_cnc_vectors::{Expect, Vector, vectors};
use serde_json::Value as Json;

use super::{How, Seed, SeedKind};
use crate::codec;
use crate::codec::message::{Answer, Output, Question, Rejection};
use crate::judge::in_catalogue;

pub(super) type Right<'a> = &'a dyn Fn(&Question) -> Answer;

/// How a defect of a codec works.
#[derive(Clone, Copy, Debug)]
pub(crate) enum CodecFault {
    /// Accepts input that must be rejected with an error of this class in this stream.
    Accepts(&'static str, &'static str),
    /// Rejects this stream at its maximum length.
    Longest(&'static str),
    /// Exchanges two fields of a stream.
    Swaps(&'static str, &'static str, &'static str),
    /// Encodes and decodes the numbers of the stream in big-endian order.
    BigEndian(Stream),
    /// Changes values after decoding and before encoding; arguments are the stream and the value.
    Value(fn(&str, &mut Json)),
    /// Changes encoded bytes.
    Bytes(fn(&str, Vec<u8>) -> Vec<u8>),
    /// Changes packets of NC text.
    Packets(fn(Vec<Vec<u8>>) -> Vec<Vec<u8>>),
    /// Changes NC text before it is processed.
    Text(fn(&[u8]) -> Vec<u8>),
    /// Any other change.
    Around(fn(Right<'_>, &Question) -> Answer),
}

impl CodecFault {
    pub(crate) fn answer(self, right: Right<'_>, question: &Question) -> Answer {
        let stream = question.stream.as_str();
        match self {
            Self::Accepts(class, of) => match right(question) {
                Answer::Reject(reject)
                    if of == stream && reject.class.as_deref() == Some(class) =>
                {
                    accepted()
                }
                answer => answer,
            },
            Self::Longest(of) => {
                let longest = Stream::by_name(of).map(|stream| stream.layout().max);
                let len = question.hex.as_ref().and_then(|hex| u32::try_from(hex.len()).ok());
                if of == stream && question.op == "decode" && len == longest {
                    refused("too-long")
                } else {
                    right(question)
                }
            }
            Self::Swaps(of, one, other) => {
                if of == stream {
                    around_value(right, question, |value| swap(value, one, other))
                } else {
                    right(question)
                }
            }
            Self::BigEndian(of) => {
                if of.layout().name == stream {
                    big_endian(right, question, of)
                } else {
                    right(question)
                }
            }
            Self::Value(change) => around_value(right, question, |value| change(stream, value)),
            Self::Bytes(change) => match right(question) {
                Answer::Ok(Output { hex: Some(bytes), .. }) if question.op == "encode" => {
                    Answer::Ok(Output { hex: Some(change(stream, bytes)), ..Output::default() })
                }
                answer => answer,
            },
            Self::Packets(change) => match right(question) {
                Answer::Ok(Output { packets: Some(packets), .. }) => {
                    Answer::Ok(Output { packets: Some(change(packets)), ..Output::default() })
                }
                answer => answer,
            },
            Self::Text(change) => {
                let mut other = question.clone();
                if question.op == "packets" {
                    other.hex = question.hex.as_deref().map(change);
                }
                for packet in other.packets.iter_mut().flatten() {
                    *packet = change(packet);
                }
                right(&other)
            }
            Self::Around(change) => change(right, question),
        }
    }
}

/// The answer that accepts anything.
pub(super) fn accepted() -> Answer {
    let value = Some(Json::Object(serde_json::Map::default()));
    Answer::Ok(Output { value, ..Output::default() })
}

pub(super) fn refused(class: &str) -> Answer {
    Answer::Reject(Rejection { class: Some(class.to_owned()), ..Rejection::default() })
}

/// Changes the value after `decode` and before `encode`.
fn around_value(right: Right<'_>, question: &Question, change: impl Fn(&mut Json)) -> Answer {
    let mut other = question.clone();
    if let Some(fields) = &question.value
        && let Ok(mut value) = serde_json::to_value(fields)
    {
        change(&mut value);
        match serde_json::from_value(value) {
            Ok(fields) => other.value = Some(fields),
            Err(error) => return Answer::Error { message: error.to_string() },
        }
    }
    match right(&other) {
        Answer::Ok(Output { value: Some(mut value), .. }) => {
            change(&mut value);
            Answer::Ok(Output { value: Some(value), ..Output::default() })
        }
        answer => answer,
    }
}

/// Exchanges two fields, in each record.
fn swap(value: &mut Json, one: &str, other: &str) {
    match value {
        Json::Array(items) => items.iter_mut().for_each(|item| swap(item, one, other)),
        Json::Object(fields) => match (fields.remove(one), fields.remove(other)) {
            (Some(first), Some(second)) => {
                fields.insert(one.to_owned(), second);
                fields.insert(other.to_owned(), first);
            }
            _ => fields.values_mut().for_each(|field| swap(field, one, other)),
        },
        _ => {}
    }
}

fn big_endian(right: Right<'_>, question: &Question, stream: Stream) -> Answer {
    let all = super::FieldDefect::of_stream(stream);
    let numbers =
        all.iter().filter(|one| one.change == super::FieldChange::SwapBytes && is_number(one));
    let turn = |bytes: &[u8]| numbers.clone().fold(bytes.to_vec(), |bytes, one| one.apply(&bytes));
    let mut other = question.clone();
    other.hex = question.hex.as_deref().map(turn);
    match right(&other) {
        Answer::Ok(Output { hex: Some(bytes), .. }) => {
            Answer::Ok(Output { hex: Some(turn(&bytes)), ..Output::default() })
        }
        answer => answer,
    }
}

fn is_number(defect: &super::FieldDefect) -> bool {
    use ads_cnc::layout::Type;
    let number = |field: &ads_cnc::layout::FieldSpec| {
        matches!(field.ty, Type::Uns16 | Type::Uns32 | Type::Unsigned | Type::Real64)
    };
    defect.field.spec().is_some_and(number)
}

/// A row of the tables of defects.
pub(super) struct CodecSeed {
    pub(super) id: &'static str,
    pub(super) breaks: &'static [&'static str],
    pub(super) what: &'static str,
    pub(super) fault: CodecFault,
}

pub(super) const fn row(
    id: &'static str,
    breaks: &'static [&'static str],
    what: &'static str,
    fault: CodecFault,
) -> CodecSeed {
    CodecSeed { id, breaks: in_catalogue(breaks), what, fault }
}

fn seed(id: String, requirements: Vec<&'static str>, what: String, fault: CodecFault) -> Seed {
    let how = How::Codec(fault);
    Seed { id, requirements, what, kind: SeedKind::Codec, edition: None, printed: true, how }
}

pub(super) fn seeds() -> Vec<Seed> {
    let mut seeds = forgotten_checks();
    seeds.extend(too_strict());
    seeds.extend(swapped());
    seeds.extend(turned());
    let rows = [address::ROWS, nc::ROWS, packets::ROWS, strict::ROWS, text::ROWS, value::ROWS];
    seeds.extend(
        rows.into_iter().flatten().map(|row| {
            seed(row.id.to_owned(), row.breaks.to_vec(), row.what.to_owned(), row.fault)
        }),
    );
    seeds
}

/// The requirements that these vectors cite, each once.
fn broken<'v>(of: impl Iterator<Item = &'v Vector>) -> Vec<&'static str> {
    let known = |id: &String| ads_cnc_vectors::clause(id).map(|clause| clause.id());
    let mut all: Vec<&'static str> =
        of.flat_map(|vector| &vector.requirements).filter_map(known).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// The vectors of the strongest level.
fn strongest(mut vectors: Vec<&'static Vector>) -> Vec<&'static Vector> {
    let level = vectors.iter().map(|vector| vector.level()).min();
    vectors.retain(|vector| Some(vector.level()) == level);
    vectors
}

/// A missing check for each class and stream that has a vector.
fn forgotten_checks() -> Vec<Seed> {
    let mut pairs: BTreeMap<(&'static str, &'static str), Vec<&'static Vector>> = BTreeMap::new();
    for vector in vectors() {
        if let Expect::Reject(reject) = &vector.expect {
            pairs.entry((&vector.stream, &reject.class)).or_default().push(vector);
        }
    }
    let each = |((stream, class), those): ((&'static str, &'static str), Vec<&'static Vector>)| {
        let those = strongest(those);
        // The classes of vectors are advisory: the defect ignores the class of this codec's error.
        let refusal = |vector: &&'static Vector| match codec::decode_stream(
            stream,
            &vector.context,
            &vector.bytes(),
        ) {
            Err(codec::Refused::Error(error)) => Some(codec::class(&error)),
            _ => None,
        };
        let called = those.iter().find_map(refusal)?;
        let what = format!("{stream}: what is {} is accepted", class.replace('-', " "));
        let id = format!("codec.accepts.{class}.{stream}");
        Some(seed(id, broken(those.into_iter()), what, CodecFault::Accepts(called, stream)))
    };
    pairs.into_iter().filter_map(each).collect()
}

/// Streams that have a vector of maximum length.
fn too_strict() -> Vec<Seed> {
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
            let what = format!("{name}: the longest there may be is refused");
            let id = format!("codec.refuses.longest.{name}");
            seed(id, broken(those.into_iter()), what, CodecFault::Longest(name))
        })
    };
    Stream::all().filter_map(each).collect()
}

/// Adjacent fields of the same type.
fn swapped() -> Vec<Seed> {
    let fields = Stream::all().filter(|stream| !stream.layout().repeats).flat_map(|stream| {
        let layout = stream.layout();
        let pairs = layout.fields.iter().zip(layout.fields.iter().skip(1));
        pairs
            .filter(|(one, other)| one.ty == other.ty)
            .map(move |(one, other)| (layout, one, other))
    });
    // Counters are not fields of a value.
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
                "{}: {} is taken for {}, and it for that",
                layout.name, one.name, other.name
            );
            let mut clauses = vec![layout.clause, one.clause, other.clause];
            clauses.sort_unstable();
            clauses.dedup();
            seed(id, clauses, what, CodecFault::Swaps(layout.name, one.name, other.name))
        })
        .collect()
}

/// Streams with numbers of several bytes.
fn turned() -> Vec<Seed> {
    let each = |stream: Stream| {
        let layout = stream.layout();
        let all = super::FieldDefect::of_stream(stream);
        let any =
            all.iter().any(|one| one.change == super::FieldChange::SwapBytes && is_number(one));
        any.then(|| {
            let what = format!("{}: numbers have the most significant byte first", layout.name);
            let id = format!("codec.big-endian.{}", layout.name);
            seed(id, vec!["GEN-1", layout.clause], what, CodecFault::BigEndian(stream))
        })
    };
    let streams = Stream::all().filter(|stream| *stream != Stream::ObjectDescriptors);
    streams.filter_map(each).collect()
}
