//! What is decoded: every golden vector, every sample, and what an attacker would make of them.

use ads_cnc::layout::Stream;
use ads_cnc_vectors::vectors;

use crate::common::each_sample;

/// Numbers that four bytes on the wire can promise and no stream can hold.
const HUGE: [u32; 6] = [u32::MAX, 0x8000_0000, 0x7FFF_FFFF, 0x4000_0001, 0x0100_0000, 0xFFFF];

/// Bytes of a long input; enough for a factor to show beside 4 KiB.
pub(crate) const LONG: usize = 0x4000;

/// Every golden vector of a stream, accepted or refused.
pub(crate) fn each_vector() -> impl Iterator<Item = (Stream, Vec<u8>)> {
    vectors().iter().filter_map(|vector| Some((Stream::by_name(&vector.stream)?, vector.bytes())))
}

/// Every vector and every sample: as it is, cut at every length, with every number in it huge or
/// at odds with the bytes there are; and every sample drawn out to the longest stream and beyond.
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

/// The first and the last of so many places, all of them if they are few.
fn ends(places: usize) -> impl Iterator<Item = usize> {
    (0..places).filter(move |at| *at < 128 || *at + 64 > places)
}

/// Counts of bytes and of numbers about as many as are left.
fn counts(left: u32) -> [u32; 6] {
    [left, left + 1, left.saturating_sub(1), left / 4, left / 4 + 1, (left / 4).saturating_sub(1)]
}

/// A sample repeated, and a sample and more bytes, each number in it once a count of what follows.
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
