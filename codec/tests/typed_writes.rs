//! Tests of encoding values: printed values, errors of a shape, and random values of every type.

use address::{Channel, ChannelAxis, IndexGroup, IndexOffset};
use ads_cnc::ErrorKind::*;
use ads_cnc::operation::{
    AxisWriteByName, Operation, ReadByName, ReadObject, WriteByHandle, WriteByName, WriteValue,
};
use ads_cnc::value::*;
use ads_cnc::*;
use proptest::collection::vec;
use proptest::prelude::*;

use super::common::shapes::{Described, ShapeMutation, check_shape};
use super::common::{check_typed, fault, fault_of};
use super::kept;

const ARRAY: &[u8] = b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0";

fn shape(data_type: DataType, dimensions: &[u32], size: u32) -> Shape<'_> {
    Shape::new(data_type, dimensions.into(), size).unwrap()
}

/// A `WriteValue` has the same bytes whether it was made from a number, a slice, a vector or
/// elements.
#[test]
fn values_to_write_are_their_bytes() {
    let bytes = 1.5_f64.to_le_bytes().to_vec();
    let (number, buffer) = (WriteValue::from(1.5_f64), WriteValue::from(&bytes[..]));
    #[cfg(feature = "alloc")]
    assert_eq!(WriteValue::from(&bytes), buffer);
    assert_eq!((number.as_bytes(), buffer.as_bytes()), (&bytes[..], &bytes[..]));
    assert_eq!(number, buffer);
    assert_ne!(number, WriteValue::from(1.25_f64));
    let elements = Elements::new(DataType::Real64, U32List::EMPTY, &bytes).unwrap();
    assert_eq!(WriteValue::from(elements), buffer);
    assert_eq!(format!("{number:?}"), format!("{bytes:?}"));
    let all: std::collections::HashSet<_> = [number, buffer, true.into()].into();
    assert_eq!(all.len(), 2);
    let mut room = [7; 3];
    assert_eq!([true, false].encode_value(&mut room).unwrap(), [1, 0]);
}

#[test]
fn names_are_accepted_from_all_text_types() {
    let channel = Channel::new(1).unwrap();
    let wanted = ReadByName::new(channel, "V.E.x").unwrap();
    #[cfg(feature = "alloc")]
    {
        let owned = CncString::from(CncStr::new("V.E.x").unwrap());
        assert_eq!(ReadByName::new(channel, &owned).unwrap(), wanted);
    }
    assert_eq!(ReadByName::new(channel, &String::from("V.E.x")).unwrap(), wanted);
}

/// An owned descriptor, a borrowed descriptor and a descriptor from a slice address the same
/// object.
#[test]
fn objects_are_addressed_by_their_descriptors() {
    let (group, offset) = (IndexGroup::new(0x12_0101), IndexOffset::new(3));
    let object = Descriptor::new("o", "BOOL").unwrap().with_size(1).with_content(group, offset);
    let wanted = ReadObject::new(group, offset, 1).unwrap();
    assert_eq!(ReadObject::of(&object).unwrap(), wanted);
    assert_eq!(ReadObject::of(object.as_ref()).unwrap(), wanted);
    let items = [object.as_ref(), object.as_ref()];
    assert!(items.iter().all(|item| ReadObject::of(item).unwrap() == wanted));
}

/// The requests printed in sections 4.3.6, 4.3.7 and 4.3.11 are encoded. The types SGN32 and REAL64
/// of their values are assumed.
#[test]
fn printed_writes() {
    let channel = Channel::new(1).unwrap();
    let (mut value, mut buf) = ([0; 20], [0; 64]);
    let one = 123_i32.encode_value(&mut value).unwrap();
    let op = WriteByHandle::new(channel, Handle(0x2001234), U32List::from(&[4]), one);
    assert_eq!(op.encode(&mut buf).unwrap(), b"\x34\x12\0\x02\x01\0\0\0\x04\0\0\0\x7b\0\0\0");
    let op = WriteByName::new(channel, "V.E.test[4]", one).unwrap();
    assert_eq!(op.encode(&mut buf).unwrap(), b"V.E.test[4]\0\x7b\0\0\0");

    let all = [123, 234, 345, 456, 567].encode_value(&mut value).unwrap();
    assert_eq!(all, ARRAY);
    let op = WriteByHandle::new(channel, Handle(0x2001234), U32List::EMPTY, all);
    assert_eq!(op.encode(&mut buf).unwrap(), [b"\x34\x12\0\x02\0\0\0\0", ARRAY].concat());
    let op = WriteByName::new(channel, "V.E.test", all).unwrap();
    assert_eq!(op.encode(&mut buf).unwrap(), [b"V.E.test\0", ARRAY].concat());

    let position = 123.456.encode_value(&mut value).unwrap();
    let axis = ChannelAxis::new(2).unwrap();
    let op = AxisWriteByName::new(channel, axis, "V.A.WCS", position).unwrap();
    assert_eq!(op.encode(&mut buf).unwrap(), b"V.A.WCS\0\x77\xbe\x9f\x1a\x2f\xdd\x5e\x40");
}

/// Requests accept values up to their limits, and reject longer values (VAR-12, VAR-13).
#[test]
fn requests_accept_values_up_to_their_limits() {
    let channel = Channel::new(1).unwrap();
    let (mut value, mut buf) = ([0; 4000], [0; 4000]);
    let mut by_handle = |numbers: &[u8], indices: U32List<'_>| {
        let value = numbers.encode_value(&mut value).unwrap();
        WriteByHandle::new(channel, Handle(1), indices, value).encode(&mut buf).map(<[u8]>::len)
    };
    assert_eq!(by_handle(&[1; 2040], U32List::EMPTY), Ok(2048));
    assert_eq!(by_handle(&[1; 2041], U32List::EMPTY).unwrap_err().kind(), TooLong);
    assert_eq!(by_handle(&[1; 2036], U32List::from(&[4])), Ok(2048));
    assert_eq!(by_handle(&[1; 2037], U32List::from(&[4])).unwrap_err().kind(), TooLong);
    let mut by_name = |numbers: &[u8], name| {
        let value = numbers.encode_value(&mut value).unwrap();
        let op = WriteByName::new(channel, name, value).unwrap();
        op.encode(&mut buf).map(<[u8]>::len)
    };
    assert_eq!(by_name(&[1; 2047], ""), Ok(2048));
    assert_eq!(by_name(&[1; 2048], "").unwrap_err().kind(), TooLong);
    assert_eq!(by_name(&[1; 2040], "V.E.abc"), Ok(2048));
    assert_eq!(by_name(&[1; 2041], "V.E.abc").unwrap_err().kind(), TooLong);

    // The content of an object may be longer, up to the limit of ADS data.
    let content = vec![0_u64; limits::ADS_DATA_MAX / 8 + 1];
    let error = content.encode_value(&mut []).unwrap_err();
    assert_eq!((error.kind(), error.expected()), (TooLong, 0x40_0000));
    let error = content[1..].encode_value(&mut []).unwrap_err();
    assert_eq!((error.kind(), error.expected()), (BufferTooSmall, 0x40_0000));
    #[cfg(feature = "alloc")]
    assert!(content.value_to_vec().is_err() && content[1..].value_to_vec().is_ok());
}

/// A shape rejects values of another type or number of elements; after an error, the buffer is
/// unchanged.
#[test]
fn writes_fit_the_description() {
    let dimensions = [2, 2];
    let array = shape(DataType::Sgn16, &dimensions, 8);
    let mut buf = [0x55; 16];
    assert_eq!(fault_of(array.encode(&[1_u16; 4], &mut buf)), fault(Mismatch, "type", 0, (4, 5)));
    assert_eq!(fault_of(array.encode(&[1_f32; 4], &mut buf)), fault(Mismatch, "type", 0, (4, 12)));
    assert_eq!(fault_of(array.encode(&[1_i16; 5], &mut buf)), fault(Mismatch, "count", 0, (4, 5)));
    assert_eq!(fault_of(array.encode(&1_i16, &mut buf)), fault(Mismatch, "count", 0, (4, 1)));
    let small = array.encode(&[1_i16; 4], &mut buf[..7]);
    assert_eq!(fault_of(small), fault(BufferTooSmall, "stream", 0, (8, 7)));
    let text = CncStr::new("1").unwrap();
    assert_eq!(fault_of(array.encode(&text, &mut buf)), fault(Mismatch, "type", 0, (4, 9)));
    assert_eq!(fault_of(array.encode_texts(&[], &mut buf)), fault(Mismatch, "type", 0, (4, 9)));
    assert_eq!(buf, [0x55; 16]);

    assert_eq!(array.encode(&[-1_i16, 2, 3, 4], &mut buf).unwrap(), b"\xff\xff\x02\0\x03\0\x04\0");
    assert_eq!(array.element_shape().encode(&-2_i16, &mut buf).unwrap(), b"\xfe\xff");
    // A decoded value is written unchanged.
    let read = array.elements(b"\x01\0\x02\0\x03\0\x04\0").unwrap();
    assert_eq!(array.encode(&read, &mut buf), Ok(read.as_bytes()));
    assert_eq!(array.element_shape().encode(&read.get(3).unwrap(), &mut buf).unwrap(), b"\x04\0");
}

/// A `CncStr` is written with a NUL after it. If both do not fit the size of the STRING, the text
/// is rejected, not truncated.
#[test]
fn texts_fit_their_size() {
    let mut buf = [0x55; 16];
    let text = |text: &'static str| CncStr::new(text).unwrap();
    let one = shape(DataType::String, &[], 4);
    assert_eq!(one.encode(&text("ä€"), &mut buf).unwrap(), b"\xe4\x80\0");
    assert_eq!(one.encode(&text("abc"), &mut buf).unwrap(), b"abc\0");
    assert_eq!(one.encode_texts(&[text("")], &mut buf).unwrap(), b"\0");
    let too_long = one.encode(&text("abcd"), &mut buf);
    assert_eq!(fault_of(too_long), fault(TooLong, "value", 0, (4, 5)));
    // A decoded text without a NUL is written without a NUL.
    let open = TextRef::with_tail(text("abcd"), None);
    assert_eq!(one.encode(&open, &mut buf).unwrap(), b"abcd");

    let dimensions = [3];
    let three = shape(DataType::String, &dimensions, 9);
    let texts = [text("ab"), text(""), text("c")];
    assert_eq!(three.encode_texts(&texts, &mut buf).unwrap(), b"ab\0\0\0\0c\0\0");
    assert!(three.elements(b"ab\0\0\0\0c\0\0").unwrap().iter().eq([
        Element::String(TextRef::with_tail(texts[0], Some(&[]))),
        Element::String(TextRef::with_tail(texts[1], Some(&[0, 0]))),
        Element::String(TextRef::with_tail(texts[2], Some(&[0]))),
    ]));
    let buf = &mut [0x55; 16];
    let too_long = three.encode_texts(&[text("ab"), text("abc"), text("")], buf);
    assert_eq!(fault_of(too_long), fault(TooLong, "value", 3, (3, 4)));
    let two = three.encode_texts(&texts[..2], buf);
    assert_eq!(fault_of(two), fault(Mismatch, "count", 0, (3, 2)));
    // The elements of these strings have another size than the elements of the shape.
    let strings = Elements::new(DataType::String, U32List::from(&dimensions), b"abcabc").unwrap();
    assert_eq!(fault_of(three.encode(&strings, buf)), fault(Mismatch, "size", 0, (9, 6)));
    assert_eq!(*buf, [0x55; 16]);
}

/// Encoding and decoding do not change signalling NaNs to quiet NaNs.
#[test]
fn nans_keep_their_bits() {
    let (single, double) = (b"\x01\0\x80\xff", b"\x01\0\0\0\0\0\xf0\x7f");
    for (data_type, bytes) in [(DataType::Real32, &single[..]), (DataType::Real64, double)] {
        let read = Elements::new(data_type, U32List::EMPTY, bytes).unwrap();
        assert_ne!(read.get(0), read.get(0));
        assert_eq!(read.get(0).unwrap().encode_value(&mut [0; 8]), Ok(bytes));
    }
}

/// Checks that numbers encode to these bits and decode from them, including NaNs with payloads.
fn check_numbers<T: Scalar>(numbers: &[T], bits: &[u8]) {
    let mut buf = vec![0; bits.len()];
    assert_eq!(numbers.encode_value(&mut buf), Ok(bits));
    let value = ValueRef { bytes: bits };
    for (place, number) in numbers.iter().enumerate() {
        let (mut one, mut two) = ([0; 8], [0; 8]);
        let read = value.get::<T>(place).unwrap();
        assert_eq!(read.encode_value(&mut one), number.encode_value(&mut two));
    }
}

/// Random dimensions of an array with few elements, and two random bytes for each element.
fn array() -> impl Strategy<Value = (Vec<u32>, Vec<u8>)> {
    vec(0..5_u32, 0..5).prop_flat_map(|dimensions| {
        let count = dimensions.iter().product::<u32>() as usize;
        (Just(dimensions), vec(any::<u8>(), count * 2))
    })
}

/// All indices of an array, in the order of nested loops: the last index varies fastest.
fn all_indices(dimensions: &[u32]) -> Vec<Vec<u32>> {
    let Some((&first, rest)) = dimensions.split_first() else { return vec![vec![]] };
    let rest = all_indices(rest);
    let with = |index| rest.iter().map(move |rest| [&[index], rest.as_slice()].concat());
    (0..first).flat_map(with).collect()
}

proptest! {
    #![proptest_config(kept::cases(256, file!()))]

    /// Random values of every number type are encoded to their bits and decoded from them.
    #[test]
    fn values_are_encoded_and_decoded(
        bytes in vec(any::<u8>(), 0..40), words in vec(any::<u16>(), 0..40),
        numbers in vec(any::<u32>(), 0..40), long in vec(any::<u64>(), 0..40),
    ) {
        let le: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        check_numbers(&words, &le);
        check_numbers(&words.iter().map(|&word| word as i16).collect::<Vec<_>>(), &le);
        let le: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        check_numbers(&numbers, &le);
        check_numbers(&numbers.iter().map(|&number| number as i32).collect::<Vec<_>>(), &le);
        check_numbers(&numbers.iter().map(|&bits| f32::from_bits(bits)).collect::<Vec<_>>(), &le);
        let nans = numbers.iter().map(|bits| bits | 0x7fc0_0000);
        let le: Vec<u8> = nans.clone().flat_map(u32::to_le_bytes).collect();
        check_numbers(&nans.map(f32::from_bits).collect::<Vec<_>>(), &le);
        let le: Vec<u8> = long.iter().flat_map(|number| number.to_le_bytes()).collect();
        check_numbers(&long, &le);
        check_numbers(&long.iter().map(|&number| number as i64).collect::<Vec<_>>(), &le);
        check_numbers(&long.iter().map(|&bits| f64::from_bits(bits)).collect::<Vec<_>>(), &le);
        let nans = long.iter().map(|bits| bits | 0x7ff8_0000_0000_0000);
        let le: Vec<u8> = nans.clone().flat_map(u64::to_le_bytes).collect();
        check_numbers(&nans.map(f64::from_bits).collect::<Vec<_>>(), &le);
        check_numbers(&bytes, &bytes);
        check_numbers(&bytes.iter().map(|&byte| byte as i8).collect::<Vec<_>>(), &bytes);
        check_numbers(&bytes.iter().map(|&byte| Boolean(byte)).collect::<Vec<_>>(), &bytes);
        check_typed(&bytes, |_| ());
    }

    /// The indices of an element select the same element as nested loops over the dimensions.
    #[test]
    fn elements_are_in_row_major_order((dimensions, bytes) in array()) {
        let elements =
            Elements::new(DataType::Uns16, dimensions.as_slice().into(), &bytes).unwrap();
        let items: Vec<u16> = elements.items().unwrap().collect();
        let all = all_indices(&dimensions);
        prop_assert_eq!(all.len(), elements.len());
        for (place, indices) in all.iter().enumerate() {
            let expected = u16::from_le_bytes([bytes[place * 2], bytes[place * 2 + 1]]);
            let indices = U32List::from(indices.as_slice());
            prop_assert_eq!(elements.element(indices), Ok(Element::Uns16(expected)));
            prop_assert_eq!(items[place], expected);
            prop_assert_eq!(elements.shape().index_of(indices), Ok(place as u32));
        }
    }

    /// An index outside its dimension is rejected with its position.
    #[test]
    fn indices_outside_their_dimension_are_rejected(
        dimensions in prop_oneof![
            vec(1..=u32::MAX, 1), vec(1..=0xFFFF_u32, 2), vec(1..=0xFF_u32, 3..5)
        ],
        picks in vec(any::<u32>(), 5), at in 0..5_usize,
        over in any::<u32>(),
    ) {
        let at = at % dimensions.len();
        let mut indices: Vec<u32> = dimensions.iter().zip(&picks).map(|(n, pick)| pick % n).collect();
        let array = shape(DataType::Uns08, &dimensions, dimensions.iter().product());
        let find = |indices: &[u32]| array.index_of(indices.into());
        prop_assert!(find(&indices).is_ok_and(|index| index < array.count()));
        indices[at] = dimensions[at].saturating_add(over % 3);
        let error = fault_of(find(&indices));
        let (last, index) = (dimensions[at] as usize - 1, indices[at] as usize);
        prop_assert_eq!(error, fault(OutOfRange, "index", at, (last, index)));
    }

    /// Shapes of any type, any size and at most four dimensions satisfy `check_shape`. A shape has
    /// the size with which it was made, and as many elements as the product of its dimensions.
    #[test]
    fn shapes_obey_the_laws(
        pick in 0..DataType::ALL.len(), bytes in vec(any::<u8>(), 0..64), size in any::<u32>(),
        given in vec(prop_oneof![1 => Just(0), 8 => 1..5_u32, 1 => any::<u32>()], 0..5),
        picks in vec(0..5_u32, 5),
    ) {
        let (data_type, dimensions) = (DataType::ALL[pick], U32List::from(given.as_slice()));
        for size in [size, bytes.len() as u32] {
            let (dimensions, indices) = (&given[..], &picks[..given.len()]);
            let of = Described { data_type, dimensions, size, indices, bytes: &bytes };
            let _ = check_shape(&of, ShapeMutation::NONE);
        }
        for size in [size, bytes.len() as u32] {
            let Ok(shape) = Shape::new(data_type, dimensions, size) else { continue };
            prop_assert_eq!(shape.size(), size);
            let product = dimensions.iter().map(u128::from).product::<u128>();
            prop_assert_eq!(u128::from(shape.count()), product);
            if let Ok(elements) = shape.elements(&bytes) {
                prop_assert!(elements.iter().count() <= bytes.len().max(1));
                let mut buf = [0; 64];
                prop_assert_eq!(shape.encode(&elements, &mut buf).is_ok(), bytes.len() <= size as usize);
            }
        }
    }
}
