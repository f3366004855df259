//! Tests of the feature `arbitrary`, which generates valid values of streams.

#![cfg(feature = "arbitrary")]

use ads_cnc::ads::*;
use ads_cnc::*;
use proptest::prelude::*;

use super::common::{Mutation, SUBJECTS, made};
use super::kept;

proptest! {
    #![proptest_config(kept::cases(200, file!()))]

    /// Values of all streams encode without an error, whatever the bytes from which they are
    /// generated.
    #[test]
    fn values_encode(bytes in prop::collection::vec(any::<u8>(), 0..4000)) {
        for subject in SUBJECTS {
            (subject.made)(&bytes, &Mutation::NONE);
        }
    }
}

/// The generated values include texts with and without a NUL, replies with and without data, and
/// lists with few and many items.
#[test]
fn values_vary() {
    let mut seen = std::collections::BTreeSet::new();
    for seed in 0..400_u32 {
        // A linear congruential generator of full period is sufficiently random for this test.
        let mut state = seed.wrapping_mul(2_654_435_761).wrapping_add(1);
        let bytes: Vec<u8> = std::iter::repeat_with(|| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.to_be_bytes()[0]
        })
        .take(64 + seed as usize * 8)
        .collect();
        let variable: Description = made(&bytes);
        seen.insert(match variable.name.tail {
            None => {
                // A name field has at least one byte (VAR-4), so a name without a NUL has a
                // character.
                assert!(!variable.name.text.as_bytes().is_empty());
                "open name"
            }
            Some(tail) if tail.is_empty() => "one NUL",
            Some(_) => "bytes behind the NUL",
        });
        seen.insert(match variable.dimensions.len() {
            0 => "elementary",
            1..=9 => "array",
            _ => "more dimensions than any variable has",
        });
        let kind = made::<VariableKind>(&bytes).kind;
        seen.insert(if kind.tail.is_none() { "no kind" } else { "kind" });
        seen.insert(if made::<ReadReply>(&bytes).data.is_some() { "data" } else { "no data" });
        seen.insert(match made::<Descriptors>(&bytes).as_ref().len() {
            1 => "one descriptor",
            _ => "descriptors",
        });
    }
    assert_eq!(seen.len(), 12, "{seen:?}");
}
