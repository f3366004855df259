//! What owned readings allocate.

use std::collections::BTreeMap;
use std::hint::black_box;

use ads_cnc::layout::Stream;

use crate::common::Subject;
use crate::counting::allocations;
use crate::inputs::{LONG, each_input};
use crate::{excess, start};

/// No count or length in the bytes makes an owned reading hold more than the bytes warrant.
#[test]
fn owned_readings_hold_no_more_than_the_input_warrants() {
    // Refused and accepted inputs, and the longest accepted one.
    let mut seen: BTreeMap<Stream, (u32, u32, usize)> = BTreeMap::new();
    each_input(|stream, bytes| {
        let decode = Subject::of(stream).owned.len;
        assert_eq!(
            excess(decode, bytes),
            0,
            "{stream}: {} bytes: {:x?}",
            bytes.len(),
            start(bytes)
        );
        let (refused, accepted, longest) = seen.entry(stream).or_default();
        match decode(bytes) {
            Ok(len) => (*accepted, *longest) = (*accepted + 1, len.max(*longest)),
            Err(_) => *refused += 1,
        }
    });
    for stream in Stream::all() {
        let (refused, accepted, longest) = seen[&stream];
        let long = (stream.layout().max as usize).min(LONG) / 2;
        assert!(refused > 0 && accepted > 0 && longest >= long, "{stream}: {:?}", seen[&stream]);
    }
}

/// To encode an owned reading allocates nothing on top of what it took to decode it.
#[test]
fn encoders_of_owned_readings_allocate_nothing() {
    let mut buf = vec![0; 0x41_0000];
    each_input(|stream, bytes| {
        let owned = Subject::of(stream).owned;
        let decoding = allocations(|| {
            let _ = black_box((owned.len)(bytes));
        });
        let both = allocations(|| {
            let _ = black_box((owned.encode)(bytes, &mut buf));
        });
        assert_eq!(both, decoding, "{stream}: {:x?}", start(bytes));
    });
}

/// The same count finds an owned reading out.
#[test]
fn owned_readings_are_seen_to_allocate() {
    let owned = Subject::of(Stream::VariableHandleRead).owned;
    let request = [1, 0, 0, 2, 1, 0, 0, 0, 4, 0, 0, 0];
    let decoding = allocations(|| {
        black_box((owned.len)(&request).unwrap());
    });
    assert!(decoding > 0);
}
