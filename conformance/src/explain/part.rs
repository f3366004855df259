//! Explains a stream by its field table.

use ads_cnc::ErrorKind;
use ads_cnc::layout::{Segment, Stream};

use super::explanation::{ExplainedFault, ExplainedStream};
use super::nc;
use super::value;
use crate::number::to_usize;
use crate::value_format::ValueFormat;

/// Explains a stream that begins at `at` of the input.
pub(super) fn of_stream(
    stream: Stream,
    at: usize,
    bytes: &[u8],
    values: &ValueFormat,
) -> ExplainedStream {
    let mut part = ExplainedStream::new(stream, at, bytes);
    let (mut segments, fault) = walk(stream, bytes);
    if fault.is_some_and(|error| error.kind() == ErrorKind::TooLong) && segments.is_empty() {
        // If the stream is too long, show the fields up to the maximum length.
        (segments, _) = walk(stream, bytes.get(..to_usize(stream.layout().max)).unwrap_or(bytes));
    }
    let mut end = 0_usize;
    for segment in &segments {
        end = to_usize(segment.offset).saturating_add(segment.bytes.len());
        match stream {
            Stream::ProgramStream => nc::add(&mut part, segment),
            _ => value::add(&mut part, stream, segment, values),
        }
    }
    if let Some(error) = fault {
        part.push_fault(ExplainedFault::of(&error, 0));
        part.leave(end, bytes);
    }
    match stream {
        Stream::ObjectAddress if bytes == [0; 8] => {
            part.notes.push("0 and 0: the class has no such instance (SDA-2)".to_owned());
        }
        Stream::VariableExtendedDescription if bytes.is_empty() => {
            part.notes.push("V.G and V.A have no extended description (VAR-16)".to_owned());
        }
        Stream::VariableKind if matches!(bytes, [] | [0]) => {
            part.notes.push("without a kind: the sum of V.E, V.G and V.A (VAR-1)".to_owned());
        }
        _ => {}
    }
    part
}

fn walk(stream: Stream, bytes: &[u8]) -> (Vec<Segment<'_>>, Option<ads_cnc::Error>) {
    let mut segments = Vec::new();
    let walked = stream.walk(bytes, |segment| segments.push(segment));
    (segments, walked.err())
}
