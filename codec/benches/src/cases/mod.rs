//! The cases, in one module for each group of subjects.

mod ads;
mod description;
mod descriptors;
mod dispatch;
mod dynamic;
mod elements;
mod frames;
mod growth;
mod objects;
mod stream;
mod streaming;
mod variables;

use stream::Entry;

use crate::Case;

/// All cases, in a fixed order.
pub fn all() -> impl Iterator<Item = Case> {
    let lists = [descriptors::CASES, description::CASES].into_iter().flatten();
    let streams = streams().flat_map(|entry| entry.cases);
    let growth = growth::CASES.iter().copied().flatten();
    let calls = [dispatch::FUNCTIONS, dispatch::REJECTIONS].into_iter().flatten();
    let texts = streaming::PACKETS.iter().chain(streaming::CHECKS).copied().flatten();
    let texts = texts.chain(streaming::GROWTH);
    let all = lists.chain(streams).chain(frames::CASES).chain(growth).chain(calls).chain(texts);
    all.copied()
}

/// The cases that are not long, and have a limit or are the reference of one.
pub fn gate() -> impl Iterator<Item = Case> {
    all().filter(Case::is_gated)
}

/// All cases that are not in [`gate`].
pub fn others() -> impl Iterator<Item = Case> {
    all().filter(|case| !case.is_gated())
}

fn streams() -> impl Iterator<Item = &'static Entry> {
    [ads::STREAMS, objects::STREAMS, elements::STREAMS, dynamic::STREAMS, variables::STREAMS]
        .into_iter()
        .flatten()
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use ads_cnc::layout::Stream;

    use super::*;

    #[test]
    fn every_stream_is_measured_once() {
        let measured: Vec<_> = streams().map(|entry| entry.stream).collect();
        for stream in Stream::all() {
            assert_eq!(measured.iter().filter(|&&one| one == stream).count(), 1, "{stream}");
        }
    }

    /// The codec and the handwritten code accept, reject and encode the same bytes of every stream.
    #[test]
    fn codec_and_hand_agree_on_every_stream() {
        streams().for_each(|entry| (entry.alike)());
    }

    #[test]
    fn names_differ_and_limits_refer_to_cases_there_are() {
        let names: HashSet<_> = all().map(|case| (case.subject, case.implementation)).collect();
        assert_eq!(names.len(), all().count());
        for case in all() {
            for other in case.limits.iter().map(crate::Limit::against) {
                assert!(
                    names.contains(&(case.subject, other)),
                    "{}/{}",
                    case.subject,
                    case.implementation
                );
            }
        }
    }

    /// Every case has units, and can be run twice.
    #[test]
    fn every_case_runs() {
        for case in all() {
            let mut work = (case.prepare)();
            assert!(work.units > 0, "{}/{}", case.subject, case.implementation);
            (work.run)();
            (work.run)();
        }
    }
}
