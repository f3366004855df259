//! Explanations of any bytes, and hex as a user types it.

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::{AmsPort, FrameRef};
use ads_cnc::layout::Stream;
use ads_cnc::operation::{AdsService, Call};
use ads_cnc::streaming::{NcText, check_line_ends};
use ads_cnc::value::DataType;
use ads_cnc_conformance::explain::{
    ExplainQuery, ExplainSubject, Explanation, ExplanationOutcome, ServiceAddress, ValueFormat,
    explain, parse_hex,
};

use super::Input;
use crate::common::{self, Mutation};
use crate::{Defect, Outcome};

#[path = "../../../../conformance/tests/common/explained.rs"]
mod explained;

use explained::{check_explanation, check_printed, printed};

pub(crate) const DEFECTS: &[&str] = &[
    "the last field of a stream is not shown if it is after the sixteenth byte",
    "a fault after the eighth byte is not found",
    "the last byte of hex with a hyphen is lost",
    "a text with an escape is printed unchanged",
    "only the first of several frames is shown",
    "a stream without a fault is shown twice if it has fields",
    "frames that the codec rejects have no fault",
];

/// Input: the subject (1 byte): a stream (0), data at an address (1), an address (2), frames (3), frames
/// with an address for replies (4), hex (5).
///
/// Hex is the rest of the input. The other subjects have the index of the stream, the type, the
/// number of dimensions, the first dimension, the address (not for 0 and 3) and the bytes.
pub(crate) fn check(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let what = input.byte();
    if what == 5 {
        return hex(input.rest(), defect);
    }
    let streams: Vec<Stream> = Stream::all().collect();
    let stream = *input.choose(&streams);
    let values = values(&mut input);
    let place = (what != 0 && what != 3).then(|| place(&mut input));
    let bytes = input.rest();
    let subject = match (what, place) {
        (0, _) => ExplainSubject::Stream(stream),
        (1, Some(place)) => ExplainSubject::Place(place),
        (2, Some(place)) if bytes.is_empty() => ExplainSubject::Address(place),
        (3 | 4, place) => ExplainSubject::Frames(place),
        _ => return Outcome::unread(),
    };
    let typed = values.ty.is_some();
    let mut explanation = explain(&ExplainQuery { subject, values }, bytes);
    mutation(&mut explanation, defect);
    check_explanation(&explanation, bytes);
    let mut plain = printed(&explanation);
    if defect.is(4) && explanation.parts.iter().any(has_escape) {
        plain.push(0x1B);
    }
    check_printed(&plain);
    let overlooked = |at: usize| defect.is(2) && at > 8 || defect.is(7) && what > 2;
    let told = explanation.parts.iter().flat_map(|part| &part.faults);
    let faulty = told.filter(|fault| !overlooked(fault.offset)).count() > 0;
    match what {
        0 => accepts(stream, bytes, typed, faulty),
        1 => {
            place.iter().for_each(|place| dispatches(place, bytes, &explanation, faulty && !typed))
        }
        3 | 4 => assert!(faulty || are_frames(bytes), "{explanation:#?}"),
        _ => {}
    }
    match explanation.outcome {
        ExplanationOutcome::Explained => Outcome::accepted(plain),
        _ => Outcome::rejected(plain),
    }
}

fn has_escape(part: &ads_cnc_conformance::explain::ExplainedStream) -> bool {
    part.rows.iter().any(|row| row.ty == "STRING" && row.hex.contains("1b"))
}

fn mutation(explanation: &mut Explanation, defect: Defect) {
    if defect.is(1) {
        for part in &mut explanation.parts {
            if part.rows.last().is_some_and(|last| last.offset > 16) {
                part.rows.pop();
            }
        }
    }
    if defect.is(5)
        && explanation.parts.iter().filter(|part| part.title.contains("AMS/TCP")).count() > 1
    {
        explanation.parts.truncate(3);
    }
    if defect.is(6) && matches!(explanation.outcome, ExplanationOutcome::Explained) {
        let again = explanation.parts.iter().find(|part| !part.rows.is_empty()).cloned();
        explanation.parts.extend(again);
    }
}

/// An explanation has a fault if the codec rejects the bytes, or if the stream is an NC text that
/// cannot be streamed to its end. If the input has no type, it has a fault only then.
fn accepts(stream: Stream, bytes: &[u8], typed: bool, faulty: bool) {
    let rejected = common::check_bent(stream, bytes, &Mutation::NONE).is_err()
        || stream == Stream::ProgramStream && !is_nc(bytes);
    assert!(faulty || !rejected, "{stream} has no fault, but the codec rejects it");
    // If the input names a type, the value may not fit this type although the codec accepts the stream.
    assert!(typed || faulty == rejected, "{stream} has a fault, but the codec accepts it");
}

/// Whether these bytes are an NC text that can be streamed to its end.
fn is_nc(bytes: &[u8]) -> bool {
    check_line_ends(bytes).is_ok()
        && NcText::new(bytes)
            .is_ok_and(|text| !text.diagnostics().any(|finding| finding.kind.ends_streaming()))
}

/// The explanation names the function to which the codec dispatches the call.
fn dispatches(place: &ServiceAddress, bytes: &[u8], explanation: &Explanation, faulty: bool) {
    let (Some(port), Some(service), false) = (place.port, place.service, place.reply) else {
        return;
    };
    let call = Call {
        port,
        service,
        index_group: place.group,
        index_offset: place.offset,
        read_length: 0xFFFF,
        data: bytes,
    };
    let Ok(request) = call.dispatch() else { return };
    let spec = request.function().spec();
    let part = &explanation.parts[0];
    let named = part.address.as_ref().and_then(|address| address.function.as_ref());
    assert_eq!(named.map(|function| function.name), Some(spec.name), "{call:?}");
    let is_nc = part.stream == Some(Stream::ProgramStream.layout().name);
    assert!(!faulty || is_nc || service == AdsService::Read, "{explanation:#?}");
}

/// Whether these bytes consist of complete frames that the codec accepts.
fn are_frames(mut bytes: &[u8]) -> bool {
    loop {
        match FrameRef::split(bytes, u32::MAX) {
            Ok(Some((_, len))) => bytes = &bytes[len..],
            _ => return false,
        }
        if bytes.is_empty() {
            return true;
        }
    }
}

fn values(input: &mut Input<'_>) -> ValueFormat {
    let ty = usize::from(input.byte()).checked_sub(1).and_then(|ty| DataType::ALL.get(ty).copied());
    let (count, length) = (input.byte(), input.byte());
    // The highest bit of the byte makes the length very large.
    let length = u32::from(length & 0x7F) << if length & 0x80 == 0 { 0 } else { 25 };
    let dimensions = [length, 2, 1][..usize::from(count % 4)].to_vec();
    ValueFormat { ty, dimensions }
}

fn place(input: &mut Input<'_>) -> ServiceAddress {
    let services =
        [None, Some(AdsService::Read), Some(AdsService::Write), Some(AdsService::ReadWrite)];
    let ports = [None, Some(551), Some(552), Some(553), Some(851)];
    ServiceAddress {
        port: input.choose(&ports).map(AmsPort),
        service: *input.choose(&services),
        reply: input.byte() & 1 == 1,
        group: IndexGroup::new(input.long()),
        offset: IndexOffset::new(input.long()),
    }
}

/// Hex consists of words of pairs of digits; a word may begin with 0x. It is read as the bytes of all
/// pairs, or rejected with the position of a wrong character.
fn hex(bytes: &[u8], defect: Defect) -> Outcome {
    let text = String::from_utf8_lossy(bytes);
    let mut read = parse_hex(&text);
    if let (true, true, Ok(read)) = (defect.is(3), text.contains('-'), &mut read) {
        read.pop();
    }
    let is_between = |one: char| one.is_whitespace() || [',', ';', ':', '-'].contains(&one);
    let words = text.split(is_between);
    let digits = words.map(|word| {
        let prefix = word.strip_prefix("0x").or_else(|| word.strip_prefix("0X"));
        let digits = prefix.unwrap_or(word);
        let pairs = digits.len() % 2 == 0 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        pairs.then_some(digits)
    });
    let digits: Option<String> = digits.collect();
    match &read {
        Ok(bytes) => {
            let shown: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
            assert_eq!(Some(shown), digits.map(|digits| digits.to_ascii_lowercase()), "{text:?}");
        }
        Err(error) => {
            assert_eq!(digits, None, "{text:?} is rejected: {error}");
            let line = text.split('\n').nth(error.line - 1).expect("a line of the text");
            let there = line.chars().nth(error.column - 1).expect("a column of it");
            assert!(error.found.is_none_or(|found| found == there), "{text:?}: {error}");
        }
    }
    Outcome::of(read.map_err(|error| error.to_string()))
}
