//! Tests of the samples: every stream except `NoData` has samples, and a walk finds the fields that
//! they list.

use std::collections::HashSet;

use ads_cnc::layout::Stream;

use super::common::{SAMPLES, SUBJECTS, check, each_sample};

/// Every stream except `NoData` occurs exactly once in `SAMPLES` and once in `SUBJECTS`, and has at
/// least one sample.
#[test]
fn every_stream_has_samples_and_types() {
    let sampled: Vec<Stream> = SAMPLES.iter().map(|&(stream, _)| stream).collect();
    let read: Vec<Stream> = SUBJECTS.iter().map(|subject| subject.stream).collect();
    for stream in Stream::all() {
        let times = |list: &[Stream]| list.iter().filter(|&&one| one == stream).count();
        assert_eq!((times(&sampled), times(&read)), (1, 1), "{stream}");
    }
    assert_eq!((sampled.len(), read.len()), (Stream::all().count(), Stream::all().count()));
    assert!(SAMPLES.iter().all(|(_, samples)| !samples.is_empty()));
}

/// No two samples of a stream share a slug or their bytes.
#[test]
fn samples_differ() {
    for (stream, samples) in SAMPLES {
        let slugs: HashSet<_> = samples.iter().map(|sample| sample.slug).collect();
        let bytes: HashSet<_> = samples.iter().map(|sample| sample.bytes()).collect();
        assert_eq!((slugs.len(), bytes.len()), (samples.len(), samples.len()), "{stream}");
    }
}

/// Every sample is accepted and encodes to the same bytes, by each type of its stream.
#[test]
fn samples_are_accepted_and_encode_to_themselves() {
    for (stream, sample) in each_sample() {
        assert_eq!(check(stream, &sample.bytes()), Ok(()), "{stream} {}", sample.slug);
    }
}

/// A walk of a sample finds the fields that the sample lists.
#[test]
fn walks_find_the_fields_of_the_samples() {
    for (stream, sample) in each_sample() {
        let bytes = sample.bytes();
        let mut found = Vec::new();
        stream
            .walk(&bytes, |segment| {
                if !segment.bytes.is_empty() {
                    found.push((segment.field.name(), segment.offset as usize, segment.bytes));
                }
            })
            .unwrap();
        let wanted: Vec<_> = sample.places().collect();
        assert_eq!(found, wanted, "{stream} {}", sample.slug);
    }
}
