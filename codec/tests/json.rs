//! Tests of the feature `serde`: a value is unchanged after it was serialised to JSON and
//! deserialised.

#![cfg(feature = "serde")]

use ads_cnc::ads::{AdsError, AmsHeader, DeviceInfoReply, ReadReply};
use ads_cnc::dynamic::DynamicValue;
use ads_cnc::layout::Stream;
use ads_cnc::sda::ElementLength;
use ads_cnc::{
    Content, Decode, Description, Descriptor, Encode, ExtendedReply, Handle, NameWrite,
    VariableName,
};
use ads_cnc_vectors::vectors;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

/// Decodes a value, serialises and deserialises it, and checks that it is unchanged. Returns false
/// if the bytes are invalid.
fn comes_back<T>(bytes: &[u8]) -> bool
where
    T: for<'a> Decode<'a> + Encode + Serialize + DeserializeOwned + PartialEq + std::fmt::Debug,
{
    let Ok(value) = T::decode(bytes) else { return false };
    let json = to_string(&value).unwrap();
    let again: T = from_str(&json).unwrap_or_else(|error| panic!("{error}: {json}"));
    assert_eq!(again, value, "{json}");
    true
}

macro_rules! each {
    ($( $stream:ident: $view:ty $( , $owned:ty )?; )+) => {
        pub(crate) fn stream_comes_back(stream: Stream, bytes: &[u8]) -> bool {
            match stream {
                $( Stream::$stream => comes_back::<each!(@ $view $( , $owned )?)>(bytes), )+
                other => panic!("{other} has no type"),
            }
        }
    };
    (@ $both:ty) => { $both };
    (@ $view:ty, $owned:ty) => { $owned };
}

ads_cnc::streams! { each }

#[test]
fn vectors_are_unchanged() {
    let streams = vectors().iter().filter(|vector| vector.is_accepted()).filter_map(|vector| {
        // Skip the vectors of index groups, index offsets, names and frames, which are not streams
        // of the codec.
        let stream = Stream::by_name(&vector.stream)?;
        assert!(stream_comes_back(stream, &vector.bytes()), "{}", vector.id);
        Some(stream)
    });
    let seen: std::collections::BTreeSet<Stream> = streams.collect();
    assert_eq!(seen.len(), Stream::all().count());
}

fn shape<T: for<'a> Decode<'a> + Serialize>(bytes: &[u8]) -> Value {
    to_value(T::decode(bytes).unwrap()).unwrap()
}

/// Most streams of several fields are serialised as a map of their fields with the names of the
/// table, without counts. Most streams of one number, such as a handle, are serialised as this
/// number.
#[test]
fn streams_are_maps_of_their_fields() {
    let description = b"\x02\0\0\x20\x09\0\0\0\x01\0\0\0\x08\0\0\0\x01\0\0\0\x04\0\0\0L\xE4nge\0";
    assert_eq!(
        shape::<Description>(description),
        json!({
            "handle": 0x2000_0002, "type": 9, "access": 1, "size": 8, "dimensions": [4], "name": "Länge",
        }),
    );
    assert_eq!(shape::<Handle>(&[4, 0, 0, 2]), json!(0x200_0004));
    assert_eq!(shape::<Content>(&[1, 2]), json!({ "content": [1, 2] }));
    assert_eq!(shape::<NameWrite>(b"V.E.a\0\x01"), json!({ "name": "V.E.a", "value": [1] }));
    let header = shape::<AmsHeader>(&[7; 32]);
    assert_eq!(header["target_net_id"], "7.7.7.7.7.7");
    assert_eq!(header.as_object().map(serde_json::Map::len), Some(9));
}

/// Serialised values contain the end of a text, the width of an element length and the bits of a
/// NaN, and show that data is absent.
#[test]
fn ends_widths_and_absent_data_are_kept() {
    assert_eq!(shape::<VariableName>(b"a\0\0"), json!({ "name": { "text": "a", "tail": [0] } }));
    assert_eq!(shape::<VariableName>(b"a\0"), json!({ "name": "a" }));
    let open =
        Description { name: ads_cnc::Text { text: "a".parse().unwrap(), tail: None }, ..blank() };
    assert_eq!(to_value(&open).unwrap()["name"], json!({ "text": "a", "tail": null }));
    assert_eq!(shape::<ElementLength>(&[4]), json!({ "UNS08": 4 }));
    assert_eq!(shape::<ElementLength>(&[4, 1]), json!({ "UNS16": 260 }));
    assert_eq!(shape::<ElementLength>(&[4, 1, 0, 0]), json!({ "UNS32": 260 }));
    assert_eq!(to_value(DynamicValue::from(0.5)).unwrap(), json!(0.5));
    let odd = DynamicValue::from_bits(0x7ff8_0000_0000_0001);
    assert_eq!(to_value(odd).unwrap(), json!({ "bits": 0x7ff8_0000_0000_0001_u64 }));
    assert_eq!(shape::<ReadReply>(&[4, 7, 0, 0]), json!({ "result": 0x704, "data": null }));
    assert_eq!(shape::<ExtendedReply>(&[]), json!(null));
    let mut info = DeviceInfoReply::decode(&[b'n'; 24]).unwrap();
    assert_eq!(to_value(info).unwrap()["name"], "n".repeat(16));
    info.name[4..].copy_from_slice(b"\0\0old\0\0\0\0\0\0\0");
    let tail = json!([0, b'o', b'l', b'd', 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(to_value(info).unwrap()["name"], json!({ "text": "nnnn", "tail": tail }));
}

fn blank() -> Description {
    Description::decode(&[&[0; 20][..], b"x"].concat()).unwrap()
}

/// A value that the Rust type cannot hold is rejected when it is deserialised. A value that the
/// type can hold but the stream cannot is rejected when it is encoded.
#[test]
fn values_are_checked() {
    let error = |json: Value| from_value::<VariableName>(json).unwrap_err().to_string();
    assert!(error(json!({ "nam": "a" })).contains("missing field `name`"));
    for name in ["a\0b", "Ω"] {
        assert!(from_value::<VariableName>(json!({ "name": name })).is_err());
    }
    assert!(from_value::<ElementLength>(json!({ "UNS08": 256 })).is_err());
    let mut header = shape::<AmsHeader>(&[7; 32]);
    header["source_net_id"] = "1.2.3".into();
    assert!(from_value::<AmsHeader>(header).is_err());

    let mut descriptor = to_value(Descriptor::new("n", "BOOL").unwrap()).unwrap();
    let mut named = |name: Value| {
        descriptor["name"] = name;
        from_value::<Descriptor>(descriptor.clone())
    };
    assert_eq!(named("x".repeat(32).into()).unwrap().name().len(), 32);
    assert!(named(json!({ "text": "x".repeat(31), "tail": [0] })).is_err());
    let long = named("x".repeat(33).into()).unwrap_err();
    assert_eq!(long.to_string(), "a text with more bytes than its field");
    assert!(named(json!({ "text": "x", "tail": vec![1; 31] })).is_err());

    let unsendable: ReadReply = from_value(json!({ "result": 0 })).unwrap();
    assert_eq!(unsendable, ReadReply { result: AdsError::NO_ERROR, data: None });
    assert!(unsendable.encode_to_vec().is_err());
}

/// The error for a text or a REAL64 in an unknown form names the known forms.
#[test]
fn unknown_forms_are_rejected() {
    let name = |name: Value| {
        from_value::<VariableName>(json!({ "name": name })).map_err(|error| error.to_string())
    };
    assert!(name(json!({ "text": "a", "tail": null })).is_ok());
    for wrong in [
        json!({ "text": "a", "tial": [0] }),
        json!({ "text": "a" }),
        json!({ "text": "a", "tail": [0], "more": 1 }),
        json!("Ω"),
        json!(1),
    ] {
        let wanted = "expected CP1252 text: a string, or a map of `text` and `tail`";
        assert_eq!(name(wrong.clone()).unwrap_err(), wanted, "{wrong}");
    }
    let wanted = "expected REAL64: a number, or a map of `bits`";
    for wrong in [json!("1"), json!({ "bits": 1, "more": 1 }), json!({ "bit": 1 })] {
        let error = from_value::<DynamicValue>(wrong.clone()).unwrap_err();
        assert_eq!(error.to_string(), wanted, "{wrong}");
    }
    let error = from_value::<AmsHeader>(json!(1)).unwrap_err().to_string();
    assert_eq!(error, "invalid type: integer `1`, expected AMS header");
}

/// Generated values of all streams are unchanged after they were serialised to JSON and
/// deserialised.
#[cfg(feature = "arbitrary")]
#[test]
fn generated_values_are_unchanged() {
    for seed in 1..60_u32 {
        let bytes: Vec<u8> = (0..400_u32)
            .map(|at| (at * seed).wrapping_mul(2_654_435_761).to_be_bytes()[0])
            .collect();
        for stream in Stream::all() {
            assert!(made::stream_comes_back(stream, &bytes));
        }
    }
}

#[cfg(feature = "arbitrary")]
mod made {
    use super::*;

    fn comes_back<T>(bytes: &[u8]) -> bool
    where
        T: for<'a> arbitrary::Arbitrary<'a> + for<'a> Decode<'a>,
        T: Encode + Serialize + DeserializeOwned + PartialEq + std::fmt::Debug,
    {
        let value = T::arbitrary(&mut arbitrary::Unstructured::new(bytes)).unwrap();
        super::comes_back::<T>(&value.encode_to_vec().unwrap())
    }

    ads_cnc::streams! { each }
}
