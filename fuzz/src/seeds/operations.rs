//! Initial inputs of the targets for operations and replies.

use ads_cnc::layout::Stream;
use ads_cnc::operation::Function;

use super::Seed;
use crate::bodies::operation;
use crate::common::{self, CALLS};

/// An operation of each function, once with logical addressing and once with addressing by index.
pub(super) fn requests() -> Vec<Seed> {
    let functions = (0_u8..).zip(Function::ALL);
    let places = [("first", [1, 0, 1], "V.E.Testvar[3]"), ("second", [2, 1, 2], "V.A.L\u{E4}nge")];
    let of = move |(pick, function): (u8, &Function)| {
        places.map(|(name, [channel, by_index, place], text)| {
            let text: Vec<u8> = text.chars().map(|at| at as u8).collect();
            let bytes = [
                // Function, channel, axes, spindle, class, kind, place, element, number, count.
                &[pick, channel, by_index, 2, 2, 0, 0, pick, pick, place, place, 0][..],
                &[0x10, 0, 0, 0, 84, 1, 0, 0],
                &[text.len() as u8],
                &text,
                &[2, 3, 0, 0, 0, 4, 0, 0, 0],
                b"\x7b\0\0\0",
            ];
            (format!("{}-{name}", format!("{function:?}").to_lowercase()), bytes.concat())
        })
    };
    functions.flat_map(of).collect()
}

/// Each call with each sample of the reply of its function.
pub(super) fn replies() -> Vec<Seed> {
    let samples = |stream: Option<Stream>| {
        let of = move |(of, sample): (Stream, &'static common::Sample)| {
            (stream == Some(of)).then(|| (sample.slug, sample.bytes()))
        };
        let found: Vec<_> = common::each_sample().filter_map(of).collect();
        if found.is_empty() { vec![("nothing", Vec::new())] } else { found }
    };
    let with = |call: &common::CallSample| {
        let (slug, called) = (call.slug, call.call);
        samples(call.function.spec().reply).into_iter().map(move |(reply, bytes)| {
            (format!("{slug}-{reply}"), operation::write_reply(&called, &bytes))
        })
    };
    CALLS.iter().flat_map(with).collect()
}
