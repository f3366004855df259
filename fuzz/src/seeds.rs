//! What fuzzers start from: the vectors, and the samples of the codec's own tests.

use ads_cnc::layout::Stream;
use ads_cnc_vectors::vectors;

use crate::bodies::bytes::FAMILIES;
use crate::bodies::{Family, operation};
use crate::{Target, common};

/// Name and bytes of an input.
pub type Seed = (String, Vec<u8>);

/// A vector that is longer is no place to start from.
const LONGEST: usize = 2048;

/// The inputs of a target that are made by hand or by vectors, in order.
///
/// # Panics
/// If the target has none.
pub fn seeds(target: &Target) -> Vec<Seed> {
    let law = target.name.split_once('_').map_or("", |(_, law)| law);
    let mut seeds = match (target.family(), law) {
        ("operation", "dispatch") => calls(),
        (family, "bytes") => {
            let family = family_of(family);
            samples(family).chain(of_vectors(family)).collect()
        }
        // Any bytes make a value: these are as good as others.
        (family, "value") => samples(family_of(family)).collect(),
        _ => panic!("{} has no seeds", target.name),
    };
    seeds.sort();
    seeds.dedup_by(|(_, one), (_, other)| one == other);
    assert!(!seeds.is_empty(), "{} has no seeds", target.name);
    seeds
}

fn family_of(name: &str) -> Family {
    let found = FAMILIES.iter().find(|(family, _)| *family == name);
    found.unwrap_or_else(|| panic!("no family {name}")).1
}

/// Samples of a family's streams, behind the byte that picks the stream.
fn samples(family: Family) -> impl Iterator<Item = Seed> {
    common::each_sample().filter_map(move |(stream, sample)| {
        let name = format!("{stream}-{}", sample.slug);
        Some((name, [vec![pick(family, stream)?], sample.bytes()].concat()))
    })
}

/// The same of vectors, good and bad.
fn of_vectors(family: Family) -> impl Iterator<Item = Seed> {
    let short = vectors()
        .iter()
        .map(|vector| (vector, vector.bytes()))
        .filter(|(_, bytes)| bytes.len() <= LONGEST);
    short.filter_map(move |(vector, bytes)| {
        let stream = *family.iter().find(|stream| stream.layout().name == vector.stream)?;
        Some((format!("vector-{}", vector.id), [vec![pick(family, stream)?], bytes].concat()))
    })
}

fn pick(family: Family, stream: Stream) -> Option<u8> {
    let place = family.iter().position(|&other| other == stream)?;
    u8::try_from(place).ok()
}

fn calls() -> Vec<Seed> {
    let write =
        |sample: &common::CallSample| (sample.slug.into(), operation::write_call(&sample.call));
    common::CALLS.iter().map(write).collect()
}
