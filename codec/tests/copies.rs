//! Tests of owned types: copies equal their originals, items are added to lists, and texts are
//! parsed.

#![cfg(feature = "alloc")]

use ads_cnc::*;

const DESCRIPTION: &[u8] =
    b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";

/// An owned copy can be used after the bytes were freed, and encodes to the same bytes.
#[test]
fn copies_of_descriptions_outlive_the_bytes() {
    let (whole, nameless) = {
        let bytes = DESCRIPTION.to_vec();
        let whole = Description::decode(&bytes).unwrap();
        let nameless = DescriptionByNameRef::decode(&bytes[..24]).unwrap();
        assert_eq!(nameless.to_owned(), DescriptionByName::decode(&bytes[..24]).unwrap());
        (whole, nameless.to_owned())
    };
    assert_eq!(whole.encode_to_vec(), Ok(DESCRIPTION.to_vec()));
    assert_eq!(nameless.encode_to_vec(), Ok(DESCRIPTION[..24].to_vec()));
    assert_eq!(nameless.dimensions, whole.dimensions);
    assert_eq!((nameless.handle, nameless.size), (whole.handle, whole.size));
}

#[test]
fn lists_contain_the_added_items_in_order() {
    let names = ["first", "zweite Größe", "third"];
    let mut list = Descriptors::default();
    assert!(list.as_ref().is_empty() && list.encode_to_vec().is_err());
    for (place, name) in names.into_iter().enumerate() {
        list.push(Descriptor::new(name, "UDINT").unwrap());
        assert_eq!(list.as_ref().len(), place + 1);
        assert_eq!(
            list.encode_to_vec().map(|bytes| bytes.len()),
            Ok((place + 1) * limits::DESCRIPTOR_LEN)
        );
    }
    for (place, name) in names.into_iter().enumerate() {
        let object = list.as_ref().get(place).unwrap();
        assert!(object.name() == name && object.type_name() == "UDINT", "{object:?}");
    }
    assert_eq!(list.as_ref().get(names.len()), None);
    let bytes = list.encode_to_vec().unwrap();
    assert_eq!(Descriptors::decode(&bytes).as_ref(), Ok(&list));

    let mut same = Descriptors::default();
    same.extend(names.map(|name| Descriptor::new(name, "UDINT").unwrap()));
    assert_eq!((&same, same.len(), same.is_empty()), (&list, 3, false));
    let mut backwards = Vec::new();
    for object in &list {
        backwards.insert(0, object);
    }
    assert!(list.iter().rev().eq(backwards));
    assert_eq!(list.as_ref().into_iter().nth(1).map(|object| object.to_owned()), {
        Some(Descriptor::new(names[1], "UDINT").unwrap())
    });
    assert!(U32List::from(&vec![3, 9]).into_iter().eq([3, 9]));
    let name: CncString = names[1].parse().unwrap();
    assert!(name == names[1] && name == *names[1] && name != names[0]);
}

/// A Rust string is converted to CP1252 with a NUL after it, or rejected.
#[test]
fn texts_of_a_program_are_cp1252_or_rejected() {
    let text: Text = "größer".parse().unwrap();
    assert_eq!(text, Text::from("größer".parse::<CncString>().unwrap()));
    assert_eq!((text.text.as_bytes(), text.tail), (&b"gr\xF6\xDFer"[..], Some(vec![])));
    for wrong in ["a\0b", "☃"] {
        assert_eq!(wrong.parse::<Text>().unwrap_err(), CncStr::new(wrong).unwrap_err());
    }
}
