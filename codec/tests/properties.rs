//! The laws of all streams over bytes: random ones, and samples and vectors with damage.

mod common;
mod damage;
mod kept;

use std::collections::BTreeSet;

use ads_cnc::layout::{Size, Stream};
use ads_cnc_vectors::vectors;
use common::{SUBJECTS, check, each_sample};
use damage::damage;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

/// Every sample, and every golden vector of a stream.
fn samples_and_vectors() -> Vec<(Stream, Vec<u8>)> {
    let samples = each_sample().map(|(stream, sample)| (stream, sample.bytes()));
    let of_stream = vectors()
        .iter()
        .filter_map(|vector| Some((Stream::by_name(&vector.stream)?, vector.bytes())));
    samples.chain(of_stream).collect()
}

/// Few bytes, many bytes, or as many as a short stream has at most.
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

/// Samples and golden vectors obey the laws; what vectors are to come to stands elsewhere.
#[test]
fn samples_and_vectors_obey_the_laws() {
    for (stream, bytes) in samples_and_vectors() {
        let _ = check(stream, &bytes);
    }
}

/// Nor does a bit of any byte make a difference to that, nor one that is all zeros or all ones.
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

    /// Random bytes: view, owned and walk agree, and what they accept comes back.
    #[test]
    fn any_bytes_obey_the_laws((stream, bytes) in random_bytes()) {
        let _ = check(stream, &bytes);
    }

    /// Damaged samples and vectors: the same, near what is valid.
    #[test]
    fn damaged_samples_obey_the_laws((stream, bytes) in damaged_bytes()) {
        let _ = check(stream, &bytes);
    }
}

/// Damage leaves some bytes of every stream to be accepted, and some to be refused unless the
/// stream takes any: without that the property above would say little.
#[test]
fn damage_reaches_both_verdicts_of_every_stream() {
    let (mut runner, maker) = (TestRunner::deterministic(), damaged_bytes());
    let mut seen = BTreeSet::new();
    for _ in 0..5000 {
        let (stream, bytes) = maker.new_tree(&mut runner).unwrap().current();
        seen.insert((stream, stream.walk(&bytes, |_| ()).is_ok()));
    }
    for stream in Stream::all() {
        let takes_any = matches!(stream.layout().fields, [row] if takes_any(row.size));
        assert!(seen.contains(&(stream, true)), "{stream}: none accepted");
        assert!(takes_any || seen.contains(&(stream, false)), "{stream}: none refused");
    }
}

fn takes_any(size: Size) -> bool {
    matches!(size, Size::Rest { .. } | Size::TextAndTail { .. })
}
