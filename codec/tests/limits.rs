//! Tests of limits: the greatest valid and the smallest invalid lengths and counts, for decoding
//! and encoding.

use std::collections::BTreeSet;

use ads_cnc::ErrorKind::*;
use ads_cnc::ads::{AdsError, ReadReplyRef};
use ads_cnc::dynamic::*;
use ads_cnc::layout::Stream;
use ads_cnc::limits::*;
use ads_cnc::sda::*;
use ads_cnc::streaming::*;
use ads_cnc::*;

use super::common::{Fault, check, fault};

/// A stream of maximum length is accepted, and a stream with one more byte rejected.
#[test]
fn streams_are_accepted_up_to_their_maximum_length() {
    let filled = |parts: &[&[u8]], len: usize| {
        let mut bytes = parts.concat();
        bytes.resize(len, 7);
        bytes
    };
    let data_length = [0, 0, 0x40, 0];
    // Not tested: streams of fixed length; descriptors, whose maximum length is not a multiple of
    // 84; an element length, whose possible lengths are 1, 2 and 4.
    let has_limit = |stream: &Stream| !stream.layout().is_fixed() && !stream.layout().repeats;
    let mut rest: BTreeSet<_> = Stream::all().filter(has_limit).collect();
    rest.remove(&Stream::ElementLength);
    for (stream, bytes) in [
        (Stream::VariableKind, filled(&[b"V.E", &[0; 253]], 256)),
        (Stream::VariableName, filled(&[&[b'V'; 255], b"\0"], 256)),
        (Stream::VariableIndexKind, filled(&[&[b'V'; 259], b"\0"], 260)),
        (Stream::VariableValue, filled(&[], 2048)),
        // The next four streams have 510 indices; 506 dimensions and a name of 4 bytes; 443
        // dimensions and a name of 256 bytes; 507 dimensions.
        (Stream::VariableHandleRead, filled(&[&[1; 4], &[0xFE, 1, 0, 0]], 2048)),
        (Stream::VariableDescription, filled(&[&[1; 16], &[0xFA, 1, 0, 0]], 2048)),
        (Stream::VariableDescription, filled(&[&[1; 16], &[0xBB, 1, 0, 0]], 2048)),
        (Stream::VariableDescriptionByName, filled(&[&[1; 16], &[0xFB, 1, 0, 0]], 2048)),
        (Stream::VariableHandleWrite, filled(&[&[1; 4], &[0; 4]], 2048)),
        (Stream::VariableNameWrite, filled(&[b"V\0"], 2048)),
        (Stream::VariableExtendedDescription, filled(&[], 8)),
        (Stream::DynamicName, filled(&[], 96)),
        (Stream::DynamicNameRequest, filled(&[], 96)),
        (Stream::ElementText, filled(&[], 256)),
        (Stream::ProgramStream, filled(&[], 992)),
        (Stream::Content, filled(&[], ADS_DATA_MAX)),
        (Stream::WriteRequest, filled(&[&[1; 8], &data_length], ADS_DATA_MAX + 12)),
        (Stream::ReadWriteRequest, filled(&[&[1; 12], &data_length], ADS_DATA_MAX + 16)),
        (Stream::ReadReply, filled(&[&[0; 4], &data_length], ADS_DATA_MAX + 8)),
        (Stream::ReadWriteReply, filled(&[&[0; 4], &data_length], ADS_DATA_MAX + 8)),
    ] {
        let max = bytes.len();
        assert_eq!(check(stream, &bytes), Ok(()));
        let more = check(stream, &filled(&[&bytes], max + 1)).unwrap_err();
        assert_eq!(Fault::of(more), fault(TooLong, "stream", max, (max, max + 1)));
        rest.remove(&stream);
    }
    assert!(rest.is_empty(), "no longest stream of {rest:?}");
}

/// A count that exceeds its maximum or the number of items in the bytes after it is rejected. The
/// error has the field of the count and the smaller of these two numbers (VAR-24).
#[test]
fn counts_that_do_not_fit_are_rejected() {
    let counted = |before: usize, count: u32, rest: usize| {
        [&vec![1; before][..], &count.to_le_bytes(), &vec![7; rest]].concat()
    };
    for (stream, count, rest, fits) in [
        // 507 dimensions would fill the stream and leave no byte for the name.
        (Stream::VariableDescription, 507, 2028, 506),
        (Stream::VariableDescription, 3, 11, 2),
        (Stream::VariableDescription, u32::MAX, 300, 75),
        (Stream::VariableDescriptionByName, 508, 2028, 507),
        (Stream::VariableDescriptionByName, 2, 4, 1),
        (Stream::VariableHandleRead, 511, 2040, 510),
        (Stream::VariableHandleRead, 1, 0, 0),
        // In 32 bits, four times this count would overflow to 4.
        (Stream::VariableHandleRead, 0x4000_0001, 4, 1),
    ] {
        let (before, counter) = match stream {
            Stream::VariableDescription | Stream::VariableDescriptionByName => {
                (16, "dimension_count")
            }
            _ => (4, "index_count"),
        };
        let error = check(stream, &counted(before, count, rest)).unwrap_err();
        let wanted = fault(TooMany, counter, before, (fits, count as usize));
        assert_eq!(Fault::of(error), wanted);
    }
}

#[test]
fn encoders_reject_what_decoders_reject() {
    const UNTOUCHED: [u8; 4096] = [0x55; 4096];
    let error_of = |value: &dyn Encode| {
        let mut buf = UNTOUCHED;
        let error = value.encode(&mut buf).unwrap_err();
        assert_eq!(buf, UNTOUCHED);
        Fault::of(error)
    };
    let text = CncStr::from_bytes;
    let (long, full) = ([b'V'; 256], [b'V'; 255]);
    let numbers = [7; 511];

    let name = |field| VariableNameRef { name: field };
    let long_name = name(text(&long).unwrap().into());
    assert_eq!(error_of(&long_name), fault(TooLong, "name", 0, (256, 257)));
    let open = name(TextRef::with_tail(text(b"V.E").unwrap(), None));
    assert_eq!(error_of(&open), fault(MissingNul, "name", 0, (256, 3)));
    let behind = name(TextRef::with_tail(text(b"V.E").unwrap(), Some(b"\0V")));
    assert_eq!(error_of(&behind), fault(Trailing, "stream", 5, (5, 6)));

    let kind = Kind::from_field(TextRef::with_tail(text(b"V.E").unwrap(), None));
    assert_eq!(error_of(&VariableKindRef { kind }), fault(MissingNul, "kind", 0, (256, 3)));
    let indexed = VariableIndexKindRef { index: 0, kind };
    assert_eq!(error_of(&indexed), fault(MissingNul, "kind", 4, (256, 3)));

    let indices = HandleReadRef { handle: Handle(1), indices: U32List::from(&numbers) };
    assert_eq!(error_of(&indices), fault(TooMany, "index_count", 4, (510, 511)));
    let indices =
        HandleWriteRef { handle: Handle(1), indices: U32List::from(&numbers), value: &[] };
    assert_eq!(error_of(&indices), fault(TooMany, "index_count", 4, (510, 511)));
    let named = NameWriteRef { name: text(&long).unwrap(), value: b"1" };
    assert_eq!(error_of(&named), fault(TooLong, "name", 0, (256, 257)));

    let write = |count, value| HandleWriteRef {
        handle: Handle(1),
        indices: U32List::from(&numbers[..count]),
        value,
    };
    let value = [0; 2041];
    for (count, bytes) in [(511, 0), (511, 1)] {
        let wanted = fault(TooMany, "index_count", 4, (510, 511));
        assert_eq!(error_of(&write(count, &value[..bytes])), wanted);
    }
    for (count, most) in [(510, 0), (0, 2040)] {
        assert!(write(count, &value[..most]).encode(&mut [0; 2048]).is_ok());
        let wanted = fault(TooLong, "stream", 2048, (2048, 2049));
        assert_eq!(error_of(&write(count, &value[..most + 1])), wanted);
    }
    let named = |len, value| NameWriteRef { name: text(&full[..len]).unwrap(), value };
    assert!(named(255, &value[..1]).encode(&mut [0; 257]).is_ok());
    let long_named = NameWriteRef { name: text(&long).unwrap(), value: &[] };
    assert_eq!(error_of(&long_named), fault(TooLong, "name", 0, (256, 257)));

    let description = |dimensions, name| DescriptionRef {
        handle: Handle(1),
        var_type: VariableType::SGN32,
        access: VariableAccess::READ_ONLY,
        size: 4,
        dimensions: U32List::from(dimensions),
        name,
    };
    let longest = text(&full).unwrap().into();
    let no_name = TextRef::with_tail(CncStr::EMPTY, None);
    let too_long_name = text(&long).unwrap().into();
    for (value, wanted) in [
        (description(&numbers[..507], longest), fault(TooMany, "dimension_count", 16, (506, 507))),
        (description(&numbers[..2], no_name), fault(Truncated, "name", 28, (1, 0))),
        (description(&numbers[..2], too_long_name), fault(TooLong, "name", 28, (256, 257))),
        (description(&numbers[..444], longest), fault(TooLong, "stream", 2048, (2048, 2052))),
    ] {
        assert_eq!(error_of(&value), wanted);
    }
    let nameless = DescriptionByNameRef {
        handle: Handle(1),
        var_type: VariableType::SGN32,
        access: VariableAccess::READ_ONLY,
        size: 4,
        dimensions: U32List::from(&numbers[..508]),
    };
    assert_eq!(error_of(&nameless), fault(TooMany, "dimension_count", 16, (507, 508)));
    let long = DynamicNameRequestRef { name: text(&full[..96]).unwrap().into() };
    assert_eq!(error_of(&long), fault(TooLong, "name", 0, (96, 97)));
    let behind = TextRef::with_tail(text(b"P1").unwrap(), Some(b"\0P"));
    assert_eq!(
        error_of(&DynamicNameRequestRef { name: behind }),
        fault(Trailing, "stream", 4, (4, 5))
    );
    assert_eq!(
        error_of(&DynamicNameRequestRef { name: no_name }),
        fault(Truncated, "name", 0, (1, 0))
    );
    assert_eq!(error_of(&DynamicNameRef { name: no_name }), fault(Truncated, "name", 0, (1, 0)));
    assert_eq!(
        error_of(&ElementTextRef { text: too_long_name }),
        fault(TooLong, "text", 0, (256, 257))
    );
    assert_eq!(error_of(&DynamicIndex(0)), fault(OutOfRange, "index", 0, (1, 0)));
    assert_eq!(error_of(&ProgramStreamRef { bytes: &[] }), fault(Truncated, "data", 0, (1, 0)));
    let bytes = &[b' '; 993];
    assert_eq!(error_of(&ProgramStreamRef { bytes }), fault(TooLong, "stream", 992, (992, 993)));
    let success_without_data = ReadReplyRef { result: AdsError::NO_ERROR, data: None };
    assert_eq!(error_of(&success_without_data), fault(Truncated, "length", 4, (4, 0)));
    let value = ValueRef { bytes: &[0; 2049] };
    assert_eq!(error_of(&value), fault(TooLong, "stream", 2048, (2048, 2049)));
    let none = DescriptorsRef::decode(&[0; 84]).unwrap().slice(1, 1);
    assert_eq!(error_of(&none), fault(Truncated, "id", 0, (4, 0)));
}

/// Dynamic parameters are counted from 1, so index 0 is rejected (DYN-5).
#[test]
fn parameter_0_is_rejected() {
    let error = check(Stream::DynamicIndex, &[0; 4]).unwrap_err();
    assert_eq!(Fault::of(error), fault(OutOfRange, "index", 0, (1, 0)));
    for index in [1_u32, 0x100, 0x1_0000, 0x100_0000] {
        check(Stream::DynamicIndex, &index.to_le_bytes()).unwrap();
    }
}

#[test]
fn descriptor_texts_have_up_to_32_characters() {
    let full = Descriptor::new(&"n".repeat(32), &"t".repeat(32)).unwrap();
    assert_eq!((full.name().len(), full.type_name().len()), (32, 32));
    let name = Descriptor::new(&"n".repeat(33), "BOOL").unwrap_err();
    assert_eq!(Fault::of(name), fault(TooLong, "name", 20, (32, 33)));
    let type_name = Descriptor::new("n", &"ß".repeat(33)).unwrap_err();
    assert_eq!(Fault::of(type_name), fault(TooLong, "type", 52, (32, 33)));
}
