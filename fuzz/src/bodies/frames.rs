//! AMS frames in a stream whose bytes arrive in any pieces.

use ads_cnc::ErrorKind;
use ads_cnc::ads::FrameRef;

use super::input::Input;
use crate::common::{SPLIT, Split, check_frames, check_verdicts_stay, frame};
use crate::{Defect, Outcome};

/// Input: the maximum length of data, the number of cuts, the cuts (2 bytes each); then frames: the
/// length of the data, the offset and change of a byte in the headers, the data. An offset after the
/// headers changes nothing.
///
/// The stream that arrives in pieces gives the same frames as the uncut stream, and then the same
/// fault or the same incomplete rest. Each frame and each fault is found when its last byte has
/// arrived.
pub(crate) fn frames(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let (max_data, count) = (input.byte().into(), input.byte() % 16);
    let cuts: Vec<usize> = (0..count).map(|_| input.word().into()).collect();
    let (mut stream, mut whole) = (Vec::new(), Vec::new());
    let mut damaged = false;
    while !input.is_empty() {
        let (len, place, change) = (input.byte(), input.byte(), input.byte());
        let mut bytes = frame(input.bytes(len.into()));
        damaged |= bytes.len() > FrameRef::HEADERS_LEN + max_data as usize;
        if let Some(byte) = bytes[..FrameRef::HEADERS_LEN].get_mut(usize::from(place)) {
            *byte ^= change;
            damaged |= change != 0;
        }
        stream.extend_from_slice(&bytes);
        if !damaged {
            whole.push(bytes);
        }
    }

    let split = split(defect);
    let uncut = check_frames([&stream[..]], max_data, split);
    // All frames before the first damaged frame are found. More may be found, because a changed frame may
    // still be valid.
    assert!(uncut.0.starts_with(&whole), "{stream:x?}");
    let mut places: Vec<usize> = cuts.iter().map(|&cut| cut % (stream.len() + 1)).collect();
    places.extend([0, stream.len()]);
    places.sort_unstable();
    let pieces = places.windows(2).map(|cut| &stream[cut[0]..cut[1]]);
    assert_eq!(check_frames(pieces, max_data, split), uncut, "cut at {places:?}: {stream:x?}");
    // At most 64 bytes after the last frame arrive one by one; a fault does not change with later
    // bytes.
    let taken: usize = uncut.0.iter().map(Vec::len).sum();
    let behind = &stream[taken..];
    check_verdicts_stay(&behind[..behind.len().min(64)], max_data, split);

    let frames = uncut.0.len();
    match uncut.1 {
        Ok(rest) => Outcome::accepted((stream, rest)),
        Err(fault) => Outcome::rejected((frames, format!("{fault:?}"))),
    }
}

pub(crate) const DEFECTS: &[&str] = &[
    "a frame with more than eight bytes of data consumes one byte too few",
    "a fault is found only with the bytes after the headers",
    "a fault is forgotten once sixty bytes are present",
    "data that is one byte too long is accepted",
    "a frame loses its last byte of data if there are more than sixteen",
    "no frame is found while exactly three bytes follow it",
];

fn split(defect: Defect) -> Split {
    let defects: [Split; 6] = [
        |bytes, max| {
            let found = FrameRef::split(bytes, max)?;
            Ok(found.map(|(frame, len)| (frame, len - usize::from(len > 46))))
        },
        |bytes, max| match FrameRef::split(bytes, max) {
            Err(_) if bytes.len() < 40 => Ok(None),
            found => found,
        },
        |bytes, max| match FrameRef::split(bytes, max) {
            Err(_) if bytes.len() > 60 => Ok(None),
            found => found,
        },
        |bytes, max| match FrameRef::split(bytes, max) {
            Err(error) if error.kind() == ErrorKind::TooLong => FrameRef::split(bytes, max + 1),
            found => found,
        },
        |bytes, max| match FrameRef::split(bytes, max)? {
            Some((frame, len)) if frame.data().len() > 16 => {
                let data = &frame.data()[..frame.data().len() - 1];
                Ok(Some((FrameRef::new(frame.header(), data)?, len)))
            }
            found => Ok(found),
        },
        |bytes, max| match FrameRef::split(bytes, max)? {
            Some((_, len)) if bytes.len() == len + 3 => Ok(None),
            found => Ok(found),
        },
    ];
    (1..)
        .zip(defects)
        .find_map(|(number, split)| defect.is(number).then_some(split))
        .unwrap_or(SPLIT)
}

/// Writes an input of [`frames`]: cuts, then frames by their data, and the offset and change of a byte.
pub(crate) fn write(max_data: u8, cuts: &[u16], frames: &[(&[u8], u8, u8)]) -> Vec<u8> {
    let mut bytes = vec![max_data, cuts.len() as u8];
    bytes.extend(cuts.iter().flat_map(|cut| cut.to_le_bytes()));
    for &(data, place, change) in frames {
        bytes.extend([data.len() as u8, place, change]);
        bytes.extend(data);
    }
    bytes
}
