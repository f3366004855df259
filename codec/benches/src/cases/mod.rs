//! The cases, by subject.

pub(crate) mod descriptors;

use crate::Case;

/// All of them, in an order that stays.
pub fn all() -> impl Iterator<Item = Case> {
    [descriptors::CASES].into_iter().flatten().copied()
}

/// Those that have limits, and those they are held against.
pub fn gate() -> impl Iterator<Item = Case> {
    all().filter(Case::is_gated)
}

/// What is measured beside them.
pub fn others() -> impl Iterator<Item = Case> {
    all().filter(|case| !case.is_gated())
}
