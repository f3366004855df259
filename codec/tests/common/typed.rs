//! Laws of the elements of values, for any bytes and any type.

use ads_cnc::value::{DataType, Element, Elements, EncodeValue, Scalar};
use ads_cnc::{ErrorKind, U32List, ValueRef};

/// Checks for every type that several ways to decode the bytes return the same elements, and that
/// these encode to the same bytes; `wrong` is a fault that changes the bytes written element by
/// element. Bytes whose number does not fit the type must be rejected.
pub(crate) fn check_typed(bytes: &[u8], wrong: fn(&mut [u8])) {
    for data_type in DataType::ALL {
        let each = data_type.size().map_or(3, |size| size as usize);
        let count = bytes.len() / each;
        let dimension = [count as u32];
        let elements = Elements::new(data_type, U32List::from(&dimension), bytes);
        let each = if data_type == DataType::String { count } else { each };
        // A value without elements has no bytes.
        let fits = bytes.len().checked_rem(each).map_or(bytes.is_empty(), |left| left == 0);
        assert_eq!(elements.is_ok(), fits, "{data_type:?}: {bytes:x?}");
        let Ok(elements) = elements else { continue };
        check_elements(elements, bytes, wrong);
        check_order(data_type, bytes, count as u32);
    }
}

fn check_elements(elements: Elements<'_>, bytes: &[u8], wrong: fn(&mut [u8])) {
    let iter = elements.iter();
    assert_eq!((iter.len(), iter.clone().count()), (elements.len(), elements.len()));
    let mut again: Vec<u8> = Vec::new();
    for (place, element) in iter.enumerate() {
        assert!(same(&element, &elements.get(place).unwrap()));
        assert_eq!(element.data_type(), elements.data_type());
        let at = again.len();
        again.resize(at + element.value_len(), 0);
        element.encode_value(&mut again[at..]).unwrap();
    }
    wrong(&mut again);
    assert_eq!(again, bytes);
    assert!(elements.get(elements.len()).is_err());

    match elements.data_type() {
        DataType::Boolean => check_items::<ads_cnc::value::Boolean>(elements),
        DataType::Sgn08 => check_items::<i8>(elements),
        DataType::Uns08 => check_items::<u8>(elements),
        DataType::Sgn16 => check_items::<i16>(elements),
        DataType::Uns16 => check_items::<u16>(elements),
        DataType::Sgn32 => check_items::<i32>(elements),
        DataType::Uns32 => check_items::<u32>(elements),
        DataType::Lint => check_items::<i64>(elements),
        DataType::Lword => check_items::<u64>(elements),
        DataType::Real32 => check_items::<f32>(elements),
        DataType::Real64 => check_items::<f64>(elements),
        _ => check_strings(elements),
    }
}

/// Checks that a value and its elements decode to numbers that encode to the same bytes, and that
/// the elements reject another type.
fn check_items<T: Scalar>(elements: Elements<'_>) {
    let (items, bytes) = (elements.items::<T>().expect("its own type"), elements.as_bytes());
    assert_eq!(items.len(), elements.len());
    let mut copy = vec![T::default(); items.len()];
    elements.copy_to(&mut copy).unwrap();
    let mut buf = vec![0; bytes.len()];
    assert_eq!(copy.encode_value(&mut buf), Ok(bytes));
    let mut more = vec![T::default(); items.len() + 1];
    assert_eq!(elements.copy_to(&mut more).unwrap_err().kind(), ErrorKind::Mismatch);

    let value = ValueRef { bytes };
    assert_eq!(value.iter::<T>().unwrap().len(), elements.len());
    let mut again = vec![T::default(); items.len()];
    value.copy_to(&mut again).unwrap();
    assert_eq!(again.encode_value(&mut buf), Ok(bytes));
    for (index, item) in value.iter::<T>().unwrap().enumerate() {
        let (mut one, mut two) = ([0; 8], [0; 8]);
        let read = value.get::<T>(index).unwrap();
        assert_eq!(read.encode_value(&mut one), item.encode_value(&mut two));
    }
    if T::TYPE == DataType::Uns08 {
        assert_eq!(
            elements.items::<i8>().err().map(|error| error.kind()),
            Some(ErrorKind::Mismatch)
        );
    } else {
        assert_eq!(
            elements.items::<u8>().err().map(|error| error.kind()),
            Some(ErrorKind::Mismatch)
        );
    }
}

/// Checks that texts have equal shares of the bytes, and are not decoded as numbers.
fn check_strings(elements: Elements<'_>) {
    let each = elements.shape().element_size() as usize;
    let each = if elements.len() == 1 { elements.as_bytes().len() } else { each };
    for element in elements {
        let Element::String(text) = element else { panic!("{element:?}") };
        assert_eq!(text.field_len(), each);
    }
    assert!(elements.items::<u8>().is_err());
}

/// Checks that the indices of two dimensions select the elements in order, the last index changing
/// fastest.
fn check_order(data_type: DataType, bytes: &[u8], count: u32) {
    for rows in [2, 3].into_iter().filter(|rows| count % rows == 0) {
        let dimensions = [rows, count / rows];
        let elements = Elements::new(data_type, U32List::from(&dimensions), bytes).unwrap();
        let mut all = elements.iter();
        for row in 0..rows {
            for column in 0..count / rows {
                let element = elements.element(U32List::from(&[row, column])).unwrap();
                assert!(same(&element, &all.next().unwrap()));
            }
        }
        assert!(all.next().is_none());
    }
}

/// Compares the encoded bytes of numbers, because a NaN does not equal itself.
fn same(one: &Element<'_>, two: &Element<'_>) -> bool {
    let (mut first, mut second) = ([0; 8], [0; 8]);
    match (one, two) {
        (Element::String(one), Element::String(two)) => one == two,
        _ => one.encode_value(&mut first) == two.encode_value(&mut second),
    }
}
