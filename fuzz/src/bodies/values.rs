//! The law of the targets `…_value`: the bytes of an encoded value decode to the same value.

use super::Family;
use super::bytes::bend_among;
use crate::common::Subject;
use crate::{Defect, Outcome};

/// Input: an index of the stream (1 byte), then the bytes from which a value of the stream is made.
///
/// The value encodes to as many bytes as announced, and the encoder rejects a smaller buffer. Every
/// reading accepts these bytes and gives the value.
pub(crate) fn check(family: Family, data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&stream) = family.get(usize::from(pick)) else { return Outcome::unread() };
    Outcome::accepted((Subject::of(stream).made)(bytes, &bend_among(&OF_BYTES, defect)))
}

/// The numbers in `bytes` of the defects that are seeded for this target. The target makes only
/// valid values, so it cannot reveal a defect of errors.
const OF_BYTES: [u8; 11] = [1, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15];

pub(crate) const DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "the announced length is one too high if it is eight or more",
    "the readings differ if the last byte is odd",
    "a byte 0xB5 is encoded as 0xB4 if there are more than 16 bytes",
    "a buffer that is too small is written into",
    "a vector has an extra byte if its last byte is 0",
    "a segment of more than four bytes is shown without its last byte",
    "`decode_prefix` returns one byte less if no byte follows the stream",
    "`decode_prefix` rejects an accepted stream of more than four bytes",
    "`BinWrite` writes a wrong last byte if there are more than four",
    "`BinRead` rejects an accepted stream of more than four bytes",
];
