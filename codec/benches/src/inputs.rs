//! The inputs of the cases of streams, made from the samples of the codec's tests, which are
//! handwritten bytes of the streams.

#[expect(dead_code, reason = "the codec's tests use more of it")]
#[path = "../../tests/common/samples.rs"]
mod samples;
#[path = "../../tests/common/samples_ads.rs"]
mod samples_ads;
#[path = "../../tests/common/samples_elements.rs"]
mod samples_elements;

use ads_cnc::layout::Stream;
use samples::Sample;

/// The minimum number of inputs in a run. A run may have more, because all samples occur equally
/// often.
const STREAMS: usize = 100;

fn each(stream: Stream) -> impl Iterator<Item = Vec<u8>> {
    let of = samples::each_sample().filter(move |(of, _)| *of == stream);
    of.map(|(_, sample)| Sample::bytes(sample))
}

/// The samples of a stream, repeated so that one-time work is negligible.
pub(crate) fn many(stream: Stream) -> Vec<&'static [u8]> {
    round(each(stream).collect())
}

/// The inputs of [`faulty`] that `accepts` rejects, repeated like those of [`many`].
pub(crate) fn rejected(stream: Stream, accepts: fn(&[u8]) -> bool) -> Vec<&'static [u8]> {
    round(faulty(stream).filter(|bytes| !accepts(bytes)).collect())
}

/// Inputs that may be faulty: truncated samples, samples with an extra byte, and long inputs of one
/// repeated byte.
pub(crate) fn faulty(stream: Stream) -> impl Iterator<Item = Vec<u8>> {
    let cut = each(stream)
        .flat_map(|bytes| (0..bytes.len()).map(|len| bytes[..len].to_vec()).collect::<Vec<_>>());
    let more = each(stream).flat_map(|bytes| [0, 1].map(|more| [&bytes[..], &[more]].concat()));
    let long = stream.layout().max as usize + 1;
    let text = [b' ', 0xFF].map(|byte| vec![byte; long.min(4096)]);
    cut.chain(more).chain(text).chain([vec![0; long]])
}

fn round(of: Vec<Vec<u8>>) -> Vec<&'static [u8]> {
    let times = STREAMS.div_ceil(of.len().max(1));
    let of: Vec<&'static [u8]> = of.into_iter().map(|bytes| &*bytes.leak()).collect();
    of.repeat(times)
}

/// Every sample unchanged, the inputs of [`faulty`], and every sample with one byte changed.
#[cfg(test)]
pub(crate) fn all(stream: Stream) -> impl Iterator<Item = Vec<u8>> {
    let flip = |(at, by): (usize, u8), bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes[at] ^= by;
        bytes
    };
    let changed = each(stream).flat_map(move |bytes| {
        let places = (0..bytes.len()).flat_map(|at| [0x01, 0x80, 0xFF].map(|by| (at, by)));
        places.map(move |place| flip(place, &bytes)).collect::<Vec<_>>()
    });
    each(stream).chain(faulty(stream)).chain(changed)
}
