//! The initial inputs of fuzzers: vectors, samples of the codec's tests, and inputs made by hand.

#[cfg(feature = "tools")]
mod connections;
mod events;
mod operations;
mod texts;
#[cfg(feature = "tools")]
pub(crate) mod tools;

use ads_cnc::layout::Stream;
use ads_cnc::value::DataType;
use ads_cnc_vectors::vectors;

use crate::bodies::bytes::FAMILIES;
use crate::bodies::{Family, operation};
use crate::{Target, common};

/// The name and the bytes of an input.
pub type Seed = (String, Vec<u8>);

/// Maximum length in bytes of a vector that is used as an initial input; a text of a sequence may
/// be twice as long.
const LONGEST: usize = 2048;

/// The initial inputs of a target, in a fixed order.
///
/// # Panics
/// If the target has no initial inputs.
pub fn seeds(target: &Target) -> Vec<Seed> {
    let law = target.name.split_once('_').map_or("", |(_, law)| law);
    let mut seeds = match (target.family(), law) {
        ("operation", "dispatch") => calls(),
        ("operation", "request") => operations::requests(),
        ("operation", "reply") => operations::replies(),
        ("ads", "frames") => events::frames(),
        ("streaming", "packets") => texts::programs(),
        ("streaming", "sender") => events::senders(),
        ("streaming", "checker") => texts::lots(),
        ("service", "host") => events::worlds(),
        ("service", "machines") => events::machines(),
        ("text", "cp1252") => texts::texts(),
        ("variable", "path") => texts::names(),
        ("variable", "typed") => values(),
        #[cfg(feature = "tools")]
        ("tools" | "cnc", _) => tools::seeds(target.name),
        (family, "bytes") => {
            let family = family_of(family);
            samples(family).chain(of_vectors(family)).collect()
        }
        // These targets make a value from any bytes, so samples of streams are suitable inputs too.
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

/// Samples of the streams of a family, after the byte that selects the stream.
fn samples(family: Family) -> impl Iterator<Item = Seed> {
    common::each_sample().filter_map(move |(stream, sample)| {
        let name = format!("{stream}-{}", sample.slug);
        Some((name, [vec![pick(family, stream)?], sample.bytes()].concat()))
    })
}

/// The accepted and rejected vectors of a family, in the same form as the [`samples`].
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

/// Inputs of the target `variable_typed`: type, dimensions, indices, size (0: the actual size), value.
fn values() -> Vec<Seed> {
    let of = |name: &str, before: &[u8], value: &[u8]| (name.to_string(), [before, value].concat());
    let mut seeds: Vec<_> = (0..)
        .zip(DataType::ALL)
        .flat_map(|(pick, data_type)| {
            let each = data_type.size().unwrap_or(4);
            let bytes: Vec<u8> = (0..each * 12).map(|at| (at * 5) as u8).collect();
            let name = format!("{data_type:?}").to_lowercase();
            [
                of(&format!("{name}-one"), &[pick, 0, 0], &bytes[..each as usize]),
                of(&format!("{name}-list"), &[pick, 1, 12, 9, 0], &bytes),
                of(&format!("{name}-rows"), &[pick, 2, 3, 4, 2, 1, 0], &bytes),
                of(&format!("{name}-beyond"), &[pick, 2, 3, 4, 2, 4, 0], &bytes),
            ]
        })
        .collect();
    let most = [0xFF; 5];
    seeds.extend([
        of("cube", &[2, 3, 2, 3, 2, 1, 2, 1, 0], b"twelve bytes"),
        of("no-element", &[3, 2, 4, 0, 1, 0, 0], b""),
        of("index-too-many", &[2, 0xF2, 12, 3, 3, 0], b"twelve bytes"),
        of("size-of-another", &[4, 1, 3, 2, 13], b"twelve bytes"),
        of("product-overflows", &[&[2, 4][..], &most, &most, &most, &most, &[0; 5]].concat(), b""),
    ]);
    seeds
}
