//! What holds several things says how many, hands out each, and is a key like what it equals.

use std::collections::HashSet;
use std::error::Error as _;
use std::hash::{BuildHasher as _, BuildHasherDefault, DefaultHasher, Hash};

use ads_cnc::ads::AmsPort;
use ads_cnc::operation::Refusal;
use ads_cnc::service::ServiceId;
use ads_cnc::value::{Boolean, DataType, Items, StringsRef};
use ads_cnc::*;

fn hash(value: impl Hash) -> u64 {
    BuildHasherDefault::<DefaultHasher>::default().hash_one(value)
}

/// At each step an iterator says exactly how many are left.
#[track_caller]
fn counts_down(mut items: impl Iterator, count: usize) {
    for left in (0..=count).rev() {
        assert_eq!(items.size_hint(), (left, Some(left)));
        assert_eq!(items.next().is_some(), left > 0);
    }
}

#[test]
fn none_one_and_several() {
    let bytes = [1, 0, 2, 0, 3, 0];
    let dimensions = [[0], [1], [3]];
    for (count, dimensions) in [0, 1, 3].into_iter().zip(&dimensions) {
        let bytes = &bytes[..2 * count];
        let elements = Elements::new(DataType::Uns16, dimensions.into(), bytes).unwrap();
        assert_eq!((elements.len(), elements.is_empty()), (count, count == 0));
        assert_eq!(elements.get(count), None);
        counts_down(elements.iter(), count);
        assert_eq!(elements.iter().len(), count);
        let (backward, forward): (Vec<_>, Vec<_>) =
            (elements.iter().rev().collect(), elements.iter().collect());
        assert!(backward.iter().eq(forward.iter().rev()) && forward.len() == count);
        for place in 0..count {
            assert_eq!(elements.iter().nth(place), elements.get(place));
        }

        let items = Items::<u16>::new(bytes).unwrap();
        assert_eq!((items.len(), items.is_empty(), items.get(count)), (count, count == 0, None));
        counts_down(items.iter(), count);
        let others =
            [&bytes[..bytes.len() - bytes.len().min(2)], &[9; 6], &[1, 0, 2, 0, 3, 0, 4, 0]];
        for other in others.into_iter().filter(|other| *other != bytes) {
            assert_ne!(items, Items::new(other).unwrap());
        }
        let copy = bytes.to_vec();
        assert_eq!(items, Items::new(&copy).unwrap());

        let texts = b"a\0b\0c\0";
        let texts = StringsRef::new(&texts[..2 * count], count as u32).unwrap();
        assert_eq!((texts.len(), texts.is_empty()), (count, count == 0));
        assert_eq!((texts.iter().count(), texts.get(count)), (count, None));

        let numbers = [7, 8, 9];
        let numbers = Numbers::from(&numbers[..count]);
        assert_eq!(
            (numbers.len(), numbers.is_empty(), numbers.get(count)),
            (count, count == 0, None)
        );
        counts_down(numbers.iter(), count);
    }
    assert_eq!(StringsRef::new(b"ab\0c\0\0", 2).unwrap().element_size(), 3);
}

#[cfg(feature = "alloc")]
#[test]
fn owned() {
    use ads_cnc::value::Values;

    for (values, count) in [
        (Values::Uns16(vec![]), 0),
        (Values::Uns16(vec![1, 2, 3]), 3),
        (Values::String(StringsRef::new(b"a\0b\0", 2).unwrap().into()), 2),
    ] {
        assert_eq!((values.len(), values.is_empty()), (count, count == 0));
    }
    let object = |name| Descriptor::new(name, "UNS32").unwrap();
    for count in [0, 1, 3] {
        let list: Descriptors =
            ["mc_a", "mc_b", "mc_c"][..count].iter().map(|name| object(name)).collect();
        let list = list.as_ref();
        assert_eq!((list.len(), list.is_empty(), list.get(count)), (count, count == 0, None));
        counts_down(list.iter(), count);
        assert!((0..count).filter_map(|place| list.get(place)).eq(list.iter()));
        for first in 0..=4 {
            for most in 0..=4 {
                let some: Vec<_> = list.iter().skip(first).take(most).collect();
                assert!(list.slice(first, most).iter().eq(some), "{first} {most} of {count}");
            }
        }
    }
}

/// Texts of one meaning are one key, and others another.
#[test]
fn keys() {
    let wire = CncStr::from_bytes(b"Gr\xF6\xDFe").unwrap();
    let text = CncStr::new("Größe").unwrap();
    assert_eq!((wire, hash(wire)), (text, hash(text)));
    assert_ne!(hash(text), hash(CncStr::new("Grösse").unwrap()));
    assert!(text == "Größe" && wire == *"Größe" && text != "Grösse" && wire != *"Grösse");

    let id = |text| ServiceId::new(text).unwrap();
    let upper = id("560AACBF-6335-44A9-895A-8B27F3ED5E47");
    let lower = id("560aacbf-6335-44a9-895a-8b27f3ed5e47");
    let other = id("560aacbf-6335-44a9-895a-8b27f3ed5e48");
    assert_eq!((upper, hash(upper)), (lower, hash(lower)));
    assert_ne!(upper, other);
    assert_ne!(hash(upper), hash(other));
    assert_eq!(HashSet::from([upper, lower, other]).len(), 2);
}

/// Numbers are equal wherever they come from, if all are, and all are there.
#[test]
fn numbers() {
    let name = VariablePath::new("V.E.a[3][0]").unwrap();
    let named = name.parts().next().unwrap().indices;
    let wire = b"\x01\0\0\0\x02\0\0\0\x03\0\0\0\0\0\0\0";
    let wire = HandleReadRef::decode(wire).unwrap().indices;
    assert_eq!((named, wire), (Numbers::from(&[3, 0]), Numbers::from(&[3, 0])));
    assert_eq!(named, wire);
    for other in [&[3, 1][..], &[2, 0], &[3], &[3, 0, 0], &[]] {
        assert_ne!(named, Numbers::from(other));
        assert_ne!(wire, Numbers::from(other));
    }
}

/// 0 is FALSE and any other byte TRUE.
#[test]
fn truth() {
    assert_eq!([0, 1, 2, 255].map(|byte| Boolean(byte).is_true()), [false, true, true, true]);
    assert_eq!((Boolean::from(false), Boolean::from(true)), (Boolean::FALSE, Boolean::TRUE));
}

/// Behind a refusal for the bytes stands the error of their stream.
#[test]
fn refusals_have_a_source() {
    let error = Handle::decode(&[0]).unwrap_err();
    let source = |refusal: &Refusal| refusal.source().map(|source| source.to_string());
    assert_eq!(source(&Refusal::Stream(error)), Some(error.to_string()));
    assert_eq!(source(&Refusal::Port(AmsPort(1))), None);
}
