//! Tests of decoding values by their types, such as printed values, a value of each type, and the
//! functions that access elements.

use address::{Channel, ChannelAxis};
use ads_cnc::ErrorKind::*;
use ads_cnc::operation::{AxisReadByName, Operation, ReadByHandle, ReadByName};
use ads_cnc::value::*;
use ads_cnc::*;

use super::common::{fault, fault_of};

const ARRAY: &[u8] = b"\x7b\0\0\0\xea\0\0\0\x59\x01\0\0\xc8\x01\0\0\x37\x02\0\0";

fn elements<'a>(data_type: DataType, dimensions: &'a [u32], bytes: &'a [u8]) -> Elements<'a> {
    Elements::new(data_type, dimensions.into(), bytes).unwrap()
}

fn shape(data_type: DataType, dimensions: &[u32], size: u32) -> Result<Shape<'_>, Error> {
    Shape::new(data_type, dimensions.into(), size)
}

/// The replies printed in sections 4.3.4, 4.3.5 and 4.3.10 are decoded. Their types SGN32 and
/// REAL64 are assumed.
#[test]
fn printed_replies() {
    let channel = Channel::new(1).unwrap();
    let by_handle = ReadByHandle::new(channel, Handle(0x20012341), U32List::from(&[4]));
    let one = by_handle.decode_reply(b"\x4d\x01\0\0").unwrap();
    let one = one.elements(VariableType::SGN32, U32List::EMPTY).unwrap();
    assert_eq!(one.element(U32List::EMPTY), Ok(Element::Sgn32(333)));
    assert!(one.items::<i32>().unwrap().eq([333]));

    let by_name = ReadByName::new(channel, "V.E.Testvar").unwrap();
    let all = by_name.decode_reply(ARRAY).unwrap();
    let all = all.elements(VariableType::SGN32, U32List::from(&[5])).unwrap();
    assert!(all.items::<i32>().unwrap().eq([123, 234, 345, 456, 567]));
    assert_eq!(all.element(U32List::from(&[3])), Ok(Element::Sgn32(456)));

    let axis = ChannelAxis::new(2).unwrap();
    let position = AxisReadByName::new(channel, axis, "V.A.WCS").unwrap();
    let value = position.decode_reply(b"\xcd\xcc\xcc\xcc\xcc\x48\x93\x40").unwrap();
    let value = value.elements(VariableType::REAL64, U32List::EMPTY).unwrap();
    assert!(value.iter().eq([Element::Real64(1234.2)]));
}

/// An element of each type is decoded and encoded. The expected bytes were computed with Python's
/// `struct`.
#[test]
fn each_type_is_read_and_written() {
    let rows: [(DataType, &[u8], Element<'_>); 11] = [
        (DataType::Boolean, b"\x80", Element::Boolean(Boolean(0x80))),
        (DataType::Sgn08, b"\x80", Element::Sgn08(-128)),
        (DataType::Uns08, b"\x80", Element::Uns08(128)),
        (DataType::Sgn16, b"\xfe\xff", Element::Sgn16(-2)),
        (DataType::Uns16, b"\xdc\xfe", Element::Uns16(0xfedc)),
        (DataType::Sgn32, b"\0\0\0\x80", Element::Sgn32(i32::MIN)),
        (DataType::Uns32, b"\x98\xba\xdc\xfe", Element::Uns32(0xfedc_ba98)),
        (DataType::Lint, b"\xfe\xff\xff\xff\xff\xff\xff\xff", Element::Lint(-2)),
        (
            DataType::Lword,
            b"\x10\x32\x54\x76\x98\xba\xdc\xfe",
            Element::Lword(0xfedc_ba98_7654_3210),
        ),
        (DataType::Real32, b"\0\0\xc0\xbf", Element::Real32(-1.5)),
        (DataType::Real64, b"\x9a\x99\x99\x99\x99\x49\x93\x40", Element::Real64(1234.4)),
    ];
    for (data_type, bytes, element) in rows {
        let read = elements(data_type, &[], bytes);
        assert!(read.iter().eq([element]), "{data_type:?}");
        assert_eq!(element.encode_value(&mut [0; 8]), Ok(bytes), "{data_type:?}");
        assert_eq!(data_type.size(), Some(bytes.len() as u32));
        let twice = [bytes, bytes].concat();
        let dimensions = [2];
        let read = elements(data_type, &dimensions, &twice);
        assert!(read.iter().eq([element; 2]) && read.iter().rev().eq([element; 2]));
    }
    let text = elements(DataType::String, &[], b"L\xE4nge\0rest");
    let Ok(Element::String(text)) = text.get(0) else { panic!("{text:?}") };
    assert_eq!((text.text(), text.tail()), (CncStr::new("Länge").unwrap(), Some(&b"rest"[..])));
}

/// Each type has a name for elements and a name for objects; other names are unknown (GEN-5).
#[test]
fn names_of_types() {
    let rows = [
        ("BOOLEAN BOOL", DataType::Boolean, Some(VariableType::BOOLEAN)),
        ("SGN08 SINT", DataType::Sgn08, Some(VariableType::SGN08)),
        ("UNS08 BYTE", DataType::Uns08, Some(VariableType::UNS08)),
        ("SGN16 INT", DataType::Sgn16, Some(VariableType::SGN16)),
        ("UNS16 WORD", DataType::Uns16, Some(VariableType::UNS16)),
        ("SGN32 DINT", DataType::Sgn32, Some(VariableType::SGN32)),
        ("UNS32 DWORD", DataType::Uns32, Some(VariableType::UNS32)),
        ("LINT LINT", DataType::Lint, None),
        ("LWORD LWORD", DataType::Lword, None),
        ("REAL32 REAL", DataType::Real32, None),
        ("REAL64 LREAL", DataType::Real64, Some(VariableType::REAL64)),
        ("STRING STRING", DataType::String, Some(VariableType::STRING)),
    ];
    assert_eq!(rows.map(|(_, data_type, _)| data_type), DataType::ALL);
    for (names, data_type, var_type) in rows {
        for name in names.split(' ') {
            let name = CncStr::new(name).unwrap();
            assert_eq!(DataType::by_name(name), Some(data_type), "{name}");
        }
        assert_eq!(names, format!("{} {}", data_type.name(), data_type.object_name()));
        assert_eq!(data_type.var_type(), var_type);
        if let Some(var_type) = var_type {
            assert_eq!(var_type.data_type(), Some(data_type));
        }
    }
    for name in ["", "bool", "BOOL ", "UDINT", "SGN64", "REAL8", "STRING(20)"] {
        assert_eq!(DataType::by_name(CncStr::new(name).unwrap()), None, "{name}");
    }
    for code in [0, 10, u32::MAX] {
        assert_eq!(VariableType(code).data_type(), None);
    }
}

/// A client decodes the value of a whole variable and that of one element by the description of the
/// variable.
#[test]
fn values_by_description() {
    let bytes = b"\x02\0\0\x02\x01\0\0\0\x01\0\0\0\x02\0\0\0\x01\0\0\0\x02\0\0\0V.E.Variable_3\0";
    let variable = DescriptionRef::decode(bytes).unwrap();
    let value = ValueRef { bytes: &[7, 0] };
    let read = variable.elements(&value).unwrap();
    assert!(read.iter().eq([Element::Boolean(Boolean(7)), Element::Boolean(Boolean::FALSE)]));
    let one = ValueRef { bytes: &[7] };
    assert_eq!(variable.element(&one), Ok(Element::Boolean(Boolean(7))));

    // The value of the array is rejected as the value of one element, and vice versa.
    assert_eq!(fault_of(variable.element(&value)), fault(Trailing, "value", 1, (1, 2)));
    assert_eq!(fault_of(variable.elements(&one)), fault(Truncated, "value", 0, (2, 1)));

    let wrong = DescriptionRef { size: 3, ..variable };
    assert_eq!(fault_of(wrong.elements(&value)), fault(Mismatch, "size", 0, (2, 3)));
    let unknown = DescriptionRef { var_type: VariableType(10), ..variable };
    assert_eq!(fault_of(unknown.elements(&value)), fault(OutOfRange, "type", 0, (9, 10)));

    #[cfg(feature = "alloc")]
    {
        let owned = Description::decode(bytes).unwrap();
        assert_eq!(owned.shape(), variable.shape());
        assert!(owned.elements(&value).unwrap().iter().eq(read.iter()));
        assert_eq!(owned.element(&one), variable.element(&one));
    }
}

/// The content of a COM object and that of an element are decoded by the names of their types.
#[test]
fn content_by_name_of_its_type() {
    let object = Descriptor::new("mc_active_single_block_r", "BOOL").unwrap().with_size(1);
    let data_type = object.data_type().unwrap();
    let shape = Shape::new(data_type, U32List::EMPTY, object.size()).unwrap();
    assert!(shape.elements(&[1]).unwrap().iter().eq([Element::Boolean(Boolean::TRUE)]));
    assert_eq!(object.as_ref().data_type(), Some(DataType::Boolean));
    assert_eq!(Descriptor::new("a", "HLI_COORD").unwrap().data_type(), None);

    let element = DataType::by_name(CncStr::new("REAL64").unwrap()).unwrap();
    let content = b"\x77\xbe\x9f\x1a\x2f\xdd\x5e\x40";
    assert!(elements(element, &[], content).iter().eq([Element::Real64(123.456)]));
}

/// A single STRING may have any length. The texts of an array have equal shares of its bytes, which
/// is an assumption (VAR-22, VAR-25).
#[test]
fn texts_of_an_array_share_its_bytes() {
    let one = shape(DataType::String, &[], 21).unwrap();
    for bytes in [&b""[..], b"\0", b"abc", b"abc\0", &[b'x'; 300]] {
        let elements = one.elements(bytes).unwrap();
        let text: TextRef<'_> = elements.get(0).unwrap().try_into().unwrap();
        assert_eq!((elements.len(), text.field_len()), (1, bytes.len()));
        assert!(elements.get(1).is_err() && elements.iter().count() == 1);
    }

    let dimensions = [2, 2];
    let four = shape(DataType::String, &dimensions, 12).unwrap();
    assert_eq!((four.count(), four.element_size(), four.size()), (4, 3, 12));
    let elements = four.elements(b"ab\0c\0ddef\0\0\0").unwrap();
    let texts: Vec<TextRef<'_>> = elements.iter().flat_map(TryFrom::try_from).collect();
    let shown: Vec<_> = texts.iter().map(|text| (text.text().to_string(), text.tail())).collect();
    let text = |text: &str, tail| (text.to_owned(), tail);
    assert_eq!(shown[..2], [text("ab", Some(&b""[..])), text("c", Some(b"d"))]);
    assert_eq!(shown[2..], [text("def", None), text("", Some(b"\0\0"))]);
    let last = elements.element(U32List::from(&[1, 0])).unwrap();
    assert_eq!(last, Element::String(texts[2]));

    assert_eq!(fault_of(four.elements(b"ab\0c\0d")), fault(Truncated, "value", 0, (12, 6)));
    let shares = |size| fault_of(shape(DataType::String, &dimensions, size));
    assert_eq!(shares(13), fault(Mismatch, "size", 0, (12, 13)));
    assert_eq!(shares(3), fault(Mismatch, "size", 0, (4, 3)));
    assert_eq!(shares(0), fault(Mismatch, "size", 0, (4, 0)));
}

/// The error for a wrong index has the position of the index, its maximum and its value.
#[test]
fn errors_name_the_wrong_index() {
    let bytes = [0; 24];
    let dimensions = [2, 3];
    let elements = elements(DataType::Sgn32, &dimensions, &bytes);
    let at = |indices: &[u32]| elements.element(indices.into());
    assert_eq!(fault_of(at(&[2, 0])), fault(OutOfRange, "index", 0, (1, 2)));
    assert_eq!(fault_of(at(&[1, 3])), fault(OutOfRange, "index", 1, (2, 3)));
    assert_eq!(fault_of(at(&[0, u32::MAX])), fault(OutOfRange, "index", 1, (2, 0xffff_ffff)));
    assert_eq!(fault_of(at(&[])), fault(Mismatch, "index_count", 0, (2, 0)));
    assert_eq!(fault_of(at(&[1])), fault(Mismatch, "index_count", 0, (2, 1)));
    assert_eq!(fault_of(at(&[1, 2, 0])), fault(Mismatch, "index_count", 0, (2, 3)));

    assert_eq!(fault_of(elements.get(6)), fault(OutOfRange, "index", 0, (5, 6)));
    let value = ValueRef { bytes: &[1, 2, 3] };
    assert_eq!(fault_of(value.get::<u16>(0)), fault(Truncated, "value", 2, (2, 1)));
    assert_eq!(fault_of(value.get::<u8>(3)), fault(OutOfRange, "index", 0, (2, 3)));
    assert_eq!(fault_of(value.copy_to(&mut [0_u8; 2])), fault(Mismatch, "count", 0, (3, 2)));
    let none = ValueRef { bytes: &[] };
    assert_eq!(fault_of(none.get::<u8>(0)), fault(Missing, "value", 0, (0, 0)));
    let other = elements.items::<u32>().map(|_| ());
    assert_eq!(fault_of(other), fault(Mismatch, "type", 0, (7, 6)));

    // The indices can come from a name.
    let path = VariablePath::new("V.E.field[1][2]").unwrap();
    assert_eq!(elements.shape().index_of(path.elements()), Ok(5));
}

/// `get`, the iterator, its reverse, `nth` and `step_by` return the same elements.
#[test]
fn elements_in_their_order() {
    let bytes: Vec<u8> = (0..24).collect();
    let dimensions = [3, 4];
    let elements = elements(DataType::Uns16, &dimensions, &bytes);
    assert_eq!(elements.shape().dimensions(), U32List::from(&dimensions));
    let all: Vec<_> = elements.into_iter().collect();
    assert_eq!(all.len(), 12);
    for place in 0..14 {
        let wanted = all.get(place).copied();
        assert_eq!((elements.get(place).ok(), elements.iter().nth(place)), (wanted, wanted));
        assert_eq!(elements.iter().rev().nth(place), all.iter().rev().nth(place).copied());
        let mut iter = elements.iter();
        iter.nth(place);
        assert_eq!(iter.len(), 11_usize.saturating_sub(place));
        assert_eq!(iter.next(), all.get(place + 1).copied());
    }
    let every_fifth: Vec<_> = elements.iter().step_by(5).collect();
    assert_eq!(every_fifth, [all[0], all[5], all[10]]);
}

/// A value with a dimension of 0 has no elements, whatever its other dimensions.
#[test]
fn a_dimension_of_0_has_no_element() {
    let huge = [u32::MAX, 0, u32::MAX];
    for data_type in DataType::ALL {
        let none = elements(data_type, &huge, &[]);
        assert_eq!((none.len(), none.iter().len()), (0, 0));
        assert_eq!(fault_of(none.get(0)), fault(Missing, "value", 0, (0, 0)));
        assert!(none.is_empty() && none.shape().size() == 0);
        let indices = [u32::MAX - 1, 0, 0];
        assert_eq!(
            fault_of(none.element(U32List::from(&indices))),
            fault(Missing, "dimension", 1, (0, 0))
        );
        assert!(Elements::new(data_type, U32List::from(&[0]), &[1]).is_err());
        assert_eq!(fault_of(shape(data_type, &[0, 7], 1)), fault(Mismatch, "size", 0, (0, 1)));
    }
    // The product of the dimensions before the 0 exceeds 32 bits.
    let late = [u32::MAX, u32::MAX, 0];
    assert!(elements(DataType::Uns08, &late, &[]).is_empty());
    assert_eq!(ValueRef { bytes: &[] }.iter::<f64>().unwrap().len(), 0);
}

/// A shape whose product of dimensions exceeds 32 bits is rejected with any size: the product
/// neither wraps nor saturates.
#[test]
fn sizes_do_not_wrap() {
    let wraps = [0x1_0000, 0x1_0000];
    for data_type in DataType::ALL {
        for size in [0, 1, u32::MAX] {
            let error = fault_of(shape(data_type, &wraps, size));
            assert_eq!(error, fault(Mismatch, "size", 0, (u32::MAX as usize, size as usize)));
        }
        assert!(Elements::new(data_type, U32List::from(&wraps), &[]).is_err());
    }
    let most = shape(DataType::Uns08, &[u32::MAX], u32::MAX).unwrap();
    assert_eq!(
        (most.size(), most.index_of(U32List::from(&[u32::MAX - 1]))),
        (u32::MAX, Ok(u32::MAX - 1))
    );
}

/// Values are rejected if the product of their dimensions exceeds 32 bits, or if their type is
/// undocumented.
#[test]
fn values_without_a_valid_size_are_rejected() {
    let value = ValueRef { bytes: &[] };
    let dimensions = [0x4000_0000, 4];
    let error = value.elements(VariableType::SGN32, U32List::from(&dimensions)).unwrap_err();
    assert_eq!((error.kind(), error.expected()), (Truncated, u32::MAX));
    for (code, bound) in [(0, 1), (10, 9), (u32::MAX, 9)] {
        let error = value.elements(VariableType(code), U32List::EMPTY).unwrap_err();
        assert_eq!((error.expected(), error.found()), (bound, code));
    }
}

/// An integer converts to each number type that represents it exactly. A floating-point number only
/// converts to its type, or from REAL32 to `f64`.
#[test]
fn elements_become_numbers_that_hold_them() {
    fn as_all(element: Element<'_>) -> ([bool; 8], [bool; 2]) {
        let integers = [
            i8::try_from(element).is_ok(),
            u8::try_from(element).is_ok(),
            i16::try_from(element).is_ok(),
            u16::try_from(element).is_ok(),
            i32::try_from(element).is_ok(),
            u32::try_from(element).is_ok(),
            i64::try_from(element).is_ok(),
            u64::try_from(element).is_ok(),
        ];
        (integers, [f32::try_from(element).is_ok(), f64::try_from(element).is_ok()])
    }

    let (all, none) = ([true; 8], [false; 8]);
    let signed = [true, false, true, false, true, false, true, false];
    let long = [false, false, false, false, false, false, true, true];
    for (element, integers, floats) in [
        (Element::Sgn08(7), all, [true; 2]),
        (Element::Uns08(7), all, [true; 2]),
        (Element::Sgn16(0), all, [true; 2]),
        (Element::Uns16(127), all, [true; 2]),
        (Element::Sgn32(-128), signed, [true; 2]),
        (Element::Lint(-1), signed, [true; 2]),
        (Element::Uns32(200), [false, true, true, true, true, true, true, true], [true; 2]),
        (Element::Lword(1 << 40), long, [true; 2]),
        (Element::Lint((1 << 40) + 1), long, [false, true]),
        (Element::Lint((1 << 53) + 1), long, [false; 2]),
        (
            Element::Lint(i64::MIN),
            [false, false, false, false, false, false, true, false],
            [true; 2],
        ),
        (
            Element::Lword(u64::MAX),
            [false, false, false, false, false, false, false, true],
            [false; 2],
        ),
        (Element::Real32(1.5), none, [true; 2]),
        (Element::Real64(2.0), none, [false, true]),
        (Element::Boolean(Boolean::TRUE), none, [false; 2]),
        (Element::String(TextRef::new("1").unwrap()), none, [false; 2]),
    ] {
        assert_eq!(as_all(element), (integers, floats), "{element:?}");
    }
    for number in [0, 1, -1, 255, -256, 0x00FF_FFFF, -0x0100_0000, 0x7FFF_FF80] {
        assert_eq!(f32::try_from(Element::Sgn32(number)), Ok(number as f32));
        assert_eq!(f64::try_from(Element::Sgn32(number)), Ok(f64::from(number)));
        assert_eq!(i64::try_from(Element::Sgn32(number)), Ok(i64::from(number)));
    }
    for number in [(1 << 53) - 1, 1 - (1 << 53), i64::MIN, 0x7FFF_FFFF_FFFF_FC00] {
        assert_eq!(f64::try_from(Element::Lint(number)), Ok(number as f64));
    }
    let error = fault_of(u8::try_from(Element::Sgn32(-1)));
    assert_eq!(error, fault(OutOfRange, "number", 0, (3, 1)));
    let error = fault_of(i64::try_from(Element::Lword(u64::MAX)));
    assert_eq!(error, fault(OutOfRange, "number", u32::MAX as usize, (10, u32::MAX as usize)));
    let error = fault_of(u8::try_from(Element::Real64(1.0)));
    assert_eq!(error, fault(Mismatch, "type", 0, (3, 8)));

    assert_eq!(bool::try_from(Element::Boolean(Boolean(7))), Ok(true));
    assert_eq!(fault_of(bool::try_from(Element::Uns08(1))), fault(Mismatch, "type", 0, (1, 3)));
    let text = Element::String(TextRef::new("Länge").unwrap());
    assert_eq!(CncStr::try_from(text), CncStr::new("Länge"));
    assert_eq!(fault_of(CncStr::try_from(Element::Lint(1))), fault(Mismatch, "type", 0, (9, 10)));
    #[cfg(feature = "alloc")]
    {
        assert_eq!(String::try_from(text).as_deref(), Ok("Länge"));
        let value = Value { bytes: vec![1, 0, 2, 0] };
        assert_eq!(value.to_vec::<u16>(), Ok(vec![1, 2]));
        let content = Content { bytes: vec![1, 0, 2, 0] };
        assert_eq!(content.iter::<i16>().unwrap().rev().collect::<Vec<_>>(), [2, 1]);
        assert_eq!((content.get(1), value.get(0)), (Ok(2_u16), Ok(1_u16)));
    }
}
