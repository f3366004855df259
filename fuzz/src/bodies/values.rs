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
    Outcome::accepted((Subject::of(stream).made)(bytes, &bend(defect)))
}
