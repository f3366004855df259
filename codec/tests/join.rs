//! Tests of `Stream::join`, which joins a stream from the bytes of its fields.

use ads_cnc::ErrorKind::{self, BufferTooSmall, Mismatch, MissingNul, TooLong, Truncated};
use ads_cnc::layout::{Field, Size, Stream};

use super::common::each_sample;

type Part<'a> = (Field, &'a [u8]);

fn walked(stream: Stream, bytes: &[u8]) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    stream.walk(bytes, |segment| parts.push((segment.field, segment.bytes))).unwrap();
    parts
}

fn is_count(stream: Stream, field: Field) -> bool {
    let fields: Vec<Field> = stream.fields().collect();
    fields
        .windows(2)
        .any(|two| two[0] == field && matches!(two[1].spec().unwrap().size, Size::Items { .. }))
}

fn join(stream: Stream, parts: &[Part<'_>], room: usize) -> Result<Vec<u8>, ads_cnc::Error> {
    let mut buf = vec![0xAA; room];
    stream.join(parts.iter().copied(), &mut buf).map(<[u8]>::to_vec)
}

#[test]
fn join_is_the_inverse_of_a_walk() {
    let mut counts = 0;
    for (stream, sample) in each_sample() {
        let bytes = sample.bytes();
        let parts = walked(stream, &bytes);
        assert_eq!(join(stream, &parts, bytes.len()).as_ref(), Ok(&bytes), "{}", sample.slug);
        let mut short = parts.clone();
        short.retain(|(field, _)| !is_count(stream, *field));
        counts += parts.len() - short.len();
        for (field, part) in &mut short {
            if let Some(Size::Padded(_)) = field.spec().map(|row| row.size) {
                let end = part.iter().rposition(|&byte| byte != 0).map_or(0, |at| at + 1);
                *part = &part[..end];
            }
        }
        // Samples with a count of 0 are skipped, because `join` does not add an omitted count
        // without items if the stream may end before the count.
        if !parts.iter().any(|(field, part)| is_count(stream, *field) && **part == [0; 4]) {
            assert_eq!(join(stream, &short, bytes.len()).as_ref(), Ok(&bytes), "{}", sample.slug);
        }
        if let Some(room) = bytes.len().checked_sub(1) {
            let error = join(stream, &parts, room).unwrap_err();
            let numbers = (error.kind(), error.expected() as usize, error.found() as usize);
            assert_eq!(numbers, (BufferTooSmall, bytes.len(), room), "{}", sample.slug);
        }
    }
    assert!(counts > 20, "{counts}");
}

/// If a part is omitted, repeated or longer, or the parts are rotated, the result is an error or
/// bytes with exactly the changed parts, apart from counts, empty parts and padding.
#[test]
fn joined_bytes_have_exactly_the_parts() {
    for (stream, sample) in each_sample() {
        let bytes = sample.bytes();
        let parts = walked(stream, &bytes);
        for at in 0..parts.len() {
            let longer = [parts[at].1, b"x"].concat();
            let mut others = [parts.clone(), parts.clone(), parts.clone(), parts.clone()];
            others[0].remove(at);
            others[1].insert(at, parts[at]);
            others[2][at].1 = &longer;
            others[3].rotate_left(at);
            for changed in others {
                let Ok(joined) = join(stream, &changed, bytes.len() + 100) else { continue };
                let found = walked(stream, &joined);
                let data = |parts: &[Part<'_>]| {
                    let kept = |part: &&Part<'_>| !part.1.is_empty() && !is_count(stream, part.0);
                    parts.iter().filter(kept).map(|part| trimmed(*part)).collect::<Vec<_>>()
                };
                assert_eq!(data(&found), data(&changed), "{}", sample.slug);
            }
        }
    }
}

fn trimmed((field, part): Part<'_>) -> (Field, Vec<u8>) {
    let mut part = part.to_vec();
    while part.last() == Some(&0) && matches!(field.spec().unwrap().size, Size::Padded(_)) {
        part.pop();
    }
    (field, part)
}

/// The stream, its parts, and the error: kind, field, offset, expected and found number.
type JoinCase<'a> = (Stream, &'a [(&'a str, &'a [u8])], (ErrorKind, &'a str, u32, u32, u32));

#[test]
fn errors_name_the_wrong_part() {
    let fault = |stream: Stream, parts: &[(&str, &[u8])]| {
        let part = |&(name, bytes)| (Field::by_name(stream, name).unwrap(), bytes);
        let parts: Vec<Part<'_>> = parts.iter().map(part).collect();
        let error = join(stream, &parts, 4000).unwrap_err();
        (error.kind(), error.field().name(), error.offset(), error.expected(), error.found())
    };
    let four = &[1, 0, 0, 0][..];
    let cases: [JoinCase<'_>; 9] = [
        // The number has three bytes instead of four.
        (Stream::VariableHandle, &[("handle", &[1, 2, 3])], (Truncated, "handle", 0, 4, 3)),
        (Stream::VariableIndexKind, &[("kind", b"V.E\0")], (MissingNul, "kind", 4, 256, 0)),
        (
            Stream::VariableIndexKind,
            &[("index", four), ("kind", b"V.E")],
            (MissingNul, "kind", 4, 256, 3),
        ),
        // The parts are in the wrong order, so that the kind is missing after the index.
        (
            Stream::VariableIndexKind,
            &[("kind", b"V.E\0"), ("index", four)],
            (MissingNul, "kind", 4, 256, 0),
        ),
        (
            Stream::VariableHandle,
            &[("handle", four), ("handle", four)],
            (Mismatch, "handle", 4, 0, 4),
        ),
        // The name contains a NUL. The bytes after it would be decoded as a part of the value.
        (
            Stream::VariableNameWrite,
            &[("name", b"a\0b\0"), ("value", four)],
            (Mismatch, "name", 0, 2, 4),
        ),
        (
            Stream::VariableNameWrite,
            &[("name", b"a"), ("value", four)],
            (Mismatch, "name", 0, 3, 1),
        ),
        // The count differs from the number of items.
        (
            Stream::VariableHandleRead,
            &[("handle", four), ("index_count", four), ("indices", four), ("indices", four)],
            (ErrorKind::Trailing, "stream", 12, 12, 16),
        ),
        (Stream::ProgramStream, &[("data", &[b'X'; 993])], (TooLong, "stream", 992, 992, 993)),
    ];
    for (at, (stream, parts, expected)) in cases.into_iter().enumerate() {
        assert_eq!(fault(stream, parts), expected, "case {at}");
    }
}
