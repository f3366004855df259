//! Random values of all streams except `DeviceInfoReply` and `DeviceStateReply` satisfy
//! `check_value`: a value encodes to bytes that decode to this value.

#![cfg(feature = "alloc")]

use ads_cnc::address::{IndexGroup, IndexOffset};
use ads_cnc::ads::*;
use ads_cnc::dynamic::*;
use ads_cnc::sda::*;
use ads_cnc::streaming::ProgramStream;
use ads_cnc::*;
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::check_value;
use super::kept;

/// Random CP1252 text of at most `max` bytes.
fn text(max: usize) -> impl Strategy<Value = CncString> {
    vec(1..=u8::MAX, 0..=max).prop_map(|bytes| CncStr::from_bytes(&bytes).expect("no NUL").into())
}

/// Random text of a request, with one NUL or several.
fn request_text() -> impl Strategy<Value = Text> {
    (text(255), 0..256_usize).prop_map(|(text, padding)| {
        let room = 255 - text.as_bytes().len();
        Text { tail: Some(vec![0; padding.min(room)]), text }
    })
}

/// Random text of a description or of an attribute of an element, with or without a NUL and bytes
/// after it. The field has at least one byte.
fn open_text() -> impl Strategy<Value = Text> {
    (text(255), prop::option::of(vec(any::<u8>(), 0..256))).prop_map(|(text, tail)| {
        let room = 255 - text.as_bytes().len();
        let tail = tail.map(|tail| tail.into_iter().take(room).collect());
        let tail = if text.as_bytes().is_empty() { tail.or(Some(vec![])) } else { tail };
        Text { text, tail }
    })
}

fn data() -> impl Strategy<Value = Vec<u8>> {
    vec(any::<u8>(), 0..300)
}

/// Random result and data of a reply; only a reply with an error may have no data field (ADS-6).
fn reply() -> impl Strategy<Value = (AdsError, Option<Vec<u8>>)> {
    prop_oneof![
        (any::<u32>(), data()).prop_map(|(result, data)| (AdsError(result), Some(data))),
        data().prop_map(|data| (AdsError::NO_ERROR, Some(data))),
        (1..=u32::MAX).prop_map(|result| (AdsError(result), None)),
    ]
}

fn place() -> impl Strategy<Value = (IndexGroup, IndexOffset)> {
    (any::<u32>(), any::<u32>())
        .prop_map(|(group, offset)| (IndexGroup::new(group), IndexOffset::new(offset)))
}

fn end() -> impl Strategy<Value = AmsAddr> {
    (any::<[u8; 6]>(), any::<u16>())
        .prop_map(|(id, port)| AmsAddr { net_id: AmsNetId(id), port: AmsPort(port) })
}

fn descriptor() -> impl Strategy<Value = Descriptor> {
    let texts = (vec(1..=127_u8, 0..=32), vec(1..=127_u8, 0..=32));
    let numbers = (any::<u32>(), any::<u32>(), any::<u16>(), any::<u16>());
    (texts, numbers, place()).prop_map(|((name, of_type), (id, size, access, free), place)| {
        let [name, of_type] = [name, of_type].map(|text| String::from_utf8(text).expect("ASCII"));
        Descriptor::new(&name, &of_type)
            .expect("at most 32")
            .with_id(id)
            .with_size(size)
            .with_write_access(WriteAccess(access))
            .with_not_assigned(free)
            .with_content(place.0, place.1)
    })
}

proptest! {
    #![proptest_config(kept::cases(128, file!()))]

    #[test]
    fn numbers_obey_the_laws(number in any::<u32>(), reserved in any::<u16>()) {
        check_value(&ObjectCount(number));
        check_value(&VariableCount(number));
        check_value(&Handle(number));
        check_value(&WriteReply { result: AdsError(number) });
        check_value(&AmsTcpHeader { reserved, length: number });
    }

    #[test]
    fn ams_headers_obey_the_laws(
        (target, source) in (end(), end()),
        (command, flags) in any::<(u16, u16)>(),
        (data_length, error, invoke_id) in any::<(u32, u32, u32)>(),
    ) {
        let (command, state_flags) = (Command(command), StateFlags(flags));
        let error = AdsError(error);
        check_value(&AmsHeader {
            target, source, command, state_flags, data_length, error, invoke_id,
        });
    }

    #[test]
    fn ads_requests_obey_the_laws((index_group, index_offset) in place(), length in any::<u32>(), data in data()) {
        check_value(&ReadRequest { index_group, index_offset, length });
        check_value(&WriteRequest { index_group, index_offset, data: data.clone() });
        check_value(&ReadWriteRequest { index_group, index_offset, read_length: length, data });
    }

    #[test]
    fn ads_replies_obey_the_laws((result, data) in reply()) {
        check_value(&ReadReply { result, data: data.clone() });
        check_value(&ReadWriteReply { result, data });
    }

    /// Values of contents, packets of the program stream, and attributes of elements are unchanged.
    #[test]
    fn contents_obey_the_laws(bytes in vec(any::<u8>(), 1..=992), text in open_text(), flag in any::<u8>()) {
        check_value(&Content { bytes: bytes.clone() });
        check_value(&ProgramStream { bytes });
        check_value(&ElementText { text });
        check_value(&ElementWriteFlag(flag));
    }

    #[test]
    fn instances_obey_the_laws((index_group, index_offset) in place()) {
        check_value(&ObjectAddress { index_group, index_offset });
        let (channel, axis) = (index_group.get(), index_offset.get());
        check_value(&ObjectAddressQuery { channel, axis });
        check_value(&ElementCount(axis));
        check_value(&ElementLength::new(axis));
        check_value(&DynamicCount(axis));
        check_value(&DynamicIndex(axis.max(1)));
    }

    #[test]
    fn dynamic_parameters_obey_the_laws(text in text(95), tail in vec(any::<u8>(), 0..96), bits in any::<u64>()) {
        let room = 95 - text.as_bytes().len();
        let tail: Vec<u8> = tail.into_iter().take(room).collect();
        let nuls = vec![0; tail.len()];
        check_value(&DynamicName { name: Text { text: text.clone(), tail: Some(tail) } });
        check_value(&DynamicNameRequest { name: Text { text, tail: Some(nuls) } });
        check_value(&DynamicValue::from_bits(bits));
    }

    /// Single descriptors and lists of descriptors are unchanged.
    #[test]
    fn descriptors_obey_the_laws(objects in vec(descriptor(), 1..5)) {
        check_value(&objects[0]);
        check_value(&objects.into_iter().collect::<Descriptors>());
    }

    /// Requests are unchanged, with and without additional NULs after the text.
    #[test]
    fn variable_requests_obey_the_laws(
        text in request_text(), index in any::<u32>(), indices in vec(any::<u32>(), 0..=510),
    ) {
        check_value(&VariableName { name: text.clone() });
        check_value(&VariableKind { kind: text.clone() });
        check_value(&VariableIndexKind { index, kind: text });
        check_value(&HandleRead { handle: Handle(index), indices });
    }

    /// Writes are unchanged, with and without a value.
    #[test]
    fn variable_writes_obey_the_laws(
        name in text(255), handle in any::<u32>(), indices in vec(any::<u32>(), 0..=250),
        value in vec(any::<u8>(), 0..=1040),
    ) {
        check_value(&HandleWrite { handle: Handle(handle), indices, value: value.clone() });
        check_value(&NameWrite { name, value });
    }

    /// Extended descriptions and empty replies are unchanged.
    #[test]
    fn extended_descriptions_obey_the_laws((synchronisation, validity) in any::<(u32, u32)>()) {
        let (synchronisation, validity) = (Synchronisation(synchronisation), Validity(validity));
        check_value(&ExtendedReply(Some(ExtendedDescription { synchronisation, validity })));
        check_value(&ExtendedReply(None));
    }

    /// Descriptions with unknown codes, many dimensions and any end of the name are unchanged. A
    /// description without its name equals the description by name.
    #[test]
    fn descriptions_obey_the_laws(
        name in open_text(),
        (handle, var_type, access, size) in any::<(u32, u32, u32, u32)>(),
        dimensions in vec(any::<u32>(), 0..=443),
    ) {
        let nameless = DescriptionByName {
            handle: Handle(handle),
            var_type: VariableType(var_type),
            access: VariableAccess(access),
            size,
            dimensions: dimensions.clone(),
        };
        let description = Description {
            handle: Handle(handle),
            var_type: VariableType(var_type),
            access: VariableAccess(access),
            size,
            dimensions,
            name,
        };
        prop_assert_eq!(description.as_ref().without_name(), nameless.as_ref());
        check_value(&nameless);
        check_value(&description);
    }

    #[test]
    fn values_obey_the_laws(bytes in vec(any::<u8>(), 0..=2048)) {
        check_value(&Value { bytes });
    }
}

/// A kind without bytes and a kind of one NUL encode to different bytes, although both mean all
/// kinds (VAR-1).
#[test]
fn empty_kinds_keep_their_form() {
    let absent = VariableKind { kind: Text { text: CncString::default(), tail: None } };
    check_value(&absent);
    assert_eq!(absent.encode_to_vec(), Ok(vec![]));
    assert_eq!(VariableKindRef { kind: Kind::ALL }.encode_to_vec(), Ok(vec![0]));
    assert_eq!(VariableKind::decode(&[]).map(|kind| kind.encode_to_vec()), Ok(Ok(vec![])));
}
