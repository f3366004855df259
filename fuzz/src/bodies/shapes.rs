//! Values of any type and dimensions.

use ads_cnc::value::DataType;

use super::input::Input;
use crate::common::shapes::{Described, ShapeMutation, check_shape};
use crate::{Defect, Outcome};

/// Input: the type, the number of dimensions, the dimensions, the indices (one for each dimension,
/// or one more), and the size, where 0 means the actual size. Each number takes a byte, or 0xFF and
/// four bytes. The rest is the value.
///
/// A shape is accepted if and only if its size is that of all its elements. An element has the
/// offset that it has in nested arrays, and a value that was read is written back unchanged.
pub(crate) fn typed(data: &[u8], defect: Defect) -> Outcome {
    let mut input = Input::new(data);
    let data_type = *input.choose(&DataType::ALL);
    let count = input.byte();
    let dimensions: Vec<u32> = (0..count % 5).map(|_| number(&mut input)).collect();
    let more = usize::from(count >= 0xF0);
    let indices: Vec<u32> = (0..dimensions.len() + more).map(|_| number(&mut input)).collect();
    let size = number(&mut input);
    let bytes = input.bytes(usize::MAX);
    let size = if size == 0 { u32::try_from(bytes.len()).unwrap_or(u32::MAX) } else { size };
    let of = Described { data_type, dimensions: &dimensions, size, indices: &indices, bytes };
    match check_shape(&of, mutation(defect)) {
        // The value that is read is a part of the input, so the input serves as the result.
        Ok(count) => Outcome::accepted((count, data)),
        Err(kind) => Outcome::rejected(format!("{kind:?}")),
    }
}

fn number(input: &mut Input<'_>) -> u32 {
    match input.byte() {
        0xFF => input.long(),
        byte => byte.into(),
    }
}

pub(crate) const DEFECTS: &[&str] = &[
    "the first index runs fastest",
    "an error about a later dimension names the first one",
    "the top bit of the second byte is lost when it is written",
    "the size may exceed that of the elements by one byte",
    "the position of an element after the ninth is one too high",
];

fn mutation(defect: Defect) -> ShapeMutation {
    let mut mutation = ShapeMutation::NONE;
    if defect.is(1) {
        mutation.indices = <[u32]>::reverse;
    }
    if defect.is(2) {
        mutation.place = |place| {
            place.map_err(|mut fault| {
                fault.offset = 0;
                fault
            })
        };
    }
    if defect.is(3) {
        mutation.written = |bytes| {
            if let Some(second) = bytes.get_mut(1) {
                *second &= 0x7F;
            }
        };
    }
    if defect.is(4) {
        mutation.size = |size| if size > 8 && size % 2 == 1 { size - 1 } else { size };
    }
    if defect.is(5) {
        mutation.place = |place| place.map(|place| place + u32::from(place > 8));
    }
    mutation
}
