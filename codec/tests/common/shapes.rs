//! Laws of shapes and their values, for any type, any size and at most four dimensions (VAR-8,
//! VAR-21).

use ads_cnc::value::{DataType, Element, Elements, EncodeValue as _, Shape};
use ads_cnc::{ErrorKind, U32List};

use super::Fault;

/// A value with its description, and the indices of an element.
#[derive(Clone, Debug)]
pub(crate) struct Described<'a> {
    pub(crate) data_type: DataType,
    pub(crate) dimensions: &'a [u32],
    pub(crate) size: u32,
    pub(crate) indices: &'a [u32],
    pub(crate) bytes: &'a [u8],
}

/// A fault that is added to shapes and values, to verify that the laws detect it.
#[derive(Clone, Copy)]
pub(crate) struct ShapeMutation {
    /// Changes the indices.
    pub(crate) indices: fn(&mut [u32]),
    pub(crate) place: fn(Result<u32, Fault>) -> Result<u32, Fault>,
    pub(crate) written: fn(&mut [u8]),
    pub(crate) size: fn(u32) -> u32,
}

impl ShapeMutation {
    pub(crate) const NONE: Self =
        Self { indices: |_| (), place: |place| place, written: |_| (), size: |size| size };
}

/// The expected size of an element in bytes; `None` if the size of the value does not match its
/// type and dimensions.
fn each(of: &Described<'_>) -> Option<u32> {
    let size = u128::from(of.size);
    // The callers pass at most four dimensions, so that the product fits 128 bits.
    let count = of.dimensions.iter().map(|&dimension| u128::from(dimension)).product::<u128>();
    match (of.data_type.size(), count) {
        (Some(each), _) => (count.checked_mul(each.into()) == Some(size)).then_some(each),
        (None, 0) => (size == 0).then_some(0),
        (None, 1) => Some(of.size),
        (None, _) => (size > 0 && size % count == 0).then(|| (size / count) as u32),
    }
}

/// The expected index of the element, computed from the sizes of the inner arrays, or the expected
/// fault of the indices.
fn place(of: &Described<'_>) -> Result<u128, Fault> {
    let fault = |kind, field, offset, expected: usize, found: u32| {
        Err(Fault { kind, field, offset, expected, found: found as usize })
    };
    let (indices, dimensions) = (of.indices, of.dimensions);
    if indices.len() != dimensions.len() {
        let given = indices.len() as u32;
        return fault(ErrorKind::Mismatch, "index_count", 0, dimensions.len(), given);
    }
    let mut place = 0;
    for (at, (&index, &dimension)) in indices.iter().zip(dimensions).enumerate() {
        if dimension == 0 {
            return fault(ErrorKind::Missing, "dimension", at, 0, 0);
        }
        if index >= dimension {
            return fault(ErrorKind::OutOfRange, "index", at, dimension as usize - 1, index);
        }
        let inner = dimensions[at + 1..].iter().map(|&dimension| u128::from(dimension));
        place += u128::from(index) * inner.product::<u128>();
    }
    Ok(place)
}

/// Checks that a shape is accepted exactly if its size matches its type and dimensions, and that
/// the index of an element is the expected one. A value that fits the shape must encode to the same
/// bytes. Returns the number of elements, or the kind of the error.
pub(crate) fn check_shape(of: &Described<'_>, mutation: ShapeMutation) -> Result<u32, ErrorKind> {
    let dimensions = U32List::from(of.dimensions);
    let shape = Shape::new(of.data_type, dimensions, (mutation.size)(of.size));
    let wanted = each(of);
    assert_eq!(shape.map(|shape| shape.element_size()).ok(), wanted, "{of:?}");
    let shape = shape.map_err(|error| error.kind())?;
    assert_eq!(
        (shape.size(), shape.data_type(), shape.dimensions()),
        (of.size, of.data_type, dimensions)
    );

    let mut indices = of.indices.to_vec();
    (mutation.indices)(&mut indices);
    let indices = U32List::from(&indices[..]);
    let found = (mutation.place)(shape.index_of(indices).map_err(Fault::of));
    let wanted = place(of);
    assert_eq!(found.map(u128::from), wanted, "{of:?}");

    let elements = shape.elements(of.bytes);
    let open = of.data_type == DataType::String && shape.count() == 1;
    let fits = open || of.bytes.len() == of.size as usize;
    assert_eq!(elements.is_ok(), fits, "{of:?}");
    let elements = elements.map_err(|error| error.kind())?;
    // A single text may have any length (VAR-25).
    let (count, each) =
        (shape.count() as usize, if open { of.bytes.len() } else { shape.element_size() as usize });
    assert_eq!((elements.len(), elements.iter().len()), (count, count));
    if let Ok(place) = wanted {
        let at = place as usize * each;
        let bytes = &of.bytes[at..at + each];
        let element = elements.element(indices).expect("an element");
        check_element(shape, element, bytes, mutation);
        check_element(shape, elements.get(place as usize).expect("it is there"), bytes, mutation);
    } else {
        assert_eq!(elements.element(indices).map_err(Fault::of).err(), wanted.err());
    }
    check_written(shape, elements, of.bytes, mutation);
    Ok(shape.count())
}

/// Checks that an element encodes to its bytes by `encode_value` and, if the shape of an element
/// has room for these bytes, also by this shape.
fn check_element(shape: Shape<'_>, element: Element<'_>, bytes: &[u8], mutation: ShapeMutation) {
    let mut buf = vec![0x55; bytes.len()];
    assert_eq!(element.encode_value(&mut buf), Ok(bytes));
    if bytes.len() <= shape.element_size() as usize {
        let mut buf = vec![0x55; bytes.len() + 1];
        assert_eq!(shape.element_shape().encode(&element, &mut buf), Ok(bytes));
        (mutation.written)(&mut buf[..bytes.len()]);
        assert_eq!((&buf[..bytes.len()], buf[bytes.len()]), (bytes, 0x55));
    }
}

fn check_written(shape: Shape<'_>, elements: Elements<'_>, bytes: &[u8], mutation: ShapeMutation) {
    let mut buf = vec![0x55; bytes.len() + 1];
    let written = shape.encode(&elements, &mut buf).map(<[u8]>::len);
    if bytes.len() > shape.size() as usize {
        assert_eq!(written.map_err(|error| error.kind()), Err(ErrorKind::TooLong));
        assert!(buf.iter().all(|&byte| byte == 0x55));
        return;
    }
    (mutation.written)(&mut buf[..bytes.len()]);
    assert_eq!((written, &buf[..bytes.len()], buf[bytes.len()]), (Ok(bytes.len()), bytes, 0x55));
    if let Some(less) = bytes.len().checked_sub(1) {
        let error = shape.encode(&elements, &mut buf[..less]).expect_err("a byte too few");
        assert_eq!(error.kind(), ErrorKind::BufferTooSmall);
    }
}
