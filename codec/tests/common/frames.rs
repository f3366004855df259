//! Laws of frames on a TCP stream, which may be received in any pieces (ADS-5).

use ads_cnc::ads::{AmsHeader, FrameRef};
use ads_cnc::limits::ADS_DATA_MAX;
use ads_cnc::{Decode as _, Encode as _, Error, ErrorKind};

use super::{Fault, SAMPLES};

/// A function that splits frames: [`FrameRef::split`], or a variant with one fault.
pub(crate) type Split = for<'a> fn(&'a [u8], u32) -> Result<Option<(FrameRef<'a>, usize)>, Error>;

/// [`FrameRef::split`], without a fault.
pub(crate) const SPLIT: Split = |received, max_data| FrameRef::split(received, max_data);

/// The bytes of the first sample of an AMS header, that of a Read. Its `data_length` is 12.
pub(crate) fn frame_header() -> [u8; 32] {
    let (_, samples) = SAMPLES.iter().find(|(stream, _)| *stream == AmsHeader::STREAM).unwrap();
    samples[0].bytes().try_into().unwrap()
}

/// The bytes of a frame with this data: the AMS/TCP header and the AMS header, both with the length
/// that this data requires, and the data.
pub(crate) fn frame(data: &[u8]) -> Vec<u8> {
    let length = |more: usize| u32::try_from(data.len() + more).unwrap().to_le_bytes();
    let mut header = frame_header();
    header[20..24].copy_from_slice(&length(0));
    [&[0, 0][..], &length(32), &header, data].concat()
}

/// The expected result: the length of the first frame, `None` if it is not complete, or its first
/// fault.
fn wanted(received: &[u8], max_data: u32) -> Result<Option<usize>, Fault> {
    let number = |at: usize| u32::from_le_bytes(received[at..at + 4].try_into().unwrap()) as usize;
    let fault =
        |kind, field, offset, expected, found| Err(Fault { kind, field, offset, expected, found });
    if received.len() < 6 {
        return Ok(None);
    }
    let (reserved, length) = (u16::from_le_bytes([received[0], received[1]]), number(2));
    let most = (max_data as usize).min(ADS_DATA_MAX + 16) + 32;
    if reserved != 0 {
        return fault(ErrorKind::Mismatch, "reserved", 0, 0, reserved.into());
    }
    if length < 32 {
        return fault(ErrorKind::OutOfRange, "length", 2, 32, length);
    }
    if length > most {
        return fault(ErrorKind::TooLong, "length", 2, most, length);
    }
    if received.len() < 38 {
        return Ok(None);
    }
    if number(26) != length - 32 {
        return fault(ErrorKind::Mismatch, "data_length", 26, length - 32, number(26));
    }
    Ok((received.len() >= 6 + length).then_some(6 + length))
}

/// Checks that splitting has the expected result, and that the header and data of the first frame
/// are those in the received bytes and encode to them. Returns the length of the frame, `None` if
/// it is not complete, or its fault.
pub(crate) fn check_split(
    received: &[u8],
    max_data: u32,
    split: Split,
) -> Result<Option<usize>, Fault> {
    let found = split(received, max_data).map_err(Fault::of);
    let len = found.map(|found| found.map(|(_, len)| len));
    assert_eq!(len, wanted(received, max_data), "at most {max_data} in {received:x?}");
    if let Ok(Some((frame, len))) = found {
        assert_eq!(frame.header(), AmsHeader::decode(&received[6..38]).unwrap());
        assert_eq!(frame.data(), &received[38..len]);
        let mut buf = vec![0x55; len + 1];
        assert_eq!(frame.encode(&mut buf), Ok(&received[..len]));
        assert_eq!(buf[len], 0x55);
        assert_eq!(FrameRef::new(frame.header(), frame.data()), Ok(frame));
    }
    len
}

/// The frames of a stream in order, and the remaining bytes or the fault after them.
pub(crate) type Frames = (Vec<Vec<u8>>, Result<Vec<u8>, Fault>);

/// Receives a stream in pieces and splits off all complete frames after each piece, up to the first
/// fault.
pub(crate) fn check_frames<'p>(
    pieces: impl IntoIterator<Item = &'p [u8]>,
    max_data: u32,
    split: Split,
) -> Frames {
    let (mut frames, mut rest) = (Vec::new(), Vec::new());
    for piece in pieces {
        rest.extend_from_slice(piece);
        let mut taken = 0;
        loop {
            match check_split(&rest[taken..], max_data, split) {
                Ok(None) => break,
                Ok(Some(len)) => {
                    frames.push(rest[taken..taken + len].to_vec());
                    taken += len;
                }
                Err(fault) => return (frames, Err(fault)),
            }
        }
        rest.drain(..taken);
    }
    (frames, Ok(rest))
}

/// Checks that bytes received later do not change the length of a complete frame, or a fault.
pub(crate) fn check_verdicts_stay(bytes: &[u8], max_data: u32, split: Split) {
    let mut verdict = Ok(None);
    for cut in 0..=bytes.len() {
        let now = check_split(&bytes[..cut], max_data, split);
        assert!(verdict == Ok(None) || verdict == now, "{cut} bytes of {bytes:x?}: {now:?}");
        verdict = now;
    }
}
