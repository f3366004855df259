//! Every sample is decoded truncated at every length, and with one extra byte. The result is an
//! error with field and offset, unless a requirement or erratum permits the changed bytes. It is
//! the same for each type of the stream.

use std::collections::BTreeSet;

use ads_cnc::Error;
use ads_cnc::ErrorKind::{self, *};
use ads_cnc::layout::Stream;

use super::common::{Fault, Sample, check, each_sample, fault};

/// The expected result of changed bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Expected {
    /// The bytes are accepted, because this requirement or erratum permits them.
    Accepted(&'static str),
    Rejected(Fault),
}

fn rejected(
    kind: ErrorKind,
    field: &'static str,
    offset: usize,
    numbers: (usize, usize),
) -> Expected {
    Expected::Rejected(fault(kind, field, offset, numbers))
}

const ADS_6: &str = "ADS-6: an error reply may stop behind the result";
const COM_3: &str = "COM-3: so many descriptors as there are";
const E_34: &str = "E-34: NULs may pad the text of a request";
const VAR_1: &str = "VAR-1: no byte at all asks for all kinds";
const VAR_4_OPEN: &str = "VAR-4: the name may end with the stream";
const VAR_4_LONGER: &str = "VAR-4: the name may be longer";
const VAR_4_BEHIND: &str = "VAR-4: bytes behind the name's NUL are kept";
const VAR_14: &str = "VAR-14: a value has any length";
const VAR_14_EMPTY: &str = "VAR-14: a value may be empty";
const COM_5: &str = "COM-5: content has any length";
const SDA_6: &str = "SDA-6: a text ends with its NUL or with the reply";
const SDA_8: &str = "SDA-8: a length has one, two or four bytes";
const DYN_2: &str = "DYN-2: a name ends with its NUL or with the reply";
const DYN_3: &str = "DYN-3: a name may come without its NUL";
const STM_5: &str = "STM-5: whether lines are whole, the CNC says when it reads them";
const VAR_16: &str = "VAR-16: V.G and V.A have no extended description";

/// The requirements and errata that permit missing or extra bytes. The test fails if one of them
/// permits no changed sample.
const ALLOWED: [&str; 16] = [
    ADS_6,
    COM_3,
    E_34,
    VAR_1,
    VAR_4_OPEN,
    VAR_4_LONGER,
    VAR_4_BEHIND,
    VAR_14,
    VAR_14_EMPTY,
    VAR_16,
    COM_5,
    SDA_6,
    SDA_8,
    DYN_2,
    DYN_3,
    STM_5,
];

/// The requirement that permits bytes (not a text) at the end of the stream, in any number up to a
/// maximum; `None` for a stream with another end, such as bytes with a field for their length.
/// `ProgramStream` has at least one such byte.
fn ends_in_bytes(stream: Stream) -> Option<&'static str> {
    match stream {
        Stream::VariableValue | Stream::VariableHandleWrite | Stream::VariableNameWrite => {
            Some(VAR_14)
        }
        Stream::Content => Some(COM_5),
        Stream::ProgramStream => Some(STM_5),
        _ => None,
    }
}

/// The kind of a text field at the end of a stream, which determines whether missing and extra
/// bytes are accepted.
#[derive(Clone, Copy, PartialEq)]
enum Text {
    /// The text ends with a NUL; more NULs may follow.
    Terminated,
    /// The text ends with a NUL, after which more NULs may follow, or at the end of the stream.
    MayTerminate,
    /// The text ends with a NUL, after which any bytes may follow, or at the end of the stream. The
    /// three strings are the requirements that permit bytes after the NUL, an end without a NUL,
    /// and a longer text.
    Open([&'static str; 3]),
}

/// The kind of a text field at the end of a stream; `None` for any other field.
fn text_of(stream: Stream, field: &str) -> Option<Text> {
    match (stream, field) {
        (Stream::VariableKind | Stream::VariableIndexKind, "kind") => Some(Text::Terminated),
        (Stream::VariableName, "name") => Some(Text::Terminated),
        (Stream::DynamicNameRequest, "name") => Some(Text::MayTerminate),
        (Stream::VariableDescription, "name") => {
            Some(Text::Open([VAR_4_BEHIND, VAR_4_OPEN, VAR_4_LONGER]))
        }
        (Stream::DynamicName, "name") => Some(Text::Open([DYN_2; 3])),
        (Stream::ElementText, "text") => Some(Text::Open([SDA_6; 3])),
        _ => None,
    }
}

/// The expected result for the first `cut` bytes of a sample, derived from the fields that the
/// sample lists.
fn expect_cut(stream: Stream, sample: &Sample, cut: usize) -> Expected {
    let (name, start, bytes) = sample
        .places()
        .find(|&(_, start, bytes)| (start..start + bytes.len()).contains(&cut))
        .expect("a cut lies in a field");
    let there = cut - start;
    match (text_of(stream, name), stream, name) {
        (Some(Text::Terminated), ..) => match there {
            0 if stream == Stream::VariableKind => Expected::Accepted(VAR_1),
            _ if bytes[..there].contains(&0) => Expected::Accepted(E_34),
            _ => rejected(MissingNul, name, start, (256, there)),
        },
        (Some(Text::MayTerminate | Text::Open(_)), stream, _)
            if there == 0 && stream != Stream::ElementText =>
        {
            rejected(Truncated, name, start, (1, 0))
        }
        (Some(Text::MayTerminate), ..) => match bytes[..there].contains(&0) {
            true => Expected::Accepted(E_34),
            false => Expected::Accepted(DYN_3),
        },
        (Some(Text::Open([behind, open, _])), ..) => match bytes[..there].contains(&0) {
            true => Expected::Accepted(behind),
            false => Expected::Accepted(open),
        },
        (None, Stream::ProgramStream, _) if there == 0 => rejected(Truncated, name, 0, (1, 0)),
        (None, _, "value") if there == 0 && ends_in_bytes(stream).is_some() => {
            Expected::Accepted(VAR_14_EMPTY)
        }
        (None, _, "value" | "content" | "data") if ends_in_bytes(stream).is_some() => {
            Expected::Accepted(ends_in_bytes(stream).unwrap())
        }
        (None, Stream::ElementLength, _) => match there {
            1 | 2 => Expected::Accepted(SDA_8),
            _ => rejected(Truncated, name, 0, (4, there)),
        },
        (None, Stream::VariableNameWrite, "name") => {
            rejected(MissingNul, name, start, (256, there))
        }
        (None, Stream::VariableExtendedDescription, _) if cut == 0 => Expected::Accepted(VAR_16),
        (None, Stream::ObjectDescriptors, "id") if there == 0 && cut > 0 => {
            Expected::Accepted(COM_3)
        }
        (None, Stream::ReadReply | Stream::ReadWriteReply, "length")
            if there == 0 && sample.fields[0].1 != [0; 4] =>
        {
            Expected::Accepted(ADS_6)
        }
        // The error for too few items is reported at the field that contains their count, which is
        // before them.
        (None, _, "dimensions" | "indices") => {
            let of_items = |&(other, ..): &(&str, usize, &[u8])| other == name;
            let (_, first, _) = sample.places().find(of_items).unwrap();
            let count = sample.places().filter(of_items).count();
            let counter = sample.places().find(|&(_, at, _)| at + 4 == first).unwrap();
            rejected(TooMany, counter.0, counter.1, ((cut - first) / 4, count))
        }
        _ => rejected(Truncated, name, start, (bytes.len(), there)),
    }
}

/// The maximum length in bytes of a text field at the end of a stream.
fn limit(stream: Stream) -> usize {
    match stream {
        Stream::DynamicName | Stream::DynamicNameRequest => 96,
        _ => 256,
    }
}

/// The expected result for a sample with one extra byte.
fn expect_extra(stream: Stream, sample: &Sample, extra: u8) -> Expected {
    let len = sample.bytes().len();
    let last = sample.places().last();
    let trailing = rejected(Trailing, "stream", len, (len, len + 1));
    match (stream, last) {
        (Stream::VariableKind, None) if extra == 0 => Expected::Accepted(E_34),
        (Stream::VariableKind, None) => rejected(MissingNul, "kind", 0, (256, 1)),
        (Stream::ElementText, None) => Expected::Accepted(SDA_6),
        (stream, _) if ends_in_bytes(stream).is_some() => {
            Expected::Accepted(ends_in_bytes(stream).unwrap())
        }
        (Stream::ElementLength, _) => match len {
            1 => Expected::Accepted(SDA_8),
            2 => rejected(Truncated, "length", 0, (4, 3)),
            _ => trailing,
        },
        (Stream::VariableExtendedDescription, None) => {
            rejected(Truncated, "synchronisation", 0, (4, 1))
        }
        (Stream::VariableExtendedDescription, _) => rejected(TooLong, "stream", 8, (8, 9)),
        (Stream::ObjectDescriptors, _) => rejected(Truncated, "id", len, (4, 1)),
        (Stream::ReadReply | Stream::ReadWriteReply, Some(("result", ..))) => {
            rejected(Truncated, "length", 4, (4, 1))
        }
        (_, Some((name, start, bytes))) => match text_of(stream, name) {
            // A text of maximum length cannot have an extra byte.
            Some(Text::Open(_)) if stream == Stream::VariableDescription && bytes.len() == 256 => {
                rejected(TooLong, name, start, (256, 257))
            }
            Some(_) if bytes.len() == limit(stream) => {
                rejected(TooLong, "stream", len, (len, len + 1))
            }
            Some(Text::Terminated) if extra == 0 => Expected::Accepted(E_34),
            Some(Text::MayTerminate) if !bytes.contains(&0) => Expected::Accepted(DYN_3),
            Some(Text::MayTerminate) if extra == 0 => Expected::Accepted(E_34),
            Some(Text::Open([behind, _, longer])) => match bytes.contains(&0) {
                true => Expected::Accepted(behind),
                false => Expected::Accepted(longer),
            },
            _ => trailing,
        },
        (_, None) => trailing,
    }
}

fn observed(verdict: Result<(), Error>, expected: Expected) -> Expected {
    match (verdict, expected) {
        (Ok(()), Expected::Accepted(_)) => expected,
        (Ok(()), Expected::Rejected(_)) => Expected::Accepted("no clause"),
        (Err(error), _) => Expected::Rejected(Fault::of(error)),
    }
}

/// Missing and extra bytes are rejected with the expected error, or permitted by a requirement or
/// erratum in [`ALLOWED`]. Each of these permits a change of at least one sample.
#[test]
fn truncated_and_extended_samples_have_the_expected_result() {
    let mut met = BTreeSet::new();
    let mut judge = |stream, sample: &Sample, bytes: &[u8], expected: Expected| {
        let verdict = check(stream, bytes);
        assert_eq!(observed(verdict, expected), expected, "{stream} {}: {bytes:x?}", sample.slug);
        if let Expected::Accepted(clause) = expected {
            met.insert(clause);
        }
    };
    for (stream, sample) in each_sample() {
        let bytes = sample.bytes();
        for cut in 0..bytes.len() {
            judge(stream, sample, &bytes[..cut], expect_cut(stream, sample, cut));
        }
        for extra in [0x00, 0xAA] {
            let more: Vec<u8> = bytes.iter().copied().chain([extra]).collect();
            judge(stream, sample, &more, expect_extra(stream, sample, extra));
        }
    }
    assert_eq!(met, BTreeSet::from(ALLOWED));
}

/// If a request ends in a text, a byte other than NUL after its NUL, or after further NULs, makes
/// the bytes from this position on trailing (E-34).
#[test]
fn text_after_the_nul_of_a_request_is_trailing() {
    for (stream, bytes, end) in [
        (Stream::VariableName, &b"V.E.a\0b\0"[..], 6),
        (Stream::VariableName, b"V.E.a\0\0\0b", 8),
        (Stream::VariableKind, b"\0V.E\0", 1),
        (Stream::VariableIndexKind, b"\x02\0\0\0V.E\0V", 8),
        (Stream::DynamicNameRequest, b"P1\0\0P", 4),
    ] {
        let expected = rejected(Trailing, "stream", end, (end, bytes.len()));
        assert_eq!(observed(check(stream, bytes), expected), expected);
    }
}

/// The walk of `Stream::NoData`, the stream without fields, accepts and rejects the same bytes as
/// its decoder.
#[test]
fn no_data_rejects_bytes() {
    assert!(Stream::NoData.walk(&[], |_| ()).is_ok());
    for bytes in [&[0][..], &[0; 300]] {
        assert_eq!(
            Stream::NoData.walk(bytes, |_| ()),
            <ads_cnc::NoData as ads_cnc::Decode<'_>>::decode(bytes).map(drop)
        );
    }
}
