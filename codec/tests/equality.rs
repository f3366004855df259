//! Tests of equality and hashes.

use std::collections::HashSet;
use std::hash::{BuildHasher as _, BuildHasherDefault, DefaultHasher, Hash};

use ads_cnc::operation::{ReadByName, WriteValue};
use ads_cnc::service::ServiceId;
use ads_cnc::value::Boolean;
use ads_cnc::*;

/// Checks that all values in `same` are equal and have equal hashes, and that `other` differs from
/// them in value and hash.
#[track_caller]
fn check<T: Hash + Eq + std::fmt::Debug>(same: &[T], other: T) {
    let state = BuildHasherDefault::<DefaultHasher>::default();
    for one in same {
        for another in same {
            assert_eq!(one, another);
            assert_eq!(state.hash_one(one), state.hash_one(another), "{one:?} {another:?}");
        }
        assert_ne!(*one, other);
        assert_ne!(state.hash_one(one), state.hash_one(&other), "{one:?} {other:?}");
    }
    let distinct: HashSet<&T> = same.iter().chain([&other]).collect();
    assert_eq!(distinct.len(), 2);
}

/// Texts from UTF-8 and from CP1252 are equal if their characters are equal.
#[test]
fn texts_are_equal_by_their_characters() {
    let given =
        [CncStr::new("größer €").unwrap(), CncStr::from_bytes(b"gr\xF6\xDFer \x80").unwrap()];
    check(&given, CncStr::new("groesser €").unwrap());
    check(&[CncStr::EMPTY, CncStr::new("").unwrap()], CncStr::new(" ").unwrap());
    assert_eq!(CncStr::new("V.E"), Ok(CncStr::from_bytes(b"V.E").unwrap()));
    for text in given {
        assert!(text == "größer €" && text == *"größer €", "{text:?}");
        assert!(text != "größer" && text != *"größer", "{text:?}");
    }
}

/// Names are compared with regard to case.
#[test]
fn names_are_equal_by_their_text_and_its_case() {
    let path = |text| VariablePath::new(text).unwrap();
    let from_text = VariablePath::from_text(CncStr::from_bytes(b"V.E.test[4]").unwrap()).unwrap();
    let mut buf = [0; 32];
    let element = path("V.E.test").write_element(U32List::from(&[4]), &mut buf).unwrap();
    check(&[path("V.E.test[4]"), from_text, element], path("V.E.TEST[4]"));
    let wire = VariablePath::from_text(CncStr::from_bytes(b"V.G.Gr\xF6\xDFe").unwrap()).unwrap();
    check(&[path("V.G.Größe"), wire], path("V.G.Grösse"));
}

/// A request for a decoded name contains the text of the name, but not the bytes after its NUL.
#[test]
fn decoded_names_are_requested_by_their_text() {
    let channel = address::Channel::new(1).unwrap();
    let expected = ReadByName::new(channel, "V.E.a").unwrap();
    let padded = VariableNameRef::decode(b"V.E.a\0\0").unwrap().name;
    assert_eq!(ReadByName::new(channel, padded).unwrap(), expected);
    #[cfg(feature = "alloc")]
    {
        let owned = padded.to_owned();
        assert_eq!(ReadByName::new(channel, &owned).unwrap(), expected);
        assert_eq!(owned.as_ref(), padded);
        assert_eq!(padded.text().to_owned(), owned.text);
    }
}

/// NULs that pad a kind are ignored when kinds are compared, but not when their text fields are
/// compared (E-34).
#[test]
fn kinds_are_equal_by_their_text() {
    let padded = VariableKindRef::decode(b"V.E\0\0").unwrap().kind;
    assert_eq!(padded.field().tail(), Some(&[0][..]));
    check(&[Kind::V_E, padded, Kind::new("V.E").unwrap()], Kind::V_G);
    assert_ne!(padded.field(), Kind::V_E.field());
}

#[test]
fn uuids_are_equal_without_regard_to_case() {
    let id = |text: &str| ServiceId::new(text).unwrap();
    check(
        &[
            id("560AACBF-6335-44a9-895A-8B27F3ED5E47"),
            id("560aacbf-6335-44A9-895a-8b27f3ed5e47"),
            id("560AACBF-6335-44A9-895A-8B27F3ED5E47"),
        ],
        id("560AACBF-6335-44a9-895A-8B27F3ED5E48"),
    );
}

/// Lists of numbers from streams, from slices and from names are equal if they have the same
/// numbers.
#[test]
fn lists_of_numbers_from_all_sources_are_equal() {
    let name = VariablePath::new("V.E.a[3][0]").unwrap();
    let named = name.parts().next().unwrap().indices;
    let wire = b"\x01\0\0\0\x02\0\0\0\x03\0\0\0\0\0\0\0";
    let wire = HandleReadRef::decode(wire).unwrap().indices;
    assert_eq!((named, wire), (U32List::from(&[3, 0]), U32List::from(&[3, 0])));
    assert_eq!(named, wire);
    for other in [&[3, 1][..], &[2, 0], &[3], &[3, 0, 0], &[]] {
        assert_ne!(named, U32List::from(other));
        assert_ne!(wire, U32List::from(other));
    }
}

/// Values to write are equal if their bytes are equal.
#[test]
fn values_to_write_are_equal_by_their_bytes() {
    check(&[WriteValue::from(&[1_u8, 0, 0, 0][..]), WriteValue::from(1_u32)], 2_u32.into());
}

/// Every byte except 0 is TRUE. The byte is kept: only 1 equals `Boolean::TRUE`.
#[test]
fn any_byte_but_0_is_true_and_is_kept() {
    for byte in 0..=u8::MAX {
        assert_eq!(Boolean(byte).is_true(), byte != 0);
        assert_eq!(Boolean(byte) == Boolean::TRUE, byte == 1);
        assert_eq!(bool::from(Boolean(byte)), byte != 0);
        assert_eq!(ValueRef { bytes: &[byte] }.get(0), Ok(byte != 0));
    }
    assert_eq!([false, true].map(Boolean::from), [Boolean::FALSE, Boolean::TRUE]);
}
