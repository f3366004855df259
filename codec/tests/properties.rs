//! Checks the laws of all streams (`common/laws.rs`) for samples and vectors, for random bytes, and
//! for mutated samples and vectors.

use std::collections::BTreeSet;

use ads_cnc::layout::{Size, Stream};
use ads_cnc_vectors::vectors;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

use super::common::{SUBJECTS, check, each_sample};
use super::damage::damage;
use super::kept;

/// The bytes of every sample, and of every golden vector of a stream.
fn samples_and_vectors() -> Vec<(Stream, Vec<u8>)> {
    let samples = each_sample().map(|(stream, sample)| (stream, sample.bytes()));
    let of_stream = vectors()
        .iter()
        .filter_map(|vector| Some((Stream::by_name(&vector.stream)?, vector.bytes())));
    samples.chain(of_stream).collect()
}

/// Random bytes for a stream: at most 16 bytes, at most 120 bytes, or the maximum length of the
/// stream if this is less than 120 bytes.
fn random_bytes() -> impl Strategy<Value = (Stream, Vec<u8>)> {
    let byte = || prop_oneof![Just(0), 0..4_u8, any::<u8>()];
    (0..SUBJECTS.len(), 0..3).prop_flat_map(move |(subject, length)| {
        let stream = SUBJECTS[subject].stream;
        let max = stream.layout().max as usize;
        let len = match length {
            0 => 0..=16,
            1 if max < 120 => max..=max,
            _ => 0..=120,
        };
        (Just(stream), vec(byte(), len))
    })
}

fn damaged_bytes() -> impl Strategy<Value = (Stream, Vec<u8>)> {
    (select(samples_and_vectors()), vec(damage(), 1..5)).prop_map(
        |((stream, mut bytes), damages)| {
            damages.iter().for_each(|damage| damage.inflict(&mut bytes));
            (stream, bytes)
        },
    )
}

/// Samples and vectors obey the laws. The results of vectors are checked in `tests/vectors.rs`.
#[test]
fn samples_and_vectors_obey_the_laws() {
    for (stream, bytes) in samples_and_vectors() {
        let _ = check(stream, &bytes);
    }
}

/// Samples with one bit flipped, or with one byte replaced by 0x00 or 0xFF, obey the laws.
#[test]
fn every_byte_of_every_sample_changed_obeys_the_laws() {
    for (stream, sample) in each_sample() {
        let mut bytes = sample.bytes();
        for at in 0..bytes.len() {
            let right = bytes[at];
            for wrong in (0..8).map(|bit| right ^ 1 << bit).chain([0, u8::MAX]) {
                bytes[at] = wrong;
                let _ = check(stream, &bytes);
            }
            bytes[at] = right;
        }
    }
}

proptest! {
    #![proptest_config(kept::cases(4000, file!()))]

    /// For random bytes, the borrowed type, the owned type and the walk have the same result, and
    /// accepted bytes encode to the same bytes.
    #[test]
    fn any_bytes_obey_the_laws((stream, bytes) in random_bytes()) {
        let _ = check(stream, &bytes);
    }

    /// The same laws hold for mutated samples and vectors, which are nearly valid.
    #[test]
    fn damaged_samples_obey_the_laws((stream, bytes) in damaged_bytes()) {
        let _ = check(stream, &bytes);
    }
}

/// Mutated samples and vectors of every stream include accepted bytes and, unless the only field of
/// the stream accepts almost any bytes, rejected bytes. Otherwise the property above would be weak.
#[test]
fn mutations_are_accepted_and_rejected_for_every_stream() {
    let (mut runner, maker) = (TestRunner::deterministic(), damaged_bytes());
    let mut seen = BTreeSet::new();
    for _ in 0..5000 {
        let (stream, bytes) = maker.new_tree(&mut runner).unwrap().current();
        seen.insert((stream, stream.walk(&bytes, |_| ()).is_ok()));
    }
    for stream in Stream::all() {
        let takes_any = matches!(stream.layout().fields, [row] if takes_any(row.size));
        assert!(seen.contains(&(stream, true)), "{stream}: none accepted");
        assert!(takes_any || seen.contains(&(stream, false)), "{stream}: none rejected");
    }
}

fn takes_any(size: Size) -> bool {
    matches!(size, Size::Rest { .. } | Size::TextAndTail { .. })
}
