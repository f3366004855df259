//! The cases of frames on a TCP stream, and of the empty stream `NoData`.

use ads_cnc::ads::FrameRef;
use ads_cnc::{Decode, Encode, NoData};

use crate::case::{Case, Limit, each};
use crate::hand::{self, HandWritten};

const ENCODE: &[Limit] = &[Limit::Instructions("encode by hand", 3.0)];
const MAX: u32 = 1024;

pub(super) const CASES: &[Case] = &[
    Case::new("frame", "split", || each!(frames(), |bytes| FrameRef::split(bytes, MAX))),
    Case::new("frame", "split by hand", || each!(frames(), |bytes| hand::Frame::split(bytes, MAX))),
    Case::new("frame", "rejected", || each!(rejected(), |bytes| FrameRef::split(bytes, MAX)))
        .within(&[Limit::Over("split", 200.0)]),
    Case::new("frame", "encode", || {
        let frames: &[Vec<u8>] = frames().leak();
        let mut buf = [0; 4096];
        let frame = |bytes| FrameRef::split(bytes, MAX).unwrap().unwrap().0;
        each!(frames.iter().map(|bytes| frame(bytes)).collect::<Vec<_>>(), |frame| frame
            .encode(&mut buf))
    })
    .within(ENCODE),
    Case::new("frame", "encode by hand", || {
        let frames: &[Vec<u8>] = frames().leak();
        let mut buf = [0; 4096];
        let frame = |bytes| hand::Frame::split(bytes, MAX).unwrap().unwrap().0;
        each!(frames.iter().map(|bytes| frame(bytes)).collect::<Vec<_>>(), |frame| frame
            .encode(&mut buf))
    }),
    Case::new("no data", "decode", || each!(nothing(), |bytes| NoData::decode(bytes))),
    Case::new("no data", "decode by hand", || {
        each!(nothing(), |bytes| hand::Nothing::decode(bytes))
    }),
    Case::new("no data", "encode", || each!([NoData; 100], |none| none.encode(&mut [])))
        .within(ENCODE),
    Case::new("no data", "encode by hand", || {
        each!([hand::Nothing; 100], |none| none.encode(&mut []))
    }),
];

fn nothing() -> Vec<Vec<u8>> {
    vec![vec![]; 100]
}

/// Frames with the AMS header of a Read request, and with 0 to 48 bytes of data.
fn frames() -> Vec<Vec<u8>> {
    (0..100).map(|at| frame(at, at % 5 * 12)).collect()
}

fn frame(at: u32, data_length: u32) -> Vec<u8> {
    let mut bytes = vec![0, 0];
    bytes.extend((data_length + 32).to_le_bytes());
    bytes.extend(b"\x7f\0\0\x01\x01\x01\x29\x02\xc0\0\x02\x07\x01\x01\x01\x80\x02\0\x04\0");
    bytes.extend(data_length.to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(at.to_le_bytes());
    bytes.extend((0..data_length).map(|byte| byte as u8));
    bytes
}

/// Frames with one fault each: `reserved` is not 0, `length` is too small or too large, or
/// `data_length` is wrong.
fn rejected() -> Vec<Vec<u8>> {
    let broken = |(at, mut bytes): (usize, Vec<u8>)| {
        bytes[[0, 2, 4, 26][at % 4]] = 7;
        bytes
    };
    frames().into_iter().enumerate().map(broken).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The codec and the handwritten code split the same frames off: unchanged frames, frames
    /// truncated at every length, and frames with one byte of their headers changed.
    #[test]
    fn by_hand_splits_the_same_frames() {
        let changed = |bytes: &Vec<u8>| {
            let flip = |(at, by): (usize, u8)| {
                let mut bytes = bytes.clone();
                bytes[at] ^= by;
                bytes
            };
            (0..38).flat_map(|at| [1, 7, 0xFF].map(|by| (at, by))).map(flip).collect::<Vec<_>>()
        };
        let whole = frames();
        let cuts = whole.iter().flat_map(|bytes| (0..bytes.len()).map(|len| bytes[..len].to_vec()));
        let all = whole.iter().cloned().chain(cuts).chain(whole.iter().flat_map(changed));
        let mut seen = [0; 3];
        for bytes in all.chain(rejected()) {
            match (FrameRef::split(&bytes, MAX), hand::Frame::split(&bytes, MAX)) {
                (Ok(None), Ok(None)) => seen[0] += 1,
                (Err(_), Err(_)) => seen[1] += 1,
                (Ok(Some((codec, len))), Ok(Some((hand, by_hand)))) => {
                    let (mut one, mut two) = ([0; 4096], [0; 4096]);
                    assert_eq!((len, codec.encode(&mut one).unwrap()), (by_hand, &bytes[..len]));
                    assert_eq!(hand.encode(&mut two).unwrap(), &bytes[..len]);
                    seen[2] += 1;
                }
                other => panic!("{bytes:02x?}: {other:?}"),
            }
        }
        assert!(seen.iter().all(|&times| times > 0));
    }

    #[test]
    fn by_hand_takes_the_same_nothing() {
        for bytes in [&[][..], &[0], &[0; 2]] {
            assert_eq!(NoData::decode(bytes).is_ok(), hand::Nothing::decode(bytes).is_ok());
        }
        assert_eq!(hand::Nothing.encode(&mut []), Ok(&[][..]));
    }
}
