//! Value → encode → decode: the same value.

use super::Family;
use super::bytes::bend_among;
use crate::common::Subject;
use crate::{Defect, Outcome};

/// The first byte picks the stream, of the rest a value of it is made.
///
/// It encodes to as many bytes as announced, into no smaller buffer, and is what those are read
/// as; every reading accepts them.
pub(crate) fn check(family: Family, data: &[u8], defect: Defect) -> Outcome {
    let Some((&pick, bytes)) = data.split_first() else { return Outcome::unread() };
    let Some(&stream) = family.get(usize::from(pick)) else { return Outcome::unread() };
    Outcome::accepted((Subject::of(stream).made)(bytes, &bend_among(&OF_BYTES, defect)))
}

/// Those of the defects of bytes that show in good values: what is made has no error.
const OF_BYTES: [u8; 11] = [1, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15];

pub(crate) const DEFECTS: &[&str] = &[
    "the last byte loses its top bit when it is encoded",
    "the length of what has eight bytes or more is announced one too long",
    "the readings differ if the last byte is odd",
    "of more than 16 bytes one of 0xB5 becomes 0xB4 when it is encoded",
    "a buffer that is too small is written into",
    "a vector has a byte too much if the last is 0",
    "a segment of more than four bytes is shown as one byte less",
    "a stream that no byte follows has one byte less by `decode_prefix`",
    "`decode_prefix` rejects an accepted stream of more than four bytes",
    "`BinWrite` writes the last of more than four bytes wrong",
    "`BinRead` rejects an accepted stream of more than four bytes",
];
