//! Every function accepts and rejects the same requests, and the same replies up to the read
//! length, as the streams in its row of the table of functions.

use std::collections::BTreeSet;

use ads_cnc::layout::Stream;
use ads_cnc::limits::DESCRIPTOR_LEN;
use ads_cnc::operation::{Call, Function};
use ads_cnc_vectors::vectors;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

use super::common::{CALLS, CallSample, check_reply, check_request, each_sample};
use super::damage::{Damage, damage};
use super::kept;

/// The bytes of every sample and vector of a stream; for `None`, only empty bytes.
fn bytes_of(stream: Option<Stream>) -> Vec<Vec<u8>> {
    let Some(stream) = stream else { return vec![vec![]] };
    let samples = each_sample().filter(|&(other, _)| other == stream);
    let vectors = vectors().iter().filter(|vector| vector.stream == stream.layout().name);
    let samples = samples.map(|(_, sample)| sample.bytes());
    samples.chain(vectors.map(|vector| vector.bytes())).collect()
}

/// The lengths to which a stream is truncated: all lengths of a stream of at most 300 bytes; only
/// some lengths of a longer stream, to save time.
fn cuts(len: usize) -> impl Iterator<Item = usize> {
    (0..=len).filter(move |&cut| len <= 300 || cut < 40 || len - cut < 8 || cut % 101 == 0)
}

/// The call of a sample with this data, and with a read length for the longest reply of its
/// function.
fn widest<'a>(sample: &CallSample, data: &'a [u8]) -> Call<'a> {
    let most = sample.function.spec().reply.map_or(0, |stream| stream.layout().max);
    let read_length = match sample.function {
        Function::ReadDescriptors => most - most % DESCRIPTOR_LEN as u32,
        _ => most,
    };
    Call { data, read_length, ..sample.call }
}

/// Each function accepts and rejects the same data as the stream of its request, for every sample
/// and vector of this stream, truncated at the lengths of [`cuts`]. The request of an accepted call
/// encodes to a call with the same address and data.
#[test]
fn requests_are_those_of_the_table() {
    let mut accepted = BTreeSet::new();
    for sample in CALLS {
        for bytes in bytes_of(sample.function.spec().request) {
            for len in cuts(bytes.len()) {
                let call = Call { data: &bytes[..len], ..sample.call };
                if check_request(&call, sample.function).is_ok() {
                    accepted.insert(sample.function);
                }
            }
        }
    }
    assert_eq!(accepted, Function::ALL.iter().copied().collect());
}

/// Each function accepts and rejects the same replies as the stream of its reply, up to the read
/// length.
#[test]
fn replies_are_those_of_the_table() {
    let mut accepted = BTreeSet::new();
    for sample in CALLS {
        let call = widest(sample, sample.call.data);
        for bytes in bytes_of(sample.function.spec().reply) {
            for len in cuts(bytes.len()) {
                if check_reply(&call, &bytes[..len]).is_ok() {
                    accepted.insert(sample.function);
                }
                let _ = check_reply(&sample.call, &bytes[..len]);
            }
            let _ = check_reply(&call, &[&bytes[..], &[0xAA; 2049]].concat());
        }
    }
    assert_eq!(accepted, Function::ALL.iter().copied().collect());
}

proptest! {
    #![proptest_config(kept::cases(2000, file!()))]

    /// Mutated requests and replies have the same results as the streams in the row of the
    /// function, replies only up to the read length.
    #[test]
    fn damaged_requests_and_replies_are_those_of_the_table(
        sample in select((0..CALLS.len()).collect::<Vec<_>>()),
        (request, reply) in any::<(Index, Index)>(),
        damages in vec(damage(), 1..5),
    ) {
        let sample = &CALLS[sample];
        let spec = sample.function.spec();
        let damaged = |stream, pick: Index| {
            let mut bytes = pick.get(&bytes_of(stream)).clone();
            damages.iter().for_each(|damage: &Damage| damage.inflict(&mut bytes));
            bytes
        };
        if spec.request.is_some() {
            let data = damaged(spec.request, request);
            let _ = check_request(&Call { data: &data, ..sample.call }, sample.function);
        }
        let _ = check_reply(&widest(sample, sample.call.data), &damaged(spec.reply, reply));
    }
}
