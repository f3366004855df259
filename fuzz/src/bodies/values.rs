//! Value → encode → decode: the same value.

use super::Family;
use super::bytes::bend;
use crate::common::Subject;
use crate::{Defect, Outcome};

/// The first byte picks the stream, of the rest a value of it is made.
///
/// It encodes to as many bytes as announced, into no smaller buffer, and is what those are read
/// as; every reading accepts them.
pub(crate) fn check(family: Family, data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&stream) = family.get(usize::from(pick)) else { return Outcome::unread() };
    let as_of_bytes = (1..).zip(OF_BYTES).find(|(number, _)| defect.is(*number));
    let defect = as_of_bytes.map_or(Defect::NONE, |(_, number)| Defect::new(number));
    Outcome::accepted((Subject::of(stream).made)(bytes, &bend(defect)))
}

/// Those of the defects of bytes that show in good values: what is made has no error.
const OF_BYTES: [u8; 4] = [1, 3, 4, 5];

pub(crate) const DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "the length of what has eight bytes or more is announced one too long",
    "the readings differ if the last byte is odd",
    "of more than 32 bytes one of 0xB5 becomes 0xB4 when it is encoded",
];
