//! Captured traffic: files of any bytes, and conversations in segments.

use ads_cnc_conformance::capture::{
    CaptureOptions, CapturePiece, Collector, FileEnd, FileError, Ports, check as judge, frames,
};

use super::Input;
use super::conversation::Conversation;
use crate::{Defect, Outcome};

pub(crate) const DEFECTS: &[&str] = &[
    "a frame is repeated if a segment is repeated",
    "segments are used in the order of the capture",
    "missing bytes are not reported",
    "a file that ends inside a record is not reported as cut",
    "one frame too many is counted if there are more than three",
];

/// Input: a byte for a file that is read on the AMS port (0) or on all ports (1), or for a conversation
/// (2); then the file or the conversation.
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    match input.byte() {
        0 => file(input.rest(), Ports::Of(vec![48898]), defect),
        1 => file(input.rest(), Ports::Any, defect),
        2 => conversation(&mut input, defect),
        _ => Outcome::unread(),
    }
}

fn read(
    file: &[u8],
    ports: Ports,
    defect: Defect,
) -> (Result<FileEnd, FileError>, Vec<CapturePiece>) {
    let mut pieces = Vec::new();
    let mut end = frames(file, ports, |piece| pieces.push(piece));
    if let (true, Ok(end)) = (defect.is(4), &mut end) {
        *end = FileEnd::Whole;
    }
    if defect.is(3) {
        pieces.retain(|piece| matches!(piece, CapturePiece::Frame { .. }));
    }
    (end, pieces)
}

/// Any file is read to its end, reported as cut, or rejected, and all frames that were read are
/// judged.
fn file(bytes: &[u8], ports: Ports, defect: Defect) -> Outcome {
    let (end, pieces) = read(bytes, ports.clone(), defect);
    let options = CaptureOptions { ports: ports.clone(), vectors: Some(Collector::new(false)) };
    let judged = judge(bytes, options);
    let end = match (end, judged) {
        (Ok(end), Ok(judged)) => {
            let found =
                pieces.iter().filter(|piece| matches!(piece, CapturePiece::Frame { .. })).count();
            let counted = judged.tally.frames + u64::from(defect.is(5) && found > 3);
            assert_eq!(counted, found as u64);
            let told = judged.tally.end.clone();
            let told = if defect.is(4) { Some(FileEnd::Whole) } else { told };
            assert_eq!(told.as_ref(), Some(&end));
            let is_told =
                judged.tally.lines().iter().any(|line| line.contains("judged only in part"));
            assert_eq!(is_told, judged.tally.end != Some(FileEnd::Whole));
            end
        }
        (Err(end), Err(judged)) => {
            assert_eq!(end.to_string(), judged.to_string());
            return Outcome::rejected(end.to_string());
        }
        other => panic!("{other:?}"),
    };
    // NetMon files may have tables at the end, which are not read.
    let has_end = !bytes.starts_with(b"GMBU");
    if let (FileEnd::Whole, Some((_, shorter)), true) = (&end, bytes.split_last(), has_end) {
        let (cut, _) = read(shorter, ports, defect);
        assert!(!matches!(cut, Ok(FileEnd::Whole)), "the file is whole without its last byte");
    }
    let bytes: Vec<_> = pieces.iter().map(|piece| format!("{piece:?}")).collect();
    match end {
        FileEnd::Whole => Outcome::accepted(bytes),
        FileEnd::Cut(why) => Outcome::rejected((why, bytes)),
    }
}

/// The frames that are found in a conversation are those that were sent, or missing bytes are reported.
fn conversation(input: &mut Input<'_>, defect: Defect) -> Outcome {
    let mut conversation = Conversation::new(input);
    if defect.is(2) {
        sort(&mut conversation);
    }
    let file = conversation.pcap();
    let (end, pieces) = read(&file, Ports::Of(vec![48898]), defect);
    assert_eq!(end.expect("a file"), FileEnd::Whole);
    let mut found = [Vec::new(), Vec::new()];
    let mut is_lost = false;
    for piece in pieces {
        match piece {
            CapturePiece::Frame { from, bytes, .. } => {
                found[usize::from(from.port() == 48898)].push(bytes);
            }
            CapturePiece::Gap { .. } | CapturePiece::Rest(_) => is_lost = true,
        }
    }
    if defect.is(1) && conversation.is_twice {
        for side in &mut found {
            side.extend(side.last().cloned());
        }
    }
    match conversation.is_whole {
        true => {
            assert_eq!(found, conversation.sent);
            assert!(!is_lost, "no byte was missing");
        }
        false => {
            assert!(is_lost, "bytes were missing");
            for (found, sent) in found.iter().zip(&conversation.sent) {
                // Frames may be missing, but those that were found were sent in this order.
                let mut sent = sent.iter();
                assert!(found.iter().all(|frame| sent.any(|one| one == frame)));
            }
        }
    }
    Outcome::accepted(found)
}

/// Renumbers the segments of each side in their current order.
fn sort(conversation: &mut Conversation) {
    for side in [true, false] {
        let mut all: Vec<_> =
            conversation.segments.iter_mut().filter(|one| one.is_client == side).collect();
        let Some(mut sequence) = all.iter().map(|one| one.sequence).min() else { continue };
        for one in &mut all {
            one.sequence = sequence;
            sequence = sequence.wrapping_add(one.payload.len() as u32);
        }
    }
}

/// A file with a conversation.
pub(crate) fn sample() -> Vec<u8> {
    Conversation::new(&mut Input::new(&[2, 1, 4, 9, 0, 1, 0, 200, 200])).pcap()
}
