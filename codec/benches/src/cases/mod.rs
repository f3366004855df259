//! The cases, by subject.

mod descriptors;

use crate::Case;

/// All of them, in an order that stays.
pub fn all() -> impl ExactSizeIterator<Item = Case> {
    [descriptors::CASES].concat().into_iter()
}
