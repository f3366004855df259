//! The inputs of the tests: every golden vector of a stream, every sample, and malicious variants
//! of them.

use ads_cnc::layout::Stream;
use ads_cnc_vectors::vectors;

use crate::common::each_sample;

/// Numbers of four bytes that are written over the bytes of an input. As counts or lengths, they
/// exceed the items that follow in every vector and sample.
const HUGE: [u32; 6] = [u32::MAX, 0x8000_0000, 0x7FFF_FFFF, 0x4000_0001, 0x0100_0000, 0xFFFF];

/// The length in bytes to which [`each_long`] extends a sample, unless the maximum length of the
/// stream is less. A decoder that copies an input of this length three times exceeds the limit in
/// `excess`.
pub(crate) const LONG: usize = 0x4000;

/// Every golden vector of a stream, including vectors that the decoder must reject.
pub(crate) fn each_vector() -> impl Iterator<Item = (Stream, Vec<u8>)> {
    vectors().iter().filter_map(|vector| Some((Stream::by_name(&vector.stream)?, vector.bytes())))
}

/// Calls `visit` with every vector and sample: unchanged, truncated at every length, and with
/// another number in four bytes at one offset (see [`ends`]). The number is huge ([`HUGE`]), or
/// close to the number of bytes or numbers after it ([`counts`]). Also calls `visit` with long
/// variants of every sample ([`each_long`]).
pub(crate) fn each_input(mut visit: impl FnMut(Stream, &[u8])) {
    let samples = || each_sample().map(|(stream, sample)| (stream, sample.bytes()));
    for (stream, bytes) in each_vector().chain(samples()) {
        visit(stream, &bytes);
        (0..bytes.len()).for_each(|cut| visit(stream, &bytes[..cut]));
        let mut lie = bytes.clone();
        for at in ends(bytes.len().saturating_sub(3)) {
            let left = (bytes.len() - at - 4) as u32;
            for number in HUGE.into_iter().chain(counts(left)) {
                lie[at..at + 4].copy_from_slice(&number.to_le_bytes());
                visit(stream, &lie);
            }
            lie.copy_from_slice(&bytes);
        }
    }
    samples().for_each(|(stream, bytes)| each_long(stream, &bytes, &mut visit));
}

/// The first 128 and the last 63 indices below `places`; all indices if `places` is at most 191.
fn ends(places: usize) -> impl Iterator<Item = usize> {
    (0..places).filter(move |at| *at < 128 || *at + 64 > places)
}

/// Counts close to the number of remaining bytes, or of remaining numbers of four bytes.
fn counts(left: u32) -> [u32; 6] {
    [left, left + 1, left.saturating_sub(1), left / 4, left / 4 + 1, (left / 4).saturating_sub(1)]
}

/// Calls `visit` with long inputs. One repeats the sample as often as fits into the smaller of
/// [`LONG`] and the maximum length of the stream. Others extend the sample to this length, and to
/// one byte more than the maximum. In those of this length, the four bytes at each offset of the
/// sample, in turn, are also replaced by [`counts`] of the bytes after them.
fn each_long(stream: Stream, sample: &[u8], visit: &mut impl FnMut(Stream, &[u8])) {
    let max = stream.layout().max as usize;
    let len = max.min(LONG);
    if !sample.is_empty() {
        let whole = sample.repeat(len / sample.len());
        visit(stream, &whole);
    }
    for fill in [0, 7] {
        let mut bytes = sample.to_vec();
        bytes.resize(max + 1, fill);
        visit(stream, &bytes);
        bytes.truncate(len);
        visit(stream, &bytes);
        for at in 0..sample.len().min(len.saturating_sub(3)) {
            let number: [u8; 4] = bytes[at..at + 4].try_into().unwrap();
            for count in counts((len - at - 4) as u32) {
                bytes[at..at + 4].copy_from_slice(&count.to_le_bytes());
                visit(stream, &bytes);
            }
            bytes[at..at + 4].copy_from_slice(&number);
        }
    }
}
